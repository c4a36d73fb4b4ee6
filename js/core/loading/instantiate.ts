/**
 * From a compiled module to running WebAssembly, joined to the JavaScript that was generated for it.
 *
 * @module
 */
import { WhitherError } from "#error";
import { reason, unavailable } from "./source.js";

/** Of the generated code: the functions that WebAssembly calls, and the setter of what WebAssembly exports. */
interface Bindings {
  readonly imports: () => WebAssembly.Imports;
  readonly __wbg_set_wasm: (exports: object) => void;
}

/** An instance of the module. */
export async function instantiate(module: WebAssembly.Module, bindings: Bindings): Promise<WebAssembly.Instance> {
  try {
    return await WebAssembly.instantiate(module, bindings.imports());
  } catch (error) {
    throw notInstantiated(error);
  }
}

/** The same without waiting. */
export function instantiateNow(module: WebAssembly.Module, bindings: Bindings): WebAssembly.Instance {
  try {
    return new WebAssembly.Instance(module, bindings.imports());
  } catch (error) {
    throw notInstantiated(error);
  }
}

/** Passes the instance's exports to the generated code, and returns them. */
export function start<E extends object>(instance: WebAssembly.Instance, bindings: Bindings): E {
  const exports = { ...instance.exports };
  for (const [name, item] of Object.entries(exports)) {
    if (typeof item === "function") exports[name] = guarded(item as Call);
  }
  bindings.__wbg_set_wasm(exports);
  (exports as { __wbindgen_start?(): void }).__wbindgen_start?.();
  return exports as E;
}

/** A function that WebAssembly exports: it takes six values at most, and ignores those beyond its own. */
type Call = (...values: [unknown, unknown, unknown, unknown, unknown, unknown]) => unknown;

/** Memory is reserved before a call (`js/core/memory.ts`); where it runs out all the same, or the stack does, that is an error too. */
function guarded(call: Call): Call {
  return (a, b, c, d, e, f) => {
    try {
      return call(a, b, c, d, e, f);
    } catch (error) {
      throw new WhitherError("too-large", "", `WebAssembly ran out of memory or of stack: ${reason(error)}`, { cause: error });
    }
  };
}

/** The error for a module that cannot be instantiated. */
export function notInstantiated(error: unknown): WhitherError {
  const name = (error as Partial<Error> | null | undefined)?.name;
  // it imports what does not exist here: another version's; any other error is not the module's fault
  const other = name === "LinkError" || name === "TypeError";
  const what = other ? `the module is not this version's ${WASM_FILE}` : "WebAssembly cannot be started here";
  return unavailable(`${what}: ${reason(error)}`, error);
}
