import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Hand } from "../hand.js";
import type { Target } from "../targets.js";
import type { PointerPosterior } from "./engine.js";
import { Track } from "./track.js";

/** Milliseconds. */
const REST = 300;

/** Two targets of 100 px, at 50 and at 550 px. */
const [left, right] = [{ key: "0" } as Target, { key: "1" } as Target];

/** What is at a place. */
function over(x: number): readonly Target[] {
  return Math.abs(x - 50) <= 50 ? [left] : Math.abs(x - 550) <= 50 ? [right] : [];
}

/** One pointer with its track, which knows what the pointer is over as a page's events have it. */
function pointer() {
  const hand = new Hand("mouse");
  const track = new Track(hand, { probability: () => 0.5 } as never as PointerPosterior);
  hand.predicted = track;
  /** At a time in seconds; gives whether there was something to observe. */
  const move = (time: number, x: number): boolean => {
    const before = hand.over ?? over(x);
    hand.moveOver(over(x));
    const observed = track.add([{ time, x, y: 50 }], before, REST, 1000 * time);
    track.moveOver(over(x));
    return observed;
  };
  /** From the left one to the right one in half a second; gives when it is there. */
  const go = (start = 0): number => {
    for (let step = 0; step <= 50; step++) move(start + step / 100, 50 + 10 * step);
    return start + 0.5;
  };
  /** Stirs about a place, 20 px at a time. */
  const stir = (start: number, x: number): number => {
    for (let step = 0; step < 20; step++) move(start + step / 100, x + 20 * Math.sin(step));
    return start + 0.2;
  };
  return { track, move, go, stir };
}

describe("track", () => {
  it("gives a press the movement that led to it, also after a rest", () => {
    for (const rest of [0.05, 0.12, 0.28, 0.5, 5]) {
      const { track, go } = pointer();
      const end = go();
      track.restAfter(REST, 1000 * (end + rest));
      assert.ok((track.leadingTo([right])?.count ?? 0) > 40, `${rest} s`);
      assert.equal(track.moving, rest < 0.3, `${rest} s`);
    }
  });

  it("gives a press after the hand has stirred on the target the movement before it", () => {
    for (const times of [1, 2, 3]) {
      const { track, go, stir } = pointer();
      let end = go();
      for (let time = 0; time < times; time++) end = stir(end + 0.5, 560);
      const movement = track.leadingTo([right]);
      assert.ok((movement?.samples.at(-1)?.time ?? 1) <= 0.5, `stirred ${times} times`);
    }
  });

  it("gives a press on another target than the one on which the hand has stirred what led there", () => {
    const { track, go, stir } = pointer();
    stir(go() + 0.5, 560);
    assert.ok((track.leadingTo([left])?.samples[0]?.time ?? 0) >= 0.9);
  });

  it("has no movement for a press without one: the first, the second of two, one after a mere stir", () => {
    const { track, go, stir } = pointer();
    assert.equal(track.leadingTo([left]), null);
    go();
    track.end();
    assert.equal(track.leadingTo([right]), null);
    stir(1, 560);
    assert.equal(track.leadingTo([right]), null);
  });

  it("keeps nothing of a movement that is over", () => {
    const { track, go } = pointer();
    go();
    track.known = true;
    track.end();
    assert.equal(track.movement, null);
    assert.equal(track.moving, false);
    assert.equal(track.probability(right), 0);
  });

  it("goes on where a rest turns out to be an event that came late", () => {
    const { track, move } = pointer();
    for (let step = 0; step <= 20; step++) move(step / 100, 50 + 10 * step);
    const { movement } = track;
    track.restAfter(REST, 600);
    assert.equal(track.moving, false);
    assert.equal(move(0.7, 500), true);
    assert.equal(track.moving, true);
    assert.equal(track.movement, movement);
  });

  it("observes nothing where a pointer repeats itself, and does not rest before its time", () => {
    const { track, go, move } = pointer();
    const end = go();
    track.fresh = false;
    assert.equal(move(end, 550), false);
    assert.equal(track.fresh, false);
    track.restAfter(REST, 1000 * end + REST);
    assert.equal(track.moving, true);
    track.restAfter(REST, 1000 * end + REST + 1);
    assert.equal(track.moving, false);
  });
});
