/**
 * The targets that a pointer is sure enough of, and since when: what has held for long enough is meant.
 *
 * @module
 */
import type { Hand } from "../hand.js";
import { type Intents, TOUCH } from "../intent.js";
import type { Settings } from "../options.js";
import type { Target } from "../targets.js";
import type { PointerPosterior } from "./engine.js";

/**
 * So much have the odds of a target to rise over those before the movement where its prior is above the threshold already, as it is
 * where there is one target alone: wherever the pointer goes.
 */
const RISE = 1.5;

export class Candidates {
  #since: ReadonlyMap<Target, number> = new Map();

  /** Takes a posterior that was computed at a time, in milliseconds. */
  consider(hand: Hand, posterior: PointerPosterior, now: number, settings: Settings, intents: Intents): void {
    const { reasons, threshold, none } = settings;
    const { targets, probabilities } = posterior;
    const before = this.#since;
    const since = new Map<Target, number>();
    this.#since = since;
    const movement = hand.predicted?.movement;
    if (!movement || reasons.pointer === null) return;
    const after = hand.isTouch ? Math.max(TOUCH, reasons.pointer) : reasons.pointer;
    for (let i = 0; i < targets.length; i++) {
      const target = targets[i] as Target;
      const probability = probabilities[i] as number;
      const enough = target.settings.threshold ?? threshold;
      if (probability < enough || movement.isLeaving(target)) continue;
      const prior = (1 - none) * posterior.prior(i);
      if (prior >= enough && odds(probability) < RISE * odds(prior)) continue;
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
