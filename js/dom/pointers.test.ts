import assert from "node:assert/strict";
import { describe, it } from "node:test";
import type { Platform } from "./platform.js";
import { listenToPointers, type PointerSinks, type Sample } from "./pointers.js";
import { type EventFields, TestPage } from "./testing/page.js";

interface Options {
  readonly pointers?: readonly string[];
  readonly raw?: boolean;
  /** The main window, where it is not the one whose pointers are followed. */
  readonly main?: Partial<Window>;
  /** When the clock of the followed window began. */
  readonly timeOrigin?: number;
}

/** A page whose pointers are followed; `heard` has each call of a sink, `samples` all of theirs, `over` what each was over. */
function follow({ pointers = ["mouse", "pen", "touch"], raw = false, main, timeOrigin = 0 }: Options = {}) {
  const page = new TestPage({ core: () => assert.fail("no predictor is needed") });
  Object.assign(page.window, { performance: { timeOrigin } });
  const button = page.append("button", { x: 0, y: 0, width: 100, height: 100 });
  const heard: unknown[] = [];
  const samples: Sample[] = [];
  const over: unknown[] = [];
  const sinks: PointerSinks = {
    moved({ pointerId }, some, _, place) {
      heard.push(["moved", pointerId]);
      samples.push(...some);
      over.push(place && (place.path[0] ?? "nothing"));
    },
    touched: ({ pointerId }, { path }) => heard.push(["touched", pointerId, path[0]]),
    pressed: ({ pointerId }, { path }) => heard.push(["pressed", pointerId, path[0]]),
    lost: (pointerId) => heard.push(["lost", pointerId]),
    gone: (pointerId) => heard.push(["gone", pointerId]),
    hidden: () => heard.push(["hidden"]),
  };
  const platform = { window: main ?? page.window, listen: page.listen.bind(page) } as Platform;
  const stop = listenToPointers(platform, page.window, sinks, ({ pointerType }) => pointers.includes(pointerType), raw);
  return { page, button, heard, samples, over, stop };
}

const FINGER: EventFields = { pointerId: 7, pointerType: "touch" };
const PEN: EventFields = { pointerId: 4, pointerType: "pen" };

/** A coalesced event. */
const part = (timeStamp: number, clientX: number) => ({ timeStamp, clientX, clientY: 5 });

describe("pointers: samples", () => {
  it("are the event itself where no coalesced ones are known, or none is in the list", () => {
    for (const fields of [{}, { getCoalescedEvents: () => [] }]) {
      const { page, samples } = follow();
      page.advance(1500);
      page.point("pointermove", 30, 5, fields);
      assert.deepEqual(samples, [{ time: 1.5, x: 30, y: 5 }]);
    }
  });

  it("are every coalesced event and the one that they were merged into, whether the list has that or not", () => {
    const parts = [part(20, 10), part(25, 20)];
    for (const list of [parts, [...parts, part(30, 30)]]) {
      const { page, samples } = follow();
      page.advance(30);
      page.point("pointermove", 30, 5, { getCoalescedEvents: () => list });
      const times = samples.map(({ time }) => time);
      assert.deepEqual(
        times,
        times.toSorted((a, b) => a - b),
      );
      assert.deepEqual(
        [...new Map(samples.map((sample) => [sample.time, sample])).values()],
        [
          { time: 0.02, x: 10, y: 5 },
          { time: 0.025, x: 20, y: 5 },
          { time: 0.03, x: 30, y: 5 },
        ],
      );
    }
  });

  it("come from raw updates only where these are asked for", () => {
    for (const raw of [true, false]) {
      const { page, samples } = follow({ raw });
      page.point("pointerrawupdate", 30, 5);
      assert.equal(samples.length, raw ? 1 : 0);
    }
  });

  it("of a frame are on the clock of the main window, coalesced ones too", () => {
    const { page, samples } = follow({ timeOrigin: 14_000, main: { performance: { timeOrigin: 10_000 } as Performance } });
    page.advance(30);
    page.point("pointermove", 30, 5, { getCoalescedEvents: () => [part(20, 10)] });
    assert.deepEqual(
      samples.map(({ time }) => time),
      [4.02, 4.03],
    );
  });

  it("are on the events' own clock where a window has no time of origin", () => {
    const { page, samples } = follow({ main: {} });
    page.advance(30);
    page.point("pointermove", 30, 5);
    assert.equal(samples[0]?.time, 0.03);
  });

  it("are of the followed types of pointers alone", () => {
    const { page, heard } = follow({ pointers: ["pen"] });
    for (const fields of [{}, FINGER]) {
      for (const type of ["pointermove", "pointerdown", "pointermove", "pointerup"]) page.point(type, 30, 5, fields);
    }
    for (const type of ["dragstart", "dragover", "drop"]) page.point(type, 30, 5);
    assert.deepEqual(
      heard.filter(([what]: never) => what !== "lost"),
      [],
    );
    page.point("pointermove", 30, 5, PEN);
    assert.deepEqual(heard.at(-1), ["moved", 4]);
  });
});

