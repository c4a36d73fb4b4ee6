/** A visitor's hand, cut into movements: one ends with a touch, and after a rest another one begins. */
import { isOn, type Position, TARGETS } from "./cabin.ts";
import { Forecaster, type Moment } from "./forecast.ts";
import { length, minus } from "./vector.ts";

/** A hand that stays within so many mm for so many seconds rests. */
const STILL = 3;
const REST = 0.6;
/** So many of the last samples are kept. */
const KEPT = 600;
/** It touches nearer to the screen than this, and is off it again from here on, in mm. */
const TOUCH = 2.5;
const OFF = 25;

export interface Movement {
  /** What is predicted by who expects shake, and by who does not. */
  readonly moments: { readonly shake: readonly Moment[]; readonly calm: readonly Moment[] };
  /** Whether it is over, by a touch; and the index of the icon that is touched, where it is one. */
  readonly touched: boolean;
  readonly icon: number | null;
}

export class Movements {
  readonly #shake = new Forecaster(true);
  readonly #calm = new Forecaster(false);
  #moments: { shake: Moment[]; calm: Moment[] } = { shake: [], calm: [] };
  #touched = false;
  #icon: number | null = null;
  /** Where and since when it has stayed about there. */
  #rest: { place: Position; since: number } | null = null;
  /** The first movement begins when the hand first moves. */
  #resting = true;

  get current(): Movement {
    return { moments: this.#moments, touched: this.#touched, icon: this.#icon };
  }

  /** `hand` is where the visitor takes it, `tip` where it is on this road; seconds on any clock. */
  add(seconds: number, hand: Position, tip: Position): void {
    if (this.#touched && hand[2] < OFF) return;
    if (this.#touched) this.#begin();
    const from = this.#rest;
    if (!from || length(minus(hand, from.place)) > STILL) {
      if (from && this.#resting) this.#begin();
      this.#rest = { place: hand, since: seconds };
    } else if (seconds - from.since > REST) {
      this.#resting = true;
    }
    if (this.#resting) return;
    const sample = [seconds, ...tip] as const;
    this.#moments = {
      shake: [...this.#moments.shake, this.#shake.observe(sample)].slice(-KEPT),
      calm: [...this.#moments.calm, this.#calm.observe(sample)].slice(-KEPT),
    };
    if (hand[2] > TOUCH) return;
    this.#touched = true;
    const icon = TARGETS.findIndex((target) => isOn(target, tip));
    this.#icon = icon < 0 ? null : icon;
  }

  free(): void {
    this.#shake.free();
    this.#calm.free();
  }

  #begin(): void {
    this.#shake.reset();
    this.#calm.reset();
    this.#moments = { shake: [], calm: [] };
    this.#touched = this.#resting = false;
    this.#icon = this.#rest = null;
  }
}
