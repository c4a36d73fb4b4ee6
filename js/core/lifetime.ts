/**
 * Freeing objects that live in WebAssembly's memory.
 *
 * @module
 */
import { WhitherError } from "#error";

/** Throws the error of a use after `free()`. */
export function freed(what: string): never {
  throw new WhitherError("freed", "", `this ${what} was freed`);
}

/**
 * The name of the method that `using` calls: `Symbol.dispose`, or a private symbol in an engine that does not have it yet.
 */
export const dispose: typeof Symbol.dispose = (Symbol.dispose as typeof Symbol.dispose | undefined) ?? (Symbol() as never);
