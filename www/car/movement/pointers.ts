/** Pointer events as samples: every coalesced one, each once, on the events' own clock. */
import type { Sample } from "./segmenter.ts";

export interface PointerSinks {
  /** All samples of one event, oldest first. */
  move(pointerId: number, samples: readonly Sample[]): void;
  /** A mouse or a pen presses on an element, or a finger was put on it and lifted from there. */
  press(pointerId: number, sample: Sample, target: Element | null): void;
  /** The pointer left the window, or the browser took it away. */
  lost(pointerId: number): void;
  /** A finger left the glass. */
  gone(pointerId: number): void;
  /** The page is hidden. */
  hidden(): void;
}

/** A finger that moved farther than this has drawn a line: no tap (px). */
const TAP = 10;

/** Listens until the returned function is called. `origin` returns the screen's corner in the viewport. */
export function listen(origin: () => { x: number; y: number }, sinks: PointerSinks): () => void {
  const controller = new AbortController();
  const options = { signal: controller.signal, passive: true };
  const fingers = new Map<number, Finger>();
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
      fingers.get(event.pointerId)?.move(event);
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
      const at = sample(event, origin());
      if (event.pointerType === "touch") {
        fingers.set(event.pointerId, new Finger(event, target));
        sinks.move(event.pointerId, [at]);
      } else sinks.press(event.pointerId, at, target);
    },
    options,
  );
  addEventListener(
    "pointerup",
    (event) => {
      if (event.pointerType !== "touch") return;
      const finger = fingers.get(event.pointerId);
      fingers.delete(event.pointerId);
      if (finger?.move(event).still) sinks.press(event.pointerId, sample(event, origin()), finger.target);
      else sinks.lost(event.pointerId);
      sinks.gone(event.pointerId);
    },
    options,
  );
  addEventListener(
    "pointercancel",
    (event) => {
      sinks.lost(event.pointerId);
      if (fingers.delete(event.pointerId)) sinks.gone(event.pointerId);
    },
    options,
  );
  document.documentElement.addEventListener("pointerleave", (event) => sinks.lost(event.pointerId), options);
  document.addEventListener(
    "visibilitychange",
    () => {
      if (document.hidden) sinks.hidden();
    },
    options,
  );
  return () => controller.abort();
}

/** A finger on the glass, from where it came down. */
class Finger {
  readonly #start: PointerEvent;
  readonly target: Element | null;
  still = true;

  constructor(start: PointerEvent, target: Element | null) {
    this.#start = start;
    this.target = target;
  }

  move({ clientX, clientY }: PointerEvent): this {
    this.still &&= Math.hypot(clientX - this.#start.clientX, clientY - this.#start.clientY) <= TAP;
    return this;
  }
}

/** A slider that is being dragged, a text that is being read: no movement towards the screen. */
function quiet(event: PointerEvent): boolean {
  return event.target instanceof Element && event.target.closest("[data-quiet]") !== null;
}
