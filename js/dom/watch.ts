/** In work: the names alone. */
import type { Watcher, WatchOptions, WatchTarget, WatchTargets } from "./types.js";

/** Watches targets. */
export function watch<T extends WatchTarget = Element>(_targets: WatchTargets, _options?: WatchOptions<T>): Watcher<T> {
  throw new Error("in work");
}
