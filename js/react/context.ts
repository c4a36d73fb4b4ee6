/**
 * Which watcher the components below share.
 *
 * @module
 */
import { createContext, createElement, type ReactElement, useEffect, useInsertionEffect, useState } from "react";
import type { WatchTarget } from "#dom";
import { Shared } from "./shared.js";
import type { IntentProviderProps } from "./types.js";

/** That of the page, for components without a provider. */
export const SharedContext = createContext(new Shared(false));

/**
 * Gives all elements below one watcher, with options of its own; they compete for one posterior, so one provider around the page is what
 * most need. Without any, all elements of the page share a watcher with the defaults. Options that are wrong throw a `WhitherError`
 * into the nearest error boundary; what goes wrong later is given to `onError`.
 *
 * @example
 * ```tsx
 * <IntentProvider threshold={0.9} limit={{ running: 2 }} onOutcome={({ verdict, lead }) => report(verdict, lead)}>
 *   <App />
 * </IntentProvider>
 * ```
 */
export function IntentProvider<T extends WatchTarget = Element>({ children, ...options }: IntentProviderProps<T>): ReactElement {
  const [shared] = useState(() => new Shared(true));
  // before any effect or ref of this commit
  useInsertionEffect(() => shared.render(options));
  useEffect(() => shared.mount(), [shared]);
  useEffect(() => shared.update());
  return createElement(SharedContext.Provider, { value: shared }, children);
}
