/**
 * The targets that a pointer is sure enough of, and since when: what has held for long enough is meant.
 *
 * @module
 */
import type { Hand } from "../hand.js";
import { type Intents, TOUCH } from "../intent.js";
import type { Settings } from "../options.js";
import type { Target } from "../targets.js";

export class Candidates {
  #since: ReadonlyMap<Target, number> = new Map();

  /** Takes a posterior that was computed at a time, in milliseconds, with so much for each target. */
  consider(
    hand: Hand,
    targets: readonly Target[],
    probabilities: Float64Array,
    now: number,
    { reasons, threshold }: Settings,
    intents: Intents,
  ): void {
    const before = this.#since;
    const since = new Map<Target, number>();
    this.#since = since;
    const movement = hand.predicted?.movement;
    if (!movement || reasons.pointer === null) return;
    const after = hand.isTouch ? Math.max(TOUCH, reasons.pointer) : reasons.pointer;
    for (let i = 0; i < targets.length; i++) {
      const target = targets[i] as Target;
      if ((probabilities[i] as number) < (target.settings.threshold ?? threshold) || movement.isLeaving(target)) continue;
      const first = before.get(target) ?? now;
      since.set(target, first);
      if (now - first >= after) intents.begin(target, "pointer", hand);
    }
  }

  clear(): void {
    this.#since = new Map();
  }
}
