// whither/testing: a hand's movements as a browser's mouse makes them, and as events, in real time and with fake timers.
import assert from "node:assert/strict";
import { describe, it, mock } from "node:test";
import { JSDOM } from "jsdom";
import { dispatch, hand, move } from "whither/testing";
import { CORNERS, hosted, logged, MIDDLE, open, ROW, until } from "./page.mjs";

const FROM = { x: 120, y: 640 };
const SAMPLES = hand(FROM, MIDDLE.b, { seed: 3 });
const [END] = SAMPLES.at(-1);

/** A mouse that keeps what it is asked for. */
function recorder(then = async () => {}) {
  const done = [];
  const keep =
    (kind) =>
    async (...place) => {
      done.push([kind, ...place]);
      await then(kind);
    };
  return { done, mouse: { move: keep("move"), down: keep("down"), up: keep("up") } };
}

/** The places that samples have one after another. */
const places = (samples) => samples.slice(0, -1).map(([, x, y]) => ["move", x, y]);

describe("move", () => {
  it("takes as long as the samples do, and goes through their places", async () => {
    const { done, mouse } = recorder();
    const start = performance.now();
    await move(mouse, SAMPLES);
    const took = performance.now() - start;
    assert.ok(took > 1000 * END - 10, `${took} ms of ${1000 * END}`);
    const kinds = places(SAMPLES).map(JSON.stringify);
    assert.deepEqual(done.at(-1), places(SAMPLES).at(-1));
    assert.deepEqual(done[0], places(SAMPLES)[0]);
    assert.ok(done.every((one) => kinds.includes(JSON.stringify(one))));
  });

  it("omits samples where the browser is slow, but never the last", async () => {
    const { done, mouse } = recorder(() => new Promise((resolve) => setTimeout(resolve, 60)));
    const start = performance.now();
    await move(mouse, SAMPLES);
    const took = performance.now() - start;
    assert.ok(done.length < SAMPLES.length / 3, `${done.length} of ${SAMPLES.length}`);
    assert.ok(took < 60 * SAMPLES.length, `${took} ms`);
    assert.deepEqual(done.at(-1), places(SAMPLES).at(-1));
  });

  it("presses where it stops, for as long as a person", async () => {
    const { done, mouse } = recorder();
    const advanced = [];
    await move(mouse, SAMPLES, { press: true, advanceTimers: (ms) => advanced.push(ms) });
    assert.deepEqual(done, [...places(SAMPLES), ["down"], ["up"]]);
    assert.ok(advanced.every(Number.isInteger));
    assert.equal(
      advanced.reduce((sum, ms) => sum + ms),
      Math.round(1000 * (END + 0.1)),
    );
  });

  it("waits for what lets fake timers pass", async () => {
    let pending = 0;
    const { mouse } = recorder(async () => assert.equal(pending, 0));
    await move(mouse, SAMPLES, {
      advanceTimers: async () => {
        pending += 1;
        await null;
        pending -= 1;
      },
    });
  });

  it("goes on when fake timers are advanced from elsewhere", async (t) => {
    mock.timers.enable({ apis: ["setTimeout"] });
    t.after(() => mock.timers.reset());
    const { done, mouse } = recorder();
    let over = false;
    const moved = move(mouse, SAMPLES).then(() => (over = true));
    for (let passed = 0; !over; passed += 4) {
      assert.ok(passed < 2000 * END, "it takes much longer than its samples");
      mock.timers.tick(4);
      for (let turn = 0; turn < 10; turn += 1) await null;
    }
    await moved;
    assert.deepEqual(done.at(-1), places(SAMPLES).at(-1));
  });

  it("stops at a signal, with its reason", async () => {
    const controller = new AbortController();
    const { done, mouse } = recorder(() => done.length === 5 && controller.abort(new Error("enough")));
    await assert.rejects(move(mouse, SAMPLES, { signal: controller.signal, advanceTimers: () => {} }), /enough/);
    assert.equal(done.length, 5);
    await assert.rejects(move(mouse, SAMPLES, { signal: AbortSignal.abort() }), { name: "AbortError" });
  });

  it("refuses what it cannot play before anything moves", async () => {
    const { done, mouse } = recorder();
    const cases = [
      [[null, SAMPLES], "wrong-type", "mouse", "mouse: must have the methods move, down and up, got nothing"],
      [[mouse, undefined], "missing-key", "samples", 'samples: missing key "samples"'],
      [[mouse, []], "wrong-length", "samples", "samples: must have at least one sample, got none"],
      [[mouse, [[0, 1]]], "wrong-length", "samples[0]", "samples[0]: must be [seconds, x, y], got [0, 1]"],
      [[mouse, [[0, 1, Number.NaN]]], "not-finite", "samples[0][2]", "samples[0][2]: must be a finite number, got NaN"],
      [
        [
          mouse,
          [
            [1, 2, 3],
            [0, 2, 3],
          ],
        ],
        "time-not-increasing",
        "samples[1][0]",
        "samples[1][0]: must be at least 1, got 0",
      ],
      [[mouse, SAMPLES, { press: 1 }], "wrong-type", "press", "press: must be a boolean, got 1"],
      [[mouse, SAMPLES, { hold: -1 }], "out-of-range", "hold", "hold: must be at least 0, got -1"],
      [[mouse, SAMPLES, { signal: {} }], "wrong-type", "signal", "signal: must be an AbortSignal, got an object"],
      [[mouse, SAMPLES, { advanceTimers: 1 }], "wrong-type", "advanceTimers", "advanceTimers: must be a function, got 1"],
      [
        [mouse, SAMPLES, { speed: 1 }],
        "unknown-key",
        "speed",
        'speed: unknown key "speed", expected one of "press", "hold", "advanceTimers", "signal"',
      ],
    ];
    for (const [args, code, path, message] of cases)
      await assert.rejects(move(...args), { name: "WhitherError", code, path, message });
    assert.deepEqual(done, []);
  });
});

