import { memory } from "./loading/instance.js";
import { fields, isAbsent, number, refuse } from "./read.js";

/**
 * What the outcomes of a user's movements have taught a predictor with the method `pointing`: a handful of plain numbers, for an
 * application to keep by `JSON.stringify` from one visit to the next, in `localStorage` or with the user's settings. It is about how
 * the user's hand moves, and no record of what was chosen or when.
 */
export interface Learnt {
  /**
   * What the log score of every target is multiplied by: below 1 for users whose movements show less of where they go than the model has
   * it. From 0.2 to 3; 1 for a new user.
   */
  readonly confidence: number;
  /** How much is known of it: the inverse of the variance of its logarithm. From 0.001. @defaultValue 4 */
  readonly precision?: number | undefined;
  /** From how many movements. @defaultValue 0 */
  readonly movements?: number | undefined;
  /** How many samples a movement has, on average. @defaultValue 0 */
  readonly samples?: number | undefined;
  /** What is added to the logarithm of `remaining.mean`, from -3 to 3. @defaultValue 0 */
  readonly mean?: number | undefined;
  /** The same for `remaining.low`. @defaultValue 0 */
  readonly low?: number | undefined;
  /** The same for `remaining.high`. @defaultValue 0 */
  readonly high?: number | undefined;
}

/** The numbers of `src/model/learnt.rs`, at an address in the module's memory. */
export const learntNumbers = (address: number): Float64Array => new Float64Array(memory(), address, 7);

/** The same by their names. */
export function learntOf([confidence = 1, precision, movements, samples, mean, low, high]: Float64Array): Learnt {
  return { confidence, precision, movements, samples, mean, low, high };
}

/** Of each number its key, the least and the most that may be set, and what it is for a new user: as in `src/model/learnt.rs`. */
const NUMBERS = [
  ["confidence", 0.2, 3, 1],
  ["precision", 0.001, 1e9, 4],
  ["movements", 0, 1e9, 0],
  ["samples", 0, 1e9, 0],
  ["mean", -3, 3, 0],
  ["low", -3, 3, 0],
  ["high", -3, 3, 0],
] as const;

/** What a user gave as numbers, in their order; null is a new user. */
export function readLearnt(given: unknown): number[] {
  const keys = NUMBERS.map(([key]) => key);
  const object = isAbsent(given) ? { confidence: 1 } : fields(given, "learnt", keys);
  return NUMBERS.map(([key, least, most, otherwise], i) => {
    if (i > 0 && isAbsent(object[key])) return otherwise;
    const path = `learnt.${key}`;
    const x = number(object[key], path);
    return x >= least && x <= most ? x : refuse("out-of-range", path, `must be from ${least} to ${most}`, x);
  });
}
