/**
 * When a movement is taken to mean one icon: the one rule by which the ring closes and by which a press is judged.
 *
 * The ring closes around an icon that is as probable as the threshold and opens when it falls below the release. The icon on
 * which the movement began is not ringed until the pointer has left it and has come back to it, or half of the way.
 */
import { leader } from "./leader.ts";

export interface Point {
  readonly x: number;
  readonly y: number;
}

/** A destination's box: its middle and its size, in px. */
export interface Box extends Point {
  readonly width: number;
  readonly height: number;
}

/** A ring that has closed. */
export interface Intent {
  /** The index of the destination. */
  readonly target: number;
  /** When, in seconds on the samples' clock. */
  readonly time: number;
}

/** The release for a threshold: .5 for .8. */
export function releaseOf(threshold: number): number {
  return 0.625 * threshold;
}

/** Follows one movement. */
export class IntentRule {
  readonly #start: Point;
  readonly #origin: { readonly index: number; readonly box: Box } | null;
  readonly #intents: Intent[] = [];
  #farthest = 0;
  #left = false;
  #current: number | null = null;
  #leaving: number | null = null;

  /** A movement that begins at `start`, among these boxes. */
  constructor(start: Point, boxes: readonly Box[]) {
    this.#start = start;
    const index = boxIndexAt(start, boxes);
    const box = index === null ? undefined : boxes[index];
    this.#origin = index !== null && box ? { index, box } : null;
  }

  /** The icon that is ringed, or null. */
  get current(): number | null {
    return this.#current;
  }

  /** The icon that would be ringed if it were not the one that is being left, or null. */
  get leaving(): number | null {
    return this.#leaving;
  }

  /** Every ring that has closed, in their order. */
  get intents(): readonly Intent[] {
    return this.#intents;
  }

  /** The icon on which the movement began and that it never left, or null. */
  get confinedTo(): number | null {
    return this.#left ? null : (this.#origin?.index ?? null);
  }

  /** The pointer is heard of at a place. */
  move(to: Point): void {
    this.#farthest = Math.max(this.#farthest, distance(to, this.#start));
    this.#left ||= this.#origin !== null && !contains(this.#origin.box, to);
  }

  /** Takes in the posterior at a time, with the pointer at a place. */
  update(time: number, at: Point, probabilities: ArrayLike<number>, threshold: number): void {
    this.move(at);
    const best = leader(probabilities);
    const sure = (probabilities[best] ?? 0) >= threshold;
    const barred = this.#barred(at);
    this.#leaving = sure && best === barred ? best : null;
    if (sure && best !== barred) {
      if (best !== this.#current) this.#intents.push({ target: best, time });
      this.#current = best;
    } else if (
      this.#current !== null &&
      ((probabilities[this.#current] ?? 0) < releaseOf(threshold) || this.#current === barred)
    ) {
      this.#current = null;
    }
  }

  /** The icon that is being left: the movement began on it and has not turned back to it. */
  #barred(at: Point): number | null {
    if (!this.#origin) return null;
    const back = contains(this.#origin.box, at) || distance(at, this.#start) <= this.#farthest / 2;
    return this.#left && back ? null : this.#origin.index;
  }
}

/** The box that a place is in, or null. */
export function boxIndexAt(place: Point, boxes: readonly Box[]): number | null {
  const index = boxes.findIndex((box) => contains(box, place));
  return index < 0 ? null : index;
}

function contains(box: Box, { x, y }: Point): boolean {
  return Math.abs(x - box.x) <= box.width / 2 && Math.abs(y - box.y) <= box.height / 2;
}

function distance(a: Point, b: Point): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}
