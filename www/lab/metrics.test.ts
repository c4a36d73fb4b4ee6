import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { add, figuresOf, meanOf, scoreOf, selections, type Prediction } from "./metrics.ts";
import type { Movement } from "./movement.ts";

/** To the right from 0 at 10 px/s, past the left target at 0 to the right one at 40. */
function movement(times: readonly number[]): Movement {
  return {
    id: "",
    user: "",
    targets: [
      [0, 0, 1, 1],
      [40, 0, 1, 1],
    ],
    target: 1,
    samples: times.map((time) => [time, 10 * time, 0]),
  };
}

const predicted = (top: number, probabilities: readonly number[]): Prediction => ({ top, probabilities });
const named = (top: number | null): Prediction => ({ top, probabilities: null });

describe("metrics", () => {
  it("are these of a movement that was scored by hand", () => {
    // times 0, 1, 2, 4: weights .5, 1, 1.5, 1 (sum 4); right at 1 and from 4 on
    const score = scoreOf(movement([0, 1, 2, 4]), [
      predicted(0, [0.6, 0.4]),
      predicted(1, [0.3, 0.7]),
      predicted(0, [0.95, 0.00001]),
      predicted(1, [0.04, 0.96]),
    ]);
    const figures = figuresOf(score);
    assert.equal(figures.time, 50);
    assert.equal(figures.lead, 0, "right since the last sample only");
    // -(ln .4 + ln .7 + ln .0001 + ln .96) / 4
    assert.ok(Math.abs((figures.loss ?? 0) - 2.6310320106) < 1e-9, `${figures.loss}`);
    // bins: .6 wrong, .7 right, .95 wrong and .96 right together: |.6 - 0| + |.7 - 1| + |1.91 - 1| = 1.81 of 4
    assert.ok(Math.abs((figures.calibration ?? 0) - 0.4525) < 1e-12);
    // a quarter of the time is at 1 (right), a half at 2 (wrong), three quarters at 3: the sample at 2
    assert.deepEqual(
      [0, 5, 10, 15, 20].map((k) => figures.course[k]),
      [0, 100, 0, 0, 100],
    );
  });

  it("have a lead from the last wrong sample on", () => {
    const lead = (...tops: (number | null)[]) => figuresOf(scoreOf(movement([0, 1, 2, 4]), tops.map(named))).lead;
    assert.equal(lead(1, null, 1, 1), 2000);
    assert.equal(lead(1, 1, 1, 0), 0);
    assert.equal(lead(1, 1, 1, 1), 4000);
  });

  it("have no loss, calibration and selection without probabilities", () => {
    const { loss, calibration, right, wrong } = figuresOf(scoreOf(movement([0, 1]), [named(0), named(1)]));
    assert.deepEqual([loss, calibration, right, wrong], [null, null, null, null]);
  });

  it("add up to means over movements and over samples", () => {
    const sum = scoreOf(
      movement([0, 1, 2]),
      [1, 1, 1].map((top) => predicted(top, [0.5, 0.5])),
    );
    add(
      sum,
      scoreOf(
        movement([0, 1]),
        [0, 0].map((top) => predicted(top, [0.9, 0.1])),
      ),
    );
    const figures = figuresOf(sum);
    assert.deepEqual([figures.movements, figures.time, figures.lead], [2, 50, 1000]);
    // (3 ln 2 + 2 ln 10) / 5
    assert.ok(Math.abs((figures.loss ?? 0) - 1.3369223455) < 1e-9, `${figures.loss}`);
    assert.deepEqual([figures.right, figures.wrong], [0, 50]);
  });

  it("select at 80% until 50%, and not the target that is being left", () => {
    const at = (...left: number[]) =>
      selections(
        movement(left.map((_, k) => k)),
        left.map((p) => predicted(p >= 0.5 ? 0 : 1, [p, 1 - p])),
      );
    // the left target, on which it began, from the second sample on; released at .4, then the right one
    assert.deepEqual(at(0.9, 0.85, 0.6, 0.4, 0.2), [
      { target: 0, sample: 1 },
      { target: 1, sample: 4 },
    ]);
    assert.deepEqual(at(0.9, 0.7, 0.3, 0.19), [{ target: 1, sample: 3 }]);
    assert.deepEqual(at(0.5, 0.21, 0.3, 0.79), []);
    // between threshold and release nothing else is selected, and nothing twice
    assert.deepEqual(at(0.5, 0.2, 0.45, 0.1, 0.2), [{ target: 1, sample: 1 }]);
  });

  it("have intervals over movements", () => {
    assert.equal(meanOf([1]), null);
    // deviation 1, of the mean 1 / sqrt(4)
    const found = meanOf([1, 1, 3, 3]);
    assert.equal(found?.mean, 2);
    assert.ok(Math.abs((found?.half ?? 0) - 1.131606528) < 1e-8, `${found?.half}`); // 1.96 sqrt(4 / 3 / 4)
  });
});
