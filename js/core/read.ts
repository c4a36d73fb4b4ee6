/**
 * Reads what users give, one value at a time, with the codes, paths and messages of `src/value.rs`.
 *
 * @module
 */
import { type ErrorCode, WhitherError } from "#error";
import { isList } from "./list.js";

/** The largest number in absolute value, and the inverse of the smallest length or time. */
const LARGEST = 1e50;

/** An object as its keys are read. */
export type Fields = Readonly<Record<string, unknown>>;

/** A number from a value, or an error with this path. */
export type Check = (value: unknown, path: string) => number;

/** Throws an error about a value: "must be a number" becomes "must be a number, got nothing". */
export function refuse(code: ErrorCode, path: string, must: string, value: unknown): never {
  throw new WhitherError(code, path, `${must}, got ${quoted(value)}`);
}

/** Throws the error of a key that is absent. */
export function missing(path: string): never {
  throw new WhitherError("missing-key", path, `missing key ${quoted(path.slice(path.lastIndexOf(".") + 1))}`);
}

/** Whether a value is as good as absent. */
export function isAbsent(value: unknown): value is null | undefined {
  return value === null || value === undefined;
}

/** An object with no keys but the legal ones; `name` is what an error calls it that has no path. */
export function fields(value: unknown, path: string, legal: readonly string[], name = path): Fields {
  if (typeof value !== "object" || value === null || isList(value) || ArrayBuffer.isView(value)) {
    refuse("wrong-type", name, "must be an object", value);
  }
  for (const key of Object.keys(value)) {
    if (!legal.includes(key) && (value as Fields)[key] !== undefined) {
      const words = legal.map(quoted).join(", ");
      throw new WhitherError(
        "unknown-key",
        path ? `${path}.${key}` : key,
        `unknown key ${quoted(key)}, expected one of ${words}`,
      );
    }
  }
  return value as Fields;
}

/** A list. */
export function list(value: unknown, path: string): ArrayLike<unknown> {
  if (isAbsent(value)) missing(path);
  return isList(value) ? value : refuse("wrong-type", path, "must be a list", value);
}

/** A string. */
export function text(value: unknown, path: string): string {
  if (isAbsent(value)) missing(path);
  return typeof value === "string" ? value : refuse("wrong-type", path, "must be a string", value);
}

/** A finite number within reach. */
export function number(value: unknown, path: string): number {
  // an item of a list is not missing
  if (isAbsent(value) && !path.endsWith("]")) missing(path);
  if (typeof value !== "number") refuse("wrong-type", path, "must be a number", value);
  if (Math.abs(value) <= LARGEST) return value;
  return Number.isFinite(value)
    ? refuse("out-of-range", path, "must be from -1e50 to 1e50", value)
    : refuse("not-finite", path, "must be a finite number", value);
}

/** A number above zero whose square and whose inverse are within reach. */
export function positive(value: unknown, path: string): number {
  const x = number(value, path);
  if (x <= 0) refuse("out-of-range", path, "must be greater than 0", x);
  if (x < 1 / LARGEST) refuse("out-of-range", path, "must be at least 1e-50", x);
  return x;
}

/** A number that is zero or above. */
export function notNegative(value: unknown, path: string): number {
  const x = number(value, path);
  return x >= 0 ? x : refuse("out-of-range", path, "must be at least 0", x);
}

/** How an error quotes a value: short, and one line. */
function quoted(value: unknown): string {
  if (isAbsent(value)) return "nothing";
  if (typeof value === "string") {
    const cut = [...value.slice(0, 80)].slice(0, 40).join("");
    return `"${cut}${cut.length < value.length ? "..." : ""}"`;
  }
  if (typeof value === "number" || typeof value === "boolean") return String(value);
  if (typeof value !== "object") return `a ${typeof value}`;
  if (!isList(value)) return "an object";
  return `[${Array.from(value).slice(0, 4).map(quoted).join(", ")}${value.length > 4 ? ", ..." : ""}]`;
}

/** The first ids of some, as the error of one that is not among them quotes them. */
export function quotedSome(ids: readonly string[]): string {
  return ids.slice(0, 5).map(quoted).join(", ") + (ids.length > 5 ? ", ..." : "");
}
