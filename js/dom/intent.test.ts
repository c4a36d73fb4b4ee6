import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Calls } from "./calls.js";
import { type Course, Hand, type Predicted } from "./hand.js";
import { Intents } from "./intent.js";
import { readOptions } from "./options.js";
import { type Target, Targets } from "./targets.js";
import { TestPage } from "./testing/page.js";
import type { Intent, Release, Watcher, WatchOptions } from "./types.js";

const BOX = { x: 0, y: 0, width: 40, height: 40 };

/** A movement with these probabilities, of targets by their element. */
class Scripted implements Predicted {
  moving = true;
  readonly remaining = null;
  readonly probabilities = new Map<Target, number>();
  movement: Course;
  #leaving: Target | null = null;

  constructor() {
    this.movement = this.#course();
  }

  probability(target: Target): number {
    return this.probabilities.get(target) ?? 0;
  }

  moveOver(): void {}

  /** Another movement begins: from a target. */
  begin(leaving: Target | null = null): void {
    this.#leaving = leaving;
    this.movement = this.#course();
  }

  #course(): Course {
    const leaving = this.#leaving;
    return { spent: new Set(), meant: [], rested: false, isLeaving: (target) => target === leaving };
  }
}

/** A predictor for which all targets are as probable. */
const EVENLY = {
  none: 0,
  remaining: null,
  observe() {},
  probabilities: (into = new Float64Array(3)) => into.fill(0.45),
  setTargets() {},
  reset() {},
  free() {},
};

/** Three buttons, what is meant of them, and a mouse that is scripted. */
function open(options: WatchOptions = {}) {
  const page = new TestPage({ core: () => assert.fail("no predictor is needed") });
  for (const id of ["a", "b", "c"]) page.append("button", BOX, { attributes: { id } });
  const log: string[] = [];
  const intents: Intent[] = [];
  const releases: Release[] = [];
  const settings = readOptions({
    root: page.document,
    onIntent(intent: Intent) {
      intents.push(intent);
      log.push(`${intent.reason} ${intent.id}`);
    },
    onRelease(release: Release) {
      releases.push(release);
      log.push(`${release.pressed ? "pressed" : "released"} ${release.id}`);
    },
    ...options,
  });
  const targets = new Targets("button", settings);
  const [a, b, c] = [...targets.all] as [Target, Target, Target];
  const hands: Hand[] = [];
  const hand = (pointerType: string) => {
    const made = new Hand(pointerType);
    made.predicted = new Scripted();
    hands.push(made);
    return made;
  };
  const mouse = hand("mouse");
  const calls = new Calls(page, () => settings.onError);
  let changes = 0;
  const room = new Intents(
    page,
    () => settings,
    () => hands,
    calls,
    () => changes++,
  );
  const over = (target: Target | null, by: "hover" | "scroll" = "hover", pointer = mouse) => {
    pointer.moveOver(target ? [target] : []);
    room.over(pointer, by);
    room.review();
  };
  return {
    page,
    room,
    targets,
    a,
    b,
    c,
    mouse,
    script: mouse.predicted as Scripted,
    hand,
    over,
    log,
    intents,
    releases,
    changes: () => changes,
  };
}

describe("intent: hover and scroll", () => {
  it("come for what a pointer has been over for 130 ms, and is over still", () => {
    for (const by of ["hover", "scroll"] as const) {
      const { page, a, b, over, log } = open();
      over(a, by);
      page.advance(129);
      over(b, by);
      page.advance(129);
      assert.deepEqual(log, []);
      page.advance(1);
      assert.deepEqual(log, [`${by} b`]);
    }
  });

  it("come after as long as is asked for, and never where that is no reason", () => {
    for (const [reasons, by, after] of [
      [{ hover: { after: 500 } }, "hover", 500],
      [{ hover: { after: 500 } }, "scroll", 500],
      [{ scroll: false }, "hover", 130],
      [{ scroll: false }, "scroll", null],
      [{ hover: false }, "hover", null],
    ] as const) {
      const { page, a, over, log } = open({ reasons });
      over(a, by);
      page.advance((after ?? 10_000) - 1);
      assert.deepEqual(log, [], JSON.stringify([reasons, by]));
      page.advance(1);
      assert.deepEqual(log, after === null ? [] : [`${by} a`], JSON.stringify([reasons, by]));
    }
  });

  it("come of no finger", () => {
    const { page, a, hand, over, log } = open();
    over(a, "hover", hand("touch"));
    page.advance(1000);
    assert.deepEqual(log, []);
  });
});

