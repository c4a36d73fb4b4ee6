// A watcher that has stopped leaves nothing on the page: each listener, observer, frame, timer and predictor is counted.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "../browser/hand.mjs";
import { AWAY, CORNERS, hosted, MIDDLE, mouse, open, reach, read, scripted, sleep } from "./page.mjs";
import { count } from "./standing.mjs";

describe("stop", () => {
  const site = hosted();

  it("leaves nothing behind: listeners, observers, frames, timers, predictors, attributes", async () => {
    const { page, close } = await open(site, `<div style="height:2000px">${CORNERS}</div>`, {
      hasTouch: true,
      head: `<script>(${count})()</script>`,
      script: `
        const { PointerPredictor } = await import("./pointing.js");
        window.used = new Set();
        for (const name of ["observe", "setTargets", "free"]) {
          const original = PointerPredictor.prototype[name];
          PointerPredictor.prototype[name] = function (...given) {
            name === "free" ? used.delete(this) : used.add(this);
            return original.apply(this, given);
          };
        }`,
    });
    const standing = () => page.evaluate(() => ({ ...standing(), predictors: used.size }));
    // a style that was written to is spaced as browsers do
    const html = () =>
      page.evaluate(() => document.body.innerHTML.replace(/style="[^"]*"/g, (style) => style.replace(/ |;(?=")/g, "")));
    await page.evaluate(() => frames(2));
    const [before, page0] = [await standing(), await html()];
    await page.evaluate(async () => {
      const pending = () => new Promise(() => {});
      const options = {
        raw: true,
        learning: true,
        record: true,
        signal: new AbortController().signal,
        reasons: { pointer: { after: 20 }, keyboard: { tabs: 2 }, viewport: { after: 5000 } },
        onIntent: pending,
      };
      window.watcher = whither.watch("button", { load: "eager", ...options });
      window.shape = whither.watch(
        { id: "s", bounds: () => ({ x: 300, y: 300, width: 40, height: 40 }) },
        { load: "idle", ...options },
      );
      watcher.subscribe(() => {});
      await watcher.ready;
      await frames(3);
    });
    const during = await standing();
    assert.ok(during.listeners > before.listeners && during.observers > before.observers, JSON.stringify(during));
    const hand = await mouse(page);
    await reach(hand, MIDDLE.b);
    await page.keyboard.press("Tab");
    await page.touchscreen.tap(MIDDLE.a.x, MIDDLE.a.y);
    // in the middle of things
    await hand.play(movement(AWAY, MIDDLE.c, 60, { seed: 2, share: 0.8 }));
    assert.ok((await standing()).predictors > 0);
    assert.notEqual(await html(), page0);
    await page.evaluate(() => {
      window.prior = document.querySelector("#b");
      watcher.stop();
      shape[Symbol.dispose]?.();
      shape.stop();
      watcher.stop();
    });
    assert.deepEqual(await standing(), before);
    await page.evaluate(() => frames(3));
    await reach(hand, MIDDLE.b);
    assert.deepEqual(await standing(), before);
    assert.equal(await html(), page0);
    await close();
  });

  it("ends what is read: nothing is moving, and no callback is called", async () => {
    const { page, step, close } = await scripted(site);
    await step({});
    await step({ c: 0.9 });
    await page.evaluate(() => {
      watcher.stop();
      log.length = 0;
    });
    assert.deepEqual((await read(page)).best, null);
    await step({ d: 0.9 });
    const hand = await mouse(page);
    await hand.press({ x: 350, y: 350 });
    await page.keyboard.press("Tab");
    await sleep(0.1);
    assert.deepEqual(await page.evaluate(() => [log, watcher.none, watcher.getSnapshot().moving]), [[], 1, false]);
    await close();
  });

  it("leaves nothing of ten thousand rows that come and go", async () => {
    const { page, close } = await open(site, `<div id="list"></div>`, {
      head: `<script>(${count})()</script>`,
      script: `window.watcher = record(".row", { predictor: scriptedPredictor }); await frames(3);`,
    });
    const result = await page.evaluate(async () => {
      const list = document.querySelector("#list");
      await frames(3);
      const before = standing();
      for (let round = 0; round < 10; round += 1) {
        list.innerHTML = Array.from({ length: 1000 }, (_, k) => `<p class="row" id="r${k}">${k}</p>`).join("");
        await frames(2);
        list.replaceChildren();
        await frames(2);
      }
      await frames(3);
      const after = standing();
      return { before, after, targets: watcher.targets.length };
    });
    assert.equal(result.targets, 0);
    assert.deepEqual(result.after, result.before);
    await close();
  });
});
