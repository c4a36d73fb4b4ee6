/**
 * One pointer's movements, and the posterior of the one under way.
 *
 * @module
 */
import type { Remaining } from "../../core/predictor.js";
import type { Hand, Predicted } from "../hand.js";
import type { Sample } from "../pointers.js";
import type { Target } from "../targets.js";
import type { PointerPosterior } from "./engine.js";
import { Candidates } from "./candidates.js";
import { Movement, Segmenter } from "./movements.js";

export class Track implements Predicted {
  readonly hand: Hand;
  readonly posterior: PointerPosterior;
  readonly candidates = new Candidates();
  readonly #segmenter = new Segmenter();
  #movement: Movement | null = null;
  /** The last movement before it that led from one place to another. */
  #before: Movement | null = null;
  /** When a sample was last heard that is no repetition, in milliseconds. */
  #heard = -Infinity;
  /** Whether there are samples that the posterior does not have yet. */
  fresh = false;
  /** Whether there is a posterior of this movement. */
  known = false;

  constructor(hand: Hand, posterior: PointerPosterior) {
    this.hand = hand;
    this.posterior = posterior;
  }

  get movement(): Movement | null {
    return this.#movement;
  }

  get moving(): boolean {
    return this.#segmenter.moving && this.#movement !== null && !this.#movement.rested;
  }

  get remaining(): Remaining | null {
    return this.known ? (this.posterior.predictor?.remaining ?? null) : null;
  }

  /**
   * Takes samples, oldest first; gives whether there was something to observe.
   *
   * @param over - What the pointer was over before them.
   * @param rest - What ends a movement, in milliseconds.
   */
  add(samples: readonly Sample[], over: readonly Target[], rest: number, now: number): boolean {
    let observed = false;
    for (const sample of samples) {
      const cut = this.#segmenter.add(sample, rest / 1000);
      const [first] = cut.samples;
      if (!first) continue;
      if (cut.fresh || !this.#movement) {
        if (this.#movement?.confinedTo.length === 0) this.#before = this.#movement;
        this.#movement = new Movement(first, over);
        this.known = false;
      }
      for (const each of cut.samples) this.#movement.add(each);
      this.#movement.rested = false;
      observed = true;
    }
    if (observed) {
      this.#heard = now;
      this.fresh = true;
    }
    return observed;
  }

  moveOver(over: readonly Target[]): void {
    this.#movement?.moveOver(over);
  }

  /** A pointer that has not moved for the time of a rest has ended its movement, unless it turns out that its events were late. */
  restAfter(rest: number, now: number): void {
    if (this.#movement && now - this.#heard > rest) this.#movement.rested = true;
  }

  /** The movement that a press on these is judged by: one that stirs on them without leaving them is no way to them. */
  leadingTo(pressed: readonly Target[]): Movement | null {
    const stirred = this.#movement?.confinedTo.some((target) => pressed.includes(target));
    return stirred ? this.#before : this.#movement;
  }

  /** The movement is over, and forgotten; what follows is another one. */
  end(): void {
    this.#segmenter.end();
    this.candidates.clear();
    this.#movement = this.#before = null;
    this.known = this.fresh = false;
  }

  probability(target: Target): number {
    return this.known ? this.posterior.probability(target) : 0;
  }
}
