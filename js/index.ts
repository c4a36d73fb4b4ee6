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
import { embedded } from "./embedded.js";
import { load } from "./glue.js";
import type { WasmSource } from "./source.js";

export * from "./exports.js";

/** What {@link init} takes. */
export interface InitOptions {
  /** Where the WebAssembly is; left out: the copy inside the package. */
  readonly wasm?: WasmSource | undefined;
}

/**
 * Loads the WebAssembly, alike in a browser, a worker, Node, Deno and Bun: nothing is fetched, the bytes are in the package.
 * Call it as often as you like: it loads once, two calls at once share one, and it can be tried again after a failure.
 *
 * @param options - Another place of the WebAssembly. Once it is loaded, or loading, this is not looked at.
 * @throws {@link WhitherError} `wasm-unavailable` where WebAssembly is not allowed: a page with a Content-Security-Policy needs
 * `'wasm-unsafe-eval'` in its `script-src`, and nothing else.
 *
 * @example
 * ```ts
 * import { init } from "whither";
 * await init();
 * ```
 */
export function init(options?: InitOptions): Promise<void> {
  return load(() => options?.wasm ?? embedded());
}
