/**
 * `whither/pointing`: `whither` for pointers on a screen alone, half as large. It has the method `pointing` and whatever
 * {@link pointerScenario} makes, with every answer of a {@link Predictor}, and neither the methods of the papers nor sequences.
 *
 * It has a WebAssembly file of its own, `whither/pointing.wasm`. Together with `whither` on one page, each loads its own.
 *
 * @example
 * ```ts
 * import { init, pointerScenario, Predictor } from "whither/pointing";
 *
 * await init();
 * const predictor = new Predictor(pointerScenario([{ id: "map", x: 600, y: 300, width: 90, height: 90 }]));
 * ```
 *
 * @module
 */
export { init, type InitOptions } from "../core/loading/embedded.js";
export * from "../core/exports.js";
export * from "../pointing/scenario.js";
