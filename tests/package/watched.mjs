// A user's page whose links are watched by whither/dom, and what Chromium does on it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { root } from "../../scripts/run.mjs";
import { movement } from "../browser/hand.mjs";
import { mouse, REST } from "../browser/support.mjs";
import { inTab } from "./support.mjs";

/** Watches three links in a row, which have no style sheet, since a policy may forbid it; `?load=eager` is the option. */
export const watching = `for (const [i, id] of ["left", "middle", "right"].entries()) {
  const link = document.createElement("a");
  Object.assign(link, { id, href: "#" + id, textContent: id });
  Object.assign(link.style, { position: "absolute", left: 100 + 400 * i + "px", top: "100px", width: "90px", height: "40px" });
  document.body.append(link);
}
window.records = { best: [], intents: [], errors: [] };
window.watcher = watch("a", {
  load: new URLSearchParams(location.search).get("load") ?? undefined,
  onPrediction: ({ best }) => best && window.records.best.push([best.target.id, best.probability]),
  onIntent: ({ target, reason }) => void window.records.intents.push([target.id, reason]),
  onError: ({ name, code }) => window.records.errors.push([name, code]),
});
`;

/** A module that does so. */
export const program = (entry = "whither/dom") => `import { watch } from "${entry}";\n${watching}`;

const center = { left: { x: 145, y: 120 }, middle: { x: 545, y: 120 }, right: { x: 945, y: 120 } };

/** How the bytes of the core's WebAssembly begin, in whatever file they are. */
const bytes = readFileSync(join(root, "dist/pointing-bytes.js"), "utf8").match(/H4sI[\w+/]{60}/)[0];

/** The scripts that a tab requests, as they come: `cores()` are those with the core's bytes in them. */
function requested(tab) {
  const texts = [];
  tab.on("response", (response) => {
    if (/\.(js|mjs|ts)$/.test(new URL(response.url()).pathname)) texts.push(response.text());
  });
  return {
    count: () => texts.length,
    cores: async () => (await Promise.all(texts)).filter((text) => text.includes(bytes)).length,
  };
}

/** Opens the page at `url`; `use` is given the tab, its scripts, what the program records, and a mouse. */
async function opened(browser, url, use, { load, expected } = {}) {
  const visit = async (tab) => {
    const scripts = requested(tab);
    await tab.setViewportSize({ width: 1280, height: 800 });
    await tab.goto(load === undefined ? url : `${url}?load=${load}`);
    await tab.waitForFunction(() => window.watcher !== undefined);
    await tab.waitForLoadState("networkidle");
    await use({ tab, scripts, hand: await mouse(tab), records: () => tab.evaluate(() => window.records) });
    await tab.evaluate(() => window.watcher.stop());
  };
  await inTab(browser, visit, expected);
}

const start = { x: 300, y: 700 };

/** Moves the mouse from below to a link. */
async function head(hand, to) {
  await hand.play([[0, start.x, start.y]]);
  await hand.rest(REST);
  await hand.play(movement(start, center[to], 40, { seed: 3 }));
}

/** The core is not requested until a pointer moves; then links are predicted and intended. */
export async function assertWatched(browser, url, { inOneFile = false, ...options } = {}) {
  await opened(
    browser,
    url,
    async ({ tab, scripts, hand, records }) => {
      const before = scripts.count();
      assert.equal(await scripts.cores(), inOneFile ? 1 : 0, "nothing has moved, and the core is there");
      await hand.play([
        [0, start.x, start.y],
        [0.02, start.x + 3, start.y],
      ]);
      await tab.evaluate(() => window.watcher.ready);
      await tab.waitForLoadState("networkidle");
      assert.equal(await scripts.cores(), 1, "the core is there once");
      if (!inOneFile) assert.ok(scripts.count() > before, "in a file of its own");
      await hand.rest(REST);
      await head(hand, "right");
      await tab.waitForFunction(() => window.records.intents.length > 0);
      const { best, intents, errors } = await records();
      assert.ok(
        best.some(([id, probability]) => id === "right" && probability > 0.8),
        `predicted: ${JSON.stringify(best)}`,
      );
      assert.deepEqual([intents, errors], [[["right", "pointer"]], []]);
    },
    options,
  );
}

/** With `load: "eager"` the core is requested at once. */
export async function assertEager(browser, url, options) {
  await opened(
    browser,
    url,
    async ({ tab, scripts }) => {
      await tab.evaluate(() => window.watcher.ready);
      assert.equal(await scripts.cores(), 1);
    },
    { ...options, load: "eager" },
  );
}

/** Where the core cannot load, that is reported once, and the signs that need no core go on. */
export async function assertFallsBack(browser, url, options) {
  await opened(
    browser,
    url,
    async ({ tab, hand, records }) => {
      const intended = (count) => tab.waitForFunction((count) => window.records.intents.length === count, count);
      const jump = (to) =>
        hand.play([
          [0, start.x, start.y],
          [0.02, center[to].x, center[to].y],
        ]);
      await jump("right");
      assert.equal(await tab.evaluate(() => window.watcher.ready.catch(({ code }) => code)), "wasm-unavailable");
      await intended(1);
      await jump("left");
      await hand.press(center.left);
      await intended(2);
      await tab.keyboard.press("Tab");
      await intended(3);
      const { best, intents, errors } = await records();
      assert.deepEqual(intents, [
        ["right", "hover"],
        ["left", "press"],
        ["middle", "focus"],
      ]);
      assert.deepEqual([best, errors], [[], [["WhitherError", "wasm-unavailable"]]]);
    },
    options,
  );
}
