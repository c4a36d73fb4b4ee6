/** What is predicted at one moment of a movement, and over a complete one. */
import { Predictor, type Remaining } from "whither";
import { LABELS, type Position, TARGETS } from "./cabin.ts";
import type { Sample } from "./gesture.ts";
import { handModel } from "./models.ts";
import { ranking } from "../shared/ranking.ts";

/** Icons whose paths are drawn. */
const LEADING = 3;
/** Points of a path, after the hand. */
const PATH = 16;

export interface Moment {
  readonly sample: Sample;
  /** In the order of the icons. */
  readonly probabilities: Float64Array;
  readonly none: number;
  readonly remaining: Remaining | null;
  /** To the leading icons, from the hand on. */
  readonly paths: readonly { readonly icon: number; readonly points: readonly Position[] }[];
}

/** Follows one movement after the other. */
export class Forecaster {
  readonly #predictor: Predictor;

  constructor(shake: boolean) {
    this.#predictor = new Predictor(handModel(shake));
  }

  observe(sample: Sample): Moment {
    const [time, ...place] = sample;
    const predictor = this.#predictor;
    predictor.observe(time, place);
    const probabilities = predictor.probabilities();
    const remaining = predictor.remaining;
    return { sample, probabilities, none: predictor.none, remaining, paths: this.#paths(time, place, probabilities, remaining) };
  }

  /** A new movement; what is known of the road stays. */
  reset(): void {
    this.#predictor.reset();
  }

  free(): void {
    this.#predictor.free();
  }

  #paths(time: number, place: Position, probabilities: Float64Array, remaining: Remaining | null): Moment["paths"] {
    if (!remaining) return [];
    const times = Array.from({ length: PATH }, (_, k) => time + (2 * remaining.high * (k + 1)) / PATH);
    return ranking(probabilities)
      .slice(0, LEADING)
      .map((icon) => {
        const numbers = this.#predictor.path(TARGETS[icon]?.id ?? "", times);
        const at = (k: number): Position => [numbers[3 * k] ?? 0, numbers[3 * k + 1] ?? 0, numbers[3 * k + 2] ?? 0];
        return { icon, points: [place, ...times.map((_, k) => at(k))] };
      });
  }
}

/** A complete movement. */
export function follow(samples: readonly Sample[], shake: boolean): Moment[] {
  const forecaster = new Forecaster(shake);
  const moments = samples.map((sample) => forecaster.observe(sample));
  forecaster.free();
  return moments;
}

/** The most probable icon. */
export function leader(moment: Moment): { readonly icon: number; readonly label: string; readonly probability: number } {
  const [icon = 0] = ranking(moment.probabilities);
  return { icon, label: LABELS[icon] ?? "", probability: moment.probabilities[icon] ?? 0 };
}
