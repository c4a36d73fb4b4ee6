/**
 * Options: an unknown key, or a value of another kind, is an error rather than ignored.
 *
 * @module
 */
import { WhitherError } from "#error";
import { isList } from "./plain.js";

/**
 * Checks that options are an object with legal keys alone. They may be `undefined` or `null`; a key may be `undefined`.
 *
 * @throws {@link WhitherError} `wrong-type`, `unknown-key`.
 */
export function checkOptions(options: unknown, legal: readonly string[]): void {
  if (options === undefined || options === null) return;
  if (typeof options !== "object" || isList(options) || ArrayBuffer.isView(options)) {
    throw new WhitherError("wrong-type", "options", `must be an object, got ${quoted(options)}`);
  }
  for (const key of Object.keys(options)) {
    if (legal.includes(key) || (options as Record<string, unknown>)[key] === undefined) continue;
    const words = legal.map((word) => `"${word}"`).join(", ");
    throw new WhitherError("unknown-key", key, `unknown key ${quoted(key)}, expected one of ${words}`);
  }
}

/** A value as errors quote it, the same as in `src/value.rs`. */
function quoted(value: unknown): string {
  if (typeof value === "string") return `"${value.length > 40 ? `${value.slice(0, 40)}...` : value}"`;
  if (typeof value === "number" || typeof value === "boolean") return String(value);
  return typeof value === "object" ? "a list" : `a ${typeof value}`;
}
