/**
 * Whether one element is meant.
 *
 * @module
 */
import { useCallback, useContext, useInsertionEffect, useMemo, useState, useSyncExternalStore } from "react";
import type { WatchTarget } from "#dom";
import { SharedContext } from "./context.js";
import { Entry } from "./entry.js";
import type { IntentOptions, IntentRef, IntentState } from "./types.js";

/**
 * Watches the element that `ref` is given, and has whether it is meant. The component is rendered again when that changes, and for
 * nothing else; {@link useIntentRef} never does that.
 *
 * @param options - What holds for the element, and what is called; new ones at every render are fine. What is wrong in them is given to
 * the `onError` of the provider, and the element stays as it was.
 *
 * @example
 * ```tsx
 * function Port({ id, name }: { id: string; name: string }) {
 *   const { ref, intended } = useIntent<HTMLAnchorElement>({
 *     onIntent: ({ signal }) => fetch(`/api/ports/${id}`, { signal, priority: "low" }),
 *   });
 *   return <a ref={ref} href={`/ports/${id}`} className={intended ? "next" : ""}>{name}</a>;
 * }
 * ```
 */
export function useIntent<T extends WatchTarget = Element>(options: IntentOptions<T> = {}): IntentState<T> {
  const { ref, entry } = useEntry(options);
  const intended = useSyncExternalStore(entry.subscribe, entry.isIntended, () => false);
  return useMemo(() => ({ ref, intended }), [ref, intended]);
}

/**
 * Watches the element that it is given, as {@link useIntent} does, and renders nothing again.
 *
 * @param options - As for {@link useIntent}.
 *
 * @example
 * ```tsx
 * const ref = useIntentRef<HTMLButtonElement>({ onIntent: () => queryClient.prefetchQuery(ports) });
 * return <button ref={ref}>Ports</button>;
 * ```
 */
export function useIntentRef<T extends WatchTarget = Element>(options: IntentOptions<T> = {}): IntentRef<T> {
  return useEntry(options).ref;
}

function useEntry<T extends WatchTarget>(options: IntentOptions<T>): { readonly ref: IntentRef<T>; readonly entry: Entry } {
  const shared = useContext(SharedContext);
  const [entry] = useState(() => new Entry());
  useInsertionEffect(() => {
    entry.options = options;
    shared.touch(entry);
  });
  const ref = useCallback(
    (node: T | null) => {
      if (node === null) shared.detach(entry);
      else shared.attach(entry, node);
    },
    [shared, entry],
  );
  return { ref, entry };
}
