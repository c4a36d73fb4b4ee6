/**
 * `whither/slim`: all of `whither` but the WebAssembly's bytes, for those who serve `whither/whither.wasm` themselves.
 *
 * @module
 */
import { WhitherError } from "#error";
import { loadWith } from "../core/loading/init.js";
import type { WasmSource } from "../core/loading/source.js";

export * from "../core/exports.js";
export * from "../core/sequence.js";
export * from "../pointing/hand.js";
export * from "../pointing/ray.js";
export * from "../pointing/scenario.js";

/** What {@link init} takes here: where the WebAssembly is. */
export interface SlimInitOptions {
  /** Where the WebAssembly is: the address of `whither/whither.wasm`, its bytes, a `Response`, a compiled module. */
  readonly wasm: WasmSource;
}

/**
 * Loads the WebAssembly. Call it as often as you like: it loads once, and can be tried again after a failure.
 *
 * @param options - Where the WebAssembly is; ignored once it is loaded or loading.
 * @throws {@link WhitherError} `wasm-unavailable` where it cannot be fetched or is not allowed; `missing-key`, `wrong-type`,
 * `unknown-key`.
 *
 * @example
 * ```ts
 * import { init } from "whither/slim";
 * await init({ wasm: "/assets/whither.wasm" });
 * ```
 */
export function init(options: SlimInitOptions): Promise<void> {
  return loadWith(options, (wasm) => {
    if (wasm !== undefined) return wasm;
    throw new WhitherError("missing-key", "wasm", 'missing key "wasm": whither/slim has no bytes of its own');
  });
}
