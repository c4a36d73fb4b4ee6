/**
 * Boxes of elements, in px of the window's viewport.
 *
 * @module
 */
import type { Bounds } from "#dom";

export function boundsOf(element: Element): Bounds {
  const { x, y, width, height } = element.getBoundingClientRect();
  return { x, y, width, height };
}

/** Whether an element is rendered and visible: panels are hidden by any of these. */
export function isShown(element: Element): boolean {
  const { width, height } = element.getBoundingClientRect();
  return width > 0 && height > 0 && (element.checkVisibility?.({ visibilityProperty: true }) ?? true);
}

/** The box straight between two: in each direction the gap, or what they have in common. */
export function betweenOf(a: Bounds, b: Bounds): Bounds {
  const [x, right] = span(a.x, a.width, b.x, b.width);
  const [y, bottom] = span(a.y, a.height, b.y, b.height);
  return { x, y, width: right - x, height: bottom - y };
}

export function isIn({ x, y, width, height }: Bounds, place: { readonly x: number; readonly y: number }): boolean {
  return place.x >= x && place.x <= x + width && place.y >= y && place.y <= y + height;
}

function span(a: number, lengthA: number, b: number, lengthB: number): [number, number] {
  const [low, high] = [Math.max(a, b), Math.min(a + lengthA, b + lengthB)];
  return low <= high ? [low, high] : [high, low];
}
