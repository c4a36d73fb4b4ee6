/**
 * What a user of `whither/react` gives and is given.
 *
 * @module
 */
import type { ComponentPropsWithRef, ElementType, ReactElement, ReactNode } from "react";
import type { Intent, Release, TargetOptions, WatchOptions, WatchTarget } from "#dom";

/**
 * What holds for one element, and what is called for it. A new object with new functions at every render is as good as the same one: the
 * functions of the last render are called, and the rest is compared by its values.
 */
export interface IntentOptions<T extends WatchTarget = Element> extends Omit<TargetOptions, "onIntent"> {
  /** It is meant. A promise that it returns is what the provider's `limit.running` waits for. @defaultValue the provider's */
  readonly onIntent?: ((intent: Intent<T>) => unknown) | undefined;
  /** It is not meant any more, or was pressed, or its component is gone. @defaultValue the provider's */
  readonly onRelease?: ((release: Release<T>) => void) | undefined;
}

/** What {@link useIntent} returns. */
export interface IntentState<T extends WatchTarget = Element> {
  /** For the element: `<a ref={ref}>`. It is the same function at every render. */
  readonly ref: IntentRef<T>;
  /** Whether the element is meant now. */
  readonly intended: boolean;
}

/** A callback ref: takes an element, or a handle that is a virtual target, and `null` when it is gone. */
export type IntentRef<T extends WatchTarget = Element> = (node: T | null) => void;

/**
 * The options of the watcher that all elements below share: those of `watch`, but for what is about selectors and single targets. As with
 * {@link IntentOptions} inline objects and functions are as good as others.
 */
export interface IntentProviderProps<T extends WatchTarget = Element>
  extends Omit<WatchOptions<T>, "root" | "signal" | "target"> {
  readonly children?: ReactNode;
}

/** What {@link Intent} takes of its own; all else is given to what it renders. */
export interface IntentOwnProps<As extends ElementType> {
  /** An element's name, or a component that hands its `ref` on to an element. @defaultValue "a" */
  readonly as?: As | undefined;
  /** What holds for the element. @defaultValue {} */
  readonly intent?: Omit<IntentOptions, "onIntent" | "onRelease"> | undefined;
  /** As in {@link IntentOptions}. */
  readonly onIntent?: IntentOptions["onIntent"];
  /** As in {@link IntentOptions}. */
  readonly onRelease?: IntentOptions["onRelease"];
}

/** The props of {@link Intent}: its own, and those of what it renders, its `ref` too. */
export type IntentProps<As extends ElementType = "a"> = IntentOwnProps<As> &
  Omit<ComponentPropsWithRef<As>, keyof IntentOwnProps<As>>;

/** The type of {@link Intent}: it has the props of what it is rendered as. */
export interface IntentComponent {
  <As extends ElementType = "a">(props: IntentProps<As>): ReactElement | null;
  /** What developer tools call it. */
  displayName?: string | undefined;
}
