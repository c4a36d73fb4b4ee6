import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { verdict } from "../view/sentences.ts";
import type { Box } from "./intent.ts";
import { judge, type Outcome } from "./outcome.ts";
import { Tally } from "./tally.ts";
import { Track } from "./track.ts";

const LABELS = ["Radio", "Seats", "Fuel"];

describe("judge", () => {
  const rings = (...list: readonly (readonly [number, number])[]) => list.map(([target, time]) => ({ target, time }));

  it("finds the chosen one right from its ring on, where no other was ringed", () => {
    assert.deepEqual(judge(rings([1, 1.25]), 1, 1.5), { chosen: 1, pressed: 1.5, verdict: "right", mistaken: null, lead: 0.25 });
    assert.equal(judge(rings([1, 1], [1, 1.3]), 1, 1.5).lead, 0.5);
  });

  it("finds it wrong where another was ringed, and still knows since when it was right", () => {
    assert.deepEqual(judge(rings([0, 1], [1, 1.25]), 1, 1.5), {
      chosen: 1,
      pressed: 1.5,
      verdict: "wrong",
      mistaken: 0,
      lead: 0.25,
    });
    assert.deepEqual(judge(rings([1, 1], [0, 1.25]), 1, 1.5), {
      chosen: 1,
      pressed: 1.5,
      verdict: "wrong",
      mistaken: 0,
      lead: 0,
    });
  });

  it("credits and blames nothing that became known at the press itself", () => {
    for (const target of [0, 1]) assert.equal(judge(rings([target, 1.5]), 1, 1.5).verdict, "unsure");
  });
});

/** Every kind of outcome. */
const KINDS: readonly Outcome[] = [
  { chosen: 1, pressed: 2, verdict: "right", mistaken: null, lead: 0.612 },
  { chosen: 1, pressed: 2, verdict: "wrong", mistaken: 0, lead: 0.212 },
  { chosen: 1, pressed: 2, verdict: "wrong", mistaken: 0, lead: 0 },
  { chosen: 1, pressed: 2, verdict: "unsure", mistaken: null, lead: 0 },
];

describe("an outcome", () => {
  it("is reported in a sentence consistent with its numbers", () => {
    const sentences = KINDS.map((outcome) => {
      const tally = new Tally();
      tally.add(outcome);
      const summary = tally.summary();
      return [verdict(outcome, LABELS), summary?.medianLead, summary?.right, summary?.wrong];
    });
    assert.deepEqual(sentences, [
      ["right 612 ms before the press", 0.612, 1, 0],
      ["wrong at first (Radio), right 212 ms before the press", 0.212, 0, 1],
      ["wrong, it expected Radio", 0, 0, 1],
      ["not sure before the press", 0, 0, 0],
    ]);
  });
});

describe("tally", () => {
  it("has no summary before the first press", () => {
    assert.equal(new Tally().summary(), null);
  });

  it("counts every press, the wrong ones too", () => {
    const tally = new Tally();
    for (const outcome of KINDS) tally.add(outcome);
    const summary = tally.summary();
    assert.ok(summary);
    assert.ok(Math.abs(summary.medianLead - 0.106) < 1e-12);
    assert.deepEqual([summary.presses, summary.right, summary.wrong], [4, 0.25, 0.5]);
  });
});

describe("track", () => {
  /** Two boxes of 100 px, 400 px apart. */
  const boxes: readonly Box[] = [50, 550].map((x) => ({ x, y: 50, width: 100, height: 100 }));

  /** A hand from the first box to the second, at 100 Hz, with a probability that grows on the way. */
  function go(track: Track, start = 0): number {
    for (let step = 0; step <= 50; step += 1) {
      track.add({ time: start + step / 100, x: 50 + 10 * step, y: 50 }, () => boxes);
      track.record(Float64Array.of(1 - step / 50, step / 50), 0, 0.8);
    }
    return start + 0.5;
  }

  /** A hand that stirs about a place, 20 px at a time. */
  function stir(track: Track, start: number, x: number): number {
    for (let step = 0; step < 20; step += 1) {
      track.add({ time: start + step / 100, x: x + 20 * Math.sin(step), y: 50 }, () => boxes);
      track.record(Float64Array.of(0.5, 0.5), 0, 0.8);
    }
    return start + 0.2;
  }

  it("judges a press by the movement that led to it", () => {
    const track = new Track();
    const end = go(track);
    const judged = track.press(end + 0.05, 1);
    assert.equal(judged?.outcome.verdict, "right");
    assert.ok(Math.abs((judged?.outcome.lead ?? 0) - 0.15) < 1e-9, String(judged?.outcome.lead));
    assert.ok((judged?.moments.length ?? 0) > 40);
  });

  it("counts a press after a hover or after a rest with the movement before it", () => {
    for (const rest of [0.12, 0.28, 0.5, 5]) {
      const track = new Track();
      const judged = track.press(go(track) + rest, 1);
      assert.equal(judged?.outcome.verdict, "right", `${rest} s`);
      assert.ok(Math.abs((judged?.outcome.lead ?? 0) - (rest + 0.1)) < 1e-9);
    }
  });

  it("counts a press after a hand has stirred on the icon with the movement before it", () => {
    for (const times of [1, 2, 3]) {
      const track = new Track();
      let end = go(track);
      for (let time = 0; time < times; time += 1) end = stir(track, end + 0.5, 560);
      const judged = track.press(end, 1);
      assert.equal(judged?.outcome.verdict, "right", `stirred ${times} times`);
      assert.ok((judged?.moments.at(-1)?.time ?? 1) <= 0.5);
    }
  });

  it("judges a press where the hand has stirred, but on another icon, by what led there", () => {
    const track = new Track();
    const end = stir(track, go(track) + 0.5, 560);
    assert.equal(track.press(end, 0)?.outcome.verdict, "unsure");
  });

  it("knows a press without a movement: the first, the second of two, one on no icon", () => {
    assert.equal(new Track().press(1, 0), null);
    const track = new Track();
    track.press(go(track), 1);
    assert.equal(track.press(0.6, 1), null);
    assert.equal(track.press(stir(track, 1, 560), 1), null);
    go(track, 3);
    assert.equal(track.press(3.6, null), null);
  });

  it("keeps nothing of a movement that was lost", () => {
    const track = new Track();
    go(track);
    track.forget();
    assert.equal(track.movement, null);
    assert.equal(track.press(1, 1), null);
  });
});
