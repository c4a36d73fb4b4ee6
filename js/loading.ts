/**
 * What every `init` does.
 *
 * @module
 */
import { load } from "./glue.js";
import { checkOptions } from "./options.js";
import type { WasmSource } from "./source.js";

/** What `init` takes. */
export interface InitOptions {
  /** Where the WebAssembly is; left out: the copy inside the package. */
  readonly wasm?: WasmSource | undefined;
}

/** Loads from what `choose` makes of the place that the options name. */
export function loadWith(options: InitOptions | undefined, choose: (wasm?: WasmSource) => WasmSource): Promise<void> {
  try {
    checkOptions(options, ["wasm"]);
  } catch (error) {
    return Promise.reject(error);
  }
  return load(() => choose(options?.wasm));
}
