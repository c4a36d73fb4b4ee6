/**
 * Where the targets are and which of them can be pointed at. Nothing is read when a pointer moves: what may have changed is
 * noted when it is reported, and read once in the next frame of a movement; for what nothing reports, a handful of targets is
 * probed in each frame, and all are read when one of these has moved.
 *
 * @module
 */
import type { Place } from "../pointers.js";
import type { Presence } from "../presence.js";
import { attempt, hostOf, type Platform } from "../platform.js";
import type { Parts } from "./prediction.js";
import { closest, contains, type Frame, type Surface } from "./surface.js";
import { readBounds, type Target, type Targets } from "../targets.js";
import type { Bounds, VirtualTarget } from "../types.js";

/** Above this probability it is worth finding out whether something covers a target. */
const WORTH = 0.01;

/** So many targets are looked up in a frame: what is at a place costs up to 225 microseconds. */
const LOOKED_UP = 12;

/** Milliseconds after which it is found out again. */
const OUTDATED = 250;

/** So many targets are probed in a frame besides the most probable ones. */
const PROBED = 4;

/** Milliseconds after which all are read again in a movement, probed or not. */
const REREAD = 500;

/** Where a target is looked up: at its centre and, where that is covered, nearer to its corners (shares of its size). */
const PLACES = [
  [0.5, 0.5],
  [0.2, 0.2],
  [0.8, 0.8],
  [0.8, 0.2],
  [0.2, 0.8],
] as const;

export class Layout {
  readonly #platform: Platform;
  readonly #surface: Surface;
  readonly #targets: Targets;
  readonly #frames = new Map<Window, Frame>();
  readonly #presence: Presence;
  #read = -Infinity;
  #probe = 0;
  readonly #covered = new Set<Target>();
  #active: readonly Target[] = [];
  /** Of these the ones that are at places where no path of an event has them. */
  #boxed: readonly Target[] = [];
  readonly #failed: (error: unknown) => void;
  /** Whose bounds were wrong when they were read last. */
  readonly #wrong = new Set<Target>();
  #stale = true;

  constructor({ platform, surface, targets, presence, failed }: Parts) {
    this.#failed = failed;
    this.#platform = platform;
    this.#surface = surface;
    this.#targets = targets;
    this.#presence = presence;
    presence.changes.moved = presence.changes.restyled = true;
  }

  /** The targets that can be pointed at now. The same list until that changes, or one of them moves. */
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
    if (this.active.length === 0 || this.#boxed.length === 0) return found;
    const main = this.toMain(place.view, place);
    const inside = this.#boxed.filter((target) => !found.includes(target) && isInside(main, target, reach));
    const inner = inside.filter((target) => isPathless(target) && isOnPath(target, place.path));
    return [...inner, ...found, ...inside.filter((target) => reach && !isPathless(target))];
  }

  /** A place of the main window's viewport, with the elements there, the innermost first. */
  placeAt({ x, y }: { readonly x: number; readonly y: number }): Place {
    const path: Element[] = [];
    let at = this.#surface.topmost(this.#platform.window.document, x, y);
    for (let view = innerOf(at); view; ) {
      const frame = this.#frame(view);
      const inner = this.#surface.topmost(view.document, (x - frame.x) / frame.across, (y - frame.y) / frame.down);
      if (!inner) break;
      at = inner;
      view = innerOf(at);
    }
    for (; at; at = at.parentElement ?? hostOf(at.getRootNode())) path.push(at);
    return { path, view: this.#platform.window, x, y };
  }

  /** The one phase of reading, at the beginning of a frame. `leading` are the most probable targets; gives whether anything changed. */
  read(leading: readonly Target[]): boolean {
    const now = this.#platform.now();
    const { changes } = this.#presence;
    for (const target of this.#covered) if (now - target.checked >= OUTDATED) this.#doubt(target);
    if (!changes.moved && now - this.#read < REREAD && !this.#probed(leading)) return this.#stale;
    this.#read = now;
    this.#frames.clear();
    if (changes.restyled) this.#restyle();
    for (const target of this.#targets.all) this.#measure(target);
    changes.moved = changes.restyled = false;
    return this.#stale;
  }

  /**
   * Finds out which of the probable targets are covered.
   *
   * @returns whether all of those that are worth it have been looked up.
   */
  uncover(active: readonly Target[], probabilities: Float64Array): boolean {
    const now = this.#platform.now();
    const worth: [Target, number][] = [];
    for (let i = 0; i < active.length; i++) {
      const probability = probabilities[i] as number;
      if (probability > WORTH) worth.push([active[i] as Target, probability]);
    }
    worth.sort(([, a], [, b]) => b - a);
    let lookedUp = 0;
    for (const [target] of worth) {
      if (!target.element || now - target.checked < OUTDATED) continue;
      if (lookedUp++ === LOOKED_UP) return false;
      this.#look(target, now);
    }
    return true;
  }

  #frame(view: Window): Frame {
    let frame = this.#frames.get(view);
    if (!frame) this.#frames.set(view, (frame = this.#surface.frameOf(view)));
    return frame;
  }

  /** Whether one of the most probable targets, or of some others in turn, is not where it was. */
  #probed(leading: readonly Target[]): boolean {
    const { active } = this;
    const some = Array.from({ length: Math.min(PROBED, active.length) }, () => active[this.#probe++ % active.length] as Target);
    return [...leading, ...some].some((target) => this.#measure(target));
  }

  /** Reads where a target is; gives whether it has moved. */
  #measure(target: Target): boolean {
    const was = target.box;
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
    const bounds = element ? this.#surface.box(element) : this.#bounds(target);
    if (!bounds) return null;
    let { x, y, width, height } = bounds;
    if (!(width > 0 && height > 0)) return null;
    const view = element?.ownerDocument.defaultView;
    if (view && view !== this.#platform.window) {
      const { across, down } = this.#frame(view);
      ({ x, y } = this.toMain(view, { x, y }));
      [width, height] = [width * across, height * down];
    }
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

  #restyle(): void {
    const modals = new Map<Document, Element[]>();
    this.#stale = true;
    for (const target of this.#targets.all) {
      const { element, visible } = target;
      this.#doubt(target);
      if (!element) target.usable = true;
      else if (visible) {
        const document = element.ownerDocument;
        let open = modals.get(document);
        if (!open) modals.set(document, (open = this.#surface.modals(document)));
        const outside = open.length > 0 && !open.some((modal) => contains(modal, element));
        target.usable = element.isConnected && !outside && this.#surface.isUsable(element);
      }
    }
  }

  #look(target: Target, now: number): void {
    target.checked = now;
    const element = target.element as Element;
    const { x, y, width, height } = this.#surface.box(element);
    const covered = PLACES.every(([across, down]) => {
      const found = this.#surface.topmost(element.ownerDocument, x + across * width, y + down * height);
      return found !== null && !belongs(found, element);
    });
    if (!covered) return;
    target.covered = true;
    this.#covered.add(target);
    this.#stale = true;
  }
}

/** The window that an element frames, if it may be looked into. */
function innerOf(element: Element | null): Window | null {
  return attempt(() => (element as HTMLIFrameElement | null)?.contentDocument?.defaultView) ?? null;
}

function isActive({ box, covered, settings }: Target): boolean {
  return box !== null && !covered && settings.enabled !== false;
}

/** Whether what is at a place of an element is that element, something in it, something around it, or its label. */
function belongs(found: Element, element: Element): boolean {
  const label = closest(found, "label") as HTMLLabelElement | null;
  return contains(element, found) || contains(found, element) || label?.control === element;
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