describe("intent: touch", () => {
  it("comes after 80 ms for what the finger is on still, and not where it is no reason", () => {
    for (const [reasons, moves, expected] of [
      [{}, false, ["touch a"]],
      [{}, true, []],
      [{ touch: false }, false, []],
    ] as const) {
      const { page, room, a, hand, log } = open({ reasons });
      const finger = hand("touch");
      finger.moveOver([a]);
      room.touch(finger, a);
      page.advance(79);
      assert.deepEqual(log, []);
      if (moves) finger.moveOver([]);
      page.advance(1);
      assert.deepEqual(log, expected);
    }
  });
});

describe("intent: press", () => {
  it("comes for the innermost of what was pressed, and ends in the press at once", () => {
    const { room, a, b, mouse, log } = open();
    room.press(mouse, [a, b]);
    assert.deepEqual(log, ["press a", "pressed a"]);
  });

  it("is none where it is no reason, or nothing was pressed", () => {
    const { room, mouse, a, log } = open({ reasons: { press: false } });
    room.press(mouse, [a]);
    const other = open();
    other.room.press(other.mouse, []);
    assert.deepEqual([log, other.log], [[], []]);
  });

  it("ends for good what was meant, and those around it, and never aborts", () => {
    const { page, room, a, b, mouse, over, log, intents } = open();
    over(a);
    page.advance(130);
    room.begin(b, "pointer", mouse);
    room.press(mouse, [a, b]);
    assert.deepEqual(log, ["hover a", "pointer b", "pressed a", "pressed b"]);
    over(null);
    room.review();
    room.leave(a);
    room.clear();
    assert.deepEqual([log.length, intents.map(({ signal }) => signal.aborted)], [4, [false, false]]);
  });

  it("leaves nothing waiting", () => {
    const { page, room, a, mouse, over, log } = open({ reactivate: 0 });
    over(a);
    room.press(mouse, [a]);
    page.advance(1000);
    assert.deepEqual(log, ["press a", "pressed a"]);
  });
});

describe("intent: focus and keyboard", () => {
  it("come once for each focus, and end when it moves on", () => {
    const { room, a, b, c, log, intents } = open();
    room.focus(a, [b]);
    assert.deepEqual(log.splice(0), ["focus a", "keyboard b"]);
    room.focus(b, [c]);
    assert.deepEqual(log.splice(0), ["keyboard c", "released a"]);
    assert.deepEqual(
      intents.map(({ id, signal }) => [id, signal.aborted]),
      [
        ["a", true],
        ["b", false],
        ["c", false],
      ],
    );
    room.focus(null, []);
    assert.deepEqual(log.splice(0), ["released b", "released c"]);
    room.focus(a, []);
    assert.deepEqual(log, ["focus a"]);
  });

  it("do not come for the focus where that is no reason", () => {
    const { room, a, log } = open({ reasons: { focus: false } });
    room.focus(a, []);
    assert.deepEqual(log, []);
  });
});

describe("intent: viewport", () => {
  it("comes for what has been visible so long, and ends when it is not any more", () => {
    const { page, room, a, log } = open({ reasons: { viewport: { after: 200 } } });
    const show = (visible: boolean) => {
      a.visible = visible;
      room.visible(a);
      room.review();
    };
    show(true);
    page.advance(150);
    show(false);
    page.advance(150);
    assert.deepEqual(log, []);
    show(true);
    page.advance(200);
    assert.deepEqual(log, ["viewport a"]);
    show(false);
    assert.deepEqual(log, ["viewport a", "released a"]);
  });

  it("is none by default", () => {
    const { page, room, a, log } = open();
    a.visible = true;
    room.visible(a);
    page.advance(10_000);
    assert.deepEqual(log, []);
  });
});

