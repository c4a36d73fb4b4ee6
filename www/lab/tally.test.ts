import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { LEAST_MOVEMENTS, MOVEMENTS_FOR_ALL, pathsFor } from "./folds.ts";
import type { Movement } from "./movement.ts";
import { expected, extrapolation, named, nearest } from "./peers.ts";
import { Tally, type Predict } from "./tally.ts";
import { leading, reasonFor } from "./words.ts";
import { verdict } from "./fitting.ts";

/** 2 px/ms to the right, past targets at 0, 100 and 300. */
const FAST: Movement = {
  id: "fast",
  user: "",
  targets: [
    [0, 0, 20, 20],
    [100, 0, 20, 20],
    [300, 0, 20, 20],
    [0, 300, 20, 20],
  ],
  target: 2,
  samples: [
    [0, 0, 0],
    [0.01, 20, 0],
    [0.02, 40, 0],
    [0.15, 300, 0],
  ],
};

describe("the methods that name one target", () => {
  it("name what their rules name", () => {
    assert.deepEqual(nearest(FAST, 4), [0, 0, 0, 2]);
    assert.equal(extrapolation(FAST, 3, { samples: 2, ahead: 0.03 })[2], 1); // 40 + 60
    assert.equal(extrapolation(FAST, 3, { samples: 3, ahead: 0.12 })[2], 2); // 40 + 240
    assert.equal(extrapolation(FAST, 1, { samples: 8, ahead: 0.6 })[0], 0, "at the first sample there is no velocity");
  });

  it("hold what the browser expected until it expects something else", () => {
    assert.equal(expected(FAST, 4), null);
    const ahead = { ...FAST, expected: [null, [90, 0], [90, 0], [310, 0]] as const };
    assert.deepEqual(expected(ahead, 4), [0, 1, 1, 2]);
    assert.equal(expected({ ...FAST, expected: [null, null, null, null] }, 4), null);
  });
});

describe("the tally", () => {
  /** The pointing model is right from the second sample on, the nearest target from the last; the others name nothing. */
  const rule: Predict = (id, movement, length) =>
    id === "pointing" ? named([0, 2, 2, 2]) : id === "nearest" ? named(nearest(movement, length)) : null;

  it("sorts methods by the share of the time, without those that could not be applied", () => {
    const tally = new Tally(rule);
    tally.add(FAST);
    tally.add({ ...FAST, id: "other" });
    const { movements, rows, comparison, best } = tally.summary();
    assert.equal(movements, 2);
    // weights .005, .01, .07, .065 of .15: all but the first
    assert.equal(rows[0]?.id, "pointing");
    assert.ok(Math.abs((rows[0]?.figures.time ?? 0) - 96.6666666667) < 1e-6);
    assert.equal(rows[0]?.spread, 0);
    // 120 ms ahead is right from the second sample on as well: it is at 20 + 240, nearer to 300 than to 100
    assert.equal(rows[1]?.id, "extrapolation");
    assert.deepEqual([best.samples, best.ahead], [2, 0.12]);
    assert.equal(comparison?.leader, "pointing");
    assert.equal(comparison?.next, "nearest");
    assert.ok(Math.abs((comparison?.mean ?? 0) - 53.3333333333) < 1e-6);
    assert.equal(rows.find(({ id }) => id === "foresight")?.figures.movements, 0);
  });

  it("counts a movement that never enters its target for none", () => {
    const tally = new Tally(rule);
    assert.equal(tally.add({ ...FAST, samples: FAST.samples.slice(0, 3) }), false);
    assert.equal(tally.summary().movements, 0);
  });

  it("counts nothing of a movement that a predictor refuses", () => {
    const tally = new Tally((id) => {
      if (id === "singleFilter") throw new Error("refused");
      return named([0, 0, 0, 0]);
    });
    assert.throws(() => tally.add(FAST), /refused/);
    const { movements, rows } = tally.summary();
    assert.deepEqual([movements, rows.every(({ figures }) => figures.movements === 0)], [0, true]);
  });
});

describe("the words", () => {
  const found = { leader: "pointing", next: "nearest", mean: 4, half: 1 } as const;
  const row = { id: "pointing", spread: 2, figures: { movements: 5 } } as Parameters<typeof reasonFor>[0];

  it("call a lead one only where it is more than chance", () => {
    assert.equal(leading(found, [row]), "Pointing model leads Nearest target by 4.0 points of time (95% interval 3.0 to 5.0).");
    assert.match(leading({ ...found, half: 6 }, [row]), /within chance: the 95% interval is −2\.0 to 10\.0\.$/);
  });

  it("state why a method was not scored on all movements", () => {
    assert.equal(reasonFor(row, 5, true), null);
    assert.equal(reasonFor(row, 7, true), "on 5 of 7 movements");
    const predicted = { ...row, id: "predicted" as const };
    assert.equal(reasonFor(predicted, 7, true), "the browser predicted in 5 of 7 movements");
  });

  it("call a gain one only where it is more than chance", () => {
    const result = {
      movements: 60,
      before: { loss: 1.5, time: 60 },
      after: { loss: 1.4, time: 61 },
      gain: { mean: 0.1, half: 0.05 },
      constants: [],
      sections: {},
    };
    assert.match(verdict(result), /^A gain of 0\.100 nats \(95% interval 0\.050 to 0\.150\)\./);
    assert.match(verdict({ ...result, gain: { mean: 0.1, half: 0.2 } }), /^No gain: 0\.100 nats are within chance/);
    assert.match(verdict({ ...result, gain: { mean: -0.1, half: 0.05 } }), /^No gain: on movements left out it is no better/);
  });
});

describe("fit", () => {
  it("learns as many constants as two thirds of the movements are enough for", () => {
    assert.deepEqual([LEAST_MOVEMENTS, MOVEMENTS_FOR_ALL], [30, 75]);
    assert.deepEqual(
      [0, 29, 30, 44, 45, 75, 500].map((movements) => pathsFor(movements)?.length ?? null),
      [null, null, 2, 2, 3, 5, 5],
    );
  });
});
