/** Scores of many gestures together. */
import { METHODS } from "./methods.ts";
import { type Score, SHARES } from "./score.ts";

export interface Row {
  /** At each share of the time, the share of the gestures with the right icon on top. */
  readonly right: readonly number[];
  /** The mean share of the time with it on top. */
  readonly time: number;
  /** Mean log loss in nats; null where there are no probabilities. */
  readonly loss: number | null;
  readonly difference: number;
  /** Seconds for an observation. */
  readonly cost: number;
}

/** In the order of the methods; `scores` has a list for each gesture. */
export function summary(scores: readonly (readonly Score[])[]): Row[] {
  return METHODS.map((_, k) => {
    const own = scores.map((score) => score[k] as Score);
    const mean = (of: (score: Score) => number) => own.reduce((sum, score) => sum + of(score), 0) / own.length;
    return {
      right: SHARES.map((_, at) => mean(({ right }) => Number(right[at]))),
      time: mean(({ time }) => time),
      loss: own[0]?.loss === null ? null : mean(({ loss }) => loss ?? 0),
      difference: Math.max(...own.map(({ difference }) => difference)),
      cost: mean(({ seconds }) => seconds) / mean(({ observations }) => observations),
    };
  });
}