describe("intent: what is handed out", () => {
  it("has the target, what its options have, its probability and a signal", () => {
    const { room, targets, a, mouse, script, intents, releases } = open();
    targets.set(a.node, { name: "Apply", data: 7 });
    script.probabilities.set(a, 0.9);
    room.begin(a, "pointer", mouse);
    const [intent] = intents;
    assert.deepEqual(
      { ...intent, signal: intent?.signal.aborted },
      { target: a.node, reason: "pointer", probability: 0.9, remaining: null, signal: false, id: "a", name: "Apply", data: 7 },
    );
    room.press(mouse, [a]);
    assert.deepEqual(releases, [{ ...intent, pressed: true }]);
  });

  it("has probability 0 between movements, and for the focus", () => {
    const { room, a, b, mouse, script, intents } = open();
    script.probabilities.set(a, 0.9);
    script.moving = false;
    room.begin(a, "hover", mouse);
    room.focus(b, []);
    assert.deepEqual(
      intents.map(({ probability }) => probability),
      [0, 0],
    );
  });

  it("goes to the target's own callback in place of the watcher's", () => {
    const { room, targets, a, b, mouse, log } = open();
    const own: Intent[] = [];
    targets.set(a.node, { onIntent: (intent: Intent) => own.push(intent) });
    room.begin(a, "pointer", mouse);
    room.begin(b, "pointer", mouse);
    assert.deepEqual([own.map(({ id }) => id), log], [["a"], ["pointer b"]]);
  });

  it("is an event and a mark on the element too, unless nothing is to be decorated", () => {
    for (const decorate of [true, false]) {
      const { room, a, mouse, intents } = open({ decorate });
      const events: unknown[] = [];
      for (const type of ["whither:intent", "whither:release"]) {
        a.element?.addEventListener(type, (event) => {
          const { bubbles, composed, detail } = event as CustomEvent<Intent>;
          events.push([type, bubbles, composed, detail.id, a.element?.getAttribute("data-predicted")]);
        });
      }
      room.begin(a, "pointer", mouse);
      assert.equal(intents.length, 1);
      room.leave(a);
      const expected = [
        ["whither:intent", true, true, "a", "true"],
        ["whither:release", true, true, "a", null],
      ];
      assert.deepEqual(events, decorate ? expected : []);
      assert.equal(a.element?.getAttribute("data-predicted"), null);
    }
  });

  it("changes what is meant", () => {
    const { room, a, mouse, changes } = open();
    room.begin(a, "pointer", mouse);
    assert.deepEqual([room.targets, changes()], [[a], 1]);
    room.leave(a);
    assert.deepEqual([room.targets, changes()], [[], 2]);
  });
});

describe("intent: once", () => {
  it("in a movement, and again in the next one", () => {
    const { room, a, mouse, script, log } = open();
    const again = () => {
      room.begin(a, "pointer", mouse);
      room.review();
    };
    again();
    again();
    assert.deepEqual(log, ["pointer a", "released a"]);
    script.begin();
    again();
    assert.deepEqual(log.length, 4);
  });

  it("for good where it is never to be reactivated", () => {
    const { room, a, mouse, script, log } = open({ reactivate: "never" });
    room.begin(a, "pointer", mouse);
    room.review();
    script.begin();
    room.begin(a, "pointer", mouse);
    assert.deepEqual(log, ["pointer a", "released a"]);
  });

  it("in so many milliseconds, in one movement too", () => {
    const { page, room, a, mouse, log } = open({ reactivate: 100 });
    for (const wait of [0, 99, 1]) {
      page.advance(wait);
      room.begin(a, "pointer", mouse);
      room.review();
    }
    assert.deepEqual(log, ["pointer a", "released a", "pointer a", "released a"]);
  });

  it("while it is meant, whatever other reason there is", () => {
    const { page, room, a, mouse, over, log } = open({ reactivate: 0 });
    room.begin(a, "pointer", mouse);
    over(a);
    page.advance(130);
    room.focus(a, []);
    assert.deepEqual(log, ["pointer a"]);
  });

  it("and not at all where it is disabled, by its options or the page", () => {
    const { room, targets, a, b, c, mouse, log } = open();
    targets.set(a.node, { enabled: false });
    b.element?.setAttribute("disabled", "");
    c.element?.setAttribute("aria-disabled", "true");
    for (const target of [a, b, c]) room.begin(target, "pointer", mouse);
    assert.deepEqual(log, []);
  });
});

