/**
 * Follows one mouse or pen over a page: what it is over, where, and whether the keyboard took its place.
 *
 * @module
 */
import type { Platform, Stop } from "./platform.js";

/** Where a pointer is: the nodes that it is over, the innermost first, and px of the viewport. */
export interface Place {
  readonly path: readonly EventTarget[];
  readonly x: number;
  readonly y: number;
}

/** Out of the window, over nothing. */
export const NOWHERE: Place = { path: [], x: -1, y: -1 };

/** Where something may be typed: an element in which the focus is worth keeping however it came there. */
const FIELDS = "input, textarea, select, [contenteditable]";

/** Whether a pointer hovers, and drags nothing. */
export function hovers({ pointerType, buttons }: PointerEvent): boolean {
  return pointerType !== "touch" && buttons === 0;
}

export function placeOf(event: PointerEvent): Place {
  return { path: event.composedPath(), x: event.clientX, y: event.clientY };
}

export class Follower {
  readonly stop: Stop;
  /** Whether a key was pressed since a pointer last pressed. */
  #keyed = false;

  /**
   * Follows a pointer until it is stopped. While one of its buttons is down it drags, and is nowhere else.
   *
   * @param at - The pointer is somewhere else, or over something else; `moved` is false where the page moved under it.
   * @param lost - It has left the window, or its device was taken away.
   */
  constructor(platform: Platform, pointerId: number, at: (place: Place, moved: boolean) => void, lost: () => void) {
    const about = (event: PointerEvent, moved: boolean) => {
      if (event.pointerId === pointerId && hovers(event)) at(placeOf(event), moved);
    };
    this.stop = platform.listen(platform.window, {
      pointermove: (event: PointerEvent) => about(event, true),
      pointerover: (event: PointerEvent) => about(event, false),
      pointerup: (event: PointerEvent) => about(event, true),
      pointerout(event: PointerEvent) {
        // into no other element: out of the window
        if (event.pointerId === pointerId && !event.relatedTarget && hovers(event)) lost();
      },
      pointercancel(event: PointerEvent) {
        if (event.pointerId === pointerId) lost();
      },
      pointerdown: () => {
        this.#keyed = false;
      },
      keydown: () => {
        this.#keyed = true;
      },
    });
  }

  /** Whether the keyboard is at work in an element: it has the focus, in a field or since a key was pressed. */
  isUsing(element: Element): boolean {
    const { activeElement } = element.getRootNode() as Document;
    if (!activeElement || !element.contains(activeElement)) return false;
    return this.#keyed || activeElement.matches(FIELDS);
  }
}
