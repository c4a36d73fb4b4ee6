/**
 * The only importer of the generated code: loads it, once, and hands out what it exports.
 *
 * @module
 */
import { __wbg_set_wasm, imports } from "./generated/whither.js";
import { WhitherError } from "./error.js";
import { checkOptions } from "./options.js";
import { compiled, compiledNow, type CompiledModule, type WasmSource } from "./source.js";
import { begin, instantiated, instantiatedNow, unfit } from "./start.js";

// in `whither/pointing` that of another module, which has no SequenceEngine
export * from "./generated/whither.js";

const side = { __wbg_set_wasm, imports };

type Running = { readonly memory: WebAssembly.Memory };

let running: Running | undefined;
let loading: Promise<void> | undefined;

/**
 * Loads the WebAssembly from what `source` gives. Everyone who calls while it loads, or later, gets the same promise; after
 * a failure the next call tries again.
 */
export function load(source: () => WasmSource): Promise<void> {
  loading ??= instantiate(source).catch((error: unknown) => {
    loading = undefined;
    throw error;
  });
  return loading;
}

async function instantiate(source: () => WasmSource): Promise<void> {
  if (running) return;
  const instance = await instantiated(ours(await compiled(source)), side);
  // `initSync` may have been quicker, and what was made since lives in its memory
  running ??= begin<Running>(instance, side);
}

/**
 * Loads the WebAssembly without waiting, for those who have compiled it already, or have its bytes where the thread may be
 * blocked. Does nothing where it is loaded.
 *
 * @param options - `module`: a `WebAssembly.Module`, or the bytes of `whither/whither.wasm` (in `whither/pointing` of `whither/pointing.wasm`).
 * @throws {@link WhitherError} `wasm-unavailable`, `wrong-type`, `unknown-key`.
 */
export function initSync(options: { module: CompiledModule | ArrayBuffer | ArrayBufferView }): void {
  checkOptions(options, ["module"]);
  running ??= begin<Running>(instantiatedNow(ours(compiledNow(options?.module)), side), side);
}

/** The generated code would keep whatever it is given, so another module must not reach it. */
function ours(module: WebAssembly.Module): WebAssembly.Module {
  const missing = ["__wbindgen_start", "engine_new"].find(
    (name) => !WebAssembly.Module.exports(module).some((item) => item.name === name),
  );
  if (missing !== undefined) throw unfit(new TypeError(`it has no ${missing}`));
  return module;
}

/** The memory of the running module. It is another buffer each time the memory has grown. */
export function memory(): ArrayBuffer {
  return loaded().memory.buffer;
}

/** Throws where the WebAssembly is not loaded. */
export function loaded(): Running {
  if (running) return running;
  throw new WhitherError("not-initialised", "", "call init() and wait for it first: await init()");
}
