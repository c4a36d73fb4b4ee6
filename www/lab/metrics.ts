/**
 * How good predictions are on the approach to the target: the metrics of `npm run evaluate`, and what selecting at a
 * threshold comes to.
 */
import { contains, places, type Movement } from "./movement.ts";

/** Shares of the approach's time at which accuracy is drawn: from its start to the entry into the target. */
export const COURSE = 21;
/** Bins of the top probability, for calibration. */
export const BINS = 10;
/** Probabilities below this count as this in the log loss. */
const FLOOR = 1e-4;
/** The probability at which a target is selected, and the one below which it is released. */
export const THRESHOLD = 0.8;
export const RELEASE = 0.5;

/** What was predicted after one sample. */
export interface Prediction {
  /** The most probable target; null where the method names none. */
  readonly top: number | null;
  /** Of each target, where the method has them. */
  readonly probabilities: ArrayLike<number> | null;
}

/** One bin of the top probability. */
export interface Bin {
  count: number;
  /** The sum of the probabilities in it, and how often the top target was the one that was pressed. */
  predicted: number;
  happened: number;
}

/** Of one method on one movement, or the sum over many. */
export interface Score {
  movements: number;
  /** Share of the approach's time with the right target on top. */
  time: number;
  /** Whether the right target is on top, at evenly spaced moments. */
  readonly course: number[];
  /** Seconds from the moment since which the top stays right until the entry. */
  lead: number;
  /** Samples for which there were probabilities, and the sum over them of `-ln p(right target)`. */
  samples: number;
  loss: number;
  readonly bins: Bin[];
  /** Movements in which the right target was selected and no other, and those in which another one was. */
  right: number;
  wrong: number;
}

/** What a table shows of a score. */
export interface Figures {
  readonly movements: number;
  /** Percent of the time with the right target on top. */
  readonly time: number;
  /** Milliseconds. */
  readonly lead: number;
  /** Nats a sample; null, as the ones that follow, where the method has no probabilities. */
  readonly loss: number | null;
  /** Expected calibration error. */
  readonly calibration: number | null;
  /** Percent of the movements in which only the right target was selected, and those in which another one was. */
  readonly right: number | null;
  readonly wrong: number | null;
  /** Percent with the right target on top over the course of the movement. */
  readonly course: readonly number[];
  readonly bins: readonly Bin[];
}

export function emptyScore(): Score {
  return {
    movements: 0,
    time: 0,
    course: Array.from({ length: COURSE }, () => 0),
    lead: 0,
    samples: 0,
    loss: 0,
    bins: Array.from({ length: BINS }, () => ({ count: 0, predicted: 0, happened: 0 })),
    right: 0,
    wrong: 0,
  };
}

/** The score of what was predicted after each of the first samples of a movement. */
export function scoreOf(movement: Movement, predictions: readonly Prediction[]): Score {
  const { target } = movement;
  const times = movement.samples.slice(0, predictions.length).map(([time]) => time);
  const at = (index: number) => times[Math.min(Math.max(index, 0), times.length - 1)] ?? 0;
  const first = at(0);
  const last = at(times.length - 1);
  const isRight = (index: number) => (predictions[index]?.top === target ? 1 : 0);
  const score = emptyScore();
  score.movements = 1;
  let total = 0;
  let right = 0;
  let since: number | null = null;
  predictions.forEach(({ top, probabilities }, index) => {
    const half = (at(index + 1) - at(index - 1)) / 2;
    total += half;
    right += half * isRight(index);
    if (!isRight(index)) since = null;
    else since ??= at(index);
    if (probabilities && top !== null) {
      score.samples += 1;
      score.loss -= Math.log(Math.max(probabilities[target] ?? 0, FLOOR));
      const probability = probabilities[top] ?? 0;
      const bin = score.bins[Math.min(BINS - 1, Math.floor(probability * BINS))];
      if (!bin) return;
      bin.count += 1;
      bin.predicted += probability;
      bin.happened += isRight(index);
    }
  });
  score.time = right / Math.max(total, 1e-12);
  score.lead = since === null ? 0 : last - since;
  let sample = 0;
  for (let k = 0; k < COURSE; k += 1) {
    const moment = first + ((last - first) * k) / (COURSE - 1) + 1e-9;
    while (sample + 1 < times.length && at(sample + 1) <= moment) sample += 1;
    score.course[k] = isRight(sample);
  }
  const selected = selections(movement, predictions);
  if (selected) {
    const others = selected.some(({ target: one }) => one !== target);
    score.wrong = others ? 1 : 0;
    score.right = !others && selected.length > 0 ? 1 : 0;
  }
  return score;
}

