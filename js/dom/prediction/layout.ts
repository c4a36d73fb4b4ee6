/**
 * Where the targets are and which of them can be pointed at. Nothing is read when a pointer moves: what may have changed is
 * noted when it is reported, and read once in the next frame of a movement; for what nothing reports, a handful of targets is
 * probed in each frame, and all are read when one of these has moved.
 *
 * @module
 */
import type { Place } from "../pointers.js";
import { attempt, hostOf, type Platform } from "../platform.js";
import type { Changes } from "./changes.js";
import type { Parts } from "./prediction.js";
import { closest, contains, type Frame, type Surface } from "./surface.js";
import { IGNORE, readBounds, type Target, type Targets } from "../targets.js";
import type { Bounds, VirtualTarget } from "../types.js";

/** Above this probability it is worth finding out whether something covers a target. */
const WORTH = 0.01;

/** So many targets are looked up in a round: what is at a place costs up to 225 microseconds. */
const LOOKED_UP = 6;

/** Milliseconds after which that is found out again, and from one target for which it is to the next. */
const OUTDATED = 250;
const APART = 100;

/** So many targets are probed in a frame besides the most probable ones. */
const PROBED = 4;

/** Where a target is looked up: at its centre and, where that is covered, nearer to its corners (shares of its size). */
const PLACES = [
  [0.5, 0.5],
  [0.2, 0.2],
  [0.8, 0.8],
  [0.8, 0.2],
  [0.2, 0.8],
] as const;

/** What in a document can be pointed at. */
interface Reach {
  /** Only what is in these, if there are any. */
  readonly modals: readonly Element[];
  /** Whether what frames the document can be. */
  readonly isUsable: boolean;
}

export class Layout {
  readonly #platform: Platform;
  readonly #surface: Surface;
  readonly #targets: Targets;
  readonly #changes: Changes;
  /** Where the viewports of framed windows are, as last read. */
  readonly #frames = new Map<Window, Frame>();
  #documents = new WeakMap<Document, Reach>();
  #probe = 0;
  #looked = -Infinity;
  readonly #covered = new Set<Target>();
  #active: readonly Target[] = [];
  /** Of these the ones that are at places where no path of an event has them. */
  #boxed: readonly Target[] = [];
  readonly #failed: (error: unknown) => void;
  /** Whose bounds were wrong when they were read last. */
  readonly #wrong = new Set<Target>();
  #stale = true;

  constructor({ platform, surface, targets, failed }: Parts, changes: Changes) {
    this.#failed = failed;
    this.#platform = platform;
    this.#surface = surface;
    this.#targets = targets;
    this.#changes = changes;
  }

  /** The targets that can be pointed at now and may be predicted. The same list until that changes, or one of them moves. */
  get active(): readonly Target[] {
    if (this.#stale) {
      this.#stale = false;
      this.#active = [...this.#targets.all].filter(isActive);
      this.#boxed = this.#active.filter((target) => isPathless(target) || target.settings.hitSlop);
    }
    return this.#active;
  }

  /** Takes in that targets are no longer watched. */
  forget(removed: readonly Target[]): void {
    for (const target of removed) {
      this.#covered.delete(target);
      this.#wrong.delete(target);
    }
    this.#stale = true;
  }

  /** What holds for targets may have changed: they are listed again. */
  relist(): void {
    this.#stale = true;
  }

  /** Whether places of a window can be brought into the main one without reading anything. */
  knows(view: Window): boolean {
    return view === this.#platform.window || this.#frames.has(view);
  }

