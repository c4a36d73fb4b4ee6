import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { hand, type HandOptions, type Sample } from "./hand.js";
import { random } from "./random.js";

const FROM = { x: 100, y: 500 };
const BOX = { x: 700, y: 60, width: 90, height: 40 };

const inside = ([, x, y]: Sample, box: typeof BOX) =>
  x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + box.height;

const mean = (numbers: readonly number[]) => numbers.reduce((sum, x) => sum + x, 0) / numbers.length;

/** Whether a call throws this. */
const refused = (call: () => unknown, code: string, path: string, message: string) =>
  assert.throws(call, { name: "WhitherError", code, path, message });

describe("hand", () => {
  it("is the same for the same seed, and another for another", () => {
    assert.deepEqual(hand(FROM, BOX, { seed: 7 }), hand(FROM, BOX, { seed: 7 }));
    assert.deepEqual(hand(FROM, BOX), hand(FROM, BOX, { seed: 1 }));
    const movements = [1, 2, 1.5, -1, 0, 2 ** 40, 2 ** 41].map((seed) => JSON.stringify(hand(FROM, BOX, { seed })));
    assert.equal(new Set(movements).size, movements.length);
  });

  it("is the same on every machine and in every version, but for the last bits of the times", () => {
    const samples = hand({ x: 0, y: 0 }, { x: 300, y: 200 }, { seed: 3, rate: 20 });
    const rounded = samples.map(([time, ...place]) => [Number(time.toFixed(3)), ...place]);
    assert.deepEqual(rounded, SNAPSHOT);
  });

  it("begins where it is from at 0 s, and presses in the target, however small that is", () => {
    for (const size of [1, 2, 5, 24, 200]) {
      for (let seed = 0; seed < 200; seed += 1) {
        const box = { x: 400, y: 300, width: size, height: 2 * size };
        const samples = hand({ x: 80.4, y: 99.6 }, box, { seed });
        assert.deepEqual(samples[0], [0, 80, 100]);
        assert.ok(inside(samples.at(-1) as Sample, box), `seed ${seed}, ${size} px: ${samples.at(-1)}`);
      }
    }
  });

  it("has what a mouse reports: integer pixels, in its own rhythm, none while it stays, and the press", () => {
    for (let seed = 0; seed < 50; seed += 1) {
      const samples = hand(FROM, BOX, { seed, rate: 100 });
      for (const [index, [time, x, y]] of samples.entries()) {
        const [before = 0, ...place] = samples[index - 1] ?? [];
        const isPress = index === samples.length - 1;
        assert.ok(index === 0 || time > before, `${time} after ${before}`);
        assert.ok(Number.isInteger(x) && Number.isInteger(y));
        assert.equal(isPress, x === place[0] && y === place[1], `seed ${seed}, sample ${index}`);
        assert.ok(isPress || Math.abs(100 * time - Math.round(100 * time)) < 1e-9, `${time}`);
      }
    }
  });

  it("has what a device of another resolution reports: its multiples, or with 0 every sample as it is", () => {
    const options = { seed: 3, rate: 50, dwell: 0 };
    const half = hand({ x: 0.3, y: 0 }, { x: 300, y: 200 }, { ...options, resolution: 0.5 });
    assert.ok(half.every(([, x, y]) => Number.isInteger(2 * x) && Number.isInteger(2 * y)));
    assert.ok(half.some(([, x]) => !Number.isInteger(x)));
    const exact = hand({ x: 0.3, y: 0 }, { x: 300, y: 200 }, { ...options, resolution: 0 });
    assert.deepEqual(
      exact.map(([time]) => time),
      Array.from(exact, (_, k) => k / 50),
    );
    assert.deepEqual(exact[0], [0, 0.3, 0]);
    for (const [time, x, y] of half) {
      const [, exactX = 0, exactY = 0] = exact[Math.round(50 * time)] ?? [];
      assert.ok(Math.abs(x - exactX) < 0.63 && Math.abs(y - exactY) < 0.63);
    }
  });

  it("takes boxes by their corner, as the platform gives them, and points in the middle of a size", () => {
    const middle = { x: BOX.x + BOX.width / 2, y: BOX.y + BOX.height / 2 };
    const square = { x: middle.x - 20, y: middle.y - 20, width: 40, height: 40 };
    assert.deepEqual(hand(FROM, middle), hand(FROM, square));
    assert.deepEqual(hand(FROM, middle, { size: 40 }), hand(FROM, square));
    assert.deepEqual(hand({ x: 80, y: 490, width: 40, height: 20 }, BOX), hand(FROM, BOX));
    // as DOMRect, whose properties are its class's
    class Rect {
      get x() {
        return BOX.x;
      }
      get y() {
        return BOX.y;
      }
      get width() {
        return BOX.width;
      }
      get height() {
        return BOX.height;
      }
    }
    assert.deepEqual(hand(FROM, new Rect()), hand(FROM, BOX));
  });

  it("without noise goes straight to the middle, fastest and half-way at half the time", () => {
    const samples = hand({ x: 0, y: 0 }, { x: 600, y: 0 }, { noise: 0, dwell: 0, pace: 10, rate: 1000 });
    assert.ok(samples.every(([, , y]) => y === 0));
    assert.deepEqual(samples.at(-1)?.slice(1), [600, 0]);
    // minimum jerk covers 10.35, 50 and 89.65% of the way in a quarter, half and three quarters of the time; its peak is 15/8 of the mean speed
    const [quarter = 0, half = 0, most = 0] = [0.1035, 0.5, 0.8965].map(
      (share) => samples.find(([, x]) => x >= 600 * share)?.[0] ?? 0,
    );
    assert.ok(Math.abs(quarter / half - 0.5) < 0.01 && Math.abs(most / half - 1.5) < 0.01, `${quarter}, ${half}, ${most}`);
    const at = (time: number) => samples.findLast(([t]) => t <= time)?.[1] ?? 0;
    const peak = (at(1.05 * half) - at(0.95 * half)) / (0.1 * half);
    assert.ok(Math.abs(peak / (300 / half) - 1.875) < 0.03, `${peak}`);
  });

  it("takes so many times as long with a pace, all else alike", () => {
    const [once, twice] = [1, 2].map((pace) => hand(FROM, BOX, { noise: 0, pace, rate: 1000 }));
    assert.ok(Math.abs((twice?.at(-1)?.[0] ?? 0) / (once?.at(-1)?.[0] ?? 1) - 2) < 0.01);
    const median = (pace: number) => {
      const times = Array.from({ length: 101 }, (_, seed) => hand(FROM, BOX, { seed, pace }).at(-1)?.[0] ?? 0);
      return times.sort((a, b) => a - b)[50] ?? 0;
    };
    assert.ok(Math.abs(median(2) / median(1) - 2) < 0.25);
  });

  it("rests as long before the press as the dwell, by itself a tenth of a second or so", () => {
    const [at, later] = [0, 2].map((dwell) => hand(FROM, BOX, { seed: 3, dwell }));
    assert.deepEqual(later?.slice(0, -1), at);
    assert.equal(later?.at(-1)?.[0], (at?.at(-1)?.[0] ?? 0) + 2);
    const rests = Array.from({ length: 201 }, (_, seed) => {
      const [[end = 0] = [], [press = 0] = []] = hand(FROM, BOX, { seed }).slice(-2);
      return press - end;
    }).sort((a, b) => a - b);
    const [early = 0, middle = 0, late = 0] = [rests[10], rests[100], rests[190]];
    assert.ok(early > 0.01 && middle > 0.08 && middle < 0.13 && late < 0.5, `${early}, ${middle}, ${late}`);
  });

  it("stops on the way with a share", () => {
    const all = hand(FROM, BOX, { seed: 3, dwell: 0 });
    const part = hand(FROM, BOX, { seed: 3, share: 0.6 });
    assert.deepEqual(part, all.slice(0, part.length));
    const entry = all.find((_, index) => all.slice(index).every((one) => inside(one, BOX)))?.[0] ?? 0;
    const [[last = 0] = [], [next = 0] = []] = [part.at(-1), all[part.length]];
    assert.ok(last <= 0.6 * entry && next > 0.6 * entry, `${last}, ${next} of ${entry}`);
  });

  it("presses beside the target now and then if it may be mistaken, and only then", () => {
    const dot = { x: 400, y: 300, width: 24, height: 24 };
    const missed = (mistakes: boolean) =>
      Array.from({ length: 3000 }, (_, seed) => hand(FROM, dot, { seed, mistakes, rate: 60 })).filter(
        (samples) => !inside(samples.at(-1) as Sample, dot),
      ).length / 3000;
    assert.equal(missed(false), 0);
    const share = missed(true);
    assert.ok(share > 0.001 && share < 0.04, `${share}`);
  });

  it("follows Fitts's law: the time of a distance and a size is that of their ratio's logarithm", () => {
    const cases = [100, 200, 400, 800].flatMap((distance) => [20, 40, 80].map((size) => ({ distance, size })));
    const points = cases.map(({ distance, size }) => {
      const durations = Array.from({ length: 150 }, (_, seed) => {
        const options = { seed: 1000 * distance + seed, size, dwell: 0, rate: 60 };
        return hand({ x: 0, y: 0 }, { x: distance, y: 0 }, options).at(-1)?.[0] ?? 0;
      });
      return [Math.log2(distance / size + 1), mean(durations)] as const;
    });
    const [bits, times] = [points.map(([x]) => x), points.map(([, y]) => y)];
    const [mx, my] = [mean(bits), mean(times)];
    const covariance = mean(points.map(([x, y]) => (x - mx) * (y - my)));
    const slope = covariance / mean(bits.map((x) => (x - mx) ** 2));
    const explained = covariance ** 2 / mean(bits.map((x) => (x - mx) ** 2)) / mean(times.map((y) => (y - my) ** 2));
    assert.ok(slope > 0.08 && slope < 0.2, `${slope} s for a bit`);
    assert.ok(explained > 0.9, `r^2 ${explained}`);
  });

  it("arrives when it goes nowhere, or out of a target", () => {
    assert.deepEqual(hand(FROM, FROM, { noise: 0, dwell: 0 }), [[0, 100, 500]]);
    assert.deepEqual(hand(FROM, FROM, { noise: 0, dwell: 0.5 }), [
      [0, 100, 500],
      [0.5, 100, 500],
    ]);
    for (let seed = 0; seed < 50; seed += 1) assert.ok(inside(hand({ x: 705, y: 65 }, BOX, { seed }).at(-1) as Sample, BOX));
  });

  it("refuses what is no place and no option, with its path", () => {
    const call = (from: unknown, to: unknown, options?: unknown) => () =>
      hand(from as never, to as never, options as HandOptions);
    refused(call(FROM, null), "missing-key", "to", 'to: missing key "to"');
    refused(call([1, 2], BOX), "missing-key", "from.x", 'from.x: missing key "x"');
    refused(call("here", BOX), "wrong-type", "from", 'from: must be a point or a box, got "here"');
    refused(call(FROM, { ...BOX, width: 0 }), "out-of-range", "to.width", "to.width: must be greater than 0, got 0");
    refused(call(FROM, { x: 1, y: 2, width: 3 }), "missing-key", "to.height", 'to.height: missing key "height"');
    refused(call(FROM, { x: 1, y: Number.NaN }), "not-finite", "to.y", "to.y: must be a finite number, got NaN");
    refused(call(FROM, BOX, { seed: "1" }), "wrong-type", "seed", 'seed: must be a number, got "1"');
    refused(call(FROM, BOX, { rate: 1e6 }), "out-of-range", "rate", "rate: must be at most 10000, got 1000000");
    refused(call(FROM, BOX, { resolution: -1 }), "out-of-range", "resolution", "resolution: must be at least 0, got -1");
    refused(call(FROM, BOX, { pace: 101 }), "out-of-range", "pace", "pace: must be at most 100, got 101");
    refused(call(FROM, BOX, { noise: -1 }), "out-of-range", "noise", "noise: must be at least 0, got -1");
    refused(call(FROM, BOX, { share: 0 }), "out-of-range", "share", "share: must be greater than 0, got 0");
    refused(call(FROM, BOX, { mistakes: 1 }), "wrong-type", "mistakes", "mistakes: must be a boolean, got 1");
    refused(
      call(FROM, BOX, { speed: 1 }),
      "unknown-key",
      "speed",
      'speed: unknown key "speed", expected one of "seed", "size", "rate", "resolution", "pace", "noise", "dwell", "share", "mistakes"',
    );
    refused(call(FROM, BOX, 3), "wrong-type", "options", "options: must be an object, got 3");
  });
});

