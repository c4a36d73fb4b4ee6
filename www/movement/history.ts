/** One movement as the predictor saw it, and what a press says about it afterwards. */

export interface Moment {
  /** Seconds on the samples' clock. */
  readonly time: number;
  readonly probabilities: Float64Array;
  readonly none: number;
  /** The index of the most probable destination. */
  readonly leader: number;
}

/** Longer than any approach; a pointer that is stirred without end must not fill the memory (seconds). */
const LONGEST = 12;

export class History {
  readonly moments: Moment[] = [];

  add(time: number, probabilities: Float64Array, none: number): void {
    const last = this.moments.at(-1);
    if (last && time <= last.time) this.moments.pop();
    this.moments.push({ time, probabilities: probabilities.slice(), none, leader: leader(probabilities) });
    const first = this.moments[0];
    if (first && time - first.time > LONGEST) this.moments.shift();
  }
}

/** The first of the largest. */
export function leader(probabilities: ArrayLike<number>): number {
  let best = 0;
  for (let index = 1; index < probabilities.length; index += 1) {
    if ((probabilities[index] ?? 0) > (probabilities[best] ?? 0)) best = index;
  }
  return best;
}

export interface Outcome {
  readonly chosen: number;
  readonly pressed: number;
  /** From this moment on the chosen one was on top until the press; null if it was not at the press. */
  readonly rightSince: number | null;
  /** Seconds between that and the press; 0 if it was not on top. */
  readonly lead: number;
  /** The first destination that passed the threshold. */
  readonly early: number | null;
}

/** What a press on `chosen` at time `pressed` says about the movement before it: what is known at the press comes too late. */
export function judge(moments: readonly Moment[], chosen: number, pressed: number, threshold: number): Outcome {
  let rightSince: number | null = null;
  let early: number | null = null;
  for (const moment of moments) {
    if (moment.time >= pressed) break;
    if (moment.leader !== chosen) rightSince = null;
    else rightSince ??= moment.time;
    if (early === null && (moment.probabilities[moment.leader] ?? 0) >= threshold) early = moment.leader;
  }
  return { chosen, pressed, rightSince, lead: rightSince === null ? 0 : Math.max(0, pressed - rightSince), early };
}
