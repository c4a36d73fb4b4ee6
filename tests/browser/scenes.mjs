// The pages of the demo. What holds for all of them is in scenes.test.mjs.
import { PAGES } from "../../www/frame.js";
import { makeMovements } from "./lab.mjs";
import { head, mouse } from "./support.mjs";

/** Uses a page until every text and number is on it, by its path; where there is none they are from the beginning. */
const FILLED = {
  "index.html": async (page) => {
    const hand = await mouse(page);
    const { end } = await head(page, hand, "fuel", "connections", { seed: 5 });
    await hand.press(end);
  },
  "bay/index.html": async (page) => {
    await page.locator("#hundred").click();
    await page.waitForFunction(() => document.querySelectorAll(".berth-line:not(.empty)").length > 12);
  },
  "lab/index.html": (page) => makeMovements(page, 2),
  // until the first of the hundred gestures is scored
  "cockpit/index.html": async (page) => {
    await page.locator("#hundred").scrollIntoViewIfNeeded();
    await page.waitForFunction(() => document.querySelector("#scores td")?.textContent !== "–");
    await page.locator("#run").click();
  },
};

/** `{ path, name, fill(page) }` for each page, in the order of the navigation. */
export const SCENES = PAGES.map(({ path, name }) => ({ path, name, fill: FILLED[path] ?? (() => Promise.resolve()) }));
