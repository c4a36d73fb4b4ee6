/**
 * Which of users' values are lists.
 *
 * @module
 */

/** The longest list that is read: as many destinations as a predictor may have. */
export const MOST_ITEMS = 1_000_000;

/** Whether `value` is read as a list. */
export function isList(value: unknown): value is ArrayLike<unknown> {
  // of all views, a DataView alone has no length; its class may be another realm's
  return Array.isArray(value) || (ArrayBuffer.isView(value) && "length" in value);
}
