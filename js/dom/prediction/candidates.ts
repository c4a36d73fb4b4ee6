/**
 * The targets that a pointer is sure enough of, and since when: what has held for long enough is meant.
 *
 * @module
 */
import type { Hand } from "../hand.js";
import { type Intents, TOUCH } from "../intent.js";
import type { Settings } from "../options.js";
import type { Target } from "../targets.js";
import { demandOf } from "./demand.js";
import type { PointerPosterior } from "./engine.js";
import type { Movement } from "./movements.js";

/**
 * So much have the odds of a target to rise over those before the movement where its prior is enough already, as it is where there is
 * one target alone: wherever the pointer goes.
 */
const RISE = 1.5;

export class Candidates {
  #since: ReadonlyMap<Target, number> = new Map();

  /** Takes the posterior of a movement that was computed at a time, in milliseconds. */
  consider(
    hand: Hand,
    movement: Movement | null,
    posterior: PointerPosterior,
    now: number,
    settings: Settings,
    intents: Intents,
  ): void {
    const { reasons, threshold, release, none } = settings;
    const { targets, probabilities } = posterior;
    const before = this.#since;
    const since = new Map<Target, number>();
    this.#since = since;
    if (!movement || reasons.pointer === null) return;
    const after = hand.isTouch ? Math.max(TOUCH, reasons.pointer) : reasons.pointer;
    for (let i = 0; i < targets.length; i++) {
      const target = targets[i] as Target;
      const probability = probabilities[i] as number;
      const stated = target.settings.threshold ?? threshold;
      // what would be released at once is not meant
      const least = Math.min(release, stated);
      if (probability < least || movement.isLeaving(target) || !target.box) continue;
      const enough = Math.max(least, demandOf(stated, target.box, movement));
      if (probability < enough) continue;
      const prior = (1 - none) * posterior.prior(i);
      if (prior >= Math.min(stated, enough) && odds(probability) < RISE * odds(prior)) continue;
      const first = before.get(target) ?? now;
      since.set(target, first);
      if (now - first >= after) intents.begin(target, "pointer", hand);
      // the page that was called may have ended the movement
      if (hand.predicted?.movement !== movement) return;
    }
  }

  clear(): void {
    this.#since = new Map();
  }
}

function odds(probability: number): number {
  return probability / (1 - probability);
}
