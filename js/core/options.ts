/**
 * Options: objects whose every key is read by someone. What is given beside them, or in their place, is an error and not ignored.
 *
 * @module
 */
import { WhitherError } from "#error";
import { isList } from "./plain.js";

/**
 * Refuses what is no object, and keys that nothing reads. Nothing at all is as good as no options, `undefined` under a key as good
 * as no key.
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

/** How an error quotes a value: as those of `src/value.rs` do. */
function quoted(value: unknown): string {
  if (typeof value === "string") return `"${value.length > 40 ? `${value.slice(0, 40)}...` : value}"`;
  if (typeof value === "number" || typeof value === "boolean") return String(value);
  return typeof value === "object" ? "a list" : `a ${typeof value}`;
}
