import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { RECORDED } from "../evidence.ts";
import { THRESHOLDS } from "../model/settings.ts";
import { Selecting, type Selection } from "../selecting.ts";
import { bandsOf, spotOf, stack } from "./bands.ts";
import { turnsBack } from "./fan.ts";
import { ellipse, isInformative } from "../../shared/ellipse.ts";
import { percent, seconds } from "../../shared/format.ts";
import { ranking } from "../../shared/ranking.ts";
import { History } from "../history.ts";
import { outcome, prediction, selection, tally } from "./sentences.ts";
import { trail } from "./trail.ts";
import { destinationOf } from "./walk.ts";
import { Status } from "../../shared/status.ts";

describe("format", () => {
  it("never calls the nearly certain certain, nor the possible impossible", () => {
    assert.deepEqual([0, 0.002, 0.0449, 0.5, 0.994, 0.998, 1].map(percent), ["0%", "<1%", "4%", "50%", "99%", ">99%", "100%"]);
  });

  it("gives times with the figures that they are good for", () => {
    assert.equal(seconds(0.3149), "0.31 s");
  });
});

describe("order of the rows", () => {
  it("is that of their numbers, however near they are", () => {
    assert.deepEqual(ranking([0.1, 0.2, 0.7]), [2, 1, 0]);
    assert.deepEqual(ranking(Float64Array.of(0.3, 0.301, 0.3005)), [1, 2, 0]);
  });

  it("is the reading order where they are equal", () => {
    assert.deepEqual(ranking([0.2, 0.3, 0.2, 0.3]), [1, 3, 0, 2]);
  });
});

describe("sentences", () => {
  it("name what is ringed", () => {
    assert.equal(prediction("Seats"), "Heading for Seats.");
    assert.equal(prediction(null), "Not sure yet.");
  });

  it("report one outcome of a press", () => {
    const of = (verdict: "right" | "wrong" | "unsure", mistaken: string | null, lead: number) =>
      outcome({ label: "Weather", verdict, mistaken, lead });
    assert.deepEqual(
      [of("right", null, 0.612), of("wrong", "Trip", 0.612), of("wrong", "Trip", 0), of("unsure", null, 0)],
      [
        "Lit Weather 0.61 s before you pressed.",
        "Lit Weather 0.61 s before you pressed, after first lighting Trip.",
        "Lit Trip, and you pressed Weather.",
        "Lit nothing before you pressed Weather.",
      ],
    );
    assert.match(outcome({ label: "Weather", verdict: "right", mistaken: null, lead: 1 }, true), /before it pressed\.$/);
  });

  it("report of a selection how it was made, and what it saved by which account", () => {
    const of = (more: Partial<Selection>) => {
      const made = { wanted: 1, selected: 1, by: "ring", saved: 0.4, measured: true, ...more } as const;
      return selection(made, made.selected === 1 ? "Trip" : "Fuel", "Trip");
    };
    assert.deepEqual(
      [of({}), of({ measured: false }), of({ saved: 0 }), of({ selected: 2, saved: 0 }), of({ by: "press", saved: 0 })],
      [
        "Selected Trip 0.40 s before the pointer was there.",
        "Selected Trip, stopped on the way: 0.40 s to go, by the model’s expectation.",
        "Selected Trip on arrival.",
        "Selected Fuel: wrong, it was to be Trip.",
        "You pressed Trip before any ring had closed.",
      ],
    );
    assert.equal(
      tally({ selections: 4, wrong: 1, pressed: 0, saved: 1, expected: 2 }),
      "4 selections, 1 wrong (25%), 1.00 s saved in all, 0.25 s each; 2 of the times expected by the model, where the hand stopped.",
    );
  });
});

