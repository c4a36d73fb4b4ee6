// How hands move: figures of tracks as `npm run evaluate` reads them, `{ targets: [[cx, cy, w, h], ...], target, samples: [[t, x, y], ...] }`.

/** Seconds between the places at which speeds are taken, and the deviation of the Gaussian that smooths them. */
const STEP = 1 / 60;
const SMOOTHING = 0.02;

/** A speed counts as a movement's own peak from this share of the highest, and if it stands out by so much of it. */
const LEAST = 0.1;
const PROMINENCE = 0.05;

/** Entries into the target in less than this are no movements, s. */
const SHORTEST = 0.1;

export const mean = (numbers) => numbers.reduce((sum, x) => sum + x, 0) / numbers.length;

export function quantile(numbers, share) {
  const sorted = [...numbers].sort((a, b) => a - b);
  return sorted[Math.floor(share * (sorted.length - 1))];
}

/** A device reports nothing while the pointer stays: a longer gap is a stay and then a step. */
function filled(samples) {
  return samples.flatMap((sample, index) => {
    const before = samples[index - 1];
    return before && sample[0] - before[0] > 1.5 * STEP ? [[sample[0] - STEP, before[1], before[2]], sample] : [sample];
  });
}

/** The place at any time, on straight lines between the samples. */
function placeAt(samples, time) {
  const next = samples.findIndex(([t]) => t >= time);
  if (next <= 0) return (next === 0 ? samples[0] : samples.at(-1)).slice(1);
  const [[t0, x0, y0], [t1, x1, y1]] = [samples[next - 1], samples[next]];
  const share = (time - t0) / (t1 - t0);
  return [x0 + share * (x1 - x0), y0 + share * (y1 - y0)];
}

/** Speeds until `duration`, px/s, smoothed. */
function speeds(places) {
  const raw = places.slice(1).map(([x, y], k) => Math.hypot(x - places[k][0], y - places[k][1]) / STEP);
  return raw.map((_, k) => {
    const near = raw
      .map((speed, j) => [speed, Math.exp(-0.5 * (((j - k) * STEP) / SMOOTHING) ** 2)])
      .slice(Math.max(0, k - 4), k + 5);
    return near.reduce((sum, [speed, weight]) => sum + speed * weight, 0) / near.reduce((sum, [, weight]) => sum + weight, 0);
  });
}

/** How many of the speeds are peaks. */
function countPeaks(speed, highest) {
  const lowestUntilHigher = (k, step) => {
    let lowest = speed[k];
    for (let j = k + step; j >= 0 && j < speed.length && speed[j] <= speed[k]; j += step) lowest = Math.min(lowest, speed[j]);
    return lowest;
  };
  const first = speed.indexOf(highest);
  return speed.filter((v, k) => {
    if (k === first) return true;
    if (v === highest || v < LEAST * highest || v <= (speed[k - 1] ?? 0) || v < (speed[k + 1] ?? 0)) return false;
    return v - Math.max(lowestUntilHigher(k, -1), lowestUntilHigher(k, 1)) >= PROMINENCE * highest;
  }).length;
}

/** The figures of one track, up to its last entry into the target; null where it is in there from the beginning. */
export function figuresOf({ targets, target, samples }) {
  const [cx, cy, width, height] = targets[target];
  const all = filled(samples);
  const inside = all.map(([, x, y]) => Math.abs(x - cx) <= width / 2 && Math.abs(y - cy) <= height / 2);
  const missed = !inside.at(-1);
  const last = missed ? inside.lastIndexOf(true) : inside.length - 1;
  const entry = last < 0 ? inside.length - 1 : inside.lastIndexOf(false, last) + 1;
  const duration = all[entry][0];
  if (duration < SHORTEST) return null;

  const [, x0, y0] = all[0];
  const distance = Math.hypot(cx - x0, cy - y0);
  const [ux, uy] = [(cx - x0) / distance, (cy - y0) / distance];
  const places = Array.from({ length: Math.ceil(duration / STEP) + 1 }, (_, k) => placeAt(all, k * STEP));
  const speed = speeds(places);
  const average = mean(speed);
  const peak = Math.max(...speed);
  const tenth = (q) => speed[Math.min(speed.length - 1, Math.floor(((q + 0.5) / 10) * speed.length))] / average;
  const [[ax, ay], [bx, by]] = [-0.025, 0.025].map((later) => placeAt(all, 0.2 * duration + later));
  const [hx, hy, gx, gy] = [bx - ax, by - ay, cx - bx, cy - by];
  return {
    duration,
    dwell: all.at(-1)[0] - duration,
    bits: Math.log2(distance / Math.min(width, height) + 1),
    missed,
    peak,
    peakToMean: peak / average,
    peakAt: (speed.indexOf(peak) + 0.5) / speed.length,
    peaks: countPeaks(speed, peak),
    profile: Array.from({ length: 10 }, (_, q) => tenth(q)),
    length: places.slice(1).reduce((sum, [x, y], k) => sum + Math.hypot(x - places[k][0], y - places[k][1]), 0) / distance,
    aside: Math.max(...places.map(([x, y]) => Math.abs((x - x0) * uy - (y - y0) * ux))) / distance,
    beyond: all.some(([, x, y]) => (x - x0) * ux + (y - y0) * uy > distance + width / 2),
    returned: inside.filter((is, k) => is && k > 0 && !inside[k - 1]).length > 1,
    // null where it does not move then
    heading: hx === 0 && hy === 0 ? null : (Math.abs(Math.atan2(hx * gy - hy * gx, hx * gx + hy * gy)) * 180) / Math.PI,
  };
}

