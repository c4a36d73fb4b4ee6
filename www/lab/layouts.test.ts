import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { LAYOUTS, nextTarget, randomOf, targetsOf } from "./layouts.ts";
import { mappingOf } from "./path.ts";

const FIELDS = [
  [785, 449],
  [328, 410],
  [1500, 857],
] as const;

describe("the targets", () => {
  for (const layout of LAYOUTS) {
    it(`of the ${layout} are large enough for a thumb, inside of the field and clear of one another`, () => {
      for (const [width, height] of FIELDS) {
        const targets = targetsOf(layout, width, height);
        assert.ok(targets.length >= 10, `${targets.length}`);
        targets.forEach(([x, y, w, h], k) => {
          assert.ok(w >= 44 && h >= 44, `${w} by ${h}`);
          assert.ok(x - w / 2 >= 0 && x + w / 2 <= width && y - h / 2 >= 0 && y + h / 2 <= height, `${[x, y]} of ${layout}`);
          for (const [ox, oy, ow, oh] of targets.slice(k + 1)) {
            assert.ok(Math.abs(ox - x) >= (ow + w) / 2 || Math.abs(oy - y) >= (oh + h) / 2, `${[x, y]} over ${[ox, oy]}`);
          }
        });
        assert.deepEqual(targetsOf(layout, width, height), targets, "the same ones again");
      }
    });
  }

  it("follow one another across the ring, each once", () => {
    const order = [0];
    while (order.length < 13) order.push(nextTarget("ring", order.at(-1) ?? 0, 13, Math.random));
    assert.deepEqual(order, [0, 6, 12, 5, 11, 4, 10, 3, 9, 2, 8, 1, 7]);
  });

  it("are never asked for twice in a row", () => {
    const random = randomOf(3);
    for (let k = 0; k < 200; k += 1) assert.notEqual(nextTarget("grid", 5, 28, random), 5);
  });

  it("are found again in a field of another size, and no others", () => {
    const [large, small] = [targetsOf("ring", 800, 457), targetsOf("ring", 400, 229)];
    const mapping = mappingOf(large, small);
    assert.ok(mapping);
    const [from, to] = [large[4], small[4]];
    const [x, y] = mapping([from?.[0] ?? 0, from?.[1] ?? 0]);
    assert.ok(Math.hypot(x - (to?.[0] ?? 0), y - (to?.[1] ?? 0)) < 4);
    assert.equal(mappingOf(targetsOf("grid", 800, 457), targetsOf("scatter", 800, 457)), null);
  });
});
