// Samples to movements: what ends one, what goes on with it, and that what follows is a fresh start.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "../browser/hand.mjs";
import { AWAY, buttons, CORNERS, hosted, logged, MIDDLE, mouse, open, read, REST, ROW, sleep } from "./page.mjs";

const BETWEEN = { best: null, none: 1, moving: false, probabilities: { a: 0, b: 0, c: 0 } };

/** A posterior without what is intended, which may go on while the pointer is over it. */
const alone = ({ intended, ...posterior }) => posterior;

const READY = `window.watcher = record("button"); await watcher.ready; await frames(2);`;

/** A hand on its way to `a`, in steps of 1/128 s, whose times are exact in binary. */
const HAND = movement({ x: 500, y: 600 }, MIDDLE.a, 60, { seed: 3, rate: 128, share: 0.8 });

describe("movements", () => {
  const site = hosted();

  it("has no posterior before the first, during one it has, and after a rest it has none", async () => {
    const { page, close } = await open(site, CORNERS, { script: READY });
    assert.deepEqual(alone(await read(page)), BETWEEN);
    const hand = await mouse(page);
    await hand.play([[0, AWAY.x, AWAY.y]]);
    await hand.rest(REST);
    await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 1, share: 0.9 }));
    const { best, none, moving, probabilities } = await read(page);
    assert.deepEqual([best.target, best.id, best.probability, moving], ["b", "b", probabilities.b, true]);
    assert.ok(best.probability > 0.8, `${best.probability}`);
    const sum = Object.values(probabilities).reduce((sum, each) => sum + each, none);
    assert.ok(Math.abs(sum - 1) < 1e-9, `${sum}`);
    await hand.rest(0.05);
    assert.equal((await read(page)).moving, true, "a short stop is no rest");
    await hand.rest(REST);
    assert.deepEqual(alone(await read(page)), BETWEEN);
    await close();
  });

  it("rests as soon as the option says", async () => {
    const { page, close } = await open(site, CORNERS, { script: READY });
    await page.evaluate(() => watcher.update({ rest: 100 }));
    const hand = await mouse(page);
    await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 1, share: 0.9 }));
    assert.equal((await read(page)).moving, true);
    await hand.rest(0.17);
    assert.deepEqual(alone(await read(page)), BETWEEN);
    await close();
  });

  it("ends with a tremble that lasts as long as a rest", async () => {
    const { page, close } = await open(site, CORNERS, { script: READY });
    const hand = await mouse(page);
    const there = movement(AWAY, MIDDLE.b, 60, { seed: 1 });
    const start = await hand.play(there);
    const [time, x, y] = there.at(-1);
    const tremble = Array.from({ length: 45 }, (_, step) => [time + 0.01 * (step + 1), x + (step % 2), y]);
    await hand.play(tremble, start);
    assert.equal((await read(page)).moving, false);
    await close();
  });

  it("computes after a rest what a watcher does that began after it, to the bit", async () => {
    const { page, close } = await open(site, CORNERS, { script: READY });
    const hand = await mouse(page);
    await hand.play(movement(MIDDLE.c, AWAY, 60, { seed: 5 }));
    await hand.rest(REST + 0.05);
    await page.evaluate(async () => {
      window.fresh = record("button");
      await fresh.ready;
      await frames(2);
    });
    await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 6, share: 0.7 }));
    const [first, second] = await page.evaluate(async () => {
      await frames(2);
      return [posterior(watcher), posterior(fresh)];
    });
    assert.equal(first.best.target, "b");
    assert.deepEqual(first, second);
    await close();
  });

  it("goes on after a gap in which the pointer moved, and begins another after one in which it did not", async () => {
    const { page, close } = await open(site, CORNERS, { script: READY });
    const after = (gap, jump) =>
      page.evaluate(
        async ([hand, gap, jump]) => {
          const watchers = [record("button")];
          const start = exactNow();
          await watchers[0].ready;
          await frames(2);
          stroke(hand, start);
          watchers.push(record("button"));
          await watchers[1].ready;
          await frames(2);
          const [time, x, y] = hand.at(-1);
          const later = Array.from({ length: 12 }, (_, k) => [time + gap + k / 128, x + jump + 8 * k, y + 6 * k]);
          stroke(later, start);
          await frames(2);
          const results = watchers.map(posterior);
          for (const watcher of watchers) watcher.stop();
          return results;
        },
        [HAND, gap, jump],
      );
    const [moved, fresh] = await after(0.5, 300);
    assert.notDeepEqual(moved.probabilities, fresh.probabilities, "it remembers where it began");
    const [rested, another] = await after(0.5, 2);
    assert.deepEqual(rested, another);
    await close();
  });

  it("is one movement for a page that has no time for events meanwhile", async () => {
    const { page, close } = await open(site, CORNERS, {
      script: `window.watcher = record("button", { record: true }); await watcher.ready;`,
    });
    const hand = await mouse(page);
    await hand.play([[0, AWAY.x, AWAY.y]]);
    await hand.rest(REST);
    const work = (async () => {
      await sleep(0.2);
      await page.evaluate((end) => {
        while (Date.now() < end);
      }, Date.now() + 550);
    })();
    await Promise.all([work, hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 1 }))]);
    await hand.press(MIDDLE.b);
    const lines = await page.evaluate(async () => {
      await frames(2);
      return watcher.ledger.lines();
    });
    assert.equal(lines.length, 1);
    const [[, x, y]] = JSON.parse(lines[0]).samples;
    assert.ok(Math.hypot(x - AWAY.x, y - AWAY.y) < 30, `it begins at ${x}, ${y}`);
    await close();
  });

  it("ends with a press, and what follows begins there", async () => {
    const { page, close } = await open(site, CORNERS, { script: READY });
    const hand = await mouse(page);
    await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 1 }));
    await hand.press(MIDDLE.b);
    await page.evaluate(async () => {
      await frames(2);
      window.pressed = posterior(watcher);
      window.fresh = record("button");
      await fresh.ready;
      await frames(2);
    });
    assert.deepEqual(alone(await page.evaluate(() => pressed)), BETWEEN);
    await hand.play(movement(MIDDLE.b, MIDDLE.c, 60, { seed: 2, share: 0.8 }));
    const [first, second] = await page.evaluate(async () => {
      await frames(2);
      return [posterior(watcher), posterior(fresh)];
    });
    assert.equal(first.best.target, "c");
    assert.ok(Math.abs(first.best.probability - second.best.probability) < 0.05);
    await close();
  });

  for (const [name, end] of [
    ["pointercancel", () => point("pointercancel", [performance.now(), 300, 300])],
    [
      "a hidden page",
      () => {
        Object.defineProperty(document, "visibilityState", { value: "hidden", configurable: true });
        Object.defineProperty(document, "hidden", { value: true, configurable: true });
        document.dispatchEvent(new Event("visibilitychange", { bubbles: true }));
        delete document.hidden;
        delete document.visibilityState;
      },
    ],
    [
      "a page that goes into the back/forward cache and comes back",
      () => {
        dispatchEvent(new PageTransitionEvent("pagehide", { persisted: true }));
        dispatchEvent(new PageTransitionEvent("pageshow", { persisted: true }));
      },
    ],
  ]) {
    it(`ends with ${name}, to the bit, and what is intended with it`, async () => {
      const { page, close } = await open(site, CORNERS, { script: READY });
      const [during, ended, afterwards, fresh] = await page.evaluate(
        async ([hand, end]) => {
          const start = exactNow();
          stroke(hand, start);
          await frames(2);
          const results = [posterior(watcher)];
          new Function(`(${end})()`)();
          await frames(2);
          results.push(posterior(watcher));
          const second = record("button");
          await second.ready;
          await frames(2);
          const last = hand.at(-1)[0];
          stroke(
            hand.map(([time, x, y]) => [last + 1 / 8 + time, 1000 - x, 700 - y]),
            start,
          );
          await frames(2);
          return [...results, posterior(watcher), posterior(second)];
        },
        [HAND, String(end)],
      );
      assert.equal(during.best.target, "a");
      assert.deepEqual(ended, { ...BETWEEN, intended: [] });
      assert.equal(afterwards.best.target, "c");
      assert.deepEqual(afterwards, fresh);
      const intents = await logged(page, "intent");
      assert.ok(intents.filter(({ target }) => target === "a").every(({ aborted }) => aborted !== null));
      await close();
    });
  }

  it("is followed through a drag and drop of the page's own", async () => {
    const body = `${CORNERS}<div id="item" draggable="true" style="position:absolute;left:60px;top:600px;width:120px;height:80px">item</div>`;
    const { page, close } = await open(site, body, {
      script: `${READY}
        window.drags = 0;
        addEventListener("dragover", (event) => { drags += 1; event.preventDefault(); });`,
    });
    await page.mouse.move(AWAY.x, AWAY.y);
    await page.mouse.down();
    const start = Date.now() / 1000;
    for (const [time, x, y] of movement(AWAY, MIDDLE.b, 60, { seed: 8, rate: 60, share: 0.95 })) {
      await sleep(Math.max(0, start + time - Date.now() / 1000));
      await page.mouse.move(x, y);
    }
    assert.ok((await page.evaluate(() => drags)) > 5);
    assert.equal((await read(page)).best?.target, "b");
    await page.mouse.up();
    await page.evaluate(() => frames(2));
    assert.deepEqual(
      (await logged(page, "outcome")).map(({ target, verdict }) => [target, verdict]),
      [["b", "right"]],
      "a drop is a press",
    );
    // the mouse is followed again: out of the window too
    await page.mouse.move(400, 400);
    await page.mouse.move(500, 500);
    await page.mouse.move(520, 560);
    assert.equal((await read(page)).moving, true);
    await page.evaluate(() => point("pointerout", [performance.now(), 520, 560], { pointerId: 1, relatedTarget: null }));
    assert.equal((await read(page)).moving, false);
    await close();
  });

  it("goes on over one event that jumps 600 px", async () => {
    const { page, close } = await open(site, CORNERS, { script: READY });
    const [before, after] = await page.evaluate(async () => {
      const start = exactNow();
      stroke(
        [0, 1, 2, 3, 4].map((k) => [k / 128, 100 + 8 * k, 600 - 4 * k]),
        start,
      );
      await frames(2);
      const results = [posterior(watcher)];
      stroke(
        [5, 6, 7, 8].map((k) => [k / 128, 700 + 8 * k, 300 - 8 * k]),
        start,
      );
      await frames(2);
      return [...results, posterior(watcher)];
    });
    assert.equal(before.moving && after.moving, true);
    assert.equal(after.best.target, "b");
    const sum = Object.values(after.probabilities).reduce((sum, each) => sum + each, after.none);
    assert.ok(Math.abs(sum - 1) < 1e-9, `${sum}`);
    await close();
  });

  it("follows targets that a wheel scrolls during a movement", async () => {
    const body = `${buttons(["a", 80, 80], ["b", 840, 500], ["c", 840, 1100])}<div style="height:3000px"></div>`;
    const { page, close } = await open(site, body, { script: READY });
    const hand = await mouse(page);
    await hand.play([[0, AWAY.x, AWAY.y]]);
    await hand.rest(REST);
    const there = movement(AWAY, { x: 880, y: 530 }, 60, { seed: 8, share: 0.6 });
    const start = await hand.play(there);
    assert.equal((await read(page)).best.target, "b");
    await page.evaluate(() => scrollTo({ top: 600, behavior: "instant" }));
    const [time, x, y] = there.at(-1);
    await hand.play(
      [
        [time + 0.03, x + 20, y - 3],
        [time + 0.06, x + 40, y - 6],
        [time + 0.09, x + 60, y - 9],
      ],
      start,
    );
    const { probabilities } = await read(page);
    assert.equal(probabilities.b, 0, "it is no longer on the screen");
    assert.ok(probabilities.c > 0.5, `what is there now: ${probabilities.c}`);
    await close();
  });

  it("intends what a wheel brought under a resting pointer, because of the scroll", async () => {
    const body = `${buttons(["a", 400, 900, 200, 200])}<div style="height:3000px"></div>`;
    for (const scroll of [true, false]) {
      const { page, close } = await open(site, body, {
        script: `window.watcher = record("button", { reasons: { scroll: ${scroll} } }); await watcher.ready;`,
      });
      await page.mouse.move(500, 350);
      await sleep(REST);
      await page.mouse.wheel(0, 650);
      await page.waitForFunction(() => scrollY === 650);
      await sleep(0.3);
      const intents = (await logged(page, "intent")).map(({ target, reason }) => [target, reason]);
      assert.deepEqual(intents, scroll ? [["a", "scroll"]] : []);
      await close();
    }
  });

  it("intends at most one of eight buttons that it sweeps over to the last", async () => {
    const { page, close } = await open(site, ROW, { script: READY });
    const hand = await mouse(page);
    for (const seed of [1, 2, 3]) {
      await hand.play([[0, 40, 360]]);
      await hand.rest(REST);
      await page.evaluate(() => (log.length = 0));
      await hand.play(movement({ x: 40, y: 360 }, { x: 850, y: 350 }, 60, { seed }));
      const intents = (await logged(page, "intent")).map(({ target }) => target);
      assert.ok(intents.length <= 1, `${seed}: ${intents}`);
    }
    await close();
  });

  it("intends nothing while it sweeps over it", async () => {
    const { page, close } = await open(site, buttons(["b", 460, 320], ["c", 900, 320]), { script: READY });
    const hand = await mouse(page);
    await hand.play([[0, 40, 350]]);
    await hand.rest(REST);
    await hand.play(movement({ x: 40, y: 350 }, { x: 940, y: 350 }, 60, { seed: 2 }));
    const intents = await logged(page, "intent");
    assert.deepEqual(
      intents.filter(({ target, over }) => target === "b" && over === "b"),
      [],
    );
    assert.deepEqual([intents.at(-1).target, intents.at(-1).aborted], ["c", null]);
    await close();
  });
});