  /** A place of a window's viewport in the main window's: as it was when the layout was last read. */
  toMain<P extends { readonly x: number; readonly y: number }>(view: Window, place: P): P {
    if (view === this.#platform.window) return place;
    const { x, y, across, down } = this.#frame(view);
    return { ...place, x: x + across * place.x, y: y + down * place.y };
  }

  /**
   * The targets at a place, the innermost first, by where the boxes were when they were last read.
   *
   * @param found - Those on its path: after those that no path has, before those that only hitSlop enlarges up to there.
   * @param reach - Whether hitSlop counts.
   */
  at(place: Place, found: readonly Target[], reach: boolean): readonly Target[] {
    if (this.active.length === 0 || this.#boxed.length === 0 || !this.knows(place.view)) return found;
    // what is drawn over the page, such as a panel of tools, has nothing under it
    if (place.path.some((node) => (node as Partial<Element>).hasAttribute?.(IGNORE))) return found;
    const main = this.toMain(place.view, place);
    const inside = this.#boxed.filter((target) => !found.includes(target) && isInside(main, target, reach));
    const inner = inside.filter((target) => isPathless(target) && isOnPath(target, place.path));
    return [...inner, ...found, ...inside.filter((target) => reach && !isPathless(target))];
  }

  /** A place of the main window's viewport, with the elements there, the innermost first. */
  placeAt({ x, y }: { readonly x: number; readonly y: number }): Place {
    const path: Element[] = [];
    for (let at = this.#topmost(x, y); at; at = at.parentElement ?? hostOf(at.getRootNode())) path.push(at);
    return { path, view: this.#platform.window, x, y };
  }

  /**
   * The one phase of reading, at the beginning of a frame; gives whether anything changed.
   *
   * @param begun - Whether a movement has begun: then nothing is left to probes.
   * @param leading - The most probable targets.
   */
  read(begun: boolean, leading: readonly Target[]): boolean {
    const now = this.#platform.now();
    const changes = this.#changes;
    for (const target of this.#covered) if (now - target.checked >= OUTDATED) this.#doubt(target);
    if (!changes.moved && !begun && !this.#probed(leading)) return this.#stale;
    this.#reframe();
    if (changes.moved) this.#documents = new WeakMap();
    for (const target of this.#targets.all) {
      if (changes.restyled) target.styled = false;
      if (changes.moved) this.#doubt(target);
      this.#measure(target);
    }
    changes.moved = changes.restyled = false;
    return this.#stale;
  }

  /** Finds out which of the probable targets are covered. */
  uncover(active: readonly Target[], probabilities: Float64Array): void {
    const now = this.#platform.now();
    const worth: [Target, number][] = [];
    for (let i = 0; i < active.length; i++) {
      const probability = probabilities[i] as number;
      if (probability > WORTH) worth.push([active[i] as Target, probability]);
    }
    worth.sort(([, a], [, b]) => b - a);
    const due = worth.flatMap(([target]) => (target.element && now - target.checked >= OUTDATED ? target : []));
    const unknown = due.filter(({ checked }) => checked === -Infinity);
    const again = now - this.#looked >= APART ? due.slice(0, 1) : [];
    for (const target of unknown.length > 0 ? unknown.slice(0, LOOKED_UP) : again) this.#look(target, now);
  }

  #frame(view: Window): Frame {
    let frame = this.#frames.get(view);
    if (!frame) this.#frames.set(view, (frame = this.#surface.frameOf(view)));
    return frame;
  }

  /** Reads again where framed windows are; gives whether one of them has moved. */
  #reframe(): boolean {
    let moved = false;
    for (const [view, was] of this.#frames) {
      // its iframe is gone
      if (view.closed) this.#frames.delete(view);
      else {
        const is = this.#surface.frameOf(view);
        moved ||= is.x !== was.x || is.y !== was.y || is.across !== was.across || is.down !== was.down;
        this.#frames.set(view, is);
      }
    }
    return moved;
  }

  /** Whether one of the most probable targets, of some others in turn or of the framed windows is not where it was. */
  #probed(leading: readonly Target[]): boolean {
    if (this.#reframe()) return true;
    const { active } = this;
    const some = Array.from({ length: Math.min(PROBED, active.length) }, () => active[this.#probe++ % active.length] as Target);
    return [...leading, ...some].some((target) => this.#measure(target));
  }

  /** Reads where a target is, and whether it can be pointed at if that is not known; gives whether it has moved. */
  #measure(target: Target): boolean {
    const was = target.box;
    if (target.visible && !target.styled) {
      target.styled = true;
      target.usable = !target.element || this.#isUsable(target.element);
      this.#doubt(target);
    }
    const box = target.visible && target.usable ? this.#box(target) : null;
    const same = was && box ? sameBox(was, box) : was === box;
    if (same) return false;
    target.box = box;
    this.#doubt(target);
    return true;
  }

  /** Whether it is covered is to be found out again, if it is probable. */
  #doubt(target: Target): void {
    target.checked = -Infinity;
    target.covered = false;
    this.#covered.delete(target);
    this.#stale = true;
  }

  #box(target: Target): Bounds | null {
    const { element, settings } = target;
    const bounds = element ? this.#place(element) : this.#bounds(target);
    if (!bounds) return null;
    const { x, y, width, height } = bounds;
    if (!(width > 0 && height > 0)) return null;
    const [top, right, bottom, left] = settings.hitSlop ?? [0, 0, 0, 0];
    return { x: x - left, y: y - top, width: width + left + right, height: height + top + bottom };
  }

  /** Where a virtual target is; null where its bounds are wrong, which is reported once. */
  #bounds(target: Target): Bounds | null {
    try {
      const bounds = readBounds((target.node as VirtualTarget).bounds(), "bounds()");
      this.#wrong.delete(target);
      return bounds;
    } catch (error) {
      if (!this.#wrong.has(target)) this.#failed(error);
      this.#wrong.add(target);
      return null;
    }
  }

  /** The box of an element in the main window. */
  #place(element: Element): Bounds {
    const box = this.#surface.box(element);
    const view = element.ownerDocument.defaultView;
    if (!view || view === this.#platform.window) return box;
    const { across, down } = this.#frame(view);
    return { ...this.toMain(view, { x: box.x, y: box.y }), width: box.width * across, height: box.height * down };
  }

  #isUsable(element: Element): boolean {
    const { modals, isUsable } = this.#reach(element.ownerDocument);
    const isInside = modals.length === 0 || modals.some((modal) => contains(modal, element));
    return isUsable && isInside && element.isConnected && this.#surface.isUsable(element);
  }

  #reach(document: Document): Reach {
    let reach = this.#documents.get(document);
    if (!reach) {
      const host = hostOf(document);
      reach = { modals: this.#surface.modals(document), isUsable: !host || this.#isUsable(host) };
      this.#documents.set(document, reach);
    }
    return reach;
  }

  #look(target: Target, now: number): void {
    target.checked = this.#looked = now;
    const element = target.element as Element;
    const { x, y, width, height } = this.#place(element);
    const covered = PLACES.every(([across, down]) => {
      const found = this.#topmost(x + across * width, y + down * height);
      return found !== null && !belongs(found, element);
    });
    if (!covered) return;
    target.covered = true;
    this.#covered.add(target);
    this.#stale = true;
  }

  /** The innermost element at a place of the main window, in iframes too. */
  #topmost(x: number, y: number): Element | null {
    let at = this.#surface.topmost(this.#platform.window.document, x, y);
    for (let view = innerOf(at); view; view = innerOf(at)) {
      const frame = this.#frame(view);
      const inner = this.#surface.topmost(view.document, (x - frame.x) / frame.across, (y - frame.y) / frame.down);
      if (!inner) break;
      at = inner;
    }
    return at;
  }
}

/** The window that an element frames, if it may be looked into. */
function innerOf(element: Element | null): Window | null {
  return attempt(() => (element as HTMLIFrameElement | null)?.contentDocument?.defaultView) ?? null;
}

function isActive({ box, covered, settings }: Target): boolean {
  return box !== null && !covered && settings.enabled !== false && settings.prior !== 0;
}

/** Whether what is at a place of an element is that element, something in it, something around it, or its label. */
function belongs(found: Element, element: Element): boolean {
  if (contains(element, found) || contains(found, element)) return true;
  return (closest(found, "label") as HTMLLabelElement | null)?.control === element;
}

/** Whether no path of an event has it: it is virtual, or in a closed shadow tree. */
function isPathless({ element }: Target): boolean {
  return !element || (element.getRootNode() as ShadowRoot).mode === "closed";
}

/** Whether the path has the host of its shadow tree, if it is in one. */
function isOnPath({ element }: Target, path: readonly EventTarget[]): boolean {
  const host = element && hostOf(element.getRootNode());
  return !host || path.includes(host);
}

/** Whether a place is in its box; without `reach` as it is without hitSlop. */
function isInside({ x, y }: { readonly x: number; readonly y: number }, { box, settings }: Target, reach: boolean): boolean {
  const [top, right, bottom, left] = (!reach && settings.hitSlop) || [0, 0, 0, 0];
  return (
    box !== null && x >= box.x + left && x <= box.x + box.width - right && y >= box.y + top && y <= box.y + box.height - bottom
  );
}

function sameBox(a: Bounds, b: Bounds): boolean {
  return a.x === b.x && a.y === b.y && a.width === b.width && a.height === b.height;
}
