import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { duration, reach, seeded } from "./hand.ts";
import { History, judge } from "./history.ts";
import { Segmenter, type Sample } from "./segmenter.ts";
import { Tally } from "./tally.ts";

const at = (time: number, x: number, y = 0): Sample => ({ time, x, y });

function feed(segmenter: Segmenter, samples: readonly Sample[]) {
  return samples.map((sample) => segmenter.add(sample));
}

describe("segmenter", () => {
  it("begins a movement with its onset, not with the sample that gave it away", () => {
    const cuts = feed(new Segmenter(), [at(0, 0), at(0.016, 2), at(0.032, 7), at(0.048, 15), at(0.064, 25)]);
    assert.deepEqual(cuts.map((cut) => cut.samples.length), [0, 0, 0, 4, 1]);
    assert.deepEqual(cuts.map((cut) => cut.fresh), [false, false, false, true, false]);
  });

  it("feeds no sample twice, and none that runs backwards", () => {
    const segmenter = new Segmenter();
    feed(segmenter, [at(0, 0), at(0.01, 50)]);
    const cuts = feed(segmenter, [at(0.01, 50), at(0.005, 40), at(0.01, 51)]);
    assert.deepEqual(cuts.map((cut) => cut.samples.length), [0, 0, 1]);
  });

  it("ends a movement at a silence of more than 120 ms", () => {
    const segmenter = new Segmenter();
    feed(segmenter, [at(0, 0), at(0.01, 50)]);
    assert.deepEqual(segmenter.add(at(0.125, 90)), { samples: [at(0.125, 90)], fresh: false });
    assert.deepEqual(segmenter.add(at(0.26, 180)), { samples: [at(0.26, 180)], fresh: true });
  });

  it("takes a trembling hand for a resting one", () => {
    const segmenter = new Segmenter();
    feed(segmenter, [at(0, 0), at(0.01, 50)]);
    for (let time = 0.02; time < 0.3; time += 0.01) segmenter.add(at(time, 50 + (Math.round(time * 100) % 2)));
    assert.equal(segmenter.add(at(0.3, 53)).samples.length, 0);
    const cut = segmenter.add(at(0.31, 70));
    assert.equal(cut.fresh, true);
    assert.ok(cut.samples.every((sample) => sample.time >= 0.19));
  });

  it("keeps following a slow hand", () => {
    const segmenter = new Segmenter();
    let fresh = 0;
    for (let step = 0; step < 200; step += 1) if (segmenter.add(at(step * 0.016, step * 0.8)).fresh) fresh += 1;
    assert.equal(fresh, 1);
  });

  it("starts afresh after a press", () => {
    const segmenter = new Segmenter();
    feed(segmenter, [at(0, 0), at(0.01, 50), at(0.02, 90)]);
    segmenter.end();
    assert.deepEqual(segmenter.add(at(0.03, 120)), { samples: [at(0.02, 90), at(0.03, 120)], fresh: true });
  });
});

describe("judge", () => {
  const history = (rows: readonly (readonly [number, ...number[]])[]) => {
    const result = new History();
    for (const [time, ...probabilities] of rows) result.add(time, Float64Array.from(probabilities), 0);
    return result.moments;
  };
  const moments = history([
    [1.0, 0.5, 0.5],
    [1.1, 0.3, 0.7],
    [1.2, 0.6, 0.4],
    [1.3, 0.1, 0.9],
    [1.4, 0.2, 0.8],
  ]);

  it("counts the lead from the moment the right one stays on top", () => {
    const outcome = judge(moments, 1, 1.65, 0.85);
    assert.equal(outcome.rightSince, 1.3);
    assert.ok(Math.abs(outcome.lead - 0.35) < 1e-12);
    assert.equal(outcome.early, 1);
  });

  it("does not credit what became known at the press itself", () => {
    assert.deepEqual(judge(moments, 1, 1.3, 0.8), { chosen: 1, pressed: 1.3, rightSince: null, lead: 0, early: null });
  });

  it("gives no lead to what was not on top at the press", () => {
    const outcome = judge(moments, 0, 1.65, 0.65);
    assert.deepEqual(outcome, { chosen: 0, pressed: 1.65, rightSince: null, lead: 0, early: 1 });
  });

  it("knows a movement without an early selection", () => {
    assert.equal(judge(moments, 1, 1.65, 0.95).early, null);
  });
});

describe("tally", () => {
  const outcome = (lead: number, early: number | null) => ({ chosen: 3, pressed: 1, rightSince: null, lead, early });

  it("is silent before the first press", () => {
    assert.equal(new Tally().summary(), null);
  });

  it("counts every press, the wrong ones too", () => {
    const tally = new Tally();
    tally.add(outcome(0.3, 3));
    assert.deepEqual(tally.summary(), { presses: 1, medianLead: 0.3, earlyRight: 1, earlyWrong: 0 });
    tally.add(outcome(0, 5));
    tally.add(outcome(0.1, null));
    tally.add(outcome(0.2, 3));
    const summary = tally.summary();
    assert.ok(summary);
    assert.ok(Math.abs(summary.medianLead - 0.15) < 1e-12);
    assert.equal(summary.earlyRight, 0.5);
    assert.equal(summary.earlyWrong, 0.25);
  });
});

describe("hand", () => {
  const from = { x: 100, y: 100 };
  const to = { x: 600, y: 300 };

  it("leaves where it starts and arrives where it should, to the tremor", () => {
    const hand = reach(from, to, 80, seeded(7));
    assert.equal(hand.duration, duration(from, to, 80));
    const start = hand.at(0);
    const end = hand.at(hand.duration);
    assert.ok(Math.hypot(start.x - from.x, start.y - from.y) < 1);
    assert.ok(Math.hypot(end.x - to.x, end.y - to.y) < 1);
  });

  it("is half-way at half-time, like every minimum-jerk movement", () => {
    const half = reach(from, to, 80, () => 0.5).at(duration(from, to, 80) / 2);
    assert.ok(Math.hypot(half.x - 350, half.y - 200) < 1);
  });

  it("makes the same movements for everybody", () => {
    assert.deepEqual(reach(from, to, 80, seeded(1)).at(0.2), reach(from, to, 80, seeded(1)).at(0.2));
  });
});
