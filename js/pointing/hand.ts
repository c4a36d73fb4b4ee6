import type { Scenario } from "../core/scenario.js";
import { deviceScenario } from "./device.js";

/** The unit of lengths. */
export type LengthUnit = "millimetres" | "metres";

/** Something that a hand may be going to: an icon of a screen, a button in the air. */
export interface HandTarget {
  /** Its name; no two are the same. */
  readonly id: string;
  /** Its centre. */
  readonly x: number;
  /** Its centre. */
  readonly y: number;
  /** Its centre. @defaultValue 0: on the plane of a screen, where that is z = 0 */
  readonly z?: number | undefined;
  /** The side along x. */
  readonly width: number;
  /** The side along y. */
  readonly height: number;
  /** The side along z. @defaultValue the shorter of the other two */
  readonly depth?: number | undefined;
}

/** What the application chooses of a `handScenario`. */
export interface HandOptions {
  /** The prior probability that the hand is going to none of the targets, from 0 to less than 1. @defaultValue 0 */
  readonly none?: number | undefined;
  /**
   * The largest amplitude, in `unit`, by which a moving car or a tremor is expected to shake the hand: how much it does, and how fast,
   * is followed, from movement to movement too. 0 expects none and costs nothing. @defaultValue 0
   */
  readonly shake?: number | undefined;
  /** The deviation of a tracked coordinate, in `unit`. @defaultValue 0.25 mm */
  readonly noise?: number | undefined;
  /** The unit of all lengths, the observations' too. @defaultValue `"millimetres"` */
  readonly unit?: LengthUnit | undefined;
}

/**
 * The tuned scenario for a hand or a fingertip that moves in the air, towards a screen or free targets: its targets and everything else
 * filled in with constants that were measured on recorded movements. What is observed is `[x, y, z]`; `null` for what the tracker
 * did not find.
 *
 * @param targets - What may be reached for, by centre and size.
 * @param options - What the application chooses.
 * @throws {@link WhitherError} with the path of the field; `not-initialised` before `init()`.
 *
 * @example
 * ```ts
 * const predictor = new Predictor(
 *   handScenario([
 *     { id: "radio", x: 40, y: 30, width: 20, height: 20 },
 *     { id: "map", x: 160, y: 90, width: 20, height: 20 },
 *   ]),
 * );
 * predictor.observe(0, [100, 200, 300]);
 * ```
 */
export function handScenario(targets: readonly HandTarget[], options?: HandOptions): Scenario {
  return deviceScenario(2, targets, options);
}