describe("selecting at the threshold", () => {
  function begun(wanted: number) {
    const done: Selection[] = [];
    const hand = new Selecting((selection) => done.push(selection));
    hand.name(wanted);
    return { hand, done };
  }

  it("saves the time until the pointer is there", () => {
    const { hand, done } = begun(3);
    assert.equal(hand.ringed(3, 1, 0.5), true);
    hand.over(2, 1.2);
    assert.deepEqual(done, []);
    hand.over(3, 1.4);
    assert.equal(done.length, 1);
    assert.ok(Math.abs((done[0]?.saved ?? 0) - 0.4) < 1e-12 && done[0]?.measured);
    assert.equal(hand.ringed(3, 2, 0.5), false, "no icon is named");
  });

  it("saves what the model expected where the hand stops on the way, and nothing on arrival", () => {
    const stopped = begun(3);
    stopped.hand.ringed(3, 1, 0.5);
    stopped.hand.rested();
    stopped.hand.over(3, 9);
    assert.deepEqual(stopped.done, [{ wanted: 3, selected: 3, by: "ring", saved: 0.5, measured: false }]);
    const there = begun(3);
    there.hand.over(3, 1);
    there.hand.ringed(3, 1, 0.5);
    assert.equal(there.done[0]?.saved, 0);
  });

  it("counts a wrong one, and what was pressed before any ring had closed", () => {
    const { hand, done } = begun(3);
    hand.ringed(4, 1, 0.5);
    hand.name(5);
    hand.pressed(5);
    hand.name(6);
    hand.ringed(6, 2, 0.25);
    hand.rested();
    assert.deepEqual(
      done.map(({ selected, by }) => [selected, by]),
      [
        [4, "ring"],
        [5, "press"],
        [6, "ring"],
      ],
    );
    assert.deepEqual(hand.tally, { selections: 3, wrong: 1, pressed: 1, saved: 0.25, expected: 1 });
  });
});

describe("evidence", () => {
  it("has figures for every threshold of the slider, with which no more than all movements are right or wrong", () => {
    for (const { rows } of RECORDED) {
      assert.deepEqual(
        rows.map(({ threshold }) => threshold),
        [...THRESHOLDS],
      );
      for (const { right, wrong } of rows) assert.ok(right + wrong <= 100.05);
    }
  });
});

describe("status", () => {
  it("are shown at once, and announced seldom, the last of several", async (test) => {
    test.mock.timers.enable({ apis: ["setTimeout"] });
    let now = 0;
    test.mock.method(performance, "now", () => now);
    const [visible, live] = [{ textContent: "" }, { textContent: "" }];
    const status = new Status(visible as HTMLElement, live as HTMLElement);
    status.write("one");
    assert.deepEqual([visible.textContent, live.textContent], ["one", "one"]);
    status.write("two");
    status.write("three");
    assert.deepEqual([visible.textContent, live.textContent], ["three", "one"]);
    now = 700;
    test.mock.timers.tick(700);
    assert.equal(live.textContent, "three");
    status.write("four", true);
    status.show("five");
    assert.deepEqual([visible.textContent, live.textContent], ["five", "four"]);
  });
});

describe("trail", () => {
  it("is widest at the newest place and narrows to a point", () => {
    assert.equal(
      trail(
        [
          { x: 0, y: 0 },
          { x: 10, y: 0 },
          { x: 20, y: 0 },
        ],
        8,
      ),
      "M0 0L10 2L20 4L20 -4L10 -2L0 0Z",
    );
    assert.equal(trail([{ x: 3, y: 3 }], 8), "");
  });
});

describe("arrow keys", () => {
  it("walk in reading order, by rows, and to the first and last", () => {
    const keys = ["ArrowRight", "ArrowLeft", "ArrowUp", "ArrowDown", "Home", "End"];
    assert.deepEqual(
      keys.map((key) => destinationOf(key, 7, 7, 21)),
      [8, 6, 0, 14, 0, 20],
    );
  });

  it("stop at the first and last, and leave other keys alone", () => {
    assert.equal(destinationOf("ArrowLeft", 0, 7, 21), null);
    assert.equal(destinationOf("ArrowDown", 14, 7, 21), null);
    assert.equal(destinationOf("a", 3, 7, 21), null);
  });
});

