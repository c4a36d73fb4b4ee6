/**
 * Predicts where a moving thing is heading while it is still on its way: which icon a pointer is going to, which harbour a
 * vessel, which airport an aircraft.
 *
 * Seconds for time everywhere, and your own unit of length (pixels on a page). Matrices are row-major.
 *
 * @example
 * ```ts
 * import { init, pointerScenario, Predictor } from "whither";
 *
 * await init();
 * const predictor = new Predictor(
 *   pointerScenario([
 *     { id: "radio", x: 100, y: 80, width: 90, height: 90 },
 *     { id: "map", x: 600, y: 300, width: 90, height: 90 },
 *   ]),
 * );
 * predictor.observe(0.0, [300, 500]);
 * predictor.observe(0.016, [306, 496]);
 * console.log(predictor.best);
 * predictor.free();
 * ```
 *
 * @packageDocumentation
 */
export { init, type InitOptions } from "../core/loading/embedded.js";
export * from "../core/exports.js";
export * from "../core/sequence.js";
export * from "../pointing/hand.js";
export * from "../pointing/ray.js";
export * from "../pointing/scenario.js";
