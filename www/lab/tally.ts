/** The scores of all methods on the same movements, one movement after the other. */
import {
  add,
  emptyScore,
  figuresOf,
  meanOf,
  scoreOf,
  selections,
  type Figures,
  type Prediction,
  type Score,
  type Selection,
} from "./metrics.ts";
import { METHODS, type MethodId } from "./methods.ts";
import { approachOf, type Movement } from "./movement.ts";
import { extrapolation, GRID, named, type Extrapolation } from "./peers.ts";

/** One method in the table. */
export interface Row {
  readonly id: MethodId;
  readonly figures: Figures;
  /** Half of the 95% interval of `figures.time` over movements; null for fewer than two. */
  readonly spread: number | null;
}

/** How the leading method compares with the next one, movement by movement: points of `time`, and half of the 95% interval. */
export interface Comparison {
  readonly leader: MethodId;
  readonly next: MethodId;
  readonly mean: number;
  readonly half: number;
}

/** Along one movement, for its picture: of each method what it had on top after each sample of the approach. */
export interface Trace {
  readonly tops: Readonly<Partial<Record<MethodId, readonly (number | null)[]>>>;
  /** The samples at which the pointing model's probability selected a target. */
  readonly selected: readonly Selection[];
  /** Seconds from the moment since which its top stays right to the entry. */
  readonly lead: number;
}

export interface Summary {
  readonly movements: number;
  /** Best first. */
  readonly rows: readonly Row[];
  /** Null where there is nothing to compare. */
  readonly comparison: Comparison | null;
  /** The point of the grid that is shown as linear extrapolation. */
  readonly best: Extrapolation;
}

/** What a method predicts: `predict` of predictions.ts. */
export type Predict = (id: MethodId, movement: Movement, length: number, best: Extrapolation) => Prediction[] | null;

interface Sum {
  readonly score: Score;
  readonly times: number[];
}

const emptySum = (): Sum => ({ score: emptyScore(), times: [] });

export class Tally {
  readonly #predict: Predict;
  readonly #sums = new Map(METHODS.map(({ id }) => [id, emptySum()]));
  readonly #grid = GRID.map(emptySum);
  #movements = 0;

  constructor(predict: Predict) {
    this.#predict = predict;
  }

  /** Scores one more movement, if it enters its target. Throws what a predictor throws, and then nothing is counted. */
  add(movement: Movement): boolean {
    const length = approachOf(movement);
    if (length === null) return false;
    // all before any is counted: after an error everything is as it was
    const scores = [...this.#sums].map(([id, sum]) => {
      const predictions = id === "extrapolation" ? null : this.#predict(id, movement, length, this.#best());
      return [sum, predictions && scoreOf(movement, predictions)] as const;
    });
    const grid = GRID.map((point, k) => {
      const predictions = named(extrapolation(movement, length, point)) ?? [];
      return [this.#grid[k] ?? emptySum(), scoreOf(movement, predictions)] as const;
    });
    this.#movements += 1;
    for (const [{ score, times }, one] of [...scores, ...grid]) {
      if (!one) continue;
      add(score, one);
      times.push(one.time);
    }
    return true;
  }

  trace(movement: Movement): Trace {
    const length = approachOf(movement) ?? 0;
    const predictions = METHODS.map(({ id }) => [id, this.#predict(id, movement, length, this.#best())] as const);
    const pointing = predictions.find(([id]) => id === "pointing")?.[1] ?? [];
    return {
      tops: Object.fromEntries(predictions.flatMap(([id, found]) => (found ? [[id, found.map(({ top }) => top)]] : []))),
      selected: selections(movement, pointing) ?? [],
      lead: scoreOf(movement, pointing).lead,
    };
  }

  summary(): Summary {
    const rows = [...this.#sums].map(([id, own]): Row => {
      const sum = id === "extrapolation" ? (this.#grid[this.#bestPlace()] ?? own) : own;
      const half = meanOf(sum.times)?.half;
      return { id, figures: figuresOf(sum.score), spread: half === undefined ? null : 100 * half };
    });
    // stable: equals stay in the order of METHODS
    rows.sort((a, b) => b.figures.time - a.figures.time);
    return { movements: this.#movements, rows, comparison: this.#compare(rows), best: this.#best() };
  }

  /** The two best of those that were scored on every movement. Methods with the same numbers count as one. */
  #compare(rows: readonly Row[]): Comparison | null {
    const complete = rows.filter(({ figures }) => figures.movements === this.#movements);
    const leader = complete[0];
    const next = complete.find(({ figures }) => figures.time < (leader?.figures.time ?? 0));
    if (!leader || !next) return null;
    const [first, second] = [this.#times(leader.id), this.#times(next.id)];
    const found = meanOf(first.map((time, k) => time - (second[k] ?? 0)));
    return found && { leader: leader.id, next: next.id, mean: 100 * found.mean, half: 100 * found.half };
  }

  #times(id: MethodId): readonly number[] {
    return (id === "extrapolation" ? this.#grid[this.#bestPlace()] : this.#sums.get(id))?.times ?? [];
  }

  #bestPlace(): number {
    const time = (k: number) => this.#grid[k]?.score.time ?? 0;
    return GRID.reduce((best, _, k) => (time(k) > time(best) ? k : best), 0);
  }

  #best(): Extrapolation {
    return GRID[this.#bestPlace()] ?? { samples: 2, ahead: 0.12 };
  }
}
