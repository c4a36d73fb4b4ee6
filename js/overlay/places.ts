/**
 * Where the targets of a watcher are on the screen: read once a frame, and only of those that are on it.
 *
 * @module
 */
import type { Bounds, Watcher, WatchTarget } from "#dom";

export class Places {
  readonly #watcher: Watcher;
  readonly #observer: IntersectionObserver;
  readonly #observed = new Set<Element>();
  readonly #visible = new Set<Element>();
  #virtual: readonly WatchTarget[] = [];

  constructor(watcher: Watcher) {
    this.#watcher = watcher;
    this.#observer = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) {
        if (isIntersecting) this.#visible.add(target);
        else this.#visible.delete(target);
      }
    });
    this.list();
  }

  /** Takes in which targets there are. */
  list(): void {
    const targets = new Set(this.#watcher.targets);
    for (const element of this.#observed) {
      if (targets.has(element)) continue;
      this.#observed.delete(element);
      this.#visible.delete(element);
      this.#observer.unobserve(element);
    }
    this.#virtual = [...targets].filter((target) => !isElement(target));
    for (const target of targets) {
      if (!isElement(target) || this.#observed.has(target)) continue;
      this.#observed.add(target);
      this.#observer.observe(target);
    }
  }

  /** The targets on the screen. */
  get targets(): WatchTarget[] {
    return [...this.#visible, ...this.#virtual];
  }

  /** How many targets there are, on the screen or not. */
  get count(): number {
    return this.#observed.size + this.#virtual.length;
  }

  /** Where they are now, those that have a size. */
  read(): Map<WatchTarget, Bounds> {
    const frames = new Map<Window, Frame | null>();
    const places = new Map<WatchTarget, Bounds>();
    for (const target of this.targets) {
      const box = isElement(target) ? boxOf(target, frames) : boundsOf(target);
      if (box && box.width > 0 && box.height > 0) places.set(target, box);
    }
    return places;
  }

  stop(): void {
    this.#observer.disconnect();
  }
}

export function isElement(target: WatchTarget): target is Element {
  return (target as Element).nodeType === 1;
}

/** Where the viewport of a framed window is in this one. */
interface Frame {
  readonly x: number;
  readonly y: number;
  readonly across: number;
  readonly down: number;
}

function boxOf(element: Element, frames: Map<Window, Frame | null>): Bounds | null {
  const { x, y, width, height } = element.getBoundingClientRect();
  const view = element.ownerDocument.defaultView;
  if (view === window || !view) return view && { x, y, width, height };
  if (!frames.has(view)) frames.set(view, frameOf(view));
  const frame = frames.get(view);
  if (!frame) return null;
  const { across, down } = frame;
  return { x: frame.x + across * x, y: frame.y + down * y, width: across * width, height: down * height };
}

/** Through the elements that frame the window and those around it; null where it is in no frame any more. */
function frameOf(view: Window): Frame | null {
  let frame = { x: 0, y: 0, across: 1, down: 1 };
  for (let at = view; at !== window; ) {
    const element = at.frameElement as HTMLElement | null;
    const around = element?.ownerDocument.defaultView;
    if (!element || !around) return null;
    const { x, y, width, height } = element.getBoundingClientRect();
    const across = width / element.offsetWidth || 1;
    const down = height / element.offsetHeight || 1;
    const { paddingLeft, paddingTop } = around.getComputedStyle(element);
    frame = {
      x: x + across * (element.clientLeft + Number.parseFloat(paddingLeft) + frame.x),
      y: y + down * (element.clientTop + Number.parseFloat(paddingTop) + frame.y),
      across: across * frame.across,
      down: down * frame.down,
    };
    at = around;
  }
  return frame;
}

/** What is wrong with a virtual target, the watcher reports. */
function boundsOf(target: Exclude<WatchTarget, Element>): Bounds | null {
  try {
    return target.bounds();
  } catch {
    return null;
  }
}
