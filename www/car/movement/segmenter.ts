/** Cuts one pointer's samples into movements: a rest or a press ends one, a late event does not; what follows starts afresh. */

/** Seconds, and pixels from the screen's corner. */
export interface Sample {
  readonly time: number;
  readonly x: number;
  readonly y: number;
}

/** A pointer that stays put this long has ended its movement (seconds). */
export const REST = 0.3;

/** A hand at rest trembles this much (px). */
const TREMOR = 3;

/**
 * Farther than this from where it rested, a pointer is under way again (px). Nearer, hands come to rest: on recorded mice that halves
 * the movements that begin where the last one arrived. Nothing is lost, as the onset is kept.
 */
const DEPARTURE = 12;

/**
 * A pointer that was not heard of for longer than a rest moved all the same if it comes back farther away than this for each
 * second of silence (px/s): its events were late. On recorded mice 99% of the rests come back with at most 16 px/s, and over a
 * remote desktop, with an event every 109 ms, with at most 145.
 */
const UNDER_WAY = 150;

/** No movement is unheard of this long (seconds): wherever the pointer comes back, it has begun another. */
const LOST = 1;

/**
 * A sample this much earlier than the last one was heard late, and is passed over; an even earlier one is on a clock that was
 * set back, where no time before it means anything (seconds).
 */
const LATE = 0.1;

/** So much of what was heard before a departure is its onset (seconds). */
const ONSET = 0.12;

export interface Cut {
  /** The samples to learn from: none while the pointer rests or repeats itself. */
  readonly samples: readonly Sample[];
  /** Whether they begin a new movement. */
  readonly fresh: boolean;
}

const NOTHING: Cut = { samples: [], fresh: false };

export class Segmenter {
  #moving = false;
  #last: Sample | null = null;
  /** While moving: where the pointer last left the tremor's circle. While resting: where it rests. */
  #reference: Sample | null = null;
  /** While resting: what was heard since the rest, in case it turns out to be the onset. */
  #onset: Sample[] = [];

  add(sample: Sample): Cut {
    const last = this.#last;
    if (last && repeats(sample, last)) return NOTHING;
    this.#last = sample;
    if (last && sample.time < last.time) this.#rest(sample);
    else if (this.#moving && last && this.#rested(last, sample)) this.#rest(last);
    return this.#moving ? this.#follow(sample) : this.#wake(sample);
  }

  /** A press, a lost pointer: whatever comes next is a new movement. */
  end(): void {
    if (this.#last) this.#rest(this.#last);
  }

  /** Whether the pointer rested until now: its displacement distinguishes a rest from an event that came late. */
  #rested(last: Sample, sample: Sample): boolean {
    const reference = this.#reference ?? last;
    const still = sample.time - reference.time;
    return sample.time - last.time > LOST || (still > REST && distance(sample, reference) <= UNDER_WAY * still);
  }

  #rest(at: Sample): void {
    this.#moving = false;
    this.#reference = at;
    this.#onset = [at];
  }

  #follow(sample: Sample): Cut {
    const reference = this.#reference ?? sample;
    if (distance(sample, reference) > TREMOR) this.#reference = sample;
    return { samples: [sample], fresh: false };
  }

  #wake(sample: Sample): Cut {
    this.#reference ??= sample;
    while (this.#onset[0] && sample.time - this.#onset[0].time > ONSET) this.#onset.shift();
    if (this.#onset.at(-1) !== sample) this.#onset.push(sample);
    if (distance(sample, this.#reference) <= DEPARTURE) return NOTHING;
    const samples = this.#onset;
    this.#onset = [];
    this.#moving = true;
    this.#reference = sample;
    return { samples, fresh: true };
  }
}

/** Browsers deliver some samples twice, and a coalesced list may reach back behind the event before it. */
function repeats(sample: Sample, last: Sample): boolean {
  const back = last.time - sample.time;
  return (back > 0 && back <= LATE) || (back === 0 && sample.x === last.x && sample.y === last.y);
}

function distance(a: Sample, b: Sample): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}
