import assert from "node:assert/strict";
import { it } from "node:test";
import type { Movement } from "./movement.ts";
import { stretches } from "./strip.ts";

it("the strip is lit from half of the interval before a right sample to half of the one after it", () => {
  const movement: Movement = {
    id: "",
    user: "",
    targets: [
      [0, 0, 1, 1],
      [9, 0, 1, 1],
    ],
    target: 1,
    samples: [0, 1, 2, 4, 5].map((time) => [time, time, 0]),
  };
  // the approach has four samples, 4 s: right at 1, and at 4
  assert.deepEqual(stretches(movement, [0, 1, 0, 1]), [
    { from: 0.125, to: 0.375 },
    { from: 0.75, to: 1 },
  ]);
  assert.deepEqual(stretches(movement, [1, 1, 1, 1]), [{ from: 0, to: 1 }]);
  assert.deepEqual(stretches(movement, [0, null, 0, 0]), []);
});
