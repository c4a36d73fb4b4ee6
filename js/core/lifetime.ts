/**
 * The end of what lives in WebAssembly's memory.
 *
 * @module
 */
import { WhitherError } from "#error";

/** Throws the error of a use after `free()`. */
export function freed(what: string): never {
  throw new WhitherError("freed", "", `this ${what} was freed`);
}

/**
 * The name of the method that `using` calls: `Symbol.dispose`, or where an engine does not have it yet, a name that nobody knows.
 */
export const dispose: typeof Symbol.dispose = (Symbol.dispose as typeof Symbol.dispose | undefined) ?? (Symbol() as never);
