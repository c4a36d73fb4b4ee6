/**
 * Pointer events as samples: every coalesced one, on the events' own clock, in the viewport's px.
 *
 * @module
 */
import type { Platform, Stop } from "./platform.js";

/** Seconds on the main window's clock, and px in a viewport. */
export interface Sample {
  readonly time: number;
  readonly x: number;
  readonly y: number;
}

/** One pointer as its events describe it. */
export interface PointerId {
  readonly pointerId: number;
  readonly pointerType: string;
}

/** Where an event was dispatched: the nodes from the innermost one outwards, and the place in the viewport of its window. */
export interface Place {
  readonly path: readonly EventTarget[];
  readonly view: Window;
  readonly x: number;
  readonly y: number;
}

export interface PointerSinks {
  /** The samples of one event, oldest first; `place` is null where the event does not show what the pointer is over. */
  moved(pointer: PointerId, samples: readonly Sample[], view: Window, place: Place | null): void;
  /** A finger was put down. */
  touched(pointer: PointerId, place: Place): void;
  /** A mouse or a pen pressed, a finger was lifted from where it came down, something was dropped. */
  pressed(pointer: PointerId, place: Place): void;
  /** The movement is over without a press: the pointer left the window, or the browser took it away. */
  lost(pointerId: number): void;
  /** A finger left the glass. */
  gone(pointerId: number): void;
  /** The page is hidden. */
  hidden(): void;
}

/** A finger that moved farther than this has drawn a line: no tap (px). */
const TAP = 10;

/** Of the mouse, until a drag has been preceded by another pointer. */
const MOUSE = { pointerId: 1, pointerType: "mouse" };

/**
 * Follows the pointers of a window until the returned function is called. `follows` decides which pointers count, and with `raw`
 * samples come at the device's rate, where the browser has such.
 */
export function listenToPointers(
  platform: Platform,
  view: Window,
  sinks: PointerSinks,
  follows: (pointer: PointerId) => boolean,
  raw: boolean,
): Stop {
  const fingers = new Map<number, { readonly place: Place; still: boolean }>();
  let last: PointerId = MOUSE;
  let dragged: PointerId | null = null;
  const lag = (view.performance?.timeOrigin ?? 0) - (platform.window.performance?.timeOrigin ?? 0) || 0;

  const sampleOf = (event: MouseEvent): Sample => ({
    time: (event.timeStamp + lag) / 1000,
    x: event.clientX,
    y: event.clientY,
  });
  const placeOf = (event: MouseEvent): Place => ({ path: event.composedPath(), view, x: event.clientX, y: event.clientY });

  const move = (event: PointerEvent) => {
    if (!follows(event)) return;
    let place: Place | null = placeOf(event);
    if (event.pointerType === "touch") {
      const finger = fingers.get(event.pointerId);
      // a finger that scrolls the page goes on with raw updates
      if (!finger) return;
      finger.still &&= distance(place, finger.place) <= TAP;
      // its events go to where it came down
      place = finger.still ? null : { ...place, path: [] };
    } else {
      last = event;
      // a drag has none of these
      dragged = null;
    }
    // the list may have the event itself or not, and may be empty
    sinks.moved(event, [...(event.getCoalescedEvents?.() ?? []), event].map(sampleOf), view, place);
  };
  const dropped = () => {
    if (dragged) sinks.lost(dragged.pointerId);
    dragged = null;
  };
  return platform.listen(view, {
    pointermove: move,
    ...(raw && { pointerrawupdate: move }),
    pointerdown(event: PointerEvent) {
      if (!follows(event)) return;
      const place = placeOf(event);
      if (event.pointerType === "touch") {
        fingers.set(event.pointerId, { place, still: true });
        sinks.moved(event, [sampleOf(event)], view, place);
        sinks.touched(event, place);
      } else if (event.button === 0) sinks.pressed(event, place);
    },
    pointerup(event: PointerEvent) {
      const finger = fingers.get(event.pointerId);
      if (!finger) return;
      fingers.delete(event.pointerId);
      if (finger.still && distance(placeOf(event), finger.place) <= TAP) sinks.pressed(event, finger.place);
      else sinks.lost(event.pointerId);
      sinks.gone(event.pointerId);
    },
    pointercancel({ pointerId }: PointerEvent) {
      // a drag goes on with events of its own
      if (pointerId === dragged?.pointerId) return;
      sinks.lost(pointerId);
      if (fingers.delete(pointerId)) sinks.gone(pointerId);
    },
    pointerout({ relatedTarget, pointerType, pointerId }: PointerEvent) {
      // into no other element: out of the window. A frame's pointer goes on in the window around it.
      if (!relatedTarget && view === platform.window && pointerType !== "touch" && !dragged) sinks.lost(pointerId);
    },
    dragstart() {
      dragged = last;
    },
    dragover(event: DragEvent) {
      // what comes from another program has no start
      dragged ??= last;
      if (follows(dragged)) sinks.moved(dragged, [sampleOf(event)], view, placeOf(event));
    },
    drop(event: DragEvent) {
      if (dragged && follows(dragged)) sinks.pressed(dragged, placeOf(event));
      dropped();
    },
    dragend: dropped,
    pagehide: () => sinks.hidden(),
    visibilitychange() {
      if (view.document.hidden) sinks.hidden();
    },
  });
}

function distance(a: Place, b: Place): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}
