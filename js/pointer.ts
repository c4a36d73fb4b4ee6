import { loaded, pointer_scenario } from "./glue.js";
import { handed } from "./room.js";
import type { PointerOptions, PointerTarget, Scenario } from "./scenario.js";

/**
 * The tuned scenario for a mouse, a pen or a finger on a screen: its targets and everything else filled in with constants that
 * were measured on recorded movements.
 *
 * @param targets - What may be pointed at, by centre and size in px.
 * @param options - What to do otherwise.
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
  loaded();
  return pointer_scenario(handed({ targets, options }, "", 2)) as Scenario;
}
