/**
 * The browser as the other files of this folder need it. It is injected, so that each of them is tested without a browser; the
 * one made here does without what a browser, or jsdom, does not have.
 *
 * @module
 */
import type { FindStopsAhead } from "./keyboard.js";
import type { Prediction } from "./prediction/prediction.js";
import type { Surface } from "./prediction/surface.js";
import type { MakePredictor } from "./types.js";

/** Ends what was begun. */
export type Stop = () => void;

/** What is called for each type of event. */
export type Listeners = Readonly<Record<string, (event: never) => void>>;

/** What is loaded when a pointer moves. */
export interface Loaded {
  readonly Prediction: typeof Prediction;
  surface(): Surface;
}

/** What is used of the browser's observers. */
export type Visibility = Pick<IntersectionObserver, "observe" | "unobserve" | "disconnect">;
export type Mutations = Pick<MutationObserver, "observe" | "disconnect">;

export interface Platform {
  /** The window whose viewport and clock everything is counted in. */
  readonly window: Window;
  /** Milliseconds on the events' clock. */
  now(): number;
  /** The next animation frame. */
  frame(run: () => void): Stop;
  /** After so many milliseconds. */
  wait(milliseconds: number, run: () => void): Stop;
  /** When the page has nothing else to do. */
  idle(run: () => void): Stop;
  /** Passive, in the capture phase. */
  listen(target: EventTarget, listeners: Listeners): Stop;
  /** Calls back with elements that appear on the screen or disappear from it, by scrolling and clipping too; null where there is none. */
  visibility(changed: (element: Element, visible: boolean) => void): Visibility | null;
  /** Calls back when something changes in the trees of the nodes. */
  mutations(changed: (records: readonly MutationRecord[]) => void): Mutations | null;
  /** The part that predicts. */
  loadPrediction(): Promise<Loaded>;
  /** The core: what makes predictors, unless the options do. */
  loadCore(): Promise<MakePredictor>;
  /** What finds tab stops. */
  loadKeyboard(): Promise<FindStopsAhead>;
  /** As an uncaught error would be. */
  report(error: unknown): void;
}

/** The host of a shadow tree, or the element that frames a document; null for the outermost, and where it may not be known. */
export function hostOf(root: Node): Element | null {
  return (root as ShadowRoot).host ?? attempt(() => (root as Document).defaultView?.frameElement) ?? null;
}

/** The browser, or null on a server. */
export function browser(): Platform | null {
  if (typeof document === "undefined" || typeof window === "undefined") return null;
  const main = window;
  const wait = (milliseconds: number, run: () => void): Stop => {
    const timer = setTimeout(run, milliseconds);
    return () => clearTimeout(timer);
  };
  return {
    window: main,
    now: () => performance.now(),
    frame(run) {
      if (typeof requestAnimationFrame !== "function") return wait(16, run);
      const frame = requestAnimationFrame(run);
      return () => cancelAnimationFrame(frame);
    },
    wait,
    idle(run) {
      if (typeof requestIdleCallback !== "function") return wait(200, run);
      const idle = requestIdleCallback(run, { timeout: 2000 });
      return () => cancelIdleCallback(idle);
    },
    listen(target, listeners) {
      const options = { passive: true, capture: true };
      const each = Object.entries(listeners) as [string, EventListener][];
      for (const [type, listener] of each) target.addEventListener(type, listener, options);
      return () => {
        for (const [type, listener] of each) target.removeEventListener(type, listener, options);
      };
    },
    visibility(changed) {
      if (typeof IntersectionObserver !== "function") return null;
      const callback = (entries: readonly IntersectionObserverEntry[]) => {
        for (const { target, intersectionRatio } of entries) changed(target, intersectionRatio > 0);
      };
      // what only touches the edge intersects with a ratio of 0: it cannot be pointed at
      return new IntersectionObserver(callback, { threshold: [0, 1e-6] });
    },
    mutations: (changed) => (typeof MutationObserver === "function" ? new MutationObserver(changed) : null),
    loadPrediction: () => import("#prediction"),
    async loadCore() {
      const { init, PointerPredictor } = await import("#pointing");
      await init();
      return (targets, options) => new PointerPredictor(targets, options);
    },
    async loadKeyboard() {
      return (await import("#keyboard")).stopsAhead;
    },
    report(error) {
      // not where it was caught, or the page would not go on
      setTimeout(() => {
        throw error;
      });
    },
  };
}

export function attempt<T>(run: () => T): T | null {
  try {
    return run();
  } catch {
    return null;
  }
}
