/**
 * Whether options that are written anew at every render are the same by their values.
 *
 * @module
 */

/** So many levels of lists and plain objects are looked into: deeper ones have to be the same object. */
const DEPTH = 4;

/** Whether two values are the same; lists and plain objects are where their items are. */
export function same(one: unknown, other: unknown, depth = DEPTH): boolean {
  if (Object.is(one, other)) return true;
  if (depth === 0 || !isPlain(one) || !isPlain(other) || lengthOf(one) !== lengthOf(other)) return false;
  // what is left out is as good as undefined
  const keys = new Set([...Object.keys(one), ...Object.keys(other)]);
  return [...keys].every((key) => same(one[key], other[key], depth - 1));
}

/** Of a list; null for what is none. */
function lengthOf(value: unknown): number | null {
  return Array.isArray(value) ? value.length : null;
}

/** A list, or an object without a class. */
function isPlain(value: unknown): value is Readonly<Record<string, unknown>> {
  if (typeof value !== "object" || value === null) return false;
  const prototype: unknown = Object.getPrototypeOf(value);
  return prototype === Object.prototype || prototype === Array.prototype || prototype === null;
}
