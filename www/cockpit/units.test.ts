import assert from "node:assert/strict";
import { before, describe, it } from "node:test";
import { init } from "whither";
import { type Position, TARGETS } from "./cabin.ts";
import { whereTo } from "./example.js";
import { follow, leader } from "./forecast.ts";
import { Movements } from "./movements.ts";
import { Replay } from "./replay.ts";
import { leadOf, outcome } from "./sentences.ts";
import type { Sample } from "./gesture.ts";
import { spread } from "./spread.ts";
import { handAt } from "./view/hand.ts";

describe("the ten lines", () => {
  it("run, and know the icon on the way to it", () => {
    const samples = Array.from({ length: 31 }, (_, k): Sample => {
      const way = 1 - (1 - k / 44) ** 2;
      return [k / 60, -60 + way * 280, 200 - way * 100, 300 - way * 300];
    });
    const answer = whereTo(TARGETS, samples);
    assert.equal(answer.id, "settings");
    assert.ok(answer.probability > 0.5 && (answer.low ?? 0) < (answer.high ?? 0), JSON.stringify(answer));
  });
});

describe("a replayed gesture", () => {
  before(() => init());

  it("is drawn between its samples, and predicted at the last one", () => {
    const replay = new Replay(3, { deviation: 0, frequency: 4 });
    const { samples } = replay.gesture;
    const { seconds, trail, at } = replay.instant((10.5 * 0.02) / replay.duration);
    assert.equal(at, 10);
    assert.ok(Math.abs(seconds - 0.21) < 1e-9);
    const [, x] = samples[10] ?? [0, 0];
    const [, next] = samples[11] ?? [0, 0];
    assert.ok(Math.abs((trail.at(-1)?.[0] ?? 0) - (x + next) / 2) < 1e-9);
    assert.equal(replay.instant(1).at, samples.length - 1);
    assert.equal(replay.instant(0).at, 0);
  });

  it("is led by its icon at the end, for as long as is stated", () => {
    const { gesture, moments } = new Replay(3, { deviation: 0, frequency: 4 });
    const last = moments.calm.at(-1);
    assert.ok(last && leader(last).icon === gesture.target);
    const lead = leadOf(moments.calm, gesture.target);
    const since = moments.calm.filter(({ sample }) => sample[0] >= last.sample[0] - lead - 1e-9);
    assert.ok(lead > 0.1 && since.every((moment) => leader(moment).icon === gesture.target));
    assert.equal(leadOf(moments.calm, (gesture.target + 1) % TARGETS.length), 0);
    assert.match(outcome(moments.calm, gesture.target), /is touched; it had been the most probable for 0\.\d\d s\.$/);
  });

  it("has probabilities that sum to one with none of them", () => {
    for (const { probabilities, none } of follow(new Replay(5, { deviation: 4, frequency: 6 }).gesture.samples, true)) {
      assert.ok(Math.abs(probabilities.reduce((sum, each) => sum + each, none) - 1) < 1e-9);
    }
  });
});

describe("a visitor's movements", () => {
  before(() => init());
  const reach = (movements: Movements, from: number, start: number) => {
    let seconds = start;
    for (let z = from; z >= 0; z -= 12, seconds += 0.02) movements.add(seconds, [220, 100, z], [220, 100, z]);
    return seconds;
  };

  it("end with a touch of what is under the finger, and begin again off the screen", () => {
    const movements = new Movements();
    let seconds = reach(movements, 240, 1);
    assert.deepEqual([movements.current.touched, TARGETS[movements.current.icon ?? 0]?.id], [true, "settings"]);
    const count = movements.current.moments.shake.length;
    movements.add(seconds, [220, 100, 12], [220, 100, 12]);
    assert.equal(movements.current.moments.shake.length, count);
    movements.add((seconds += 0.02), [220, 100, 60], [220, 100, 60]);
    assert.deepEqual([movements.current.touched, movements.current.moments.calm.length], [false, 1]);
    movements.free();
  });

  it("begin anew after a rest", () => {
    const movements = new Movements();
    const [start, hand]: [Position, Position] = [
      [80, 100, 220],
      [100, 100, 200],
    ];
    for (let k = 0; k < 5; k += 1) movements.add(k / 50 - 1, start, start);
    assert.equal(movements.current.moments.shake.length, 0);
    for (let k = 0; k < 60; k += 1) movements.add(k / 50, hand, hand);
    const rested = movements.current.moments.shake.length;
    assert.ok(rested > 25 && rested < 40, `${rested} samples until it rests`);
    movements.add(1.3, [110, 100, 190], [110, 100, 190]);
    assert.equal(movements.current.moments.shake.length, 1);
    movements.free();
  });

  it("touch nothing between the icons", () => {
    const movements = new Movements();
    for (let z = 40; z >= 0; z -= 4) movements.add(1 - z / 100, [40, 40, z], [40, 40, z]);
    assert.deepEqual([movements.current.touched, movements.current.icon], [true, null]);
    assert.equal(outcome(movements.current.moments.shake, null), "The screen is touched between the icons.");
    movements.free();
  });
});

describe("drawing", () => {
  it("has the fingertip where the hand is, and the arm behind it", () => {
    const [index] = handAt([100, 60, 50], [0, 0, 0, 1], [0, 0, 0, 1]);
    const [tip] = index?.points ?? [];
    assert.ok(tip && Math.hypot(tip[0] - 100, tip[1] - 60, tip[2] - 50) <= 8.5, String(tip));
    assert.ok((index?.points.at(-1)?.[2] ?? 0) > 80);
  });

  it("spreads names until each has its room", () => {
    assert.deepEqual(spread([10, 12, 50], 10, 0, 100), [10, 20, 50]);
    assert.deepEqual(spread([95, 97, 99], 10, 0, 100), [80, 90, 100]);
    assert.deepEqual(spread([-5], 10, 0, 100), [0]);
  });
});
