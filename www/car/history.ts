/** The posterior over the movements since the last press. */

export interface Moment {
  /** Seconds on the page's clock. */
  readonly time: number;
  /** One for each icon. */
  readonly probabilities: Float64Array;
}

/** Longer than any approach; a pointer that is stirred without end must not fill the memory (seconds). */
const LONGEST = 12;

/** So many movements are kept. */
const MOST = 8;

export class History {
  #movements: Moment[][] = [];
  #open = false;

  /** The movement under way, or the last one. */
  get current(): readonly Moment[] {
    return this.#movements.at(-1) ?? [];
  }

  add(moment: Moment): void {
    if (!this.#open) this.#movements = [...this.#movements.slice(1 - MOST), []];
    this.#open = true;
    const moments = this.#movements.at(-1);
    moments?.push(moment);
    if (moments?.[0] && moment.time - moments[0].time > LONGEST) moments.shift();
  }

  /** The movement is over; what follows is another one. */
  end(): void {
    this.#open = false;
  }

  /** Of a press the movement that was under way at `since`, else the last one; nothing is kept. */
  take(since: number): readonly Moment[] {
    const found = this.#movements.find((moments) => (moments.at(-1)?.time ?? 0) >= since) ?? this.current;
    this.#movements = [];
    this.#open = false;
    return found;
  }
}