describe("bands", () => {
  const moment = (time: number, ...probabilities: number[]) => ({
    time,
    probabilities: Float64Array.from(probabilities),
  });
  const labels = ["a", "b", "c", "d", "e", "f", "g"];
  const close = (values: readonly number[], expected: readonly number[]) =>
    values.forEach((value, index) => assert.ok(Math.abs(value - (expected[index] ?? Number.NaN)) < 1e-12, `${values}`));

  it("are the icons in the order in which they are noticed, all others as one, and none of them: 100% in all", () => {
    const bands = bandsOf([moment(0, 0.1, 0.05, 0.2), moment(1, 0.1, 0.7, 0.05)], labels);
    assert.deepEqual(
      bands.map((band) => band.label),
      ["c", "b", "", "", "", "Others", "None of them"],
    );
    close(bands[5]?.values ?? [], [0.1, 0.1]);
    close(bands[6]?.values ?? [], [0.65, 0.15]);
    close(stack(bands.map((band) => band.values)).at(-1) ?? [], [1, 1]);
  });

  it("keep an icon's place, and so its colour, for the complete movement", () => {
    const moments = [
      moment(0, 0.2, 0.1, 0, 0, 0, 0, 0),
      moment(1, 0.1, 0.6, 0.2, 0, 0, 0, 0),
      moment(2, 0, 0.2, 0.7, 0.05, 0, 0, 0),
      moment(3, 0, 0, 0, 0.2, 0.2, 0.2, 0.2),
    ];
    const places = moments.map((_, count) => bandsOf(moments.slice(0, count + 1), labels).map((band) => band.label));
    assert.deepEqual(
      ["a", "b", "c"].map((label) => places.map((names) => names.indexOf(label))),
      [
        [0, 0, 0, 0],
        [-1, 1, 1, 1],
        [-1, 2, 2, 2],
      ],
    );
    const led = bandsOf([...moments, moment(4, 0, 0, 0, 0, 0, 0, 0.6)], labels).map((band) => band.label);
    assert.equal(led.indexOf("g"), 0, "who leads has an area, in place of who was least probable");
  });

  it("are stacked", () => {
    assert.deepEqual(
      stack([
        [1, 2],
        [3, 4],
        [5, 6],
      ]),
      [
        [1, 2],
        [4, 6],
        [9, 12],
      ],
    );
  });

  it("are named where there is most room, and off the lines", () => {
    const xs = [0, 10, 20, 30, 40, 50];
    const lower = xs.map(() => 0.2);
    const upper = [0.3, 0.3, 0.5, 0.9, 0.9, 0.9];
    assert.deepEqual(spotOf(xs, lower, upper, 5, []), { x: 40, y: 0.55, room: 0.7 });
    const beside = spotOf(xs, lower, upper, 5, [38]);
    assert.ok(beside && Math.abs(beside.x - 38) >= 5);
    assert.equal(spotOf(xs, lower, upper, 30, []), null);
  });
});

describe("paths", () => {
  it("that turn back, to icons that the movement has passed, are hooks", () => {
    assert.equal(turnsBack([0, 0, 10, 0, 20, 2, 30, 8]), false);
    assert.equal(turnsBack([0, 0, 20, 0, 30, 5, 10, 8, -10, 10]), true);
  });
});

describe("ellipse", () => {
  it("has the deviations as its axes", () => {
    const { long, short, angle } = ellipse([9, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], 4);
    assert.deepEqual([long, short, Math.abs(angle)], [3, 2, 0]);
  });

  it("lies along the correlation", () => {
    const { long, short, angle } = ellipse([5, 3, 3, 5], 2);
    assert.ok(Math.abs(long - Math.sqrt(8)) < 1e-12);
    assert.ok(Math.abs(short - Math.sqrt(2)) < 1e-12);
    assert.ok(Math.abs(angle - Math.PI / 4) < 1e-12);
  });

  it("is shown once it distinguishes places", () => {
    assert.equal(isInformative({ long: 300, short: 20, angle: 0 }, 800, 430), false);
    assert.equal(isInformative({ long: 60, short: 20, angle: 0 }, 800, 430), true);
  });
});

describe("history", () => {
  /** Two movements, at 1 to 1.2 s and at 3 to 3.2 s. */
  function two(): History {
    const history = new History();
    for (const start of [1, 3]) {
      for (const later of [0, 0.1, 0.2]) history.add({ time: start + later, probabilities: Float64Array.of(later) });
      history.end();
    }
    return history;
  }
  const times = (moments: readonly { time: number }[]) => moments.map(({ time }) => time);

  it("has for a press the movement in which the icon was ringed, else the last one", () => {
    assert.deepEqual(times(two().take(1.15)), [1, 1.1, 1.2]);
    assert.deepEqual(times(two().take(3)), [3, 3.1, 3.2]);
    assert.deepEqual(times(two().take(4)), [3, 3.1, 3.2]);
  });

  it("begins again after a press, and keeps no more than the last seconds of a movement", () => {
    const history = two();
    history.take(4);
    assert.deepEqual(history.current, []);
    for (let time = 5; time < 30; time++) history.add({ time, probabilities: Float64Array.of(1) });
    assert.deepEqual([history.current[0]?.time, history.current.length], [17, 13]);
  });
});
