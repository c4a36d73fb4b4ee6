// What `watch` takes and what its watcher does: targets of every kind, changes on the way, stores, loading, and stopping.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "../browser/hand.mjs";
import {
  AWAY,
  buttons,
  CORNERS,
  hosted,
  logged,
  MIDDLE,
  mouse,
  nextFrame,
  open,
  read,
  REST,
  ROW,
  scripted,
  sleep,
} from "./page.mjs";

const READY = `window.watcher = record("button"); await watcher.ready; await frames(2);`;
const names = (page) => page.evaluate(() => watcher.targets.map(nameOf));
const targets = async (page, kind = "intent") => (await logged(page, kind)).map(({ target }) => target);

/** A hand of Chromium's own that goes to a place, from where it rests. */
async function reach(hand, goal, { from = AWAY, ...options } = {}) {
  await hand.play([[0, from.x, from.y]]);
  await hand.rest(REST);
  await hand.play(movement(from, goal, 60, { seed: 1, ...options }));
}

describe("watch", () => {
  const site = hosted();

  describe("targets", () => {
    it("follows a live selector: what is added, what comes to match, what is taken away", async () => {
      const { page, close } = await open(site, `${CORNERS}<i id="later"></i>`, {
        script: `window.watcher = record("button, .also"); await watcher.ready; await frames(2);`,
      });
      assert.deepEqual(await names(page), ["a", "b", "c"]);
      await page.evaluate(async () => {
        const style = "position:absolute;left:80px;top:300px;width:80px;height:60px";
        document
          .querySelector("#b")
          .insertAdjacentHTML("beforebegin", `<div><button id="new" style="${style}">new</button></div>`);
        await frames(3);
      });
      assert.deepEqual(await names(page), ["a", "new", "b", "c"]);
      await reach(await mouse(page), { x: 120, y: 330 });
      assert.deepEqual(await targets(page), ["new"]);
      await page.evaluate(async () => {
        document.querySelector("#new").parentElement.remove();
        document.querySelector("#later").className = "also";
        document.querySelector("#a").remove();
        await frames(3);
      });
      assert.deepEqual(await names(page), ["b", "c", "later"]);
      await page.evaluate(async () => {
        document.querySelector("#later").className = "";
        await frames(3);
      });
      assert.deepEqual(await names(page), ["b", "c"]);
      await close();
    });

    it("takes an element, and any iterable of elements and virtual targets", async () => {
      const { page, close } = await open(site, CORNERS);
      const result = await page.evaluate(() => {
        const [a, b, c] = document.querySelectorAll("button");
        const shape = { id: "shape", bounds: () => ({ x: 1, y: 2, width: 30, height: 40 }) };
        function* some() {
          yield b;
          yield shape;
        }
        const given = [a, shape, [c, a], new Set([a, c, shape]), document.querySelectorAll("button"), some(), []];
        return given.map((targets) => {
          const watcher = record(targets);
          const found = watcher.targets.map(nameOf);
          watcher.stop();
          return found;
        });
      });
      assert.deepEqual(result, [["a"], ["shape"], ["c", "a"], ["a", "c", "shape"], ["a", "b", "c"], ["b", "shape"], []]);
      await close();
    });

    it("intends virtual targets on a canvas, where they are now", async () => {
      const { page, close } = await open(site, `<canvas width="1000" height="700" style="display:block"></canvas>`, {
        script: `
          window.shapes = [
            { id: "sun", x: 840, y: 80 },
            { id: "moon", x: 840, y: 560 },
          ].map((shape) => Object.assign(shape, { bounds: () => ({ x: shape.x, y: shape.y, width: 80, height: 60 }) }));
          window.watcher = record(shapes); await watcher.ready; await frames(2);`,
      });
      const hand = await mouse(page);
      await reach(hand, MIDDLE.b);
      assert.deepEqual(await targets(page), ["sun"]);
      assert.ok(await page.evaluate(() => watcher.best.target === shapes[0]), "the same object");
      await hand.press(MIDDLE.b);
      await nextFrame(page);
      assert.deepEqual(
        (await logged(page, "outcome")).map(({ target, verdict }) => [target, verdict]),
        [["sun", "right"]],
      );
      // they change places
      await page.evaluate(() => {
        [shapes[0].y, shapes[1].y] = [560, 80];
        log.length = 0;
      });
      await reach(hand, MIDDLE.b);
      assert.deepEqual(await targets(page), ["moon"]);
      await page.evaluate(async () => {
        shapes[1].bounds = () => ({ x: 840, y: 80, width: 0, height: 0 });
        log.length = 0;
        await frames(2);
      });
      await reach(hand, MIDDLE.b);
      assert.ok(!(await targets(page)).includes("moon"), "one without size cannot be meant");
      await close();
    });

    it("tells apart elements with the same id attribute and the same href", async () => {
      const place = (x, y) => `style="position:absolute;left:${x}px;top:${y}px;width:80px;height:60px"`;
      const body = `<a id="same" data-name="first" href="/x" ${place(80, 80)}>1</a><a id="same" data-name="second" href="/x" ${place(840, 80)}>2</a>`;
      const { page, problems, close } = await open(site, body, {
        script: `window.watcher = record("a"); await watcher.ready; await frames(2);`,
      });
      const hand = await mouse(page);
      await reach(hand, MIDDLE.b);
      await reach(hand, MIDDLE.a);
      assert.deepEqual(
        (await logged(page, "intent")).map(({ target, id }) => [target, id]),
        [
          ["second", "same"],
          ["first", "same"],
        ],
      );
      assert.deepEqual(problems, []);
      await close();
    });

    it("looks for a selector in its root: an element, a shadow root", async () => {
      const { page, close } = await open(
        site,
        `<div id="part">${CORNERS}</div><button id="other">other</button><div id="host"></div>`,
      );
      const result = await page.evaluate(async () => {
        const root = document.querySelector("#host").attachShadow({ mode: "open" });
        root.innerHTML = '<button id="in">in</button>';
        const watchers = [record("button", { root: document.querySelector("#part") }), record("button", { root })];
        const before = watchers.map((watcher) => watcher.targets.map(nameOf));
        root.append(Object.assign(document.createElement("button"), { id: "too" }));
        await frames(3);
        return [...before, watchers[1].targets.map(nameOf)];
      });
      assert.deepEqual(result, [["a", "b", "c"], ["in"], ["in", "too"]]);
      await close();
    });

    it("looks in another root from an update on, also where nothing is yet", async () => {
      const { page, close } = await open(site, `<div id="host"></div>`);
      const result = await page.evaluate(async () => {
        const root = document.querySelector("#host").attachShadow({ mode: "open" });
        const watcher = record("button");
        watcher.update({ root });
        root.append(Object.assign(document.createElement("button"), { id: "late" }));
        document.body.append(Object.assign(document.createElement("button"), { id: "elsewhere" }));
        await frames(3);
        return watcher.getSnapshot().moving || watcher.targets.map(nameOf);
      });
      assert.deepEqual(result, ["late"]);
      await close();
    });

    it("leaves out what data-whither-ignore takes out, now and later", async () => {
      const { page, step, close } = await scripted(
        site,
        "{}",
        `<div data-whither-ignore="">${ROW}</div>${buttons(["free", 10, 10])}`,
      );
      await step({});
      await step({ c: 0.9 });
      assert.deepEqual(await targets(page), []);
      await page.evaluate(async () => {
        document.querySelector("[data-whither-ignore]").removeAttribute("data-whither-ignore");
        await frames(3);
      });
      await step({});
      await step({ c: 0.9 });
      assert.deepEqual(await targets(page), ["c"]);
      await page.evaluate(async () => {
        document.querySelector("#d").setAttribute("data-whither-ignore", "");
        await frames(3);
      });
      await step({ d: 0.9 });
      assert.deepEqual(await targets(page), ["c"]);
      await close();
    });

    it("has options for each as an object or as a function of it", async () => {
      const { page, close } = await open(site, CORNERS);
      const result = await page.evaluate(async () => {
        const given = async (target) => {
          const watcher = record("button", { predictor: scriptedPredictor, target });
          await frames(3);
          for (let k = 0; k < 3; k += 1) await scriptedStep({});
          watcher.stop();
          return scriptedPredictor.given.map(({ x, y, width, height, prior }) => [x, y, width, height, prior]);
        };
        const each = ({ id }) =>
          ({ a: { prior: 5, enabled: false }, b: { prior: 2, hitSlop: { left: 20, bottom: 8 } }, c: null })[id];
        return [await given({ prior: 3, hitSlop: 10 }), await given(each)];
      });
      assert.deepEqual(result[0], [
        [120, 110, 100, 80, 3],
        [880, 110, 100, 80, 3],
        [880, 590, 100, 80, 3],
      ]);
      assert.deepEqual(result[1], [
        [870, 114, 100, 68, 2],
        [880, 590, 80, 60, 1],
      ]);
      await close();
    });
  });

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
      const { page, step, close } = await scripted(site, "{ none: 0.2, constants: { motion: { noise: 700 } } }");
      await step({});
      await step({});
      assert.deepEqual(await page.evaluate(() => scriptedPredictor.options), {
        none: 0.2,
        constants: { motion: { noise: 700 } },
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

  describe("stop", () => {
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
});

/** Runs in the page before anything else: counts what is listened to, observed and waited for. */
function count() {
  const listeners = new Map();
  const key = (type, capture) => `${type} ${Boolean(typeof capture === "object" ? capture?.capture : capture)}`;
  const { addEventListener, removeEventListener } = EventTarget.prototype;
  const forget = (target, listener, name) => listeners.get(target)?.get(listener)?.delete(name);
  EventTarget.prototype.addEventListener = function (type, listener, options) {
    const target = this ?? globalThis;
    if (listener && !options?.signal?.aborted) {
      const name = key(type, options);
      const of = listeners.get(target) ?? listeners.set(target, new Map()).get(target);
      const names = of.get(listener) ?? of.set(listener, new Set()).get(listener);
      names.add(name);
      const gone = () => forget(target, listener, name);
      if (options?.signal) addEventListener.call(options.signal, "abort", gone);
      if (options?.once) addEventListener.call(target, type, gone);
      // what is dispatched once to what is gone then
      if (type === "abort") addEventListener.call(target, type, gone);
    }
    return addEventListener.call(target, type, listener, options);
  };
  EventTarget.prototype.removeEventListener = function (type, listener, options) {
    forget(this ?? globalThis, listener, key(type, options));
    return removeEventListener.call(this ?? globalThis, type, listener, options);
  };

  const observers = new Map();
  for (const name of ["ResizeObserver", "IntersectionObserver", "MutationObserver", "PerformanceObserver"]) {
    window[name] = class extends window[name] {
      observe(target, ...more) {
        const of = observers.get(this) ?? observers.set(this, new Set()).get(this);
        of.add(target);
        return super.observe(target, ...more);
      }
      unobserve(target) {
        observers.get(this)?.delete(target);
        return super.unobserve(target);
      }
      disconnect() {
        observers.delete(this);
        return super.disconnect();
      }
    };
  }

  const waiting = new Map();
  for (const [begin, end] of [
    ["requestAnimationFrame", "cancelAnimationFrame"],
    ["setTimeout", "clearTimeout"],
    ["setInterval", "clearInterval"],
    ["requestIdleCallback", "cancelIdleCallback"],
  ]) {
    const [start, cancel] = [window[begin], window[end]];
    waiting.set(begin, new Set());
    window[begin] = (callback, ...more) => {
      const id = start.call(
        window,
        (...given) => {
          if (begin !== "setInterval") waiting.get(begin).delete(id);
          return callback(...given);
        },
        ...more,
      );
      waiting.get(begin).add(id);
      return id;
    };
    window[end] = (id) => {
      waiting.get(begin).delete(id);
      return cancel.call(window, id);
    };
  }

  const sum = (numbers) => [...numbers].reduce((total, each) => total + each, 0);
  window.standing = () => ({
    listeners: sum([...listeners.values()].flatMap((of) => [...of.values()].map((names) => names.size))),
    observers: sum([...observers.values()].map((targets) => targets.size)),
    waiting: Object.fromEntries([...waiting].map(([name, ids]) => [name, ids.size])),
  });
}
