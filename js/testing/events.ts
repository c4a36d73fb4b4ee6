/**
 * The events of a pointer that hovers, in the order of Pointer Events and UI Events.
 *
 * @module
 */

/** A sample on the page's clock (milliseconds), and the samples that are reported with it. */
export interface Init {
  readonly time: number;
  readonly x: number;
  readonly y: number;
  readonly coalesced?: readonly Init[];
}

interface More {
  readonly button?: number;
  readonly buttons?: number;
  readonly detail?: number;
  readonly relatedTarget?: Element | null;
}

/** What a browser would report of a pointer; each is given the elements that are under it. */
export interface Events {
  move(before: Element | null, now: Element | null, init: Init): void;
  /** Returns whether mouse events come with it: not where the page has prevented the default. */
  down(element: Element, init: Init): boolean;
  up(pressed: Element | null, element: Element | null, init: Init, compatible: boolean): void;
}

export function eventsOf(page: Document, pointerType: string, pointerId: number): Events {
  const view = page.defaultView ?? window;

  const make = (type: string, { time, x, y, coalesced = [] }: Init, more: More = {}): Event => {
    const bubbles = !/enter$|leave$/.test(type);
    const init = {
      bubbles,
      cancelable: bubbles,
      composed: bubbles,
      clientX: x,
      clientY: y,
      screenX: x,
      screenY: y,
      button: 0,
      buttons: 0,
      ...more,
    };
    const stamp = { value: time };
    if (type.startsWith("mouse")) return Object.defineProperty(new view.MouseEvent(type, init), "timeStamp", stamp);
    const coalescedEvents = coalesced.map((each) => make(type, each, more) as PointerEvent);
    const pointer = { pointerType, pointerId, isPrimary: true, pressure: init.buttons ? 0.5 : 0 };
    // older versions of jsdom have no such class
    const event = view.PointerEvent
      ? new view.PointerEvent(type, { ...init, ...pointer, coalescedEvents })
      : Object.defineProperties(
          new view.MouseEvent(type, init),
          Object.fromEntries(Object.entries(pointer).map(([key, value]) => [key, { value }])),
        );
    // jsdom returns its own objects in place of these
    if (coalesced.length > 0 && (event as PointerEvent).getCoalescedEvents?.()[0] !== coalescedEvents[0])
      Object.defineProperty(event, "getCoalescedEvents", { value: () => [...coalescedEvents] });
    return Object.defineProperty(event, "timeStamp", stamp);
  };

  /** Out of one element and into another. */
  const cross = (kind: "pointer" | "mouse", before: Element | null, now: Element | null, init: Init) => {
    if (before === now) return;
    const left = ancestors(before);
    const entered = ancestors(now);
    const button = kind === "pointer" ? { button: -1 } : {};
    const to = { ...button, relatedTarget: now };
    const from = { ...button, relatedTarget: before };
    before?.dispatchEvent(make(`${kind}out`, init, to));
    for (const each of left.filter((one) => !entered.includes(one))) each.dispatchEvent(make(`${kind}leave`, init, to));
    now?.dispatchEvent(make(`${kind}over`, init, from));
    for (const each of entered.filter((one) => !left.includes(one)).reverse())
      each.dispatchEvent(make(`${kind}enter`, init, from));
  };

  return {
    move(before, now, init) {
      const { coalesced: _, ...alone } = init;
      const left = before?.isConnected ? before : null;
      cross("pointer", left, now, alone);
      now?.dispatchEvent(make("pointermove", init, { button: -1 }));
      cross("mouse", left, now, alone);
      now?.dispatchEvent(make("mousemove", alone));
    },
    down(element, init) {
      const compatible = element.dispatchEvent(make("pointerdown", init, { buttons: 1 }));
      if (compatible) element.dispatchEvent(make("mousedown", init, { buttons: 1, detail: 1 }));
      return compatible;
    },
    up(pressed, element, init, compatible) {
      element?.dispatchEvent(make("pointerup", init));
      if (compatible) element?.dispatchEvent(make("mouseup", init, { detail: 1 }));
      const common = ancestors(pressed).find((each) => ancestors(element).includes(each));
      common?.dispatchEvent(make("click", init, { detail: 1 }));
    },
  };
}

/** An element and what it is in, out of shadow trees too, from the inside. */
function ancestors(element: Element | null): Element[] {
  const all: Element[] = [];
  for (let each = element; each; each = each.parentElement ?? ((each.getRootNode() as ShadowRoot).host as Element | null) ?? null)
    all.push(each);
  return all;
}
