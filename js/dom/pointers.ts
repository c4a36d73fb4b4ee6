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
 * Follows the pointers of a window until the returned function is called. `follows` decides which pointers count, and with `raw` samples come at the device's rate, where the browser has such.
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
    if (event.pointerType !== "touch") last = event;
    const place = placeOf(event);
    const finger = fingers.get(event.pointerId);
    // a finger that scrolls the page goes on with raw updates
    if (event.pointerType === "touch" && !finger) return;
    if (finger && distance(place, finger.place) > TAP) finger.still = false;
    // the list may have the event itself or not, and may be empty
    const samples = [...(event.getCoalescedEvents?.() ?? []), event].map(sampleOf);
    sinks.moved(event, samples, view, finger ? null : place);
  };
  const down = (event: PointerEvent) => {
    if (!follows(event)) return;
    const place = placeOf(event);
    if (event.pointerType === "touch") {
      fingers.set(event.pointerId, { place, still: true });
      sinks.moved(event, [sampleOf(event)], view, place);
      sinks.touched(event, place);
    } else if (event.button === 0) sinks.pressed(event, place);
  };
  const up = (event: PointerEvent) => {
    const finger = fingers.get(event.pointerId);
    if (!finger) return;
    fingers.delete(event.pointerId);
    if (finger.still && distance(placeOf(event), finger.place) <= TAP) sinks.pressed(event, finger.place);
    else sinks.lost(event.pointerId);
    sinks.gone(event.pointerId);
  };
  const cancel = (event: PointerEvent) => {
    // a drag goes on with events of its own
    if (event.pointerId === dragged?.pointerId) return;
    sinks.lost(event.pointerId);
    if (fingers.delete(event.pointerId)) sinks.gone(event.pointerId);
  };
  const out = (event: PointerEvent) => {
    // into no other element: out of the window. A frame's pointer goes on in the window around it.
    if (event.relatedTarget === null && view === platform.window && event.pointerType !== "touch" && !dragged) {
      sinks.lost(event.pointerId);
    }
  };
  const drag = (event: DragEvent) => {
    const pointer = (dragged ??= last);
    if (!follows(pointer)) return;
    if (event.type === "dragover") sinks.moved(pointer, [sampleOf(event)], view, placeOf(event));
    if (event.type === "drop") sinks.pressed(pointer, placeOf(event));
    if (event.type === "drop" || event.type === "dragend") {
      dragged = null;
      sinks.lost(pointer.pointerId);
    }
  };
  const hide = (event: Event) => {
    if (event.type === "pagehide" || view.document.hidden) sinks.hidden();
  };

  const stops = [
    platform.listen(view, raw ? ["pointermove", "pointerrawupdate"] : ["pointermove"], move),
    platform.listen(view, ["pointerdown"], down),
    platform.listen(view, ["pointerup"], up),
    platform.listen(view, ["pointercancel"], cancel),
    platform.listen(view, ["pointerout"], out),
    platform.listen(view, ["dragstart", "dragover", "drop", "dragend"], drag),
    platform.listen(view, ["pagehide", "visibilitychange"], hide),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}

function distance(a: Place, b: Place): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}
