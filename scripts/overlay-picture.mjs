// Takes the picture of docs/overlay.md from examples/dom/overlay.html, in the middle of a movement: docs/overlay.webp.
import { writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { movement } from "../tests/browser/hand.mjs";
import { launch, mouse, nextFrame } from "../tests/browser/support.mjs";
import { build } from "./build.mjs";
import { ensureChromium } from "./chromium.mjs";
import { main, root } from "./run.mjs";
import { serve } from "./serve.mjs";

const file = fileURLToPath(new URL("../docs/overlay.webp", import.meta.url));

const LARGEST = 150_000;

/** Where the hand goes, in turn: what it presses, and at last what it is on its way to. */
const TOUR = ["ryde", "today", "southampton", "lymington", "wind", "portsmouth", "cowes", "bembridge", "beaulieu"];
const LAST = "ryde";

await main(import.meta.url, async () => {
  await build();
  await ensureChromium();
  const host = await serve(root);
  const browser = await launch();
  const page = await browser.newPage({ viewport: { width: 1280, height: 810 }, deviceScaleFactor: 1.5, colorScheme: "dark" });
  await page.goto(`${host.url}examples/dom/overlay.html`);
  await page.click("#look");
  await page.waitForSelector("whither-overlay", { state: "attached" });
  const middle = async (name) => {
    const { x, y, width, height } = await page.locator(`a[href="#${name}"]`).boundingBox();
    return { x: x + width / 2, y: y + height / 2, size: Math.min(width, height) };
  };
  const hand = await mouse(page);
  let from = { x: 640, y: 600 };
  await hand.play([[0, from.x, from.y]]);
  for (const [index, name] of TOUR.entries()) {
    const to = await middle(name);
    await hand.rest(0.35);
    await hand.play(movement(from, to, to.size, { seed: index }));
    await hand.rest(0.06);
    await hand.press(to);
    from = to;
  }
  await page.evaluate(() => {
    const [, ledger] = document.querySelector("whither-overlay").shadowRoot.querySelectorAll("details");
    ledger.open = true;
  });
  await hand.rest(0.6);
  const to = await middle(LAST);
  await hand.play(movement(from, to, to.size, { seed: 3, share: 0.62 }));
  await nextFrame(page);
  const session = await page.context().newCDPSession(page);
  const { data } = await session.send("Page.captureScreenshot", { format: "webp", quality: 85 });
  const picture = Buffer.from(data, "base64");
  await writeFile(file, picture);
  await browser.close();
  await host.close();
  if (picture.length > LARGEST) throw new Error(`docs/overlay.webp has ${picture.length} bytes`);
  console.log(`docs/overlay.webp: ${picture.length} bytes`);
});
