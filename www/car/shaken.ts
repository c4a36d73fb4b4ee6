/**
 * The visitor's own pointer over a road, or as another device: its events are taken, displaced, and handed on as events of a type of their
 * own, which a watcher follows in place of them. What is drawn is where the shaken hand is.
 */
import { deviceOf, observer, type Ride, type Sample } from "./devices.ts";
import type { Point } from "./geometry.ts";
import type { Cursor } from "./view/cursor.ts";

/** The `pointerType` of its events. */
export const SHAKEN = "shaken";

const REAL = ["mouse", "pen", "touch"];

/** A pointer event of what is not the browser's pointer, at the moment that its sample is of. */
export class ObservedEvent extends PointerEvent {
  override readonly timeStamp: number;

  constructor(type: "pointermove" | "pointerdown", pointerType: string, { time, x, y }: Sample) {
    const button = type === "pointerdown" ? 0 : -1;
    super(type, { pointerType, pointerId: -1, clientX: x, clientY: y, button, bubbles: true, composed: true });
    this.timeStamp = time * 1000;
  }
}

/** Dispatches events where the last sample is. */
export function dispatch(type: "pointermove" | "pointerdown", pointerType: string, samples: readonly Sample[]): void {
  const last = samples.at(-1);
  if (!last) return;
  const target = document.elementFromPoint(last.x, last.y) ?? document.documentElement;
  for (const sample of samples) target.dispatchEvent(new ObservedEvent(type, pointerType, sample));
}

/** Hands on until the returned function is called. `ride` is read at each event, and `corner` is that of the element, in px of the viewport. */
export function handOn(element: HTMLElement, cursor: Cursor, ride: () => Ride, corner: () => Point): () => void {
  const controller = new AbortController();
  const observed = observer(1);
  /** The finger on the glass. */
  let finger: number | null = null;

  const sampleOf = ({ timeStamp, clientX, clientY }: PointerEvent): Sample => ({
    time: timeStamp / 1000,
    x: clientX,
    y: clientY,
  });
  const inside = (event: Event) => event.target instanceof Node && element.contains(event.target);
  const move = (events: readonly PointerEvent[]) => {
    const samples = events.flatMap((event) => observed(sampleOf(event), ride()) ?? []);
    const last = samples.at(-1);
    if (!last) return;
    dispatch("pointermove", SHAKEN, samples);
    cursor.add(samples);
    cursor.draw(last.time, corner());
  };
  const press = (event: PointerEvent) => {
    const at = observed(sampleOf(event), { ...ride(), device: "mouse" });
    if (at) dispatch("pointerdown", SHAKEN, [at]);
  };

  const listen = (type: string, listener: (event: PointerEvent, contact: boolean) => void) => {
    const heard = (event: Event) => {
      if (event instanceof ObservedEvent || !(event instanceof PointerEvent) || !REAL.includes(event.pointerType)) return;
      // a real finger is there on the glass alone, whatever it stands for
      listener(event, deviceOf(ride()).contact || event.pointerType === "touch");
    };
    addEventListener(type, heard, { signal: controller.signal, capture: true });
  };
  listen("pointermove", (event, contact) => {
    if (contact && finger !== event.pointerId) return;
    if (inside(event) || finger !== null) cursor.show(ride().device);
    else cursor.hide();
    const all = event.getCoalescedEvents();
    move(all.length > 0 ? all : [event]);
  });
  listen("pointerdown", (event, contact) => {
    if (!inside(event) || event.button !== 0) return;
    if (!contact) {
      press(event);
      return;
    }
    finger = event.pointerId;
    cursor.show(ride().device);
    move([event]);
  });
  listen("pointerup", (event) => {
    if (finger !== event.pointerId) return;
    press(event);
    finger = null;
    cursor.hide();
  });
  listen("pointercancel", (event) => {
    if (finger === event.pointerId) finger = null;
    cursor.hide();
  });
  listen("pointerout", (event) => {
    if (finger === null && event.relatedTarget === null) cursor.hide();
  });
  // the browser's click is where the hand would be without the road
  listen("click", (event) => {
    if (!inside(event)) return;
    event.preventDefault();
    event.stopPropagation();
  });
  return () => {
    controller.abort();
    cursor.hide();
  };
}
