/**
 * Cuts one pointer's samples into movements: a rest or a press ends one, a late event does not; what follows starts afresh.
 *
 * @module
 */
import type { Course, Meant } from "../hand.js";
import type { Sample } from "../pointers.js";
import type { Target } from "../targets.js";

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
const LATE = 0.5;

/**
 * Samples that follow one another within this time, after a silence that is long against it, were held up together, by a radio or a busy
 * driver, and stamped as they came: no pointer moved so fast. They have one time, and the last of them is where it was (seconds).
 */
const BUNCHED = 0.002;
const SILENCE = 8;

/** No bunch lasts longer (seconds): a mouse of 1 kHz goes on. */
const LONGEST_BUNCH = 0.01;

/** So much of what was heard before a departure is its onset (seconds). */
const ONSET = 0.12;

/** No more samples of a movement are kept. */
const MOST_SAMPLES = 8192;

/** Where a pointer is heading is read from so long before its last sample, or from one sample to the next (seconds). */
const HEADING = 0.03;

export interface Cut {
  /** The samples to observe: none while the pointer rests or repeats itself. */
  readonly samples: readonly Sample[];
  /** Whether they begin a new movement. */
  readonly fresh: boolean;
}

const NOTHING: Cut = { samples: [], fresh: false };

export class Segmenter {
  #moving = false;
  #last: Sample | null = null;
  /** When the last sample and the one before it were heard, and the time that samples of their bunch have. */
  #heard = -Infinity;
  #before = -Infinity;
  #bunch = -Infinity;
  /** While moving: where the pointer last left the tremor's circle. While resting: where it rests. */
  #reference: Sample | null = null;
  /** While resting: what was heard since the rest, in case it turns out to be the onset. */
  #onset: Sample[] = [];

  /** Whether a movement is under way, as far as has been heard. */
  get moving(): boolean {
    return this.#moving;
  }

  /** Takes a sample; `rest` is how long a pointer that has ended its movement stays put, in seconds. */
  add(heard: Sample, rest: number): Cut {
    const last = this.#last;
    const sample = this.#timed(heard);
    if (last && repeats(sample, last)) return NOTHING;
    this.#last = sample;
    if (last && sample.time < last.time) this.#rest(sample);
    else if (this.#moving && last && this.#rested(last, sample, rest)) this.#rest(last);
    return this.#moving ? this.#follow(sample) : this.#wake(sample);
  }

  /** A press, a lost pointer: whatever comes next is a new movement. */
  end(): void {
    if (this.#last) this.#rest(this.#last);
  }

  /** The sample at the time of its bunch, where it is of one. */
  #timed(sample: Sample): Sample {
    const { time } = sample;
    const step = time - this.#heard;
    if (step <= 0 && step >= -LATE) return step < 0 ? sample : { ...sample, time: this.#bunch };
    const begun = this.#bunch < this.#heard || this.#heard - this.#before >= SILENCE * step;
    if (step > BUNCHED || step < 0 || !begun || time - this.#bunch > LONGEST_BUNCH) this.#bunch = time;
    this.#before = this.#heard;
    this.#heard = time;
    return this.#bunch < time ? { ...sample, time: this.#bunch } : sample;
  }

  /** Whether the pointer rested until now: its displacement distinguishes a rest from an event that came late. */
  #rested(last: Sample, sample: Sample, rest: number): boolean {
    const reference = this.#reference ?? last;
    const still = sample.time - reference.time;
    return sample.time - last.time > LOST || (still > rest && distance(sample, reference) <= UNDER_WAY * still);
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

/** One movement, from its first sample on. */
export class Movement implements Course {
  /** The last of its samples. */
  readonly samples: Sample[] = [];
  /** How many there were in all. */
  count = 0;
  readonly meant: Meant[] = [];
  readonly spent = new Set<Target>();
  /** The probabilities of the most probable target at each frame, for calibration. */
  readonly leaders: { readonly target: Target; readonly probability: number }[] = [];
  readonly #start: Sample;
  #farthest = 0;
  #at: Sample;
  /** What the pointer was over at the start, and whether it has left that since. */
  readonly #origin: readonly Target[];
  #over: readonly Target[];
  #left: boolean;
  rested = false;

  constructor(start: Sample, over: readonly Target[]) {
    this.#start = this.#at = start;
    this.#origin = this.#over = over;
    this.#left = over.length === 0;
  }

  /** Where it is now. */
  get at(): Sample {
    return this.#at;
  }

  /** How far it came lately: the direction that it has now. */
  get heading(): { readonly x: number; readonly y: number } {
    const { time, x, y } = this.#at;
    let place = this.samples.length - 1;
    while (place > 0 && time - (this.samples[place] as Sample).time < HEADING) place--;
    const from = this.samples[place] ?? this.#at;
    return { x: x - from.x, y: y - from.y };
  }

  /** The targets that it began on and never left; empty where there is none. */
  get confinedTo(): readonly Target[] {
    return this.#left ? [] : this.#origin;
  }

  /** Takes a sample. */
  add(sample: Sample): void {
    if (this.samples.length >= MOST_SAMPLES) this.samples.splice(0, MOST_SAMPLES / 2);
    this.samples.push(sample);
    this.count++;
    this.#at = sample;
    this.#farthest = Math.max(this.#farthest, distance(sample, this.#start));
  }

  /** Keeps what was the most probable target at a frame. */
  note(target: Target, probability: number): void {
    if (this.leaders.length < MOST_SAMPLES) this.leaders.push({ target, probability });
  }

  /** The samples after the first so many. */
  after(count: number): readonly Sample[] {
    return this.samples.slice(Math.max(0, this.samples.length - (this.count - count)));
  }

  /** What the pointer is over now. */
  moveOver(over: readonly Target[]): void {
    this.#over = over;
    this.#left ||= !this.#origin.some((target) => over.includes(target));
  }

  /** Whether the target is being left: the movement began on it, and has not turned back to it or half of the way. */
  isLeaving(target: Target): boolean {
    if (!this.#origin.includes(target)) return false;
    const back = this.#over.includes(target) || distance(this.#at, this.#start) <= this.#farthest / 2;
    return !(this.#left && back);
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
