/** One pointer's movements, one after the other, and the outcome of its presses. */
import { History, type Moment } from "./history.ts";
import { IntentRule, type Box, type Intent } from "./intent.ts";
import { judge, type Outcome } from "./outcome.ts";
import { Segmenter, type Cut, type Sample } from "./segmenter.ts";

export interface Movement {
  readonly history: History;
  readonly intent: IntentRule;
}

/** A press with the movement that it is judged by. */
export interface Judged {
  readonly outcome: Outcome;
  readonly moments: readonly Moment[];
}

export class Track {
  readonly #segmenter = new Segmenter();
  #movement: Movement | null = null;
  /** The last movement before it that led from one place to another. */
  #before: Movement | null = null;
  #heard: Sample | null = null;

  /** The movement under way, or the last one while the pointer rests; null after a press and before the first. */
  get movement(): Movement | null {
    return this.#movement;
  }

  /** The last sample that taught something, or null. */
  get heard(): Sample | null {
    return this.#heard;
  }

  /** Takes a sample; where it begins a movement, among the boxes as they are then. */
  add(sample: Sample, boxes: () => readonly Box[]): Cut {
    const cut = this.#segmenter.add(sample);
    const [first] = cut.samples;
    if (!first) return cut;
    if (cut.fresh) {
      if (this.#movement?.intent.confinedTo === null) this.#before = this.#movement;
      this.#movement = { history: new History(), intent: new IntentRule(first, boxes()) };
    }
    for (const each of cut.samples) this.#movement?.intent.move(each);
    this.#heard = sample;
    return cut;
  }

  /** Records the posterior now. */
  record(probabilities: Float64Array, none: number, threshold: number): void {
    if (!this.#heard || !this.#movement) return;
    this.#movement.history.add(this.#heard.time, probabilities, none);
    this.#movement.intent.update(this.#heard.time, this.#heard, probabilities, threshold);
  }

  /** Discards the movement; what follows is another one. */
  forget(): void {
    this.#segmenter.end();
    this.#movement = this.#before = this.#heard = null;
  }

  /**
   * A press on a destination, or with null on none; null where no movement led to it. A press counts with the movement
   * that led to the destination: one that stirs on it without leaving it is no way to it, so that the one before counts.
   */
  press(time: number, chosen: number | null): Judged | null {
    const stirred = chosen !== null && this.#movement?.intent.confinedTo === chosen;
    const movement = stirred ? this.#before : this.#movement;
    this.forget();
    if (chosen === null || !movement) return null;
    const intents: readonly Intent[] = movement.intent.intents;
    return { outcome: judge(intents, chosen, time), moments: movement.history.moments.filter((moment) => moment.time < time) };
  }
}
