/**
 * `whither/pointing`: which target on a screen a pointer is going to, with all that this needs and nothing else, a fifth of the
 * size of `whither`. A {@link PointerPredictor} has the probabilities of a `Predictor` of `whither` with `pointerScenario`.
 *
 * It has a WebAssembly file of its own, `whither/pointing.wasm`. Together with `whither` on one page, each loads its own.
 *
 * @example
 * ```ts
 * import { init, PointerPredictor } from "whither/pointing";
 *
 * await init();
 * const predictor = new PointerPredictor([{ id: "map", x: 600, y: 300, width: 90, height: 90 }]);
 * ```
 *
 * @module
 */
export { init, type InitOptions } from "../core/loading/embedded.js";
export * from "../pointing/exports.js";
