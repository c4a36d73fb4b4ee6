import type { Scenario } from "../core/scenario.js";
import { deviceScenario } from "./device.js";

/** Something on a screen that a pointer may be going to. */
export interface PointerTarget {
  /** Its name; no two are the same. */
  readonly id: string;
  /** Its centre, in px from the left. */
  readonly x: number;
  /** Its centre, in px from the top. */
  readonly y: number;
  /** In px. */
  readonly width: number;
  /** In px. */
  readonly height: number;
}

/** What the application chooses of a `pointerScenario`. */
export interface PointerOptions {
  /** The prior probability that the pointer is going to none of the targets, from 0 to less than 1. @defaultValue 0 */
  readonly none?: number | undefined;
  /**
   * The largest amplitude, in px, by which a moving car or a tremor is expected to shake the pointer: how much it does, and how fast, is
   * followed, from movement to movement too. 0 expects none and costs nothing. @defaultValue 0
   */
  readonly shake?: number | undefined;
}

/**
 * The tuned scenario for a mouse, a pen or a finger on a screen: its targets and everything else filled in with constants that
 * were measured on recorded movements.
 *
 * @param targets - What may be pointed at, by centre and size in px.
 * @param options - What the application chooses.
 * @throws {@link WhitherError} with the path of the field; `not-initialised` before `init()`.
 *
 * @example
 * ```ts
 * const predictor = new Predictor(
 *   pointerScenario([
 *     { id: "radio", x: 100, y: 80, width: 90, height: 90 },
 *     { id: "map", x: 600, y: 300, width: 90, height: 90 },
 *   ]),
 * );
 * ```
 */
export function pointerScenario(targets: readonly PointerTarget[], options?: PointerOptions): Scenario {
  return deviceScenario(0, targets, options);
}