/** A document of jsdom, whose elements have the boxes that `data-box` states, and the log of its events. */
function documentOf(html) {
  const { window } = new JSDOM(`<!doctype html><body>${html}</body>`, { pretendToBeVisual: true });
  for (const element of window.document.querySelectorAll("[data-box]")) {
    const [left, top, right, bottom] = element.dataset.box.split(" ").map(Number);
    const box = { x: left, y: top, left, top, right, bottom, width: right - left, height: bottom - top };
    element.getBoundingClientRect = () => box;
  }
  const log = [];
  const kinds = ["over", "enter", "out", "leave", "move", "down", "up"];
  for (const type of [...kinds.flatMap((kind) => [`pointer${kind}`, `mouse${kind}`]), "click"])
    for (const element of window.document.querySelectorAll("*"))
      element.addEventListener(type, (event) => {
        if (event.eventPhase === 2) log.push({ type, id: element.id || element.localName, event });
      });
  return { window, document: window.document, log };
}

const TWO =
  '<div id="outer" data-box="0 0 400 400"><a id="left" data-box="0 0 100 100"></a><a id="right" data-box="200 0 300 100"></a></div>';
const ACROSS = [
  [0, 50, 50],
  [0.01, 60, 50],
  [0.02, 150, 50],
  [0.03, 250, 50],
];
const atOnce = { advanceTimers: () => {}, frames: 100, start: 1000 };

