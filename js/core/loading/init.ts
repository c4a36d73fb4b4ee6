/**
 * What every `init` has in common.
 *
 * @module
 */
import { load } from "./instance.js";
import { checkOptions } from "../options.js";
import type { WasmSource } from "./source.js";

/** What `init` takes. */
export interface InitOptions {
  /** Where the WebAssembly is; left out: the copy inside the package. */
  readonly wasm?: WasmSource | undefined;
}

/** Loads from the source that `choose` returns for the one in the options. */
export function loadWith(options: InitOptions | undefined, choose: (wasm?: WasmSource) => WasmSource): Promise<void> {
  try {
    checkOptions(options, ["wasm"]);
  } catch (error) {
    return Promise.reject(error);
  }
  return load(() => choose(options?.wasm));
}