describe("intent: limit", () => {
  it("of what runs counts an intent until its promise is fulfilled, rejected, or its signal aborts", async () => {
    for (const finish of ["fulfil", "reject", "abort"] as const) {
      const errors: unknown[] = [];
      let end = (): void => {};
      const onIntent = ({ id }: Intent) => {
        started.push(id);
        return new Promise<void>((resolve, reject) => {
          end = finish === "fulfil" ? resolve : () => reject(new Error("offline"));
        });
      };
      const started: unknown[] = [];
      const { room, a, b, mouse, script } = open({ limit: { running: 1 }, onIntent, onError: (error) => errors.push(error) });
      script.probabilities.set(a, 0.9);
      room.begin(a, "pointer", mouse);
      room.begin(b, "pointer", mouse);
      assert.deepEqual(started, ["a"]);
      if (finish === "abort") room.leave(a);
      else end();
      await new Promise(setImmediate);
      room.begin(b, "pointer", mouse);
      assert.deepEqual(started, ["a", "b"], finish);
      assert.equal(errors.length, finish === "reject" ? 1 : 0);
    }
  });

  it("goes on counting what was pressed", () => {
    const { room, a, b, mouse, log } = open({ limit: { running: 1 } });
    room.begin(a, "pointer", mouse);
    room.press(mouse, [a]);
    room.begin(b, "pointer", mouse);
    assert.deepEqual(log, ["pointer a", "pressed a"]);
  });

  it("of a minute counts what began in the last one", () => {
    const { page, room, a, b, c, mouse, log } = open({ limit: { perMinute: 2 } });
    for (const [target, wait] of [
      [a, 30_000],
      [b, 29_999],
      [c, 1],
      [c, 0],
    ] as const) {
      room.begin(target, "pointer", mouse);
      page.advance(wait);
    }
    assert.deepEqual(
      log.filter((line) => line.startsWith("pointer")),
      ["pointer a", "pointer b", "pointer c"],
    );
    const { log: early, ...other } = open({ limit: { perMinute: 2 } });
    other.room.begin(other.a, "pointer", other.mouse);
    other.room.begin(other.b, "pointer", other.mouse);
    other.page.advance(59_999);
    other.room.begin(other.c, "pointer", other.mouse);
    assert.deepEqual(early, ["pointer a", "pointer b"]);
  });
});

describe("intent: the end", () => {
  it("comes when no sign holds any more: probability, pointer, focus", () => {
    const { room, a, mouse, script, over, log } = open();
    script.probabilities.set(a, 0.9);
    room.begin(a, "pointer", mouse);
    over(a);
    script.probabilities.set(a, 0.1);
    room.review();
    room.focus(a, []);
    over(null);
    assert.deepEqual(log, ["pointer a"]);
    script.probabilities.set(a, 0.5);
    room.focus(null, []);
    assert.deepEqual(log, ["pointer a"]);
    script.probabilities.set(a, 0.49);
    room.review();
    assert.deepEqual(log, ["pointer a", "released a"]);
  });

  it("comes where the movement is over", () => {
    const { room, a, mouse, script, log, intents } = open();
    script.probabilities.set(a, 0.9);
    room.begin(a, "pointer", mouse);
    script.moving = false;
    room.review();
    assert.deepEqual([log, intents[0]?.signal.aborted], [["pointer a", "released a"], true]);
  });

  it("comes for the target that is being left, whatever its probability", () => {
    const { room, a, mouse, script, over, log } = open();
    over(a);
    room.begin(a, "hover", mouse);
    script.begin(a);
    script.probabilities.set(a, 0.9);
    over(null);
    assert.deepEqual(log, ["hover a", "released a"]);
  });

  it("does not come while another pointer's sign holds", () => {
    const { room, a, mouse, hand, over, log } = open();
    const pen = hand("pen");
    over(a, "hover", pen);
    room.begin(a, "pointer", mouse);
    room.review();
    assert.deepEqual(log, ["pointer a"]);
  });

  it("comes when it is disabled by its options, or has gone", () => {
    const { room, targets, a, b, log } = open();
    room.focus(a, [b]);
    targets.set(a.node, { enabled: false });
    room.review();
    room.leave(b);
    assert.deepEqual(log, ["focus a", "keyboard b", "released a", "released b"]);
  });

  it("lets a movement that turns out not to have rested mean it once more", () => {
    for (const rested of [true, false]) {
      const { room, a, mouse, script, log } = open();
      room.begin(a, "pointer", mouse);
      Object.assign(script.movement, { rested });
      room.review();
      room.begin(a, "pointer", mouse);
      assert.equal(log.filter((line) => line === "pointer a").length, rested ? 2 : 1);
    }
  });

  it("of everything ends what waits too, and the focus", () => {
    const { page, room, a, b, c, mouse, over, log } = open({ reasons: { viewport: { after: 50 } } });
    room.focus(a, []);
    over(b);
    c.visible = true;
    room.visible(c);
    room.clear();
    page.advance(1000);
    assert.deepEqual([log, page.clock.pending], [["focus a", "released a"], 0]);
    room.begin(a, "hover", mouse);
    room.review();
    assert.deepEqual(room.targets, []);
  });
});

