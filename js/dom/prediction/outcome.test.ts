import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Hand } from "../hand.js";
import type { Bounds } from "../types.js";
import type { Target } from "../targets.js";
import { Movement } from "./movements.js";
import { outcomeOf, type Press } from "./outcome.js";
import { Records } from "./records.js";

const [radio, seats] = ["radio", "seats"].map((id, i) => {
  const box: Bounds = { x: 100 * i, y: 0, width: 80, height: 40 };
  return { node: { id, bounds: () => box }, settings: { name: id.toUpperCase(), data: i }, box };
}) as never as readonly [Target, Target];

/** A press on the seats at 1500 ms, after a movement in which these were meant at these times. */
function press(meant: readonly (readonly [Target, number])[], active: readonly Target[] | null = null): Press {
  const movement = new Movement({ time: 1, x: 10, y: 20 }, []);
  movement.add({ time: 1, x: 10, y: 20 });
  movement.add({ time: 1.25, x: 60, y: 30 });
  for (const [target, time] of meant) movement.meant.push({ target, time, reason: "pointer" });
  return outcomeOf(new Hand("pen"), seats, movement, 1500, 0.75, null, active);
}

const judged = (...meant: readonly (readonly [Target, number])[]) => {
  const { verdict, mistaken, lead } = press(meant).outcome;
  return [verdict, mistaken, lead];
};

describe("outcome", () => {
  it("is right where the pressed target was meant and no other one, from then on", () => {
    assert.deepEqual(judged([seats, 1250]), ["right", null, 0.25]);
    assert.deepEqual(judged([seats, 1000], [seats, 1300]), ["right", null, 0.5]);
  });

  it("is wrong where another one was meant, and still has since when the pressed one was", () => {
    assert.deepEqual(judged([radio, 1000], [seats, 1250]), ["wrong", radio.node, 0.25]);
    assert.deepEqual(judged([seats, 1000], [radio, 1250]), ["wrong", radio.node, 0]);
  });

  it("is unsure where nothing was, and credits and blames nothing that was meant at the press itself", () => {
    for (const meant of [[], [[radio, 1500]], [[seats, 1500]]] as const) {
      assert.deepEqual(judged(...meant), ["unsure", null, 0]);
    }
  });

  it("has what is known of the target and the press", () => {
    assert.deepEqual(press([[seats, 1250]]).outcome, {
      target: seats.node,
      id: "seats",
      name: "SEATS",
      data: 1,
      time: 1500,
      pointerType: "pen",
      verdict: "right",
      mistaken: null,
      lead: 0.25,
      probability: 0.75,
      learnt: null,
    });
  });

  it("has a line of centres, sizes and samples where it is recorded and the target could have been pressed", () => {
    assert.equal(press([]).line, null);
    assert.equal(press([], [radio]).line, null);
    assert.deepEqual(JSON.parse(press([], [radio, seats]).line ?? ""), {
      targets: [
        [40, 20, 80, 40],
        [140, 20, 80, 40],
      ],
      target: 1,
      samples: [
        [1, 10, 20],
        [1.25, 60, 30],
      ],
    });
  });
});

describe("records", () => {
  it("have no summary before the first press", () => {
    assert.equal(new Records().summary(), null);
  });

  it("count every press, the wrong ones too, and have the median of the leads", () => {
    const records = new Records();
    for (const meant of [
      [[seats, 900]],
      [
        [radio, 1000],
        [seats, 1300],
      ],
      [
        [seats, 1000],
        [radio, 1250],
      ],
      [],
    ] as const) {
      records.add(press(meant));
    }
    const summary = records.summary();
    assert.ok(Math.abs((summary?.lead ?? 0) - 0.1) < 1e-12);
    assert.deepEqual([summary?.presses, summary?.right, summary?.wrong, summary?.calibration], [4, 0.25, 0.5, null]);
    assert.equal(records.presses(seats), 4);
    assert.equal(records.presses(radio), 0);
  });
});