describe("dispatch", () => {
  it("sends to what is under the pointer, in the order of the platform", async () => {
    const { document, log } = documentOf(TWO);
    await dispatch(document, ACROSS.slice(0, 3), atOnce);
    const into = (kind, id, ...entered) => [`${kind}over ${id}`, ...entered.map((each) => `${kind}enter ${each}`)];
    assert.deepEqual(
      log.map(({ type, id }) => `${type} ${id}`),
      [
        ...into("pointer", "left", "html", "body", "outer", "left"),
        "pointermove left",
        ...into("mouse", "left", "html", "body", "outer", "left"),
        "mousemove left",
        "pointermove left",
        "mousemove left",
        "pointerout left",
        "pointerleave left",
        "pointerover outer",
        "pointermove outer",
        "mouseout left",
        "mouseleave left",
        "mouseover outer",
        "mousemove outer",
      ],
    );
    const out = log.find(({ type }) => type === "pointerout").event;
    assert.equal(out.relatedTarget.id, "outer");
    assert.deepEqual([out.bubbles, out.button, out.buttons], [true, -1, 0]);
  });

  it("goes on from where the movement before has ended", async () => {
    const { document, log } = documentOf(TWO);
    await dispatch(document, ACROSS.slice(0, 1), atOnce);
    log.length = 0;
    await dispatch(document, ACROSS.slice(3), atOnce);
    const pointers = log.filter(({ type }) => type.startsWith("pointer")).map(({ type, id }) => `${type} ${id}`);
    assert.deepEqual(pointers, [
      "pointerout left",
      "pointerleave left",
      "pointerover right",
      "pointerenter right",
      "pointermove right",
    ]);
  });

  it("has every sample once, as coalesced events with their own times, on the clock of the page", async () => {
    const { document, window, log } = documentOf("");
    const samples = SAMPLES.slice(0, -1);
    await dispatch(document.body, samples, { advanceTimers: () => {}, start: 5000 });
    const moves = log.filter(({ type }) => type === "pointermove").map(({ event }) => event);
    const coalesced = moves.flatMap((event) => event.getCoalescedEvents());
    const flat = coalesced.map(({ timeStamp, clientX, clientY }) => [timeStamp, clientX, clientY]);
    assert.deepEqual(
      flat,
      samples.map(([time, x, y]) => [5000 + 1000 * time, x, y]),
    );
    assert.ok(moves.length < samples.length / 1.5, `${moves.length} events of ${samples.length} samples`);
    for (const event of moves) {
      const last = event.getCoalescedEvents().at(-1);
      assert.deepEqual([event.timeStamp, event.clientX, event.clientY], [last.timeStamp, last.clientX, last.clientY]);
      assert.ok(event instanceof window.PointerEvent && last instanceof window.PointerEvent);
      assert.deepEqual([event.pointerType, event.pointerId, event.isPrimary, event.button], ["mouse", 1, true, -1]);
    }
    await dispatch(document.body, samples, { advanceTimers: () => {} });
    const [{ event }] = log.slice(-2);
    assert.ok(Math.abs(event.timeStamp - performance.now()) < 1000 * END + 60_000);
  });

  it("presses and clicks where asked", async () => {
    const { document, log } = documentOf(TWO);
    const options = { ...atOnce, press: true, hold: 0.25, pointerType: "pen", pointerId: 4 };
    await dispatch(document, [...ACROSS, [0.5, 250, 50]], options);
    const last = log.slice(-5);
    assert.deepEqual(
      last.map(({ type, id, event }) => [type, id, event.buttons, event.detail, event.timeStamp]),
      [
        ["pointerdown", "right", 1, 0, 1500],
        ["mousedown", "right", 1, 1, 1500],
        ["pointerup", "right", 0, 0, 1750],
        ["mouseup", "right", 0, 1, 1750],
        ["click", "right", 0, 1, 1750],
      ],
    );
    assert.deepEqual([last[0].event.pointerType, last[4].event.pointerId, last[0].event.pressure], ["pen", 4, 0.5]);
  });

  it("activates what it clicks", async () => {
    const { document } = documentOf('<label><input type="checkbox">agreed</label>');
    const box = document.querySelector("input");
    await dispatch(box, hand(FROM, MIDDLE.a), { advanceTimers: () => {}, press: true });
    assert.equal(box.checked, true);
  });

  it("sends no mouse event of a press whose default is prevented, but the click", async () => {
    const { document, log } = documentOf(TWO);
    document.addEventListener("pointerdown", (event) => event.preventDefault());
    await dispatch(document, ACROSS, { ...atOnce, press: true });
    assert.deepEqual(
      log.slice(-3).map(({ type }) => type),
      ["pointerdown", "pointerup", "click"],
    );
  });

  it("clicks what is around both where the press moved what is under it, and nothing where there is none", async () => {
    const { document, log } = documentOf(TWO);
    const right = document.querySelector("#right");
    right.addEventListener("pointerdown", () => right.remove());
    await dispatch(document, ACROSS, { ...atOnce, press: true });
    assert.deepEqual(
      log.filter(({ type }) => ["pointerup", "click"].includes(type)).map(({ type, id }) => `${type} ${id}`),
      ["pointerup outer"],
    );
  });

  it("asks for what is under the pointer, and sends nothing where there is nothing", async () => {
    const { document, log } = documentOf(TWO);
    const asked = [];
    const hit = (x, y) => {
      asked.push([x, y]);
      return x < 200 ? document.querySelector("#left") : null;
    };
    await dispatch(document, ACROSS, { ...atOnce, hit, press: true });
    assert.deepEqual(asked.slice(0, 2), [
      [50, 50],
      [60, 50],
    ]);
    assert.deepEqual(
      log.slice(-7).map(({ type, id }) => `${type} ${id}`),
      ["pointerout", "pointerleave", "mouseout", "mouseleave"]
        .flatMap((type) =>
          type.endsWith("leave") ? ["left", "outer", "body", "html"].map((id) => `${type} ${id}`) : [`${type} left`],
        )
        .slice(-7),
    );
  });

  it("refuses what is no target and no option", async () => {
    const { document } = documentOf("");
    const must = "must be an element, a document or a shadow root";
    await assert.rejects(dispatch(null, SAMPLES), {
      code: "wrong-type",
      path: "target",
      message: `target: ${must}, got nothing`,
    });
    await assert.rejects(dispatch(document, SAMPLES, { hit: 3 }), {
      code: "wrong-type",
      path: "hit",
      message: "hit: must be a function, got 3",
    });
    await assert.rejects(dispatch(document, SAMPLES, { frames: 0 }), {
      code: "out-of-range",
      path: "frames",
      message: "frames: must be greater than 0, got 0",
    });
    await assert.rejects(dispatch(document, SAMPLES, { pointerType: 1 }), { code: "wrong-type", path: "pointerType" });
    await assert.rejects(dispatch(document, SAMPLES, { start: "now" }), { code: "wrong-type", path: "start" });
  });
});

