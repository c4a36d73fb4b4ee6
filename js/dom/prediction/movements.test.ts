import assert from "node:assert/strict";
import { describe, it } from "node:test";
import type { Sample } from "../pointers.js";
import type { Target } from "../targets.js";
import { Movement, Segmenter } from "./movements.js";

/** Seconds. */
const REST = 0.3;

const at = (time: number, x: number, y = 0): Sample => ({ time, x, y });

function feed(segmenter: Segmenter, samples: readonly Sample[]) {
  return samples.map((sample) => segmenter.add(sample, REST));
}

/** How many movements a track has. */
function movements(samples: readonly Sample[]): number {
  return feed(new Segmenter(), samples).filter((cut) => cut.fresh).length;
}

/** A hand at a steady pace to the right, in px/s, sampled at a rate. */
function steady({
  from = 0,
  start = 0,
  seconds,
  speed,
  rate,
}: {
  from?: number;
  start?: number;
  seconds: number;
  speed: number;
  rate: number;
}): Sample[] {
  return Array.from({ length: Math.floor(seconds * rate) + 1 }, (_, step) =>
    at(start + step / rate, from + (speed * step) / rate),
  );
}

/** A movement from 0 to 400 px in .4 s, at 100 Hz. */
const THERE = steady({ seconds: 0.4, speed: 1000, rate: 100 });

