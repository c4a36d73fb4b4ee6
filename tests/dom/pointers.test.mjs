// Pointer events to samples: every one of them once, on the events' own clock, for each pointer by itself.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "../browser/hand.mjs";
import { AWAY, buttons, CORNERS, hosted, logged, MIDDLE, mouse, open, read, REST, sleep, until } from "./page.mjs";

/** A hand on its way to `a`, in steps of 1/128 s, whose times are exact in binary. */
const HAND = movement({ x: 500, y: 600 }, MIDDLE.a, 60, { seed: 3, rate: 128, share: 0.8 });

describe("pointers", () => {
  const site = hosted();

  /** What a new watcher computes from events that `dispatch` (a function of the page) makes of the hand. */
  async function computed(page, dispatch, { options = {}, argument = null } = {}) {
    return page.evaluate(
      async ([text, hand, options, argument]) => {
        const watcher = record("button", options);
        await watcher.ready;
        await frames(2);
        new Function("hand", "start", "argument", `(${text})(hand, start, argument)`)(hand, exactNow(), argument);
        await frames(2);
        const result = posterior(watcher);
        watcher.stop();
        return result;
      },
      [String(dispatch), HAND, options, argument],
    );
  }

  const single = (hand, start) => stroke(hand, start);

  it("takes the same samples from every form of the coalesced list, to the bit", async () => {
    const { page, close } = await open(site, CORNERS);
    /** Events of three samples each; `lists` makes the coalesced list of the samples, and of those of the event before. */
    const grouped = (hand, start, form) => {
      const samples = hand.map(([time, x, y]) => [start + 1000 * time, x, y]);
      let before = samples[0];
      for (let i = 0; i < samples.length; i += 3) {
        const group = samples.slice(i, i + 3);
        const last = group.at(-1);
        const list = {
          "with the parent": group,
          "without the parent": group.slice(0, -1),
          "with the last sample of the event before": [before, ...group],
          "with every sample twice": group.flatMap((sample) => [sample, sample]),
        }[form];
        point("pointermove", last, { list });
        before = last;
      }
    };
    const expected = await computed(page, single);
    assert.equal(expected.best.target, "a");
    assert.ok(expected.best.probability > 0.5, `${expected.best.probability}`);
    const forms = [
      "with the parent",
      "without the parent",
      "with the last sample of the event before",
      "with every sample twice",
    ];
    for (const form of forms) assert.deepEqual(await computed(page, grouped, { argument: form }), expected, form);
    const noMethod = (hand, start) => stroke(hand, start, { list: null });
    assert.deepEqual(await computed(page, noMethod), expected, "no getCoalescedEvents");
    const twice = (hand, start) => hand.forEach((sample) => stroke([sample, sample], start));
    assert.deepEqual(await computed(page, twice), expected, "every event twice");
    await close();
  });

  it("takes several places at one time for one observation, of the last", async () => {
    const { page, close } = await open(site, CORNERS);
    const expected = await computed(page, single);
    const several = (hand, start) =>
      hand.forEach(([time, x, y]) => {
        stroke([[time, x - 9, y + 5]], start);
        stroke([[time, x, y]], start);
      });
    assert.deepEqual(await computed(page, several), expected);
    await close();
  });

  it("takes samples from pointerrawupdate where it is asked to, and none twice", async () => {
    const { page, close } = await open(site, CORNERS);
    const expected = await computed(page, single);
    const raw = (hand, start) => {
      for (const [index, [time, x, y]] of hand.entries()) {
        const sample = [start + 1000 * time, x, y];
        point("pointerrawupdate", sample);
        if (index % 3 === 2 || index === hand.length - 1) point("pointermove", sample, { list: [sample] });
      }
    };
    assert.deepEqual(await computed(page, raw, { options: { raw: true } }), expected);
    const alone = (hand, start) => {
      for (const [time, x, y] of hand) point("pointerrawupdate", [start + 1000 * time, x, y]);
    };
    assert.deepEqual(await computed(page, alone, { options: { raw: true } }), expected, "before any pointermove");
    assert.equal((await computed(page, alone)).moving, false, "not asked to");
    await close();
  });

  it("computes the same from a real mouse with raw updates and without", async () => {
    const script = `window.watcher = record("button"); window.raw = record("button", { raw: true });
      await Promise.all([watcher.ready, raw.ready]);`;
    const { page, close } = await open(site, CORNERS, { script });
    const hand = await mouse(page);
    await hand.play([[0, 500, 600]]);
    await hand.rest(REST);
    await hand.play(movement({ x: 500, y: 600 }, MIDDLE.b, 60, { seed: 4, share: 0.9 }));
    const [usual, raw] = [await read(page), await read(page, "raw")];
    assert.equal(usual.best.target, "b");
    assert.deepEqual(raw, usual);
    await close();
  });

  describe("clocks", () => {
    for (const [name, origin] of [
      ["an iframe's, that began later", -50_000],
      ["a negative one", -10_000_000],
      ["one that is ahead", 86_400_000],
    ]) {
      it(`computes the same to the bit on another clock: ${name}`, async () => {
        const { page, close } = await open(site, CORNERS);
        const expected = await computed(page, single);
        const shifted = (hand, start, origin) => stroke(hand, start + origin);
        assert.deepEqual(await computed(page, shifted, { argument: origin }), expected);
        await close();
      });
    }

    it("goes on after a clock that jumps forward, in the middle of a movement and between two", async () => {
      const { page, close } = await open(site, CORNERS);
      const jumping = (hand, start) => {
        const middle = Math.floor(hand.length / 3);
        stroke(hand.slice(0, middle), start);
        stroke(hand.slice(middle), start + 3_600_000);
      };
      const { best, none, probabilities } = await computed(page, jumping);
      assert.equal(best.target, "a");
      const sum = Object.values(probabilities).reduce((sum, each) => sum + each, none);
      assert.ok(Math.abs(sum - 1) < 1e-9, `${sum}`);
      const between = (hand, start) => {
        const away = hand.map(([time, x, y]) => [time, 1000 - x, 700 - y]);
        stroke(away, start);
        stroke(hand, start + 3_600_000);
      };
      assert.deepEqual(await computed(page, between), await computed(page, single));
      await close();
    });

    it("takes a step back for a new movement, to the bit", async () => {
      const { page, close } = await open(site, CORNERS);
      const back = (hand, start) => {
        const away = hand.map(([time, x, y]) => [time, 1000 - x, 700 - y]);
        stroke(away, start);
        stroke(hand, start - 20_000);
      };
      assert.deepEqual(await computed(page, back), await computed(page, single));
      await close();
    });

    it("predicts from a clock that is rounded to 100 ms", async () => {
      const { page, close } = await open(site, CORNERS);
      const rounded = (hand, start) => {
        for (const [time, x, y] of hand) point("pointermove", [Math.floor((start + 1000 * time) / 100) * 100, x, y]);
      };
      const { best } = await computed(page, rounded);
      assert.equal(best.target, "a");
      await close();
    });

    it("predicts in an iframe, on its own clock", async () => {
      const inner = `<!doctype html><style>body { margin: 0 }</style>${CORNERS}`;
      const { page, close } = await open(site, `<iframe src="inner.html" style="width:1000px;height:700px;border:0"></iframe>`, {
        pages: { "inner.html": inner },
      });
      await page.waitForFunction(() => document.querySelector("iframe").contentDocument?.querySelector("#c"));
      await page.evaluate(async () => {
        window.watcher = record("button", { root: document.querySelector("iframe").contentDocument });
        await watcher.ready;
      });
      const hand = await mouse(page);
      await hand.play([[0, AWAY.x, AWAY.y]]);
      await hand.rest(REST);
      await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 8, share: 0.85 }));
      const { best } = await read(page);
      assert.equal(best.target, "b");
      await close();
    });
  });

  it("goes on from the page into an iframe, whose clock began later", async () => {
    const inner = `<!doctype html><style>body { margin: 0 }</style>${buttons(["b", 340, 80])}`;
    const { page, close } = await open(site, buttons(["a", 80, 80]), { pages: { "inner.html": inner } });
    await page.evaluate(async () => {
      const frame = document.createElement("iframe");
      frame.style = "position:absolute;left:500px;top:0;width:480px;height:600px;border:0";
      frame.src = "inner.html";
      const loaded = new Promise((resolve) => frame.addEventListener("load", resolve));
      document.body.append(frame);
      await loaded;
      const button = frame.contentDocument.querySelector("button");
      window.watcher = record([document.querySelector("#a"), button], { record: true });
      await watcher.ready;
      await frames(3);
    });
    const hand = await mouse(page);
    await hand.play([[0, AWAY.x, AWAY.y]]);
    await hand.rest(REST);
    await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 8 }));
    assert.equal((await read(page)).best?.target, "b");
    await hand.press(MIDDLE.b);
    const lines = await page.evaluate(async () => {
      await frames(2);
      return watcher.ledger.lines();
    });
    assert.equal(lines.length, 1);
    const { samples } = JSON.parse(lines[0]);
    assert.ok(Math.hypot(samples[0][1] - AWAY.x, samples[0][2] - AWAY.y) < 30, `it begins at ${samples[0]}`);
    for (const [index, [time, x]] of samples.slice(1).entries()) {
      assert.ok(time >= samples[index][0] && time - samples[index][0] < 0.2, `${samples[index][0]}, ${time}`);
      assert.ok(Math.abs(x - samples[index][1]) < 100, `${samples[index][1]}, ${x}`);
    }
    await close();
  });

  it("follows two pointers at once, each by itself, and has the last one's that moved", async () => {
    const { page, close } = await open(site, CORNERS);
    const results = await page.evaluate(async (hand) => {
      const both = record("button");
      const pen = record("button", { pointers: ["pen"] });
      const mouse = record("button", { pointers: ["mouse"] });
      await Promise.all([both, pen, mouse].map((watcher) => watcher.ready));
      await frames(2);
      const start = exactNow();
      const own = { pointerId: 11, pointerType: "pen" };
      for (const [time, x, y] of hand) {
        stroke([[time, x, y]], start);
        stroke([[time, 1000 - x, 700 - y]], start, own);
      }
      await frames(2);
      const afterPen = [posterior(both), posterior(pen)];
      const [time, x, y] = hand.at(-1);
      stroke([[time + 1 / 128, x - 2, y - 2]], start);
      await frames(2);
      return { afterPen, afterMouse: [posterior(both), posterior(mouse)] };
    }, HAND);
    assert.equal(results.afterPen[0].best.target, "c");
    const alone = ({ intended, ...posterior }) => posterior;
    assert.deepEqual(alone(results.afterPen[0]), alone(results.afterPen[1]));
    assert.equal(results.afterMouse[0].best.target, "a");
    assert.deepEqual(alone(results.afterMouse[0]), alone(results.afterMouse[1]));
    await close();
  });

  it("follows only the pointers that it is asked to", async () => {
    const { page, close } = await open(site, CORNERS);
    const pen = (hand, start) => stroke(hand, start, { pointerId: 2, pointerType: "pen" });
    assert.equal((await computed(page, pen, { options: { pointers: ["mouse"] } })).best, null);
    assert.equal((await computed(page, pen, { options: { pointers: ["pen"] } })).best.target, "a");
    await close();
  });

  it("predicts a hovering pen, and takes its touch for a press", async () => {
    const { page, close } = await open(site, CORNERS, { script: `window.watcher = record("button"); await watcher.ready;` });
    const session = await page.context().newCDPSession(page);
    const send = (type, x, y, more) =>
      session.send("Input.dispatchMouseEvent", { type, x, y, pointerType: "pen", timestamp: Date.now() / 1000, ...more });
    await send("mouseMoved", AWAY.x, AWAY.y);
    await sleep(REST);
    const start = Date.now() / 1000;
    for (const [time, x, y] of movement(AWAY, MIDDLE.b, 60, { seed: 8 })) {
      await sleep(Math.max(0, start + time - Date.now() / 1000));
      await send("mouseMoved", x, y);
    }
    assert.equal((await read(page)).best?.target, "b");
    await send("mousePressed", MIDDLE.b.x, MIDDLE.b.y, { button: "left", buttons: 1, clickCount: 1 });
    await send("mouseReleased", MIDDLE.b.x, MIDDLE.b.y, { button: "left", clickCount: 1 });
    await page.evaluate(() => frames(2));
    const [outcome] = await logged(page, "outcome");
    assert.deepEqual([outcome.target, outcome.pointerType, outcome.verdict], ["b", "pen", "right"]);
    await close();
  });

  describe("fingers", () => {
    const phone = { hasTouch: true };

    /** A finger of Chromium's, from one place on to others. */
    async function finger(page) {
      const session = await page.context().newCDPSession(page);
      const send = (type, ...touchPoints) => session.send("Input.dispatchTouchEvent", { type, touchPoints });
      return {
        down: (x, y) => send("touchStart", { x, y, id: 1 }),
        move: (x, y) => send("touchMove", { x, y, id: 1 }),
        up: () => send("touchEnd"),
      };
    }

    it("takes a tap for a press", async () => {
      const { page, close } = await open(site, CORNERS, {
        ...phone,
        script: `window.watcher = record("button", { reasons: { viewport: { after: 0 } } }); await watcher.ready; await frames(3);`,
      });
      assert.equal((await logged(page, "intent")).length, 3);
      await page.touchscreen.tap(MIDDLE.a.x, MIDDLE.a.y);
      await page.evaluate(() => frames(2));
      const releases = await logged(page, "release");
      assert.deepEqual(
        releases.map(({ target, pressed, aborted }) => [target, pressed, aborted]),
        [["a", true, false]],
      );
      await close();
    });

    it("takes a finger that stays for an intent, and its lifting for the press", async () => {
      const { page, close } = await open(site, CORNERS, {
        ...phone,
        script: `window.watcher = record("button"); await watcher.ready;`,
      });
      const { down, up } = await finger(page);
      await page.evaluate(() => addEventListener("pointerdown", () => (window.down = performance.now()), { capture: true }));
      await down(MIDDLE.a.x, MIDDLE.a.y);
      await until(page, "intent");
      const [intent, ...others] = await logged(page, "intent");
      assert.deepEqual([intent.target, intent.reason, others], ["a", "touch", []]);
      const wait = intent.time - (await page.evaluate(() => window.down));
      assert.ok(wait >= 75 && wait < 500, `after ${wait} ms`);
      await up();
      await page.evaluate(() => frames(2));
      const [release] = await logged(page, "release");
      assert.deepEqual([release.pressed, release.aborted], [true, false]);
      assert.deepEqual(await logged(page, "outcome"), [], "no movement led to it");
      await close();
    });

    it("knows a finger that is down after its options have changed", async () => {
      const { page, close } = await open(site, CORNERS, {
        ...phone,
        script: `window.watcher = record("button"); await watcher.ready;`,
      });
      const { down, up } = await finger(page);
      await down(MIDDLE.a.x, MIDDLE.a.y);
      await until(page, "intent");
      await page.evaluate(() => watcher.update({ threshold: 0.7, pointers: ["touch"], reasons: { hover: false } }));
      await up();
      await page.evaluate(() => frames(2));
      const [release] = await logged(page, "release");
      assert.deepEqual([release.target, release.pressed], ["a", true]);
      await close();
    });

    it("takes a pan for neither", async () => {
      const body = `${buttons(["a", 80, 300], ["b", 80, 400])}<div style="height: 3000px"></div>`;
      const { page, close } = await open(site, body, {
        ...phone,
        script: `window.watcher = record("button"); await watcher.ready;`,
      });
      const { down, move, up } = await finger(page);
      await down(120, 430);
      for (let step = 1; step <= 12; step += 1) {
        await sleep(0.012);
        await move(120, 430 - 15 * step);
      }
      await sleep(0.15);
      await up();
      await page.waitForFunction(() => scrollY > 50);
      await page.evaluate(() => frames(3));
      assert.deepEqual([await logged(page, "intent"), await logged(page, "outcome")], [[], []]);
      await close();
    });

    it("takes a finger that is drawn away from a target for no intent of that", async () => {
      const { page, close } = await open(site, CORNERS, {
        ...phone,
        head: "<style>html { touch-action: none }</style>",
        script: `window.watcher = record("button", { reasons: { pointer: false } }); await watcher.ready;`,
      });
      const { down, move, up } = await finger(page);
      const { x, y } = MIDDLE.a;
      // all at once, however busy the machine is
      await Promise.all([down(x, y), ...[20, 40, 60, 80].map((aside) => move(x + aside, y + aside))]);
      await sleep(0.15);
      await up();
      assert.deepEqual([await logged(page, "intent"), await logged(page, "outcome")], [[], []]);
      await close();
    });

    it("takes a short tap for an intent as it is lifted", async () => {
      const { page, close } = await open(site, CORNERS, {
        ...phone,
        script: `window.watcher = record("button"); await watcher.ready;`,
      });
      await page.touchscreen.tap(MIDDLE.a.x, MIDDLE.a.y);
      await page.evaluate(() => frames(2));
      assert.deepEqual(
        (await logged(page, "intent")).map(({ target, reason, aborted }) => [target, reason, aborted]),
        [["a", "press", null]],
      );
      await close();
    });

    it("follows no raw updates of a finger that scrolls the page", async () => {
      const { page, close } = await open(site, `${buttons(["a", 80, 100])}<div style="height: 3000px"></div>`, {
        ...phone,
        script: `window.watcher = record("button", { raw: true }); await watcher.ready;`,
      });
      const { down, move, up } = await finger(page);
      await down(120, 630);
      for (let step = 1; step <= 12; step += 1) {
        await sleep(0.012);
        await move(120, 630 - 15 * step);
      }
      assert.equal((await read(page)).moving, false);
      await up();
      await close();
    });

    it("predicts a finger that is drawn where the page does not scroll, and takes its lifting for no press", async () => {
      const { page, close } = await open(site, CORNERS, {
        ...phone,
        head: "<style>html { touch-action: none }</style>",
        script: `window.watcher = record("button"); await watcher.ready;`,
      });
      const { down, move, up } = await finger(page);
      await down(AWAY.x, AWAY.y);
      const start = Date.now() / 1000;
      for (const [time, x, y] of movement(AWAY, MIDDLE.b, 60, { seed: 8 })) {
        await sleep(Math.max(0, start + time - Date.now() / 1000));
        await move(x, y);
      }
      assert.equal((await read(page)).best?.target, "b");
      await up();
      await page.evaluate(() => frames(2));
      assert.deepEqual(await logged(page, "outcome"), []);
      assert.equal((await read(page)).best, null);
      await close();
    });
  });
});
