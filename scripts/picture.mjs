// Takes the README's picture from the built page, in the middle of a movement: docs/demo.webp.
import { mkdir, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { buildDemo } from "./build-demo.mjs";
import { ensureChromium } from "./chromium.mjs";
import { main } from "./run.mjs";

const file = fileURLToPath(new URL("../docs/demo.webp", import.meta.url));

/** A README is read over slow lines, too. */
const LARGEST = 200_000;

await main(import.meta.url, async () => {
  await buildDemo();
  await ensureChromium();
  // they need what was built
  const { movement } = await import("../tests/browser/hand.mjs");
  const { launch, middles, mouse, open, read, serve } = await import("../tests/browser/support.mjs");
  const host = await serve();
  const browser = await launch();
  const { page, problems } = await open(browser, host.url, { viewport: { width: 1280, height: 800 }, deviceScaleFactor: 2 });
  const hand = await mouse(page);
  const icons = new Map((await middles(page)).map((icon) => [icon.id, icon]));

  const tour = ["lights", "help", "navigation", "calendar", "phone", "camera", "tyres"].map((id) => icons.get(id));
  await hand.play([[0, tour[0].x, tour[0].y]]);
  for (const [index, to] of tour.slice(1).entries()) {
    await hand.rest(0.3);
    await hand.play(movement(tour[index], to, to.width, { seed: index }));
    await hand.rest(0.06);
    await hand.press(to);
  }
  await hand.rest(0.6);
  const to = icons.get("seats");
  await hand.play(movement(tour.at(-1), to, to.width, { seed: 2, share: 0.78 }));
  await read(page);
  await page.waitForTimeout(900);
  await mkdir(new URL("../docs/", import.meta.url), { recursive: true });
  const session = await page.context().newCDPSession(page);
  const { data } = await session.send("Page.captureScreenshot", { format: "webp", quality: 85 });
  const picture = Buffer.from(data, "base64");
  await writeFile(file, picture);
  await browser.close();
  await host.close();

  if (problems.length > 0 || picture.length > LARGEST)
    throw new Error([`docs/demo.webp has ${picture.length} bytes`, ...problems].join("\n"));
  console.log(`docs/demo.webp: ${picture.length} bytes`);
});
