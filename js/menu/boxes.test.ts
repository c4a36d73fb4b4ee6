import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { betweenOf, isIn } from "./boxes.js";

const trigger = { x: 100, y: 100, width: 80, height: 40 };

describe("the box between a trigger and its panel", () => {
  const cases = [
    [
      "is the gap beside it, as high as the trigger",
      { x: 200, y: 60, width: 100, height: 300 },
      { x: 180, y: 100, width: 20, height: 40 },
    ],
    ["is the gap above it", { x: 120, y: 0, width: 300, height: 90 }, { x: 120, y: 90, width: 60, height: 10 }],
    [
      "is the gap of both directions, diagonally",
      { x: 200, y: 160, width: 50, height: 50 },
      { x: 180, y: 140, width: 20, height: 20 },
    ],
    ["is what they have in common", { x: 150, y: 120, width: 100, height: 100 }, { x: 150, y: 120, width: 30, height: 20 }],
  ] as const;
  for (const [name, panel, expected] of cases) {
    it(name, () => {
      assert.deepEqual(betweenOf(trigger, panel), expected);
      assert.deepEqual(betweenOf(panel, trigger), expected);
    });
  }

  it("has its edges in it", () => {
    assert.equal(isIn(trigger, { x: 180, y: 140 }), true);
    assert.equal(isIn(trigger, { x: 180.1, y: 140 }), false);
  });
});
