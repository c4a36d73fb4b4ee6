/**
 * One component's interest in one target.
 *
 * @module
 */
import type { WatchTarget } from "#dom";
import type { IntentOptions } from "./types.js";

export class Entry {
  /** Those of the last render. */
  options: IntentOptions<never> = {};
  /** What the component's ref was given; null while there is nothing. */
  node: WatchTarget | null = null;
  #intended = false;
  readonly #listeners = new Set<() => void>();

  /** Takes in whether the target is meant. */
  mean(intended: boolean): void {
    if (intended === this.#intended) return;
    this.#intended = intended;
    for (const listener of [...this.#listeners]) listener();
  }

  // these two are given to useSyncExternalStore
  readonly subscribe = (listener: () => void): (() => void) => {
    this.#listeners.add(listener);
    return () => {
      this.#listeners.delete(listener);
    };
  };

  readonly isIntended = (): boolean => this.#intended;
}
