/**
 * The one instance of the WebAssembly, and the one importer of the code that is generated for it: loads it, once, and
 * exports its bindings.
 *
 * @module
 */
import { __wbg_set_wasm, imports } from "#wasm";
import { WhitherError } from "#error";
import { checkOptions } from "../options.js";
import { instantiate, instantiateNow, notInstantiated, start } from "./instantiate.js";
import { compile, compileNow, type CompiledModule, type WasmSource } from "./source.js";

export * from "#wasm";

const bindings = { __wbg_set_wasm, imports };

type Exports = { readonly memory: WebAssembly.Memory };

let running: Exports | undefined;
let loading: Promise<void> | undefined;

/**
 * Loads the WebAssembly from `source`. Every call while it loads, or later, returns the same promise; after a failure the next
 * call tries again.
 */
export function load(source: () => WasmSource): Promise<void> {
  loading ??= loadOnce(source).catch((error: unknown) => {
    loading = undefined;
    throw error;
  });
  return loading;
}

async function loadOnce(source: () => WasmSource): Promise<void> {
  if (running) return;
  const instance = await instantiate(checked(await compile(source)), bindings);
  // `initSync` may have been quicker, and the objects made since live in its memory
  running ??= start<Exports>(instance, bindings);
}

/**
 * Loads the WebAssembly without waiting, for those who have compiled it already, or have its bytes where the thread may be
 * blocked. Does nothing where it is loaded.
 *
 * @param options - `module`: a `WebAssembly.Module`, or the bytes of `whither/whither.wasm` (in `whither/pointing` of
 * `whither/pointing.wasm`).
 * @throws {@link WhitherError} `wasm-unavailable`, `wrong-type`, `unknown-key`.
 */
export function initSync(options: { module: CompiledModule | ArrayBuffer | ArrayBufferView }): void {
  checkOptions(options, ["module"]);
  running ??= start<Exports>(instantiateNow(checked(compileNow(options?.module)), bindings), bindings);
}

/** The module, if it is ours: one that imports nothing can be instantiated, whatever it is. */
function checked(module: WebAssembly.Module): WebAssembly.Module {
  if (WebAssembly.Module.exports(module).some(({ name }) => name === "__wbindgen_start")) return module;
  throw notInstantiated(new TypeError("it has no __wbindgen_start"));
}

/** The memory of the running module. It is another buffer each time the memory has grown. */
export function memory(): ArrayBuffer {
  return loaded().memory.buffer;
}

/** Throws where the WebAssembly is not loaded. */
export function loaded(): Exports {
  if (running) return running;
  throw new WhitherError("not-initialised", "", "call init() and wait for it first: await init()");
}