describe("intent: errors", () => {
  it("of callbacks are reported, and nothing stops", async () => {
    const errors: unknown[] = [];
    const onIntent = ({ id }: Intent) => {
      if (id === "a") throw new Error("thrown");
      return Promise.reject(new Error("rejected"));
    };
    const onRelease = () => {
      throw new Error("release");
    };
    const { room, a, b, mouse } = open({ onIntent, onRelease, onError: (error) => errors.push((error as Error).message) });
    room.begin(a, "pointer", mouse);
    room.begin(b, "pointer", mouse);
    room.review();
    await new Promise(setImmediate);
    assert.deepEqual(errors, ["thrown", "release", "release", "rejected"]);
    assert.deepEqual(room.targets, []);
  });

  it("are none where what was aborted rejects with an AbortError", async () => {
    const errors: unknown[] = [];
    const onIntent = ({ signal }: Intent) =>
      new Promise((_, reject) => signal.addEventListener("abort", () => reject(signal.reason)));
    const { room, a, mouse } = open({ onIntent, onError: (error) => errors.push(error) });
    room.begin(a, "pointer", mouse);
    room.leave(a);
    await new Promise(setImmediate);
    assert.deepEqual(errors, []);
  });
});

describe("intent: a page that interferes", () => {
  type Interfere = (watcher: Watcher, page: TestPage, elements: readonly Element[]) => void;

  /** A watcher on three buttons, on a page that does something at the first intent: as it is called back, or in an event's listener. */
  function watched(by: "callback" | "event", interfere: Interfere, options: WatchOptions = {}) {
    const elements: Element[] = [];
    const tabStops = (focused: Element) => elements.slice(elements.indexOf(focused) + 1);
    const page = new TestPage({ core: () => assert.fail("no predictor is needed"), tabStops });
    for (const [i, id] of ["a", "b", "c"].entries()) {
      elements.push(page.append("button", { ...BOX, x: 100 * i }, { attributes: { id } }));
    }
    const log: string[] = [];
    const signals: AbortSignal[] = [];
    let interfered = false;
    const once = () => {
      if (interfered) return;
      interfered = true;
      interfere(watcher, page, elements);
    };
    const watcher = page.watch("button", {
      reasons: { keyboard: { tabs: 2 } },
      onIntent({ id, reason, signal }) {
        log.push(`${reason} ${id}`);
        signals.push(signal);
        if (by === "callback") once();
      },
      onRelease: ({ id }) => log.push(`released ${id}`),
      ...options,
    });
    if (by === "event") elements[0]?.addEventListener("whither:intent", once);
    const marked = () => elements.filter((element) => element.getAttribute("data-predicted") !== null).map(({ id }) => id);
    return { page, watcher, elements, log, signals, marked };
  }

  /** The focus goes to the first button by a Tab key; the other two are ahead. */
  async function focused(by: "callback" | "event", interfere: Interfere) {
    const made = watched(by, interfere);
    const { page, elements } = made;
    await new Promise(setImmediate);
    page.dispatch("keydown", elements[0] as Element, { key: "Tab", shiftKey: false });
    page.dispatch("focusin", elements[0] as Element);
    page.advance(100);
    return made;
  }

  for (const by of ["callback", "event"] as const) {
    const begun = by === "callback" ? ["focus a"] : [];

    it(`by stopping the watcher in a ${by} has nothing open, and is called no more`, async () => {
      const { page, log, signals, marked } = await focused(by, (watcher) => watcher.stop());
      assert.deepEqual([log, marked()], [[...begun, "released a"], []]);
      assert.ok(signals.every(({ aborted }) => aborted));
      assert.deepEqual([page.listening, page.clock.pending, page.errors], [0, 0, []]);
    });

    it(`by pausing the watcher in a ${by} has nothing open until it is resumed`, async () => {
      const { page, watcher, elements, log, marked } = await focused(by, (watcher) => watcher.pause());
      assert.deepEqual([log.splice(0), marked()], [[...begun, "released a"], []]);
      watcher.resume();
      page.dispatch("focusin", elements[1] as Element);
      assert.equal(log[0], "focus b");
    });

    it(`by removing the target itself in a ${by} has its intent ended`, async () => {
      const { watcher, log } = await focused(by, (watcher, _, [a]) => watcher.remove(a as Element));
      assert.deepEqual(log.toSorted(), [...begun, "released a", "keyboard b", "keyboard c"].toSorted());
      assert.equal(watcher.getSnapshot().intended.length, 2);
    });

    it(`by removing another target in a ${by} hears nothing of that one`, async () => {
      const { log } = await focused(by, (watcher, _, [, b]) => watcher.remove(b as Element));
      assert.deepEqual(log, ["focus a", "keyboard c"]);
    });

    it(`by moving the focus on in a ${by} hears of what is ahead of that alone`, async () => {
      const { log, marked } = await focused(by, (_, page, [, , c]) => page.dispatch("focusin", c as Element));
      assert.ok(!log.includes("keyboard b"), log.join(", "));
      assert.deepEqual(marked(), ["c"]);
    });

    for (const [what, interfere] of [
      ["stopping the watcher", (watcher) => watcher.stop()],
      ["removing another target", (watcher, _, [, b]) => watcher.remove(b as Element)],
    ] as readonly (readonly [string, Interfere])[]) {
      it(`by ${what} in a ${by} hears of no other target that is as probable`, async () => {
        const options = { threshold: 0.1, load: "eager", predictor: () => EVENLY as never, reasons: {} } as const;
        const { page, watcher, log, marked } = watched(by, interfere, options);
        await watcher.ready;
        page.advance(20);
        for (const x of [440, 420, 400]) {
          page.point("pointermove", x, 300);
          page.advance(20);
        }
        const stopped = what.startsWith("stopping");
        assert.ok(
          log.every((line) => !line.endsWith(" b") && !line.endsWith(" ") && !line.endsWith("undefined")),
          log.join(", "),
        );
        assert.deepEqual(marked(), stopped ? [] : ["a", "c"]);
        watcher.stop();
        assert.deepEqual([page.listening, page.clock.pending, page.errors], [0, 0, []]);
      });
    }
  }

  it("by pausing the watcher as something is released has no movement left, nor is there one as it is resumed", async () => {
    const { page, watcher, log } = watched("callback", () => {}, {
      load: "eager",
      predictor: () => EVENLY as never,
      onRelease() {
        log.push("released");
        watcher.pause();
      },
    });
    await watcher.ready;
    page.point("pointermove", 20, 20);
    page.advance(200);
    const getCoalescedEvents = () =>
      [100, 200, 300].map((x, i) => ({ timeStamp: page.clock.now - 9 + 3 * i, clientX: x, clientY: 300 }));
    page.point("pointermove", 400, 300, { getCoalescedEvents });
    watcher.resume();
    page.advance(50);
    assert.deepEqual([log, watcher.getSnapshot().moving], [["hover a", "released"], false]);
    watcher.stop();
  });
});