describe("pointers: a mouse and a pen", () => {
  it("press with their primary button, and with no other one", () => {
    const { page, button, heard } = follow();
    page.point("pointerdown", 30, 5, { button: 2 });
    page.point("pointerdown", 30, 5);
    page.point("pointerdown", 30, 5, PEN);
    page.point("pointerup", 30, 5);
    assert.deepEqual(heard, [
      ["pressed", 1, button],
      ["pressed", 4, button],
    ]);
  });

  it("are lost when they leave the window, and not when they go to another element", () => {
    const { page, button, heard } = follow();
    page.point("pointerout", 100, 5, { relatedTarget: button });
    assert.deepEqual(heard, []);
    page.point("pointerout", 100, 5);
    assert.deepEqual(heard, [["lost", 1]]);
  });

  it("go on in the window around a frame when they leave the frame", () => {
    const { page, heard } = follow({ main: {} });
    page.point("pointerout", 100, 5);
    assert.deepEqual(heard, []);
  });

  it("are lost when the browser takes them away", () => {
    const { page, heard } = follow();
    page.point("pointercancel", 30, 5);
    assert.deepEqual(heard, [["lost", 1]]);
  });
});

describe("pointers: a finger", () => {
  it("presses what it came down on when it is lifted within 10 px, and is gone", () => {
    for (const [x, y] of [
      [30, 5],
      [36, 13],
    ] as const) {
      const { page, button, heard } = follow();
      page.point("pointerdown", 30, 5, FINGER);
      page.point("pointerup", x, y, FINGER);
      const before = [
        ["moved", 7],
        ["touched", 7, button],
      ];
      assert.deepEqual(heard, [...before, ["pressed", 7, button], ["gone", 7]]);
    }
  });

  it("presses nothing when it has moved farther, even if it came back", () => {
    for (const [far, back] of [
      [41, 41],
      [60, 30],
    ] as const) {
      const { page, heard } = follow();
      page.point("pointerdown", 30, 5, FINGER);
      page.point("pointermove", far, 5, FINGER);
      page.point("pointerup", back, 5, FINGER);
      assert.deepEqual(heard.slice(-2), [
        ["lost", 7],
        ["gone", 7],
      ]);
    }
  });

  it("presses nothing when it is lifted far away, without a move between", () => {
    const { page, heard } = follow();
    page.point("pointerdown", 30, 5, FINGER);
    page.point("pointerup", 60, 5, FINGER);
    assert.deepEqual(heard.slice(-2), [
      ["lost", 7],
      ["gone", 7],
    ]);
  });

  it("is lost and gone when it scrolls the page, and has no samples after that", () => {
    const { page, heard } = follow({ raw: true });
    page.point("pointerdown", 30, 5, FINGER);
    page.point("pointercancel", 30, 20, FINGER);
    assert.deepEqual(heard.splice(0).slice(-2), [
      ["lost", 7],
      ["gone", 7],
    ]);
    page.point("pointerrawupdate", 30, 60, FINGER);
    page.point("pointerup", 30, 60, FINGER);
    assert.deepEqual(heard, []);
  });

  it("is over what it came down on, and over nothing from when it was drawn away", () => {
    const { page, button, over } = follow();
    page.point("pointerdown", 30, 5, FINGER);
    page.point("pointermove", 34, 5, FINGER);
    page.point("pointermove", 60, 5, FINGER);
    page.point("pointermove", 30, 5, FINGER);
    assert.deepEqual(over, [button, null, "nothing", "nothing"]);
  });

  it("is one of several, each by itself", () => {
    const { page, heard } = follow();
    const other = { ...FINGER, pointerId: 8 };
    page.point("pointerdown", 30, 5, FINGER);
    page.point("pointerdown", 60, 5, other);
    page.point("pointermove", 90, 5, other);
    heard.length = 0;
    page.point("pointerup", 90, 5, other);
    page.point("pointerup", 30, 5, FINGER);
    assert.deepEqual(
      heard.map(([what, id]: never) => [what, id]),
      [
        ["lost", 8],
        ["gone", 8],
        ["pressed", 7],
        ["gone", 7],
      ],
    );
  });
});

