import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { isOn, TARGETS } from "./cabin.ts";
import { gesture, RATE } from "./gesture.ts";
import { shaking } from "./road.ts";

const SMOOTH = { deviation: 0, frequency: 4 };

describe("simulated gestures", () => {
  const gestures = Array.from({ length: 200 }, (_, k) => gesture(k + 1, SMOOTH));

  it("are the same for the same seed, and others for another", () => {
    assert.deepEqual(gesture(7, SMOOTH), gestures[6]);
    assert.notDeepEqual(gestures[7], gestures[6]);
  });

  it("end on the icon that they are to, on all of them", () => {
    assert.equal(new Set(gestures.map(({ target }) => target)).size, TARGETS.length);
    for (const { samples, target } of gestures) {
      const [, x, y, z] = samples.at(-1) as (typeof samples)[0];
      // a deviation of 3 mm of the aim and of 2 mm of the tracker
      assert.ok(
        isOn({ ...(TARGETS[target] as (typeof TARGETS)[0]), width: 36, height: 36 }, [x, y, z]) && Math.abs(z) < 10,
        `${[x, y, z]}`,
      );
    }
  });

  it("take about as long as Fitts's law has it, 50 samples a second", () => {
    const durations = gestures.map(({ samples }) => samples.at(-1)?.[0] ?? 0).sort((a, b) => a - b);
    const median = durations[100] ?? 0;
    assert.ok(median > 0.7 && median < 0.9, `${median} s`);
    for (const { samples } of gestures) samples.forEach(([time], k) => assert.ok(Math.abs(time - k / RATE) < 1e-9));
  });
});

describe("the road", () => {
  it("shakes each axis by its deviation, at about its frequency", () => {
    const shake = shaking({ deviation: 5, frequency: 4 }, 3);
    const places = Array.from({ length: 20_000 }, (_, k) => shake(k / 200));
    for (const axis of [0, 1, 2] as const) {
      const along = places.map((place) => place[axis]);
      const deviation = Math.sqrt(along.reduce((sum, x) => sum + x * x, 0) / along.length);
      assert.ok(Math.abs(deviation - 5) < 0.25, `${deviation} mm`);
      const crossings = along.filter((x, k) => k > 0 && x > 0 !== (along[k - 1] ?? 0) > 0).length;
      assert.ok(Math.abs(crossings / 100 / 2 - 4) < 0.6, `${crossings / 200} Hz`);
    }
  });

  it("is still where its deviation is 0", () => {
    assert.deepEqual(shaking(SMOOTH, 1)(0.7).map(Math.abs), [0, 0, 0]);
  });
});
