"use client";
/**
 * `whither/react`: components and hooks for elements that know, before the press, that they are meant. For React 18 and 19.
 *
 * Nothing happens at import, and a server component may import it: it is a client module.
 *
 * @example
 * ```tsx
 * import { useIntent } from "whither/react";
 *
 * export function Port({ id, name }: { id: string; name: string }) {
 *   const { ref, intended } = useIntent<HTMLAnchorElement>({
 *     onIntent: ({ signal }) => fetch(`/api/ports/${id}`, { signal }),
 *   });
 *   return <a ref={ref} href={`/ports/${id}`} className={intended ? "next" : ""}>{name}</a>;
 * }
 * ```
 *
 * @module
 */
export { Intent } from "../react/component.js";
export { IntentProvider } from "../react/context.js";
export { useMergedRefs } from "../react/merged-refs.js";
export type {
  IntentComponent,
  IntentOptions,
  IntentOwnProps,
  IntentProps,
  IntentProviderProps,
  IntentRef,
  IntentState,
} from "../react/types.js";
export { useIntent, useIntentRef } from "../react/use-intent.js";
export { usePrediction, useWatcher } from "../react/use-watcher.js";
