/** One predictor for each pointer, all of them copies of one scenario. */
import { Predictor, type PointerTarget } from "whither";
import type { Sample } from "../movement/segmenter.ts";
import { ACCUMULATING, scenarioOf, type Settings } from "./settings.ts";

/** Seconds. */
export interface TimeToGo {
  readonly mean: number;
  readonly low: number;
  readonly high: number;
}

export interface Belief {
  readonly probabilities: Float64Array;
  readonly none: number;
  readonly timeToGo: TimeToGo | null;
}

export interface Outlook {
  /** Expected positions on the way to a destination: x, y, x, y, ... */
  readonly paths: readonly { readonly index: number; readonly points: ArrayLike<number> }[];
  /** Where the pointer is expected to be on arrival. */
  readonly mean: ArrayLike<number>;
  /** Row-major, `states` rows. */
  readonly covariance: ArrayLike<number>;
  readonly states: number;
}

/** Places on a drawn path. */
const PATH_POINTS = 14;

export class Predictions {
  #targets: readonly PointerTarget[];
  #settings: Settings;
  #template: Predictor;
  readonly #tracks = new Map<number, Predictor>();

  constructor(targets: readonly PointerTarget[], settings: Settings) {
    this.#targets = targets;
    this.#settings = settings;
    this.#template = new Predictor(scenarioOf(targets, settings));
  }

  /** Where the icons are now: what has been observed stays, but for the methods that accumulate, which begin again. */
  place(targets: readonly PointerTarget[]): void {
    if (targets.every((target, i) => sameBox(target, this.#targets[i]))) return;
    this.#targets = targets;
    const { destinations } = scenarioOf(targets, this.#settings);
    for (const predictor of [this.#template, ...this.#tracks.values()]) {
      if (ACCUMULATING.includes(this.#settings.method)) predictor.reset();
      predictor.setDestinations(destinations);
    }
  }

  /** Another model: every pointer starts afresh. */
  configure(settings: Settings): void {
    const template = new Predictor(scenarioOf(this.#targets, settings));
    for (const pointerId of [...this.#tracks.keys()]) this.release(pointerId);
    this.#template.free();
    this.#template = template;
    this.#settings = settings;
  }

  begin(pointerId: number): void {
    this.#track(pointerId).reset();
  }

  observe(pointerId: number, samples: readonly Sample[]): void {
    const predictor = this.#track(pointerId);
    for (const sample of samples) predictor.observe(sample.time, [sample.x, sample.y]);
  }

  release(pointerId: number): void {
    this.#tracks.get(pointerId)?.free();
    this.#tracks.delete(pointerId);
  }

  /** The prior, before the first observation. */
  prior(): Belief {
    return { probabilities: this.#template.probabilities(), none: this.#template.none, timeToGo: null };
  }

  belief(pointerId: number, now: number): Belief {
    const predictor = this.#track(pointerId);
    return { probabilities: predictor.probabilities(), none: predictor.none, timeToGo: timeToGo(predictor, now) };
  }

  outlook(pointerId: number, now: number, leaders: readonly number[]): Outlook | null {
    const predictor = this.#track(pointerId);
    const arrival = predictor.arrival();
    if (!arrival) return null;
    const last = arrival.times.at(-1) ?? now;
    const times = Array.from({ length: PATH_POINTS }, (_, step) => now + ((last - now) * step) / (PATH_POINTS - 1));
    const paths = leaders.map((index) => ({ index, points: predictor.path(this.#targets[index]?.id ?? "", times) }));
    const forecast = predictor.forecast(Math.max(now, arrival.mean));
    return forecast && { paths, ...forecast, states: forecast.mean.length };
  }

  #track(pointerId: number): Predictor {
    let predictor = this.#tracks.get(pointerId);
    if (!predictor) {
      predictor = this.#template.clone();
      this.#tracks.set(pointerId, predictor);
    }
    return predictor;
  }
}

/** The calibrated figure where the method has one, else the mean and the 10 and 90% points of the arrival's nodes. */
function timeToGo(predictor: Predictor, now: number): TimeToGo | null {
  const { remaining } = predictor;
  if (remaining) return remaining;
  const arrival = predictor.arrival();
  if (!arrival) return null;
  const quantile = (share: number) => {
    let sum = 0;
    const node = arrival.probabilities.findIndex((probability) => (sum += probability) >= share);
    return Math.max(0, (arrival.times[node] ?? arrival.mean) - now);
  };
  return { mean: Math.max(0, arrival.mean - now), low: quantile(0.1), high: quantile(0.9) };
}

function sameBox(one: PointerTarget, other: PointerTarget | undefined): boolean {
  return (
    other !== undefined && one.x === other.x && one.y === other.y && one.width === other.width && one.height === other.height
  );
}
