/**
 * From a compiled module to running WebAssembly, with the JavaScript side that was generated for it.
 *
 * @module
 */
import { WhitherError } from "./error.js";
import { reason, unavailable } from "./source.js";

/** What the generated code has for this: the functions that WebAssembly calls, and one that takes in what WebAssembly exports. */
interface Side {
  readonly imports: () => WebAssembly.Imports;
  readonly __wbg_set_wasm: (exports: object) => void;
}

/** An instance of the module. */
export async function instantiated(module: WebAssembly.Module, side: Side): Promise<WebAssembly.Instance> {
  try {
    return await WebAssembly.instantiate(module, side.imports());
  } catch (error) {
    throw unfit(error);
  }
}

/** The same without waiting. */
export function instantiatedNow(module: WebAssembly.Module, side: Side): WebAssembly.Instance {
  try {
    return new WebAssembly.Instance(module, side.imports());
  } catch (error) {
    throw unfit(error);
  }
}

/** Hands the instance to the generated code; gives what it exports. */
export function begin<E extends object>(instance: WebAssembly.Instance, side: Side): E {
  const exports = { ...instance.exports };
  for (const [name, item] of Object.entries(exports)) {
    if (typeof item === "function") exports[name] = guarded(item as Call);
  }
  side.__wbg_set_wasm(exports);
  (exports as { __wbindgen_start?(): void }).__wbindgen_start?.();
  return exports as E;
}

/** What WebAssembly exports takes six values at most; what is beyond its own it does not look at. */
type Call = (...values: [unknown, unknown, unknown, unknown, unknown, unknown]) => unknown;

/** Memory is asked for before a call takes it (`js/room.ts`): where it runs out all the same, or the stack does, that has a code, too. */
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
export function unfit(error: unknown): WhitherError {
  const name = (error as Partial<Error> | null | undefined)?.name;
  // what it imports is not there; anything else is not the module's fault
  const other = name === "LinkError" || name === "TypeError";
  const what = other ? `the module is not this version's ${WASM_FILE}` : "WebAssembly cannot be started here";
  return unavailable(`${what}: ${reason(error)}`, error);
}
