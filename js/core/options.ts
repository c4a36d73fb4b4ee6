/**
 * Options: an unknown key, or a value of another kind, is an error rather than ignored.
 *
 * @module
 */
import { fields, isAbsent } from "./read.js";

/**
 * Checks that options are an object with legal keys alone. They may be `undefined` or `null`; a key may be `undefined`.
 *
 * @throws {@link WhitherError} `wrong-type`, `unknown-key`.
 */
export function checkOptions(options: unknown, legal: readonly string[]): void {
  if (!isAbsent(options)) fields(options, "", legal, "options");
}
