/**
 * `init` of the entries that embed their WebAssembly.
 *
 * @module
 */
import { base64 } from "#bytes";
import { loadWith, type InitOptions } from "./init.js";
import { unpack } from "./unpack.js";

export type { InitOptions };

/**
 * Loads the WebAssembly, alike in a browser, a worker, Node, Deno and Bun: nothing is fetched, the bytes are in the package.
 * Call it as often as you like: it loads once, two calls at once share one, and it can be tried again after a failure.
 *
 * @param options - Another source of the WebAssembly, ignored once it is loaded or loading.
 * @throws {@link WhitherError} `wasm-unavailable` where WebAssembly is not allowed: a page with a Content-Security-Policy needs
 * `'wasm-unsafe-eval'` in its `script-src`, and nothing else; `wrong-type` and `unknown-key` for the options.
 *
 * @example
 * ```ts
 * import { init } from "whither";
 * await init();
 * ```
 */
export function init(options?: InitOptions): Promise<void> {
  return loadWith(options, (wasm) => wasm ?? unpack(base64, `use init({ wasm }) with whither/${WASM_FILE}`));
}