describe("random", () => {
  it("gives numbers from 0 to 1 that are spread evenly, the same for a seed", () => {
    const [next, again] = [random(5), random(5)];
    const numbers = Array.from({ length: 10_000 }, next);
    assert.deepEqual(numbers.slice(0, 9), Array.from({ length: 9 }, again));
    const counts = Array.from({ length: 10 }, (_, k) => numbers.filter((x) => Math.floor(10 * x) === k).length);
    assert.ok(Math.min(...counts) > 900 && Math.max(...counts) < 1100, counts.join());
  });

  it("begins differently for seeds that are neighbours", () => {
    const firsts = Array.from({ length: 1000 }, (_, seed) => random(seed)());
    const correlation = mean(firsts.slice(1).map((x, k) => (x - 0.5) * ((firsts[k] ?? 0) - 0.5))) * 12;
    assert.ok(Math.abs(correlation) < 0.1, `${correlation}`);
    assert.ok(Math.abs(mean(firsts) - 0.5) < 0.03);
  });
});

/** Of seed 3, 20 a second. */
const SNAPSHOT: unknown = [
  [0, 0, 0],
  [0.05, -23, 11],
  [0.1, -28, 13],
  [0.15, 93, -82],
  [0.2, 256, -74],
  [0.25, 264, 133],
  [0.3, 269, 163],
  [0.35, 284, 172],
  [0.4, 299, 186],
  [0.45, 311, 194],
  [0.5, 312, 197],
  [0.576, 312, 197],
];