describe("pointers: a drag", () => {
  it("goes on from dragover with the pointer that began it, and ends in a press where it is dropped", () => {
    const { page, button, heard, samples } = follow();
    page.point("pointermove", 200, 5, PEN);
    page.point("dragstart", 200, 5);
    page.point("pointercancel", 200, 5, PEN);
    page.point("pointerout", 200, 5, PEN);
    page.advance(16);
    page.point("dragover", 90, 5);
    page.point("drop", 90, 5);
    page.point("dragend", 90, 5);
    assert.deepEqual(heard, [
      ["moved", 4],
      ["moved", 4],
      ["pressed", 4, button],
      ["lost", 4],
    ]);
    assert.deepEqual(samples.at(-1), { time: 0.016, x: 90, y: 5 });
  });

  it("that is given up is lost, once", () => {
    const { page, heard } = follow();
    page.point("dragstart", 200, 5);
    page.point("dragend", 200, 5);
    page.point("dragend", 200, 5);
    assert.deepEqual(heard, [["lost", 1]]);
  });

  it("from another program is the mouse's", () => {
    const { page, button, heard } = follow();
    page.point("dragover", 90, 5);
    page.point("drop", 90, 5);
    assert.deepEqual(heard, [
      ["moved", 1],
      ["pressed", 1, button],
      ["lost", 1],
    ]);
  });

  it("is over when the pointer moves by itself: it can be lost again", () => {
    const { page, heard } = follow();
    page.point("dragstart", 200, 5);
    page.point("pointermove", 200, 5);
    page.point("pointerout", 200, 5);
    assert.deepEqual(heard, [
      ["moved", 1],
      ["lost", 1],
    ]);
  });
});

describe("pointers: the page", () => {
  it("that is hidden, or left for another one, is reported; one that is shown is not", () => {
    const { page, heard } = follow();
    page.dispatch("visibilitychange", null);
    assert.deepEqual(heard, []);
    Object.assign(page.document, { hidden: true });
    page.dispatch("visibilitychange", null);
    page.dispatch("pagehide", null);
    assert.deepEqual(heard, [["hidden"], ["hidden"]]);
  });

  it("is listened to no longer after the end", () => {
    const { page, heard, stop } = follow({ raw: true });
    assert.ok(page.listening > 0);
    stop();
    page.point("pointermove", 30, 5);
    assert.deepEqual([page.listening, heard], [0, []]);
  });
});
