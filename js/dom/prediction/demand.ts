/**
 * How probable a target has to be before it is meant: the threshold, as far as it is still to go.
 *
 * While there is far to go, waiting costs little and the posterior is about to become surer; a target that is nearly reached is meant
 * now or too late. So the odds that are asked for rise with the distance `d` from the pointer to the target's edge,
 *
 *     p / (1 - p) >= threshold / (1 - threshold) ((d + 10 px) / (50 px + 10 px))^0.6,
 *
 * and what the pointer moves away from is not meant. On recorded mice that has more movements right and early, and no more wrong ones,
 * than one threshold for all: docs/pointing.md, "The first crossing".
 *
 * @module
 */
import type { Bounds } from "../types.js";
import type { Movement } from "./movements.js";

/** The distance at which the threshold is asked for as it is, what is added to both, and the power of their ratio (px, px, 1). */
const DISTANCE = 50;
const NEAR = 10;
const POWER = 0.6;

/** The probability that a target has to have; infinite where the pointer moves away from it. */
export function demandOf(threshold: number, box: Bounds, { at, heading }: Movement): number {
  const x = box.x + box.width / 2 - at.x;
  const y = box.y + box.height / 2 - at.y;
  if (x * heading.x + y * heading.y < 0) return Infinity;
  const away = Math.hypot(Math.max(0, Math.abs(x) - box.width / 2), Math.max(0, Math.abs(y) - box.height / 2));
  const odds = (threshold / (1 - threshold)) * ((away + NEAR) / (DISTANCE + NEAR)) ** POWER;
  return 1 / (1 + 1 / odds);
}
