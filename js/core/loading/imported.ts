/**
 * `init` of the entries for where code may not compile WebAssembly at run time (Cloudflare Workers): an import gives the
 * compiled module.
 *
 * @module
 */
import compiledModule from "#module";
import { loadWith, type InitOptions } from "./init.js";

export type { InitOptions };

/** As in `whither`: {@link index!init}. */
export function init(options?: InitOptions): Promise<void> {
  return loadWith(options, (wasm) => wasm ?? compiledModule);
}
