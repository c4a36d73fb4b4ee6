/** One gesture, by every method: whether the right icon is on top, and how probable it is, at equal shares of the gesture's time. */
import { Predictor } from "whither";
import { TARGETS } from "../cabin.ts";
import { type Gesture, gesture } from "../gesture.ts";
import type { Road } from "../road.ts";
import { ranking } from "../../shared/ranking.ts";
import { METHODS } from "./methods.ts";

/** The shares at which it is scored: 0, 5, .. 100%. */
export const SHARES: readonly number[] = Array.from({ length: 21 }, (_, k) => k / 20);
/** A probability is taken for no less than this, so that one gesture does not decide the mean. */
const LEAST = 1e-12;

/** Of one method, over one gesture. */
export interface Score {
  /** At each share, whether the right icon is on top. */
  readonly right: readonly boolean[];
  /** The share of the time during which it is, over all observations. */
  readonly time: number;
  /** The mean of minus the logarithm of the right icon's probability; null where there are no probabilities. */
  readonly loss: number | null;
  /** The largest difference of a probability from that of the method that has to be the same; 0 without one. */
  readonly difference: number;
  /** How long it took to compute, in seconds, and for how many observations. */
  readonly seconds: number;
  readonly observations: number;
}

export class Scorer {
  readonly #road: Road;
  readonly #predictors: readonly (Predictor | null)[];

  constructor(road: Road) {
    this.#road = road;
    this.#predictors = METHODS.map((method) => {
      const scenario = method.scenario();
      return scenario && new Predictor(scenario);
    });
  }

  /** In the order of the methods. */
  score(seed: number): Score[] {
    const drawn = gesture(seed, this.#road);
    const results = this.#predictors.map((predictor) => (predictor ? modelled(predictor, drawn) : nearest(drawn)));
    return METHODS.map(({ same }, k): Score => {
      const { posteriors, seconds } = results[k] as Result;
      const twin = results[METHODS.findIndex(({ id }) => id === same)];
      const at = SHARES.map((share) => posteriors[Math.round(share * (posteriors.length - 1))] as Float64Array);
      const loss = (posterior: Float64Array) => -Math.log(Math.max(LEAST, posterior[drawn.target] ?? 0));
      const isRight = (posterior: Float64Array) => ranking(posterior)[0] === drawn.target;
      return {
        right: at.map(isRight),
        time: posteriors.filter(isRight).length / posteriors.length,
        loss: this.#predictors[k] ? at.reduce((sum, posterior) => sum + loss(posterior), 0) / at.length : null,
        difference: twin ? largest(posteriors, twin.posteriors) : 0,
        seconds,
        observations: posteriors.length,
      };
    });
  }
}

interface Result {
  readonly posteriors: readonly Float64Array[];
  readonly seconds: number;
}

function modelled(predictor: Predictor, { samples }: Gesture): Result {
  const begun = performance.now();
  predictor.reset();
  const posteriors = samples.map(([time, ...place]) => {
    predictor.observe(time, place);
    return predictor.probabilities();
  });
  return { posteriors, seconds: (performance.now() - begun) / 1000 };
}

/** Certain of the icon that is nearest. */
function nearest({ samples }: Gesture): Result {
  const begun = performance.now();
  const posteriors = samples.map(([, px, py, pz]) => {
    const distances = TARGETS.map(({ x, y }) => -Math.hypot(px - x, py - y, pz));
    const [first = 0] = ranking(distances);
    return Float64Array.from(TARGETS, (_, icon) => (icon === first ? 1 : 0));
  });
  return { posteriors, seconds: (performance.now() - begun) / 1000 };
}

function largest(one: readonly Float64Array[], other: readonly Float64Array[]): number {
  return one.reduce(
    (most, posterior, k) =>
      posterior.reduce((largest, probability, icon) => Math.max(largest, Math.abs(probability - (other[k]?.[icon] ?? 0))), most),
    0,
  );
}
