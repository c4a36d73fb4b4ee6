/** Cuts one pointer's samples into movements: a rest, a press or a gap ends one, and what follows starts afresh. */

/** Seconds, and pixels from the screen's corner. */
export interface Sample {
  readonly time: number;
  readonly x: number;
  readonly y: number;
}

/** A pointer that stays put this long, or is not heard of, has ended its movement (seconds). */
const REST = 0.12;

/** A hand at rest trembles this much (px). */
const TREMOR = 3;

/**
 * Farther than this from where it rested, a pointer is under way again (px). Nearer, hands settle: on recorded mice that halves
 * the movements that begin where the last one arrived. Nothing is lost, as the onset is kept.
 */
const DEPARTURE = 12;

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
    if (this.#moving && last && sample.time - last.time > REST) this.#rest(last);
    return this.#moving ? this.#follow(sample) : this.#wake(sample);
  }

  /** A press, a lost pointer: whatever comes next is a new movement. */
  end(): void {
    if (this.#last) this.#rest(this.#last);
  }

  #rest(at: Sample): void {
    this.#moving = false;
    this.#reference = at;
    this.#onset = [at];
  }

  #follow(sample: Sample): Cut {
    const reference = this.#reference ?? sample;
    if (distance(sample, reference) > TREMOR) this.#reference = sample;
    else if (sample.time - reference.time > REST) {
      this.#rest(sample);
      return NOTHING;
    }
    return { samples: [sample], fresh: false };
  }

  #wake(sample: Sample): Cut {
    this.#reference ??= sample;
    while (this.#onset[0] && sample.time - this.#onset[0].time > REST) this.#onset.shift();
    this.#onset.push(sample);
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
  return sample.time < last.time || (sample.time === last.time && sample.x === last.x && sample.y === last.y);
}

function distance(a: Sample, b: Sample): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}
