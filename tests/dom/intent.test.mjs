// When a target is intended, and when no more: with a scripted posterior where the numbers matter, with hands elsewhere.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "../browser/hand.mjs";
import { AWAY, buttons, CORNERS, hosted, logged, MIDDLE, mouse, nextFrame, open, REST, scripted, sleep, until } from "./page.mjs";

const targets = async (page, kind = "intent") => (await logged(page, kind)).map(({ target }) => target);
const READY = `window.watcher = record("button"); await watcher.ready; await frames(2);`;

describe("intent", () => {
  const site = hosted();

  describe("by a scripted posterior", () => {
    it("comes at the threshold and is released below the release, with the numbers of that moment", async () => {
      const { page, step, close } = await scripted(site);
      for (const c of [0.1, 0.79]) await step({ c });
      assert.deepEqual(await targets(page), []);
      await step({ c: 0.8 });
      const [intent] = await logged(page, "intent");
      assert.deepEqual(
        [intent.target, intent.reason, intent.probability, intent.remaining, intent.id],
        ["c", "pointer", 0.8, { mean: 0.5, low: 0.25, high: 1 }, "c"],
      );
      await step({ c: 0.5 });
      assert.deepEqual(await targets(page, "release"), []);
      assert.deepEqual(await page.evaluate(() => watcher.getSnapshot().intended.map(nameOf)), ["c"]);
      await step({ c: 0.49 });
      const [release] = await logged(page, "release");
      assert.deepEqual([release.target, release.reason, release.pressed, release.aborted], ["c", "pointer", false, true]);
      assert.notEqual((await logged(page, "intent"))[0].aborted, null);
      assert.deepEqual(await page.evaluate(() => watcher.getSnapshot().intended), []);
      await close();
    });

    it("has the threshold and the release of the options, and a release of .625 of the threshold without", async () => {
      const { page, step, close } = await scripted(site, "{ threshold: 0.4 }");
      await step({});
      await step({ c: 0.4 });
      await step({ c: 0.26 });
      assert.deepEqual([await targets(page), await targets(page, "release")], [["c"], []]);
      await step({ c: 0.24 });
      assert.deepEqual(await targets(page, "release"), ["c"]);
      await page.evaluate(() => watcher.update({ release: 0.1 }));
      await step({ d: 0.4 });
      await step({ d: 0.11 });
      assert.deepEqual(await targets(page, "release"), ["c"]);
      await step({ d: 0.09 });
      assert.deepEqual(await targets(page, "release"), ["c", "d"]);
      await close();
    });

    it("has a threshold of its own for each target", async () => {
      const { page, step, close } = await scripted(
        site,
        `{ target: (target) => target.id === "c" ? { threshold: 0.3 } : { threshold: undefined } }`,
      );
      await step({});
      // c is 78 px away
      await step({ c: 0.36, d: 0.7 });
      assert.deepEqual(await targets(page), ["c"]);
      await close();
    });

    it("comes once in a movement, and again in another", async () => {
      const { page, step, rest, close } = await scripted(site);
      for (const c of [0, 0.9, 0.2, 0.9]) await step({ c });
      assert.deepEqual(await targets(page), ["c"]);
      await step({ d: 0.9 });
      assert.deepEqual(await targets(page), ["c", "d"]);
      await rest();
      await step({ c: 0.9 });
      assert.deepEqual(await targets(page), ["c", "d", "c"]);
      await close();
    });

    it("never comes again where it is not to", async () => {
      const { page, step, rest, close } = await scripted(site, `{ reactivate: "never" }`);
      for (const c of [0, 0.9, 0.2]) await step({ c });
      await rest();
      for (const c of [0, 0.9]) await step({ c });
      await step({ d: 0.9 });
      assert.deepEqual(await targets(page), ["c", "d"]);
      await close();
    });

    it("comes again after so many milliseconds, in the same movement too", async () => {
      const { page, step, close } = await scripted(site, "{ reactivate: 600 }");
      for (const c of [0, 0.9, 0.2, 0.9, 0.2]) await step({ c });
      assert.deepEqual(await targets(page), ["c"]);
      const [{ time }] = await logged(page, "intent");
      while ((await page.evaluate(() => performance.now())) < time + 620) await step({ c: 0.2 });
      await step({ c: 0.9 });
      assert.deepEqual(await targets(page), ["c", "c"]);
      await close();
    });

    it("runs as many at a time as the limit has it: until a promise is fulfilled, or the signal aborts", async () => {
      const { page, step, press, rest, close } = await scripted(
        site,
        `{ limit: { running: 1 }, onIntent: ({ target, signal }) => {
             log.push({ kind: "intent", target: target.id });
             return new Promise((resolve) => (window.fulfil = resolve));
           } }`,
      );
      await step({});
      await step({ c: 0.9 });
      await step({ c: 0.55, d: 0.9 });
      assert.deepEqual(await targets(page), ["c"], "one is running");
      await page.evaluate(() => fulfil());
      await step({ c: 0.55, d: 0.9 });
      assert.deepEqual(await targets(page), ["c", "d"], "that was fulfilled");
      await step({ e: 0.9 });
      await step({ e: 0.9 });
      assert.deepEqual(await targets(page), ["c", "d", "e"], "that was aborted");
      await rest();
      await step({ f: 0.9 });
      assert.deepEqual(await targets(page), ["c", "d", "e", "f"]);
      await press({ x: 650, y: 350 });
      await step({});
      await step({ g: 0.9 });
      assert.deepEqual(await targets(page), ["c", "d", "e", "f"], "what was pressed goes on");
      await page.evaluate(() => fulfil());
      await step({ g: 0.9 });
      assert.deepEqual(await targets(page), ["c", "d", "e", "f", "g"]);
      await close();
    });

    it("begins as many in a minute as the limit has it", async () => {
      const { page, step, close } = await scripted(site, "{ limit: { perMinute: 2 } }");
      await step({});
      for (const target of ["c", "d", "e", "f"]) await step({ [target]: 0.9 });
      assert.deepEqual(await targets(page), ["c", "d"]);
      await step({});
      await page.evaluate(() => watcher.update({ limit: undefined }));
      await step({ g: 0.9 });
      assert.deepEqual(await targets(page), ["c", "d", "g"]);
      await close();
    });

    it("waits until the probability has held for as long as asked", async () => {
      const { page, step, close } = await scripted(site, "{ reasons: { pointer: { after: 300 } } }");
      await step({});
      await step({ c: 0.9 });
      await step({ c: 0.3 });
      await step({ d: 0.9 });
      assert.deepEqual(await targets(page), [], "not for a moment");
      const start = await page.evaluate(() => performance.now());
      while ((await page.evaluate(() => performance.now())) < start + 350) await step({ d: 0.9 });
      assert.deepEqual(await targets(page), ["d"]);
      await close();
    });

    it("comes after that wait also where no further event does", async () => {
      const { page, step, close } = await scripted(site, "{ reasons: { pointer: { after: 100 } } }");
      await step({});
      await step({ c: 0.9 });
      await sleep(0.18);
      assert.deepEqual(await targets(page), ["c"]);
      await close();
    });

    it("does not come by the posterior where that is no reason", async () => {
      const { page, step, close } = await scripted(site, "{ reasons: { pointer: false } }");
      await step({});
      await step({ c: 0.99 });
      assert.deepEqual(await targets(page), []);
      await close();
    });

    it("calls the function of the target in place of the one of the watcher", async () => {
      const { page, step, close } = await scripted(
        site,
        `{ target: ({ id }) => id === "c" ? { onIntent: ({ target }) => void log.push({ kind: "own", target: target.id }) } : null }`,
      );
      await step({});
      await step({ c: 0.9 });
      await step({ d: 0.9 });
      assert.deepEqual([await targets(page), await targets(page, "own")], [["d"], ["c"]]);
      await close();
    });

    for (const [name, act] of [
      ["the watcher stops", "watcher.stop()"],
      ["it pauses", "watcher.pause()"],
      ["its signal aborts", "controller.abort()"],
      ["the target is taken away", `watcher.remove(document.querySelector("#c"))`],
      ["the target leaves the page", `document.querySelector("#c").remove()`],
      ["the target is ignored from now on", `document.querySelector("#c").setAttribute("data-whither-ignore", "")`],
      ["the target is disabled by its options", `watcher.set(document.querySelector("#c"), { enabled: false })`],
    ]) {
      it(`aborts when ${name}`, async () => {
        const { page, step, close } = await scripted(site, "{ signal: (window.controller = new AbortController()).signal }");
        await step({});
        await step({ c: 0.9 });
        assert.deepEqual(await targets(page), ["c"]);
        await page.evaluate(async (act) => {
          new Function(act)();
          await frames(3);
        }, act);
        assert.notEqual((await logged(page, "intent"))[0].aborted, null);
        assert.deepEqual(await page.evaluate(() => watcher.getSnapshot().intended), []);
        await close();
      });
    }

    it("ignores an AbortError, and gives every other rejection to onError", async () => {
      const { page, step, close } = await scripted(
        site,
        `{ onIntent: ({ target, signal }) => target.id === "c"
             ? new Promise((_, reject) => signal.addEventListener("abort", () => reject(signal.reason)))
             : Promise.reject(new TypeError("no such page")) }`,
      );
      await step({});
      await step({ c: 0.9 });
      await step({ d: 0.9 });
      await step({});
      assert.deepEqual(
        (await logged(page, "error")).map(({ name, message }) => [name, message]),
        [["TypeError", "no such page"]],
      );
      await close();
    });
  });

  describe("of a hand", () => {
    /** A page on which the pointer has come from away to a target, with its watcher in `watcher`. */
    async function arrived(target, { body = CORNERS, script = READY, share = 1 } = {}) {
      const opened = await open(site, body, { script });
      const hand = await mouse(opened.page);
      await hand.play([[0, AWAY.x, AWAY.y]]);
      await hand.rest(REST);
      await hand.play(movement(AWAY, target, 60, { seed: 1, share }));
      return { ...opened, hand };
    }

    it("comes before the pointer is there, and stays when the movement ends on it", async () => {
      const { page, hand, close } = await arrived(MIDDLE.b);
      await hand.rest(REST + 0.05);
      await nextFrame(page);
      const [intent, ...others] = await logged(page, "intent");
      assert.deepEqual([intent.target, intent.reason, others], ["b", "pointer", []]);
      assert.ok(intent.probability >= 0.8 && intent.remaining.mean > 0 && intent.over !== "b");
      assert.deepEqual([intent.aborted, await logged(page, "release")], [null, []]);
      await close();
    });

    it("aborts when the hand turns to another target", async () => {
      const { page, hand, close } = await arrived(MIDDLE.b, { share: 0.75 });
      assert.deepEqual(await targets(page), ["b"]);
      const { x, y } = { x: 700, y: 215 };
      await hand.play(movement({ x, y }, MIDDLE.c, 60, { seed: 3 }));
      const [first, second] = await logged(page, "intent");
      assert.ok(first.aborted !== null, "b");
      assert.deepEqual([second.target, second.aborted], ["c", null]);
      await close();
    });

    it("aborts when the hand stops on the way", async () => {
      const { page, hand, close } = await arrived(MIDDLE.b, { share: 0.7 });
      assert.deepEqual(await targets(page), ["b"]);
      await hand.rest(REST + 0.05);
      await nextFrame(page);
      assert.notEqual((await logged(page, "intent"))[0].aborted, null);
      assert.deepEqual(await targets(page, "release"), ["b"]);
      await close();
    });

    const PARAGRAPH = `<p style="position:absolute; left:500px; top:80px; width:400px; margin:0; font:24px/48px monospace">
      Some words and then <a id="link" href="#there">a link that goes on over the end of its line</a> and more.</p>`;
    const link = {
      body: PARAGRAPH,
      script: `window.watcher = record("a"); await watcher.ready; await frames(2);
        window.boxes = [...document.querySelector("a").getClientRects()].map(({ x, y, width, height }) => ({ x, y, width, height }));`,
    };

    it("goes by what the pointer is over, not by rectangles, when a movement ends beside a link that wraps", async () => {
      // within the link's box, left of its first line
      const beside = { x: 520, y: 104 };
      const { page, hand, close } = await arrived(beside, link);
      const [box, over] = await page.evaluate(({ x, y }) => {
        const { left, right, top, bottom } = document.querySelector("a").getBoundingClientRect();
        return [left < x && x < right && top < y && y < bottom, document.elementFromPoint(x, y).id];
      }, beside);
      assert.deepEqual([box, over], [true, ""], "the place is in the box and not over the link");
      assert.deepEqual(await targets(page), ["link"]);
      await hand.rest(REST + 0.05);
      await nextFrame(page);
      assert.notEqual((await logged(page, "intent"))[0].aborted, null);
      await close();
    });

    it("stays when a movement ends on the second line of a link that wraps", async () => {
      const { page, hand, close } = await arrived({ x: 560, y: 152 }, link);
      assert.equal(await page.evaluate(() => document.elementFromPoint(560, 152).id), "link");
      await hand.rest(REST + 0.05);
      await nextFrame(page);
      const [{ target, aborted }] = await logged(page, "intent");
      assert.deepEqual([target, aborted], ["link", null]);
      await close();
    });

    it("stays when a movement ends on something inside of the target", async () => {
      const body = `<button id="b" style="position:absolute;left:800px;top:60px;width:160px;height:100px"><b id="inner">bold</b></button>`;
      const { page, hand, close } = await arrived(MIDDLE.b, { body });
      assert.equal(await page.evaluate(({ x, y }) => document.elementFromPoint(x, y).id, MIDDLE.b), "inner");
      await hand.rest(REST + 0.05);
      await nextFrame(page);
      assert.equal((await logged(page, "intent"))[0].aborted, null);
      await close();
    });

    it("never aborts after a press on the target, whatever happens then", async () => {
      const { page, hand, close } = await arrived(MIDDLE.b);
      await hand.press(MIDDLE.b);
      await nextFrame(page);
      const [release] = await logged(page, "release");
      assert.deepEqual([release.target, release.pressed, release.aborted], ["b", true, false]);
      await hand.play(movement(MIDDLE.b, MIDDLE.c, 60, { seed: 3 }));
      await page.evaluate(() => {
        document.querySelector("#b").remove();
        watcher.pause();
        watcher.stop();
      });
      await nextFrame(page);
      const b = (await logged(page, "intent")).filter(({ target }) => target === "b");
      assert.deepEqual(
        b.map(({ aborted }) => aborted),
        [null],
      );
      await close();
    });

    it("aborts what was intended beside the target that is pressed", async () => {
      const { page, step, press, close } = await scripted(site, "{ threshold: 0.4, release: 0.1 }");
      await step({});
      await step({ c: 0.5, d: 0.3 });
      await step({ c: 0.3, d: 0.5 });
      assert.deepEqual(await page.evaluate(() => watcher.getSnapshot().intended.map(nameOf)), ["c", "d"]);
      await press({ x: 450, y: 350 });
      const aborted = Object.fromEntries((await logged(page, "intent")).map(({ target, aborted }) => [target, aborted]));
      assert.equal(aborted.d, null);
      assert.notEqual(aborted.c, null);
      await close();
    });

    it("belongs to the movement before it where the pointer comes to rest over a target: one intent", async () => {
      const { page, hand, close } = await arrived(MIDDLE.b);
      await hand.rest(0.6);
      assert.deepEqual(await targets(page), ["b"]);
      await close();
    });

    it("is right for at least 90% on a grid of 21 buttons, and before the pointer is there for at least 80% of them", async (test) => {
      const places = Array.from({ length: 21 }, (_, k) => [`t${k}`, 60 + 130 * (k % 7), 120 + 180 * Math.floor(k / 7), 80, 80]);
      /** Movements from target to target, numbers `first` to `last`: how many were early, and the intents. */
      const visit = async (first, last) => {
        const { page, close } = await open(site, buttons(...places), { script: READY });
        const hand = await mouse(page);
        let at = { x: 20, y: 680 };
        const found = { early: 0, right: 0, all: 0 };
        for (let k = first; k < last; k += 1) {
          const [id, left, top] = places[(k * 8 + 3) % 21];
          await hand.play([[0, at.x, at.y]]);
          await hand.rest(REST);
          await page.evaluate(() => (log.length = 0));
          const goal = { x: left + 40, y: top + 40 };
          await hand.play(movement(at, goal, 80, { seed: 100 + k }));
          await nextFrame(page);
          const intents = (await logged(page, "intent")).filter(({ reason }) => reason === "pointer");
          found.all += intents.length;
          found.right += intents.filter(({ target }) => target === id).length;
          found.early += Number(intents.some(({ target, over }) => target === id && over !== id));
          at = goal;
        }
        await close();
        return found;
      };
      const [per, hands] = [10, 3];
      const parts = await Promise.all(Array.from({ length: hands }, (_, k) => visit(k * per, (k + 1) * per)));
      const [early, right, all] = ["early", "right", "all"].map((key) => parts.reduce((sum, part) => sum + part[key], 0));
      const count = per * hands;
      test.diagnostic(`${early} of ${count} early, ${right} of ${all} right`);
      assert.ok(early >= 0.8 * count, `${early} of ${count} before the pointer was there`);
      assert.ok(right >= 0.9 * all, `${right} of ${all} right`);
    });
  });

  it("is announced by events that bubble out of shadow roots, and by attributes", async () => {
    const { page, close } = await open(site, `<div id="host" style="position:absolute;left:840px;top:80px"></div>`, {
      script: `
        const root = document.querySelector("#host").attachShadow({ mode: "open" });
        root.innerHTML = '<button id="b" style="width:80px;height:60px">b</button>';
        window.button = root.querySelector("button");
        window.watcher = record(button);
        for (const type of ["whither:intent", "whither:release"]) {
          document.addEventListener(type, (event) => {
            const { target, reason, probability, signal } = event.detail;
            log.push({ kind: type, at: event.target.id, from: event.composedPath()[0] === button, reason, probability,
              same: target === button, bubbles: event.bubbles, composed: event.composed, signal: signal instanceof AbortSignal });
          });
        }
        await watcher.ready;
        await frames(2);`,
    });
    const hand = await mouse(page);
    await hand.play([[0, AWAY.x, AWAY.y]]);
    await hand.rest(REST);
    await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 1, share: 0.8 }));
    await nextFrame(page);
    const shown = () =>
      page.evaluate(() => [button.hasAttribute("data-predicted"), Number(button.style.getPropertyValue("--probability"))]);
    const [predicted, probability] = await shown();
    assert.equal(predicted, true);
    assert.ok(probability > 0.8 && probability <= 1, `${probability}`);
    await hand.rest(REST + 0.05);
    await nextFrame(page);
    assert.deepEqual(await shown(), [false, 0]);
    const [intent] = await logged(page, "whither:intent");
    const { same, bubbles, composed, signal, at, from, reason } = intent;
    assert.deepEqual(
      { same, bubbles, composed, signal, at, from, reason },
      { same: true, bubbles: true, composed: true, signal: true, at: "host", from: true, reason: "pointer" },
    );
    assert.equal(intent.probability, (await logged(page, "intent"))[0].probability);
    assert.equal((await logged(page, "whither:release")).length, 1);
    await close();
  });

  it("leaves elements alone where it is not to decorate", async () => {
    const { page, step, close } = await scripted(site, "{ decorate: false }");
    await page.evaluate(() => {
      window.events = 0;
      document.addEventListener("whither:intent", () => (events += 1));
      window.before = document.body.outerHTML;
    });
    await step({});
    await step({ c: 0.9 });
    await until(page, "intent");
    assert.equal(await page.evaluate(() => document.body.outerHTML === before), true);
    await step({});
    assert.equal(await page.evaluate(() => events), 0);
    await page.evaluate(() => watcher.update({ decorate: true }));
    await step({ d: 0.9 });
    assert.deepEqual(await page.evaluate(() => [events, document.querySelectorAll("[data-predicted]").length]), [1, 1]);
    await page.evaluate(async () => {
      watcher.update({ decorate: false });
      await frames(2);
    });
    assert.equal(await page.evaluate(() => document.querySelectorAll("[data-predicted]").length), 0);
    await close();
  });
});
