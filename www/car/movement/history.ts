/** The posterior over one movement. */
import { leader } from "./leader.ts";

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
