/**
 * The watcher that all share, and what it has computed.
 *
 * @module
 */
import { useContext, useEffect, useMemo, useRef, useSyncExternalStore } from "react";
import type { Snapshot, Watcher, WatchTarget } from "#dom";
import { SharedContext } from "./context.js";
import { same } from "./same.js";
import { RESTING } from "./shared.js";

/**
 * The watcher of the provider, for its ledger, virtual targets, pausing; null on the server and until the provider is mounted. Its
 * provider begins and stops it, and changes its options.
 *
 * @example
 * ```tsx
 * function Early() {
 *   const watcher = useWatcher();
 *   return <button onClick={() => console.table(watcher?.ledger.summary())}>How early?</button>;
 * }
 * ```
 */
export function useWatcher<T extends WatchTarget = Element>(): Watcher<T> | null {
  const shared = useContext(SharedContext);
  const watcher = useSyncExternalStore(shared.subscribe, shared.getWatcher, () => null);
  return watcher as unknown as Watcher<T> | null;
}

/**
 * What follows from what the watcher has computed. The component is rendered again when that is another value: lists and plain objects
 * are compared by their items.
 *
 * @param select - What is wanted of the snapshot; another function at every render is fine.
 *
 * @example
 * ```tsx
 * const heading = usePrediction(({ best }) => (best && best.probability > 0.5 ? best.id : null));
 * ```
 */
export function usePrediction<S, T extends WatchTarget = Element>(select: (snapshot: Snapshot<T>) => S): S {
  const shared = useContext(SharedContext);
  const last = useRef<{ readonly value: S } | null>(null);
  const [read, readOnServer] = useMemo(() => {
    let known: { readonly snapshot: Snapshot; readonly value: S } | null = null;
    const from = (snapshot: Snapshot): S => {
      if (known?.snapshot === snapshot) return known.value;
      const next = select(snapshot as Snapshot<never>);
      const value = last.current && same(last.current.value, next) ? last.current.value : next;
      known = { snapshot, value };
      return value;
    };
    return [() => from(shared.getSnapshot()), () => from(RESTING)];
  }, [shared, select]);
  const value = useSyncExternalStore(shared.subscribe, read, readOnServer);
  useEffect(() => {
    last.current = { value };
  }, [value]);
  return value;
}