describe("segmenter", () => {
  it("begins a movement with its onset, not with the sample that gave it away", () => {
    const cuts = feed(new Segmenter(), [at(0, 0), at(0.016, 2), at(0.032, 7), at(0.048, 15), at(0.064, 25)]);
    assert.deepEqual(
      cuts.map(({ samples, fresh }) => [samples.length, fresh]),
      [
        [0, false],
        [0, false],
        [0, false],
        [4, true],
        [1, false],
      ],
    );
  });

  it("passes on no sample twice, and none that came late", () => {
    const segmenter = new Segmenter();
    feed(segmenter, [at(0, 0), at(0.01, 50)]);
    const cuts = feed(segmenter, [at(0.01, 50), at(0.005, 40), at(0.01, 51)]);
    assert.deepEqual(
      cuts.map((cut) => cut.samples.length),
      [0, 0, 1],
    );
  });

  it("passes over what a busy page is given late, in the midst of a movement", () => {
    const late = THERE.flatMap((sample, step) => (step % 10 === 9 ? [sample, { ...sample, time: sample.time - 0.15 }] : sample));
    assert.equal(movements(late.filter(({ time }) => time >= 0)), 1);
  });

  it("gives samples that were held up and come a millisecond apart one time", () => {
    const bunches = [0.1, 0.2].flatMap((time) => [0, 1, 2, 3].map((k) => at(time + 0.001 * k, 1000 * time + 20 * k)));
    const times = feed(new Segmenter(), [at(0, 0), ...bunches]).flatMap(({ samples }) => samples.map(({ time }) => time));
    assert.deepEqual(times, [0, ...Array(4).fill(0.1), ...Array(4).fill(0.2)]);
  });

  it("leaves the times of a mouse of 1 kHz as they are, but for the first of them after a silence", () => {
    const quick = steady({ start: 1, seconds: 0.2, speed: 1000, rate: 1000 });
    const times = feed(new Segmenter(), [at(0, -40), ...quick]).flatMap(({ samples }) => samples.map(({ time }) => time));
    assert.deepEqual(
      times.slice(-150),
      quick.slice(-150).map(({ time }) => time),
    );
    assert.ok(new Set(times).size > 185, `${new Set(times).size}`);
  });

  it("ends a movement at a rest that is longer than the option's, and at none that is shorter", () => {
    for (const [rest, count] of [
      [0.12, 1],
      [0.2, 1],
      [0.28, 1],
      [0.35, 2],
      [0.8, 2],
      [30, 2],
    ] as const) {
      const after = steady({ from: 401, start: 0.4 + rest, seconds: 0.3, speed: 600, rate: 100 });
      assert.equal(movements([...THERE, ...after]), count, `${rest} s`);
    }
    const segmenter = new Segmenter();
    const short = [...THERE, ...steady({ from: 401, start: 0.6, seconds: 0.1, speed: 600, rate: 100 })];
    assert.equal(short.map((sample) => segmenter.add(sample, 0.15)).filter((cut) => cut.fresh).length, 2);
  });

  it("begins the movement after a rest as if there had been none before", () => {
    const segmenter = new Segmenter();
    feed(segmenter, THERE);
    const next = steady({ from: 401, start: 1.4, seconds: 0.1, speed: 600, rate: 100 });
    const cuts = feed(segmenter, next);
    assert.deepEqual(
      cuts.flatMap((cut) => cut.samples),
      next,
    );
    assert.equal(cuts.find((cut) => cut.samples.length > 0)?.fresh, true);
  });

  it("takes an event that comes late for no rest: a busy page, in the midst of a movement", () => {
    for (const gap of [0.13, 0.3, 0.35, 0.5, 0.9]) {
      const before = steady({ seconds: 0.2, speed: 800, rate: 100 });
      const after = steady({ from: 160 + 500, start: 0.2 + gap, seconds: 0.2, speed: 800, rate: 100 });
      assert.equal(movements([...before, ...after]), 1, `${gap} s`);
    }
  });

  it("takes a late event for no rest wherever the pointer has turned meanwhile", () => {
    const before = steady({ seconds: 0.2, speed: 800, rate: 100 });
    for (const [x, y] of [
      [160, 300],
      [-140, 0],
      [60, -200],
    ] as const)
      assert.equal(movements([...before, at(0.6, x, y), at(0.61, x, y + 5)]), 1, `${x}, ${y}`);
  });

  it("follows a remote desktop, with an event every 109 ms", () => {
    assert.equal(movements(steady({ seconds: 1.5, speed: 500, rate: 1 / 0.109 })), 1);
    assert.equal(movements(steady({ seconds: 3, speed: 60, rate: 1 / 0.109 })), 1);
  });

  it("recognises a rest over a remote desktop, although the first event after it comes from farther away", () => {
    const before = steady({ seconds: 1.09, speed: 500, rate: 1 / 0.109 });
    const last = before.at(-1) as Sample;
    const after = steady({ from: last.x + 40, start: last.time + 0.654, seconds: 0.5, speed: 500, rate: 1 / 0.109 });
    assert.equal(movements([...before, ...after]), 2);
  });

  it("takes a trembling hand for a resting one", () => {
    const segmenter = new Segmenter();
    feed(segmenter, [at(0, 0), at(0.01, 50)]);
    for (let time = 0.02; time < 0.5; time += 0.01) segmenter.add(at(time, 50 + (Math.round(time * 100) % 2)), REST);
    assert.equal(segmenter.add(at(0.5, 53), REST).samples.length, 0);
    const cut = segmenter.add(at(0.51, 70), REST);
    assert.equal(cut.fresh, true);
    assert.ok(cut.samples.every((sample) => sample.time >= 0.39));
  });

  it("takes a trembling hand that falls silent for a resting one", () => {
    const tremble = Array.from({ length: 20 }, (_, step) => at(0.41 + step * 0.01, 400 + (step % 2)));
    assert.equal(movements([...THERE, ...tremble, ...steady({ from: 410, start: 0.8, seconds: 0.2, speed: 600, rate: 100 })]), 2);
  });

  it("keeps following a slow hand", () => {
    assert.equal(movements(steady({ seconds: 3.2, speed: 50, rate: 62.5 })), 1);
  });

  it("begins another movement after more than a second of silence, wherever the pointer comes back", () => {
    assert.equal(movements([...THERE, ...steady({ from: 1400, start: 1.6, seconds: 0.2, speed: 800, rate: 100 })]), 2);
  });

  it("begins another movement on a clock that was set back, and follows it", () => {
    const segmenter = new Segmenter();
    feed(segmenter, steady({ start: 100, seconds: 0.4, speed: 1000, rate: 100 }));
    const cuts = feed(segmenter, steady({ from: 410, start: 20, seconds: 0.4, speed: 1000, rate: 100 }));
    assert.equal(cuts.filter((cut) => cut.fresh).length, 1);
    const times = cuts.flatMap((cut) => cut.samples.map((sample) => sample.time));
    assert.equal(times[0], 20);
    assert.deepEqual(
      times,
      times.toSorted((a, b) => a - b),
    );
  });

  it("starts afresh after its end", () => {
    const segmenter = new Segmenter();
    feed(segmenter, [at(0, 0), at(0.01, 50), at(0.02, 90)]);
    segmenter.end();
    assert.equal(segmenter.moving, false);
    assert.deepEqual(segmenter.add(at(0.03, 120), REST), { samples: [at(0.02, 90), at(0.03, 120)], fresh: true });
    assert.equal(segmenter.moving, true);
  });
});