describe("in Chromium", () => {
  const site = hosted();
  const READY = `window.watcher = record("button"); await watcher.ready; await frames(2);
    window.testing = await import("./testing.js");`;

  it("a browser's mouse is predicted before it arrives, and presses", async () => {
    const { page, close } = await open(site, CORNERS, { script: READY });
    await page.evaluate(() => {
      window.pressed = [];
      addEventListener("click", ({ target, isTrusted }) => pressed.push([nameOf(target), isTrusted]));
    });
    let early = 0;
    for (const [seed, goal] of ["b", "c", "a", "b"].entries()) {
      const from = seed === 0 ? FROM : MIDDLE[["b", "c", "a"][seed - 1]];
      await page.mouse.move(from.x, from.y);
      await page.waitForTimeout(400);
      await page.evaluate(() => (log.length = 0));
      await move(page.mouse, hand(from, await page.locator(`#${goal}`).boundingBox(), { seed, pace: 2.5, noise: 0.5 }), {
        press: true,
      });
      await until(page, "outcome");
      const intents = await logged(page, "intent");
      assert.ok(
        intents.some(({ target }) => target === goal),
        `${goal}: ${JSON.stringify(intents)}`,
      );
      early += Number(intents.some(({ target, over }) => target === goal && over !== goal));
    }
    // on a busy machine not every movement has enough frames
    assert.ok(early >= 2, `${early} of 4 before the mouse was there`);
    assert.deepEqual(
      await page.evaluate(() => pressed),
      ["b", "c", "a", "b"].map((id) => [id, true]),
    );
    await close();
  });

  it("events are as good as a mouse's for a watcher, with all samples, and cross open shadow roots", async () => {
    const { page, close } = await open(site, `${CORNERS}<div id="host" style="position:absolute;left:0;top:0"></div>`, {
      script: READY,
    });
    const found = await page.evaluate(async () => {
      const { hand, dispatch } = window.testing;
      const root = document.querySelector("#host").attachShadow({ mode: "open" });
      root.innerHTML = '<button id="inner" style="position:absolute;left:440px;top:20px;width:80px;height:60px"></button>';
      const inner = root.querySelector("button");
      const events = [];
      inner.addEventListener("pointerenter", ({ composed }) => events.push(["enter", composed]));
      inner.addEventListener("click", () => events.push(["click"]));
      document.querySelector("#host").addEventListener("click", ({ target }) => events.push(["host", target.id]));
      await dispatch(document, hand({ x: 120, y: 640 }, document.querySelector("#b").getBoundingClientRect(), { seed: 3 }));
      const intents = log.filter(({ kind }) => kind === "intent").map(({ target }) => target);
      await dispatch(document, hand({ x: 880, y: 110 }, inner.getBoundingClientRect(), { seed: 4 }), { press: true });
      return { intents, events };
    });
    assert.ok(found.intents.includes("b"), JSON.stringify(found.intents));
    assert.deepEqual(found.events, [["enter", false], ["click"], ["host", "host"]]);
    await close();
  });

  it("a page whose clock stands still is played on that clock", async () => {
    const { page, close } = await open(site, ROW, { script: READY });
    await page.clock.install({ time: 0 });
    await page.clock.pauseAt(60_000);
    const before = await page.evaluate(() => performance.now());
    await move(page.mouse, SAMPLES, { advanceTimers: (ms) => page.clock.runFor(ms) });
    const after = await page.evaluate(() => performance.now());
    assert.equal(Math.round(after - before), Math.round(1000 * END));
    await close();
  });
});
