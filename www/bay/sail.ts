/** Simulated vessels: conditionally Markov sequences between the states that they pass, reported with an error. */
import { ConditionallyMarkovSequence } from "whither";
import { PILOT_STATION, type Place } from "./coast.ts";
import { Random } from "./random.ts";
import { BASIN_SIZE, DEFAULT, ENTRY_SPEED, REPORTED, SPEED } from "./scenario.ts";

/** A reported position: seconds on the bay's clock, metres. */
export interface Report extends Place {
  readonly time: number;
}

/** A state that a vessel passes: minutes from the first report, kilometres, m/s, and how well they are known, in metres and m/s. */
export interface Pin {
  readonly minute: number;
  readonly place: readonly [number, number];
  readonly velocity: readonly [number, number];
  readonly spread: number;
  readonly speedSpread: number;
}

/** Seconds between two reports of a vessel that is followed alone. */
export const INTERVAL = 30;
const STATES = 4;

/** Where a vessel is at a time, between two reports on the line between them. */
export function placeAt(reports: readonly Report[], time: number): Place {
  const after = reports.findIndex((report) => report.time > time);
  const [from, to] = [reports[after - 1], reports[after]];
  if (!from || !to) return to ?? reports.at(-1) ?? PILOT_STATION;
  const share = (time - from.time) / (to.time - from.time);
  return { x: from.x + share * (to.x - from.x), y: from.y + share * (to.y - from.y) };
}

/** A track through pinned states: nearly constant velocity given all of them, reported with an error at every step. */
export function sail(
  pins: readonly Pin[],
  { seed, departs, interval }: { seed: number; departs: number; interval: number },
): Report[] {
  const step = (minute: number) => Math.round((60 * minute) / interval);
  const steps = step(pins.at(-1)?.minute ?? 0);
  const variances = pins.flatMap(({ spread, speedSpread }) => [spread ** 2, spread ** 2, speedSpread ** 2, speedSpread ** 2]);
  const sequence = new ConditionallyMarkovSequence({
    motion: { type: "constantVelocity", dimensions: 2, noise: DEFAULT.noise },
    timeStep: interval,
    steps,
    pins: pins.map(({ minute }) => step(minute)),
    pinnedMean: pins.flatMap(({ place: [x, y], velocity }) => [1000 * x, 1000 * y, ...velocity]),
    pinnedCovariance: variances.map((variance, i) => variances.map((_, j) => (i === j ? variance : 0))),
    observation: { noise: REPORTED },
  });
  const [states = new Float64Array()] = sequence.sample({ seed, count: 1 });
  sequence.free();
  const random = new Random(seed);
  return Array.from({ length: steps + 1 }, (_, k) => ({
    time: departs + k * interval,
    x: (states[STATES * k] ?? 0) + REPORTED * random.normal(),
    y: (states[STATES * k + 1] ?? 0) + REPORTED * random.normal(),
  }));
}

/**
 * From a place to a harbour, in so many seconds, drawn from the predictor's own model: nearly constant velocity from any start, given
 * that the harbour is observed at its end.
 */
export function bound(from: Place, to: Place, seconds: number, random: Random): Pin[] {
  const east = ends(to.x - from.x, seconds, random);
  const north = ends(to.y - from.y, seconds, random);
  const pin = (minute: number, x: number, y: number, velocity: Pin["velocity"]): Pin => ({
    minute,
    place: [x / 1000, y / 1000],
    velocity,
    spread: 1,
    speedSpread: 0.01,
  });
  return [
    pin(0, from.x, from.y, [east.departure, north.departure]),
    pin(seconds / 60, from.x + east.way, from.y + north.way, [east.entry, north.entry]),
  ];
}

/**
 * Along one axis: the velocity at the start, the way that is made and the velocity at its end. Drawn from the prior and corrected by the
 * harbour, which is observed as drawn at random too: what comes out is a draw from the posterior.
 */
function ends(distance: number, seconds: number, random: Random): { departure: number; way: number; entry: number } {
  const density = DEFAULT.noise ** 2;
  const start = SPEED ** 2;
  const departure = SPEED * random.normal();
  const entry = departure + Math.sqrt(density * seconds) * random.normal();
  const way = (seconds / 2) * (departure + entry) + Math.sqrt((density * seconds ** 3) / 12) * random.normal();
  // the covariance of way and velocity at the end
  const xx = start * seconds ** 2 + (density * seconds ** 3) / 3;
  const xv = start * seconds + (density * seconds ** 2) / 2;
  const vv = start + density * seconds;
  // with that of the harbour, and what both lack
  const [all, entries] = [xx + BASIN_SIZE ** 2 / 12, vv + ENTRY_SPEED ** 2];
  const lacking = distance - way - (BASIN_SIZE / Math.sqrt(12)) * random.normal();
  const slowing = -entry - ENTRY_SPEED * random.normal();
  const determinant = all * entries - xv * xv;
  const u = (entries * lacking - xv * slowing) / determinant;
  const v = (all * slowing - xv * lacking) / determinant;
  return { departure: departure + start * (seconds * u + v), way: way + xx * u + xv * v, entry: entry + xv * u + vv * v };
}