describe("movement", () => {
  it("heads where it has gone in the last 30 ms, or since the sample before", () => {
    const course = (...samples: readonly Sample[]) => {
      const movement = new Movement(samples[0] as Sample, []);
      for (const sample of samples) movement.add(sample);
      return [movement.at, movement.heading];
    };
    assert.deepEqual(course(at(0, 5, 6)), [at(0, 5, 6), { x: 0, y: 0 }]);
    assert.deepEqual(course(at(0, 0), at(0.01, 9), at(0.02, 9, 1), at(0.04, 9, 4)), [at(0.04, 9, 4), { x: 0, y: 4 }]);
    assert.deepEqual(course(at(0, 0), at(0.109, 50), at(0.218, 40, 3)), [at(0.218, 40, 3), { x: -10, y: 3 }]);
  });

  const [fuel, seats] = [{ key: "0" } as Target, { key: "1" } as Target];

  /** A movement that begins on the fuel at 50 px, then goes to these places, over these targets. */
  function leave(...places: readonly (readonly [x: number, over: readonly Target[]])[]): boolean[] {
    const movement = new Movement(at(0, 50), [fuel]);
    return places.map(([x, over], step) => {
      movement.add(at(0.01 * (step + 1), x));
      movement.moveOver(over);
      return movement.isLeaving(fuel);
    });
  }

  it("leaves the target that it began on, and no other one", () => {
    assert.deepEqual(leave([60, [fuel]], [95, [fuel]], [120, []]), [true, true, true]);
    assert.equal(new Movement(at(0, 50), [fuel]).isLeaving(seats), false);
    assert.equal(new Movement(at(0, 50), []).isLeaving(fuel), false);
  });

  it("does not leave it any more once the pointer has come half of the way back, or is over it", () => {
    assert.deepEqual(leave([250, [seats]], [160, []], [148, []], [250, [seats]]), [true, true, false, true]);
    assert.deepEqual(leave([105, []], [95, [fuel]]), [true, false]);
  });

  it("is confined to the target that it began on until it is over something else, and never again", () => {
    const movement = new Movement(at(0, 50), [fuel]);
    movement.moveOver([fuel]);
    assert.deepEqual(movement.confinedTo, [fuel]);
    movement.moveOver([]);
    movement.moveOver([fuel]);
    assert.deepEqual(movement.confinedTo, []);
    assert.deepEqual(new Movement(at(0, 50), []).confinedTo, []);
  });

  it("has the samples after any count, of those that it keeps", () => {
    const movement = new Movement(at(0, 0), []);
    for (let step = 0; step < 10_000; step++) movement.add(at(step, step));
    assert.equal(movement.count, 10_000);
    assert.ok(movement.samples.length <= 8192);
    assert.deepEqual(movement.after(9_998), [at(9_998, 9_998), at(9_999, 9_999)]);
    assert.deepEqual(movement.after(10_000), []);
    assert.equal(movement.after(0).length, movement.samples.length);
  });
});
