/**
 * What is a few tab stops ahead. Loaded when `reasons.keyboard` asks for it, with the library that knows the order of tab stops.
 *
 * @module
 */
import { tabbable } from "tabbable";

/**
 * The elements that are at most so many tab stops ahead of what has the focus: after it in the direction 1, before it in the direction
 * -1, none in no direction.
 */
export type FindStopsAhead = (focused: EventTarget | undefined, direction: number, most: number) => Element[];

export const stopsAhead: FindStopsAhead = (focused, direction, most) => {
  const body = (focused as Element | undefined)?.ownerDocument?.body;
  if (!body || direction === 0) return [];
  const stops = tabbable(body, { getShadowRoot: true }) as Element[];
  const at = stops.indexOf(focused as Element);
  if (at < 0) return [];
  return direction > 0 ? stops.slice(at + 1, at + 1 + most) : stops.slice(Math.max(0, at - most), at).reverse();
};