/** A target that was selected, and at which sample. */
export interface Selection {
  readonly target: number;
  readonly sample: number;
}

/**
 * What selecting at the threshold does: a target is selected when its probability reaches it, and stays so until that falls
 * below the release. The target on which the movement began is not, until the pointer has been off it. Null without probabilities.
 */
export function selections(movement: Movement, predictions: readonly Prediction[]): Selection[] | null {
  if (predictions.some(({ probabilities }) => probabilities === null)) return null;
  const where = places(movement);
  const [start] = where;
  const origin = start ? movement.targets.findIndex((box) => contains(box, start)) : -1;
  let left = origin < 0;
  let now: number | null = null;
  const found: Selection[] = [];
  predictions.forEach(({ top, probabilities }, sample) => {
    const box = movement.targets[origin];
    const place = where[sample];
    if (!left && box && place) left = !contains(box, place);
    if (now !== null && (probabilities?.[now] ?? 0) < RELEASE) now = null;
    if (now !== null || top === null || (probabilities?.[top] ?? 0) < THRESHOLD) return;
    if (top === origin && !left) return;
    now = top;
    found.push({ target: top, sample });
  });
  return found;
}

/** Adds a score to another. */
export function add(to: Score, from: Score): void {
  to.movements += from.movements;
  to.time += from.time;
  to.lead += from.lead;
  to.samples += from.samples;
  to.loss += from.loss;
  to.right += from.right;
  to.wrong += from.wrong;
  from.course.forEach((right, k) => (to.course[k] = (to.course[k] ?? 0) + right));
  to.bins.forEach((bin, k) => {
    bin.count += from.bins[k]?.count ?? 0;
    bin.predicted += from.bins[k]?.predicted ?? 0;
    bin.happened += from.bins[k]?.happened ?? 0;
  });
}

export function figuresOf(score: Score): Figures {
  const movements = Math.max(score.movements, 1);
  const any = score.samples > 0;
  const percent = (count: number) => (100 * count) / movements;
  return {
    movements: score.movements,
    time: percent(score.time),
    lead: (1000 * score.lead) / movements,
    loss: any ? score.loss / score.samples : null,
    calibration: any ? calibrationError(score.bins) : null,
    right: any ? percent(score.right) : null,
    wrong: any ? percent(score.wrong) : null,
    course: score.course.map(percent),
    bins: score.bins,
  };
}

/** `|predicted - happened|` of each bin, weighted by its count. */
export function calibrationError(bins: readonly Bin[]): number {
  const count = bins.reduce((sum, bin) => sum + bin.count, 0);
  return bins.reduce((sum, bin) => sum + Math.abs(bin.predicted - bin.happened), 0) / Math.max(count, 1);
}

/** A mean with half of its 95% interval, of numbers of one kind; null of fewer than two. */
export function meanOf(values: readonly number[]): { mean: number; half: number } | null {
  const count = values.length;
  if (count < 2) return null;
  const mean = values.reduce((sum, value) => sum + value, 0) / count;
  const squares = values.reduce((sum, value) => sum + (value - mean) ** 2, 0);
  return { mean, half: 1.96 * Math.sqrt(squares / (count - 1) / count) };
}
