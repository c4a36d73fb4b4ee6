import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { duration, reach, seeded } from "./hand.ts";

describe("hand", () => {
  const from = { x: 100, y: 100 };
  const to = { x: 600, y: 300 };

  it("begins at the start and arrives at the target, to the tremor", () => {
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

  it("takes longer at a slower pace, along the same way", () => {
    const [hand, slow] = [1, 2].map((pace) => reach(from, to, 80, () => 0.5, pace));
    assert.ok(hand && slow);
    assert.equal(slow.duration, 2 * hand.duration);
    assert.ok(Math.hypot(slow.at(slow.duration / 4).x - hand.at(hand.duration / 4).x) < 1);
  });

  it("makes the same movements for everybody", () => {
    assert.deepEqual(reach(from, to, 80, seeded(1)).at(0.2), reach(from, to, 80, seeded(1)).at(0.2));
  });
});
