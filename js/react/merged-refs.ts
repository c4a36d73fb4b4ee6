/**
 * One ref of several.
 *
 * @module
 */
import { type Ref, type RefCallback, useMemo } from "react";

/**
 * One callback ref that gives its element to several refs: functions, with or without a clean-up of their own, objects, or none. It stays
 * the same function as long as they are the same.
 *
 * @param refs - As many at each render.
 *
 * @example
 * ```tsx
 * const Card = forwardRef<HTMLElement, CardProps>(function Card(props, forwarded) {
 *   const own = useRef<HTMLElement>(null);
 *   const { ref } = useIntent();
 *   return <article ref={useMergedRefs(own, forwarded, ref)}>{props.children}</article>;
 * });
 * ```
 */
export function useMergedRefs<T>(...refs: readonly (Ref<T> | undefined)[]): RefCallback<T> {
  return useMemo(() => {
    let detach: (() => void)[] = [];
    return (node: T | null) => {
      for (const each of detach.splice(0)) each();
      // nothing is returned, since React 18 warns of that: both versions call with null
      if (node !== null) detach = refs.map((ref) => give(ref, node));
    };
  }, refs);
}

/** Gives a node to a ref; returns what takes it away again. */
function give<T>(ref: Ref<T> | undefined, node: T): () => void {
  if (typeof ref === "function") {
    const cleanUp: unknown = ref(node);
    return typeof cleanUp === "function" ? () => void cleanUp() : () => void ref(null);
  }
  const object = ref as { current: T | null } | null | undefined;
  if (object) object.current = node;
  return () => {
    if (object) object.current = null;
  };
}
