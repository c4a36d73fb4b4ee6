/**
 * The end of what lives in WebAssembly's memory.
 *
 * @module
 */
import { WhitherError } from "./error.js";

/** Throws the error of a use after `free()`. */
export function freed(what: string): never {
  throw new WhitherError("freed", "", `this ${what} was freed`);
}

/** Gives a class its `Symbol.dispose`, which not every engine has yet. */
export function disposable<T extends object>(prototype: T, dispose: (object: T) => void): void {
  if (typeof Symbol.dispose !== "symbol") return;
  const value = function (this: T): void {
    dispose(this);
  };
  Object.defineProperty(prototype, Symbol.dispose, { value, configurable: true, writable: true });
}
