import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Camera } from "./camera.ts";

function camera(turn = { azimuth: -20, elevation: 24 }): Camera {
  const found = new Camera();
  found.resize(800, 500);
  found.turnTo(turn);
  return found;
}

describe("the camera", () => {
  it("has right at the right, down below, and near nearer", () => {
    const at = camera();
    const [middle, right, down, near] = [
      [100, 60, 0],
      [140, 60, 0],
      [100, 100, 0],
      [100, 60, 40],
    ].map((place) => at.project(place as [number, number, number]));
    assert.ok(middle && right && down && near);
    assert.ok(right.x > middle.x && down.y > middle.y && near.depth < middle.depth);
  });

  it("finds the place under a point again", () => {
    for (const turn of [
      { azimuth: -20, elevation: 24 },
      { azimuth: 40, elevation: 40 },
    ]) {
      for (const place of [
        [20, 20, 0],
        [250, 100, 180],
        [-100, 150, 260],
      ] as const) {
        const { x, y } = camera(turn).project(place);
        const found = camera(turn).placeAt(x, y, place[2]);
        found.forEach((value, axis) => assert.ok(Math.abs(value - (place[axis] ?? 0)) < 1e-6, `${found} for ${place}`));
      }
    }
  });

  it("projects by its matrix as by itself", () => {
    const at = camera({ azimuth: 30, elevation: 12 });
    const matrix = at.matrix();
    for (const place of [
      [20, 20, 0],
      [250, 100, 180],
      [-100, 150, 260],
    ] as const) {
      const clip = [0, 1, 2, 3].map((row) =>
        [...place, 1].reduce((sum, value, column) => sum + value * (matrix[4 * column + row] ?? 0), 0),
      );
      const [x = 0, y = 0, z = 0, w = 1] = clip;
      const expected = at.project(place);
      assert.ok(Math.abs(400 + (400 * x) / w - expected.x) < 1e-2 && Math.abs(250 - (250 * y) / w - expected.y) < 1e-2);
      assert.ok(Math.abs(w - expected.depth) < 1e-2 && Math.abs(z / w) < 1);
    }
  });

  it("turns no farther than its limits", () => {
    assert.deepEqual(camera({ azimuth: 500, elevation: -90 }).turn, { azimuth: 46, elevation: 6 });
  });
});
