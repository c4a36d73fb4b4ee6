/** Pointer events as samples: every coalesced one, each once, on the events' own clock. */
import type { Sample } from "./segmenter.ts";

export interface PointerSinks {
  /** All samples of one event, oldest first. */
  move(pointerId: number, samples: readonly Sample[]): void;
  /** A pointer came down: a mouse or a pen presses, a finger begins to be seen. */
  down(pointerId: number, sample: Sample, touch: boolean, target: Element | null): void;
  /** A finger left the glass. */
  lift(pointerId: number, sample: Sample): void;
  /** The pointer left the window, or the browser took it away. */
  lost(pointerId: number): void;
}

/** Listens until the returned function is called. `origin` tells where the screen's corner is in the viewport. */
export function listen(origin: () => { x: number; y: number }, sinks: PointerSinks): () => void {
  const controller = new AbortController();
  const options = { signal: controller.signal, passive: true };
  const sample = (event: PointerEvent, corner: { x: number; y: number }): Sample => ({
    time: event.timeStamp / 1000,
    x: event.clientX - corner.x,
    y: event.clientY - corner.y,
  });

  addEventListener(
    "pointermove",
    (event) => {
      if (quiet(event)) {
        sinks.lost(event.pointerId);
        return;
      }
      const corner = origin();
      const coalesced = event.getCoalescedEvents?.() ?? [];
      const events = coalesced.length > 0 ? coalesced : [event];
      sinks.move(
        event.pointerId,
        events.map((each) => sample(each, corner)),
      );
    },
    options,
  );
  addEventListener(
    "pointerdown",
    (event) => {
      if (quiet(event) || event.button !== 0) return;
      const target = event.target instanceof Element ? event.target : null;
      sinks.down(event.pointerId, sample(event, origin()), event.pointerType === "touch", target);
    },
    options,
  );
  addEventListener(
    "pointerup",
    (event) => {
      if (event.pointerType === "touch") sinks.lift(event.pointerId, sample(event, origin()));
    },
    options,
  );
  addEventListener("pointercancel", (event) => sinks.lost(event.pointerId), options);
  document.documentElement.addEventListener("pointerleave", (event) => sinks.lost(event.pointerId), options);
  return () => controller.abort();
}

/** A slider that is being dragged, a text that is being read: no movement towards the screen. */
function quiet(event: PointerEvent): boolean {
  return event.target instanceof Element && event.target.closest("[data-quiet]") !== null;
}
