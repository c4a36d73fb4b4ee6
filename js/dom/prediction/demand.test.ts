import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { demandOf } from "./demand.js";
import { Movement } from "./movements.js";

/** 40 px wide and 20 high, 500 px to the right. */
const BOX = { x: 500, y: -10, width: 40, height: 20 };

/** A movement to the right that has come to these places, a sample every 10 ms. */
function movement(...places: readonly (readonly [x: number, y: number])[]): Movement {
  const samples = places.map(([x, y], step) => ({ time: step / 100, x, y }));
  const made = new Movement(samples[0] as (typeof samples)[number], []);
  for (const sample of samples) made.add(sample);
  return made;
}

/** On the way to the right, at a place. */
const at = (x: number, y = 0) => movement([x - 10, y], [x, y]);

describe("what a target has to have", () => {
  it("is the threshold 50 px before its edge, more before and less after that", () => {
    const demand = (x: number, y?: number) => Number(demandOf(0.8, BOX, at(x, y)).toFixed(4));
    assert.equal(demand(450), 0.8);
    // the corner at (500, 10) is 50 px away
    assert.equal(demand(470, 50), 0.8);
    // odds of 4 times (10/60)^.6 = .3413, as at its edge so in it
    assert.deepEqual([demand(500), demand(515)], [0.5772, 0.5772]);
    // times (560/60)^.6 = 3.8197
    assert.equal(demand(-50), 0.9386);
  });

  it("is more for a higher threshold everywhere, and never reached for 1", () => {
    for (const x of [0, 400, 499, 510]) {
      const demands = [0.05, 0.5, 0.9, 0.99].map((threshold) => demandOf(threshold, BOX, at(x)));
      assert.deepEqual(
        demands.toSorted((a, b) => a - b),
        demands,
      );
      assert.equal(demandOf(1, BOX, at(x)), 1);
    }
  });

  it("is more than any probability where the pointer moves away from it, and not across it or at rest", () => {
    assert.equal(demandOf(0.1, BOX, movement([450, 0], [440, 0])), Infinity);
    assert.equal(demandOf(0.1, BOX, at(540)), Infinity);
    assert.ok(demandOf(0.1, BOX, movement([450, 0], [450, 0])) < 1);
    assert.ok(demandOf(0.1, BOX, movement([450, 20], [450, 19])) < 1);
  });
});
