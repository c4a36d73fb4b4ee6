/**
 * An element that is watched, as a component.
 *
 * @module
 */
import { createElement, type ElementType, type ForwardedRef, forwardRef } from "react";
import { useMergedRefs } from "./merged-refs.js";
import type { IntentComponent, IntentOwnProps } from "./types.js";
import { useIntentRef } from "./use-intent.js";

type Props = IntentOwnProps<ElementType> & Readonly<Record<string, unknown>>;

/**
 * An element, or a component of yours or another's such as a router's link, that is watched. All props but `as`, `intent`, `onIntent` and
 * `onRelease` are its own, the `ref` too. It is never rendered again for an intent: the attribute `data-predicted` and the variable
 * `--probability` are for styles.
 *
 * @example
 * ```tsx
 * <Intent as={Link} to="/ports" intent={{ hitSlop: 8 }} onIntent={() => router.preload("/ports")}>
 *   Ports
 * </Intent>
 * ```
 */
export const Intent = forwardRef(function Intent(
  { as = "a", intent, onIntent, onRelease, ...props }: Props,
  forwarded: ForwardedRef<unknown>,
) {
  const ref = useMergedRefs(useIntentRef({ ...intent, onIntent, onRelease }), forwarded);
  return createElement(as, { ...props, ref });
}) as unknown as IntentComponent;
