/**
 * What is a few tab stops ahead. Loaded when `reasons.keyboard` asks for it, with the library that knows the order of tab stops.
 *
 * @module
 */
import { tabbable } from "tabbable";

/** The elements that are at most so many tab stops ahead of one: after it in the direction 1, before it in the direction -1. */
export type FindStopsAhead = (focused: Element, direction: number, most: number) => Element[];

export const stopsAhead: FindStopsAhead = (focused, direction, most) => {
  const stops = tabbable(focused.ownerDocument.body, { getShadowRoot: true }) as Element[];
  const at = stops.indexOf(focused);
  if (at < 0) return [];
  return direction > 0 ? stops.slice(at + 1, at + 1 + most) : stops.slice(Math.max(0, at - most), at).reverse();
};
