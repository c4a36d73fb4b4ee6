/**
 * One pointer, as far as its events alone show: what it is over, and where.
 *
 * @module
 */
import type { Remaining } from "../core/predictor.js";
import type { Place } from "./pointers.js";
import type { Target } from "./targets.js";
import type { Reason } from "./types.js";

/** In which a target is meant once: a movement, a focus. */
export interface Scope {
  readonly spent: Set<Target>;
}

/** An intent of a movement: what was meant, since when (milliseconds), and why. */
export interface Meant {
  readonly target: Target;
  readonly time: number;
  readonly reason: Reason;
}

/** What is known of a pointer's movement, once it is predicted. */
export interface Course extends Scope {
  /** What was taken to be meant, in its order. */
  readonly meant: Meant[];
  /** Ended by a rest, unless the next sample shows that its events were late. */
  readonly rested: boolean;
  /** Whether the movement began on the target, and has not turned back to it. */
  isLeaving(target: Target): boolean;
}

/** What a prediction adds to a hand. */
export interface Predicted {
  /** The movement under way, or the last one; null before the first, and after a press. */
  readonly movement: Course | null;
  /** Whether it is under way. */
  readonly moving: boolean;
  probability(target: Target): number;
  readonly remaining: Remaining | null;
  /** What the pointer is over has changed. */
  moveOver(over: readonly Target[]): void;
}

export class Hand {
  readonly pointerType: string;
  /** The targets that it is over, the innermost first; null before that is known. */
  over: readonly Target[] | null = null;
  /** In the viewport of its window. */
  place: Place | null = null;
  predicted: Predicted | null = null;
  #scope: Scope = { spent: new Set() };

  constructor(pointerType: string) {
    this.pointerType = pointerType;
  }

  get isTouch(): boolean {
    return this.pointerType === "touch";
  }

  /** The movement, or what stands for one where none is known. */
  get scope(): Scope {
    return this.predicted?.movement ?? this.#scope;
  }

  get moving(): boolean {
    return this.predicted?.moving ?? false;
  }

  probability(target: Target): number {
    return this.moving ? (this.predicted?.probability(target) ?? 0) : 0;
  }

  isOver(target: Target): boolean {
    return this.over?.includes(target) ?? false;
  }

  /** What it is over now; gives whether that is something else. */
  moveOver(over: readonly Target[]): boolean {
    const before = this.over;
    this.over = over;
    if (before?.length === over.length && over.every((target, i) => target === before[i])) return false;
    this.#scope = { spent: new Set() };
    this.predicted?.moveOver(over);
    return true;
  }
}
