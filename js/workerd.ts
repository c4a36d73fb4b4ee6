/**
 * `whither` where code may not compile WebAssembly at run time (Cloudflare Workers): the module comes compiled, by import.
 *
 * @module
 */
import { load } from "./glue.js";
import type { InitOptions } from "./embedded.js";
import compiledModule from "./whither.wasm";

export * from "./exports.js";
export type { InitOptions } from "./embedded.js";

/** As in `whither`: {@link index!init}. */
export function init(options?: InitOptions): Promise<void> {
  return load(() => options?.wasm ?? compiledModule);
}