/** The line of least squares. */
function line(xs, ys) {
  const [mx, my] = [mean(xs), mean(ys)];
  const slope = xs.reduce((sum, x, k) => sum + (x - mx) * (ys[k] - my), 0) / xs.reduce((sum, x) => sum + (x - mx) ** 2, 0);
  return { slope, intercept: my - slope * mx };
}

const fixed =
  (digits, factor = 1) =>
  (x) =>
    (factor * x).toFixed(digits);
const range = (numbers, format) => {
  const [low, middle, high] = [0.05, 0.5, 0.95].map((share) => format(quantile(numbers, share)));
  return `${middle} (${low} to ${high})`;
};

/** The rows of the table: a name, and the figure of a set as text. */
export const ROWS = [
  [
    "seconds to the last entry: median (5 to 95%)",
    (all) =>
      range(
        all.map((one) => one.duration),
        fixed(2),
      ),
  ],
  [
    "seconds from it to the press",
    (all) =>
      range(
        all.map((one) => one.dwell),
        fixed(2),
      ),
  ],
  [
    "Fitts's law: seconds at 0 bits, and for each",
    (all) => {
      const bits = all.map((one) => one.bits);
      if (quantile(bits, 0.95) - quantile(bits, 0.05) < 1) return "one distance";
      const { slope, intercept } = line(
        bits,
        all.map((one) => one.duration),
      );
      return `${intercept.toFixed(2)} + ${slope.toFixed(3)}`;
    },
  ],
  ["presses outside, %", (all) => fixed(1, 100)(mean(all.map((one) => Number(one.missed))))],
  ["left and entered again, %", (all) => fixed(0, 100)(mean(all.map((one) => Number(one.returned))))],
  ["went beyond by half the size, %", (all) => fixed(0, 100)(mean(all.map((one) => Number(one.beyond))))],
  [
    "peak speed, px/s: median",
    (all) =>
      fixed(0)(
        quantile(
          all.map((one) => one.peak),
          0.5,
        ),
      ),
  ],
  [
    "peak over mean speed: median",
    (all) =>
      fixed(2)(
        quantile(
          all.map((one) => one.peakToMean),
          0.5,
        ),
      ),
  ],
  [
    "its time, % of the way: median",
    (all) =>
      fixed(
        0,
        100,
      )(
        quantile(
          all.map((one) => one.peakAt),
          0.5,
        ),
      ),
  ],
  ["peaks of speed: mean", (all) => fixed(2)(mean(all.map((one) => one.peaks)))],
  ["one peak, %", (all) => fixed(0, 100)(mean(all.map((one) => Number(one.peaks === 1))))],
  [
    "length over distance: median, 90%",
    (all) =>
      [0.5, 0.9]
        .map((q) =>
          fixed(2)(
            quantile(
              all.map((one) => one.length),
              q,
            ),
          ),
        )
        .join(", "),
  ],
  [
    "aside of the line, % of it: median, 90%",
    (all) =>
      [0.5, 0.9]
        .map((q) =>
          fixed(
            0,
            100,
          )(
            quantile(
              all.map((one) => one.aside),
              q,
            ),
          ),
        )
        .join(", "),
  ],
  [
    "heading over 45 degrees off at a fifth, %",
    (all) => {
      const known = all.map((one) => one.heading).filter((heading) => heading !== null);
      return fixed(0, 100)(mean(known.map((heading) => Number(heading > 45))));
    },
  ],
  ...Array.from({ length: 10 }, (_, q) => [
    `speed over its mean, ${q + 1}${["st", "nd", "rd"][q] ?? "th"} tenth of the time`,
    (all) => fixed(2)(mean(all.map((one) => one.profile[q]))),
  ]),
];
