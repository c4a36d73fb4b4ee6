import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { IntentRule, releaseOf, type Box } from "./intent.ts";

/** Three boxes of 100 px in a row, from 0 to 300. */
const BOXES: readonly Box[] = [0, 1, 2].map((index) => ({ x: 50 + 100 * index, y: 50, width: 100, height: 100 }));
const OUTSIDE = { x: 150, y: 400 };
const THRESHOLD = 0.8;

/** What is ringed after each step: place, then probabilities. */
function ringed(rule: IntentRule, steps: readonly (readonly [number, number, ...number[]])[]): (number | null)[] {
  return steps.map(([x, y, ...probabilities], step) => {
    rule.update(step, { x, y }, probabilities, THRESHOLD);
    return rule.current;
  });
}

describe("intent", () => {
  it("is there at the threshold, and stays until the release", () => {
    const rule = new IntentRule(OUTSIDE, BOXES);
    const steps = [0.79, 0.8, 0.6, 0.5, 0.49, 0.79, 0.9].map((p) => [150, 300, p, 1 - p, 0] as const);
    assert.deepEqual(ringed(rule, steps), [null, 0, 0, 0, null, null, 0]);
    assert.deepEqual(rule.intents, [
      { target: 0, time: 1 },
      { target: 0, time: 6 },
    ]);
  });

  it("moves over when another one passes the threshold", () => {
    const rule = new IntentRule(OUTSIDE, BOXES);
    assert.deepEqual(
      ringed(rule, [
        [150, 300, 0.9, 0.1, 0],
        [150, 290, 0.1, 0.9, 0],
      ]),
      [0, 1],
    );
    assert.deepEqual(
      rule.intents.map(({ target }) => target),
      [0, 1],
    );
  });

  it("has a release that follows the threshold", () => {
    assert.equal(releaseOf(0.8), 0.5);
    const rule = new IntentRule(OUTSIDE, BOXES);
    for (const [p, current] of [
      [0.4, 0],
      [0.3, 0],
      [0.24, null],
    ] as const) {
      rule.update(p, OUTSIDE, [p, 0.2, 0.2], 0.4);
      assert.equal(rule.current, current, String(p));
    }
  });

  it("is never the icon that is being left, which is named instead", () => {
    const rule = new IntentRule({ x: 50, y: 50 }, BOXES);
    assert.deepEqual(
      ringed(rule, [
        [60, 50, 0.95, 0.05, 0],
        [95, 50, 0.95, 0.05, 0],
        [120, 50, 0.9, 0.1, 0],
      ]),
      [null, null, null],
    );
    assert.equal(rule.leaving, 0);
    assert.deepEqual(ringed(rule, [[180, 50, 0.1, 0.1, 0.8]]), [2]);
    assert.equal(rule.leaving, null);
    assert.deepEqual(
      rule.intents.map(({ target }) => target),
      [2],
    );
  });

  it("is the icon that was left once the pointer has come half of the way back, or is over it", () => {
    const half = new IntentRule({ x: 50, y: 50 }, BOXES);
    assert.deepEqual(
      ringed(half, [
        [250, 50, 0.9, 0.1, 0],
        [160, 50, 0.9, 0.1, 0],
        [148, 50, 0.9, 0.1, 0],
        [250, 50, 0.9, 0.1, 0],
      ]),
      [null, null, 0, null],
    );
    const over = new IntentRule({ x: 2, y: 50 }, BOXES);
    assert.deepEqual(
      ringed(over, [
        [105, 50, 0.9, 0.1, 0],
        [95, 50, 0.9, 0.1, 0],
      ]),
      [null, 0],
    );
  });

  it("knows whether the pointer has left the icon that it began on, also between two beliefs", () => {
    const rule = new IntentRule({ x: 50, y: 50 }, BOXES);
    assert.equal(rule.confinedTo, 0);
    rule.move({ x: 130, y: 50 });
    rule.move({ x: 60, y: 50 });
    assert.equal(rule.confinedTo, null);
    assert.equal(new IntentRule(OUTSIDE, BOXES).confinedTo, null);
  });
});
