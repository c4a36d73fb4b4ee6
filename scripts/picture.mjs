// Takes the README's picture from the built page, while its simulated hand plays: docs/demo.webp, animated.
import { mkdir, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { buildDemo } from "./build-demo.mjs";
import { ensureChromium } from "./chromium.mjs";
import { main } from "./run.mjs";

const file = fileURLToPath(new URL("../docs/demo.webp", import.meta.url));

/** A README is read over slow lines, too. */
const LARGEST = 400_000;

/** Milliseconds on the page's clock: when the first frame is taken, after the hand has set out; between two; until the last; and how long that stays. */
const FIRST = 1600;
const STEP = 80;
const LENGTH = 6000;
const LAST = 1200;

/** Px. */
const WIDTH = 1200;

await main(import.meta.url, async () => {
  await buildDemo();
  await ensureChromium();
  // they need what was built
  const { open, launch, serve } = await import("../tests/browser/support.mjs");
  const { default: sharp } = await import("sharp");
  const host = await serve();
  const browser = await launch();
  const { page, problems } = await open(browser, host.url, { viewport: { width: 1280, height: 800 } });
  // however long a frame takes, the hand is where it is then
  await page.clock.install({ time: 0 });
  await page.clock.pauseAt(1000);
  await page.reload();
  await page.waitForFunction(() => "ready" in document.documentElement.dataset, null, { polling: 50 });
  const clip = await page.evaluate(() => {
    const [stage, status] = ["#screen", "#status"].map((each) => document.querySelector(each).getBoundingClientRect());
    const margin = 16;
    return { x: margin, y: stage.top - margin, width: innerWidth - 2 * margin, height: status.bottom - stage.top + 2 * margin };
  });
  await page.clock.runFor(FIRST);
  const frames = [];
  for (let time = 0; time < LENGTH; time += STEP) {
    await page.clock.runFor(STEP);
    frames.push(await page.screenshot({ clip }));
  }
  await browser.close();
  await host.close();

  const small = await Promise.all(frames.map((frame) => sharp(frame).resize({ width: WIDTH }).png().toBuffer()));
  const delay = small.map((_, index) => (index === small.length - 1 ? LAST : STEP));
  const picture = await sharp(small, { join: { animated: true } })
    .webp({ quality: 60, effort: 6, loop: 0, delay, mixed: true, minSize: true })
    .toBuffer();
  await mkdir(new URL("../docs/", import.meta.url), { recursive: true });
  await writeFile(file, picture);
  if (problems.length > 0 || picture.length > LARGEST)
    throw new Error([`docs/demo.webp has ${picture.length} bytes`, ...problems].join("\n"));
  console.log(`docs/demo.webp: ${frames.length} frames, ${picture.length} bytes`);
});
