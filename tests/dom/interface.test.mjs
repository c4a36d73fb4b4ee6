// What a watcher does: changes on the way, reads, stores, several on a page, loading.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "../browser/hand.mjs";
import { AWAY, CORNERS, hosted, logged, MIDDLE, mouse, open, read, reach, REST, scripted } from "./page.mjs";

const READY = `window.watcher = record("button"); await watcher.ready; await frames(2);`;
const targets = async (page, kind = "intent") => (await logged(page, kind)).map(({ target }) => target);

describe("watch", () => {
  const site = hosted();

  describe("changes", () => {
    it("updates options: what is left out stays, undefined is the default", async () => {
      const { page, step, close } = await scripted(site, "{ threshold: 0.9 }");
      await step({});
      await page.evaluate(() => watcher.update({ none: 0.1 }));
      await step({ c: 0.85 });
      assert.deepEqual(await targets(page), []);
      await page.evaluate(() => watcher.update({ threshold: undefined }));
      await step({ c: 0.85 });
      assert.deepEqual(await targets(page), ["c"]);
      await page.evaluate(() =>
        watcher.update({ onIntent: ({ target }) => void log.push({ kind: "other", target: target.id }) }),
      );
      await step({ d: 0.85 });
      assert.deepEqual([await targets(page), await targets(page, "other")], [["c"], ["d"]]);
      await close();
    });

    it("gives a changed prior of none to the model, and its constants", async () => {
      const { page, step, close } = await scripted(site, "{ none: 0.25, constants: { motion: { noise: 700 } } }");
      await step({});
      await step({});
      assert.deepEqual(await page.evaluate(() => scriptedPredictor.options), {
        none: 0.25,
        constants: { motion: { noise: 700 } },
        learning: false,
      });
      await page.evaluate(() => watcher.update({ none: 0.3 }));
      await step({});
      await step({});
      assert.equal(await page.evaluate(() => scriptedPredictor.options.none), 0.3);
      await close();
    });

    it("sets what holds for one target, and null sets it back", async () => {
      const { page, step, rest, close } = await scripted(site);
      const set = (options) => page.evaluate((options) => watcher.set(document.querySelector("#c"), options), options);
      await set({ threshold: 0.3, name: "third", data: 3 });
      await step({});
      await step({ c: 0.4, d: 0.4 });
      assert.deepEqual(
        (await logged(page, "intent")).map(({ target, name, data }) => [target, name, data]),
        [["c", "third", 3]],
      );
      await set(null);
      await rest();
      await step({ c: 0.4 });
      assert.deepEqual(await targets(page), ["c"]);
      await set({ enabled: false });
      await step({ c: 0.9 });
      assert.deepEqual(
        [await targets(page), await page.evaluate(() => watcher.probability(document.querySelector("#c")))],
        [["c"], 0],
      );
      await close();
    });

    it("adds and removes targets", async () => {
      const { page, close } = await open(site, `${CORNERS}<i id="i"></i>`, {
        script: `window.watcher = record(document.querySelector("#a")); await watcher.ready;`,
      });
      const result = await page.evaluate(() => {
        const element = (id) => document.querySelector(`#${id}`);
        const shape = { id: "shape", bounds: () => ({ x: 500, y: 300, width: 30, height: 40 }) };
        const results = [];
        for (const change of [
          () => watcher.add(element("b"), shape),
          () => watcher.add(element("b")),
          () => watcher.remove(element("a"), shape),
          () => watcher.remove(element("i")),
        ]) {
          change();
          results.push(watcher.targets.map(nameOf));
        }
        return results;
      });
      assert.deepEqual(result, [["a", "b", "shape"], ["a", "b", "shape"], ["b"], ["b"]]);
      await reach(await mouse(page), MIDDLE.b);
      assert.deepEqual(await targets(page), ["b"]);
      await close();
    });

    it("keeps what was removed from a selector's targets away, and takes what is added to them", async () => {
      const { page, close } = await open(site, `${CORNERS}<i id="i"></i>`, { script: READY });
      const result = await page.evaluate(async () => {
        watcher.remove(document.querySelector("#a"));
        watcher.add(document.querySelector("#i"));
        document.body.append(Object.assign(document.createElement("button"), { id: "late" }));
        await frames(3);
        return watcher.targets.map(nameOf);
      });
      assert.deepEqual(result.sort(), ["b", "c", "i", "late"]);
      await close();
    });

    it("reads again what nothing reports, on refresh", async () => {
      const body = `<input type="checkbox" id="one"><input type="checkbox" id="two" checked>`;
      const { page, close } = await open(site, body, { script: `window.watcher = record("input:checked"); await frames(2);` });
      const result = await page.evaluate(async () => {
        document.querySelector("#one").checked = true;
        watcher.refresh();
        await frames(2);
        return watcher.targets.map(nameOf);
      });
      assert.deepEqual(result, ["one", "two"]);
      await close();
    });

    it("follows nothing while it pauses, and goes on afterwards", async () => {
      const { page, close } = await open(site, CORNERS, { script: READY });
      const hand = await mouse(page);
      await reach(hand, MIDDLE.b, { share: 0.8 });
      assert.equal((await read(page)).best.target, "b");
      await page.evaluate(() => watcher.pause());
      assert.deepEqual(await read(page), {
        best: null,
        none: 1,
        moving: false,
        intended: [],
        probabilities: { a: 0, b: 0, c: 0 },
      });
      await page.evaluate(() => (log.length = 0));
      await reach(hand, MIDDLE.c);
      await hand.press(MIDDLE.c);
      assert.deepEqual(await page.evaluate(() => log), []);
      await page.evaluate(() => watcher.resume());
      await reach(hand, MIDDLE.a);
      assert.deepEqual(await targets(page), ["a"]);
      await close();
    });
  });

  describe("reads", () => {
    it("has the time to the entry, a forecast and paths during a movement, and none between", async () => {
      const { page, close } = await open(site, CORNERS, { script: READY });
      const reads = () =>
        page.evaluate(async () => {
          await frames(1);
          const b = document.querySelector("#b");
          return {
            remaining: watcher.remaining,
            now: watcher.forecast(0),
            later: watcher.forecast(0.5),
            path: [...watcher.path(b, [0, 0.1, 0.4])],
            elsewhere: watcher.probability(document.body),
          };
        });
      assert.deepEqual(await reads(), { remaining: null, now: null, later: null, path: [], elsewhere: 0 });
      const hand = await mouse(page);
      const samples = movement(AWAY, MIDDLE.b, 60, { seed: 1, share: 0.6 });
      await reach(hand, MIDDLE.b, { share: 0.6 });
      const { remaining, now, later, path, elsewhere } = await reads();
      assert.ok(remaining.low > 0 && remaining.low <= remaining.mean && remaining.mean <= remaining.high && remaining.high < 2);
      const [, x, y] = samples.at(-1);
      assert.ok(Math.hypot(now.mean[0] - x, now.mean[1] - y) < 80, `${now.mean} at ${x}, ${y}`);
      assert.ok(later.mean[0] > now.mean[0] && later.mean[1] < now.mean[1], `${later.mean}`);
      assert.deepEqual([path.length, elsewhere], [6, 0]);
      assert.ok(Math.hypot(path[4] - MIDDLE.b.x, path[5] - MIDDLE.b.y) < Math.hypot(path[0] - MIDDLE.b.x, path[1] - MIDDLE.b.y));
      await close();
    });

    it("is a store: the same immutable snapshot until something changes, and listeners are called when it does", async () => {
      const { page, step, rest, close } = await scripted(site);
      await page.evaluate(() => {
        window.calls = 0;
        window.unsubscribe = watcher.subscribe(() => (calls += 1));
        window.first = watcher.getSnapshot();
      });
      await page.evaluate(() => frames(3));
      assert.ok(await page.evaluate(() => watcher.getSnapshot() === first && calls === 0), "nothing has changed");
      await step({});
      await step({ c: 0.9, d: 0.05, e: 0.005 });
      const moving = await page.evaluate(() => {
        window.second = watcher.getSnapshot();
        window.counted = calls;
        const { moving, best, none, targets, intended } = second;
        const plain = ({ target, ...more }) => ({ target: target.id, ...more });
        return {
          moving,
          best: plain(best),
          none,
          targets: targets.map(plain),
          intended: intended.map(nameOf),
          again: second === watcher.getSnapshot(),
        };
      });
      assert.ok(Math.abs(moving.none - 0.045) < 1e-9);
      assert.deepEqual(
        { ...moving, none: null },
        {
          moving: true,
          best: { target: "c", id: "c", probability: 0.9 },
          none: null,
          targets: [
            { target: "c", id: "c", probability: 0.9 },
            { target: "d", id: "d", probability: 0.05 },
          ],
          intended: ["c"],
          again: true,
        },
      );
      assert.ok(
        await page.evaluate(() => calls > 0 && first !== second && first.best === null && first.none === 1 && !first.moving),
      );
      await page.evaluate(() => frames(3));
      assert.ok(await page.evaluate(() => watcher.getSnapshot() === second && calls === counted), "no event, no change");
      await rest();
      await page.evaluate(() => {
        unsubscribe();
        calls = 0;
      });
      await step({ d: 0.9 });
      assert.ok(await page.evaluate(() => calls === 0 && second.best.target.id === "c" && second.targets.length === 2));
      await close();
    });

    it("calls onPrediction with the snapshot, at most once a frame", async () => {
      const { page, close } = await open(site, CORNERS, {
        script: `
          window.predictions = [];
          window.frame = 0;
          requestAnimationFrame(function count() { frame += 1; requestAnimationFrame(count); });
          window.watcher = record("button", { onPrediction: (snapshot) => predictions.push([frame, snapshot === watcher.getSnapshot(), snapshot.moving]) });
          await watcher.ready; await frames(2);`,
      });
      await reach(await mouse(page), MIDDLE.b);
      const predictions = await page.evaluate(() => predictions);
      assert.ok(predictions.length > 10, `${predictions.length}`);
      assert.equal(new Set(predictions.map(([frame]) => frame)).size, predictions.length, "two in a frame");
      assert.ok(predictions.every(([, same]) => same));
      await close();
    });
  });

  it("stops by its AbortSignal, also by one that has aborted before", async () => {
    const { page, step, close } = await scripted(site, "{ signal: (window.controller = new AbortController()).signal }");
    await step({});
    await page.evaluate(() => controller.abort());
    await step({ c: 0.9 });
    assert.deepEqual(await targets(page), []);
    const result = await page.evaluate(async () => {
      const watcher = record("button", { signal: AbortSignal.abort() });
      point("pointermove", [performance.now(), 300, 300]);
      point("pointerdown", [performance.now(), 350, 350]);
      await frames(3);
      return [watcher.best, watcher.none, log.length];
    });
    assert.deepEqual(result, [null, 1, 0]);
    await close();
  });

  it("is one of several on a page, which do not know each other", async () => {
    const { page, step, close } = await scripted(site);
    await page.evaluate(async () => {
      window.logs = [[], []];
      window.others = [0.5, 0.95].map((threshold, k) => record("button", { threshold, predictor: scriptedPredictor }, logs[k]));
      await frames(3);
    });
    await step({});
    await step({ c: 0.6 });
    await step({ c: 0.9 });
    const counts = () => page.evaluate(() => logs.map((log) => log.filter(({ kind }) => kind === "intent").length));
    assert.deepEqual([await targets(page), await counts()], [["c"], [1, 0]]);
    await page.evaluate(() => others[0].stop());
    await step({ d: 0.96 });
    assert.deepEqual(
      [await targets(page), await counts()],
      [
        ["c", "d"],
        [1, 1],
      ],
    );
    await close();
  });

  describe("loading", () => {
    it("keeps samples until the core is there, so that the first movement is predicted", async () => {
      const { page, close } = await open(site, CORNERS);
      let release;
      const held = new Promise((resolve) => (release = resolve));
      let asked = false;
      await page.route("**/pointing-bytes.js", async (route) => {
        asked = true;
        await held;
        await route.continue();
      });
      await page.evaluate(async () => {
        window.watcher = record("button", { load: undefined });
        await frames(3);
      });
      assert.equal(asked, false, "it is not fetched before a pointer moves");
      const hand = await mouse(page);
      await hand.play([[0, AWAY.x, AWAY.y]]);
      await hand.rest(REST);
      const there = movement(AWAY, MIDDLE.b, 60, { seed: 1, share: 0.65 });
      const start = await hand.play(there);
      assert.equal(asked, true);
      assert.deepEqual([(await read(page)).best, await targets(page)], [null, []]);
      release();
      // the hand goes on slowly while it loads
      const [time, x, y] = there.at(-1);
      await hand.play(
        Array.from({ length: 20 }, (_, k) => [time + 0.1 + 0.01 * k, x + 4 * k, y - 3 * k]),
        start,
      );
      await page.evaluate(() => watcher.ready);
      const { best } = await read(page);
      assert.equal(best?.target, "b");
      await close();
    });

    it("fetches the core at once, or when the page is idle, where it is asked to", async () => {
      for (const load of ["eager", "idle"]) {
        const { page, close } = await open(site, CORNERS);
        await page.evaluate(async (load) => {
          window.watcher = record("button", { load });
          await watcher.ready;
        }, load);
        await close();
      }
    });

    it("loads nothing where another model is given", async () => {
      const asked = [];
      const { page, step, close } = await scripted(site);
      await page.route("**/pointing*.js", (route) => (asked.push(route.request().url()), route.continue()));
      await page.evaluate(() => watcher.ready);
      await step({});
      await step({ c: 0.9 });
      assert.deepEqual([asked, await targets(page)], [[], ["c"]]);
      assert.equal(
        await page.evaluate(() => performance.getEntriesByType("resource").some(({ name }) => name.includes("pointing"))),
        false,
      );
      await close();
    });
  });
});
