/**
 * The browser as the other files of this folder need it: injected, so that recorded movements are replayed without one.
 *
 * @module
 */
import { watch, type Watcher, type WatchOptions, type WatchTarget } from "#dom";

/** Ends what was begun. */
export type Stop = () => void;

export interface Platform {
  readonly window: Window;
  /** After so many milliseconds. */
  wait(milliseconds: number, run: () => void): Stop;
  /** Passive, in the capture phase. */
  listen(target: EventTarget, listeners: Readonly<Record<string, (event: never) => void>>): Stop;
  /** `watch` of `whither/dom`. */
  watch(targets: Iterable<WatchTarget>, options: WatchOptions): Watcher;
  /** As an uncaught error would be. */
  report(error: unknown): void;
}

/** The browser, or null on a server. */
export function browser(): Platform | null {
  if (typeof document === "undefined" || typeof window === "undefined") return null;
  return {
    window,
    wait(milliseconds, run) {
      const timer = setTimeout(run, milliseconds);
      return () => clearTimeout(timer);
    },
    listen(target, listeners) {
      const options = { passive: true, capture: true };
      const each = Object.entries(listeners) as [string, EventListener][];
      for (const [type, listener] of each) target.addEventListener(type, listener, options);
      return () => {
        for (const [type, listener] of each) target.removeEventListener(type, listener, options);
      };
    },
    watch: (targets, options) => watch(targets, options as never) as never,
    report(error) {
      // not where it was caught, or the page would not go on
      setTimeout(() => {
        throw error;
      });
    },
  };
}
