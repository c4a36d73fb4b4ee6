/**
 * What a user of `whither/menu` gives and is given.
 *
 * @module
 */
import type { Bounds, WatchOptions } from "#dom";

/**
 * What opens beside a trigger: an element; or a function that returns one, several (a panel and those that opened out of it), or null while
 * there is none, for panels that are mounted when they open.
 */
export type Panel = Element | (() => Element | Iterable<Element> | null | undefined);

/** When an open panel is let go, and how far a pointer is followed. */
export interface HoldOptions {
  /**
   * The posterior probability of the panel, or of the way back to its trigger, below which it is let go: above 0 and below 1.
   *
   * @defaultValue 0.25; 0.4 for `handleClose`, which is called when the pointer has left the trigger already
   */
  readonly release?: number | undefined;
  /** The prior probability that a pointer that leaves the trigger goes elsewhere, at least 0 and less than 1. @defaultValue 0.4 */
  readonly none?: number | undefined;
  /** A panel is held for at most so many milliseconds while the pointer is neither on it nor on its trigger. @defaultValue 1000 */
  readonly bound?: number | undefined;
  /** Milliseconds at rest, on neither of them nor straight between them, after which it is let go. @defaultValue 150 */
  readonly rest?: number | undefined;
  /** The constants of the model of pointing that `fit` has learnt. @defaultValue the mouse's */
  readonly constants?: WatchOptions["constants"];
  /** Another model with the methods of `PointerPredictor`. @defaultValue `PointerPredictor` of `whither/pointing` */
  readonly predictor?: WatchOptions["predictor"];
  /** What went wrong: the core cannot be loaded, a callback threw. @defaultValue reported as an uncaught error */
  readonly onError?: ((error: unknown) => void) | undefined;
}

/**
 * Why a panel is let go.
 *
 * | reason | the pointer |
 * |---|---|
 * | `away` | has turned away: the posterior probability of the panel has fallen below `release` |
 * | `rest` | rests on neither of them |
 * | `bound` | has been on the way for as long as `bound` allows |
 * | `lost` | has left the window, or its device was taken away |
 * | `unknown` | was on neither of them for 300 milliseconds, and there is no posterior: the core is not loaded yet, or cannot be |
 */
export type Why = "away" | "rest" | "bound" | "lost" | "unknown";

/** What `heldOpen` takes. */
export interface HeldOpenOptions extends HoldOptions {
  /** The panel is to be closed: the pointer is on neither of the two, nor on its way. */
  readonly onClose: (closing: Closing) => void;
  /** The pointer has come to the trigger, and the panel is not open. @defaultValue nothing is opened */
  readonly onOpen?: (() => void) | undefined;
  /** Milliseconds for which the pointer has to be on the trigger until `onOpen`. @defaultValue 0 */
  readonly delay?: number | undefined;
  /**
   * Whether the panel stays open whatever the pointer does, asked before `onClose`.
   *
   * @defaultValue as long as the keyboard is used in it: the focus is in it, in a field or since a key was pressed
   */
  readonly keep?: (() => boolean) | undefined;
  /** Stops it. @defaultValue none */
  readonly signal?: AbortSignal | undefined;
}

/** What `onClose` gets. */
export interface Closing {
  readonly why: Why;
  /** The posterior probability of the panel, or of the way back, as it was then; 0 where there was none. */
  readonly probability: number;
  /** The element that the pointer is over, or null. */
  readonly over: Element | null;
}

/** What {@link heldOpen} returns. */
export interface HeldOpen {
  /** Whether the pointer is on neither of the two, and the panel is held because it is on its way. */
  readonly held: boolean;
  /** The posterior probability of the panel, or of the way back, of the movement under way; 0 between movements. */
  readonly probability: number;
  /** Changes options; what is left out stays, and `undefined` sets the default. */
  update(options: Partial<HeldOpenOptions>): void;
  /** Stops for good: nothing is left on the page. What is open stays open. */
  stop(): void;
  /** As {@link stop}, at the end of a `using` declaration's block. */
  [Symbol.dispose](): void;
}

/** What {@link menu} takes. */
export interface MenuOptions extends HoldOptions {
  /**
   * A selector of the items of the lists, of those with a submenu and those without.
   *
   * @defaultValue `[role^=menuitem]` where the root has such, else `li`
   */
  readonly items?: string | undefined;
  /**
   * The submenu of an item, or null for none.
   *
   * @defaultValue the element that `aria-controls` names, else the list, `[role=menu]` or `[popover]` that is a child of the item or comes
   *   right after it
   */
  readonly submenu?: ((item: Element) => Element | null | undefined) | undefined;
  /**
   * Shows a submenu.
   *
   * @defaultValue takes `hidden` off the panel, or shows its popover, and sets `aria-expanded` on the item
   */
  readonly onOpen?: ((opening: Submenu) => void) | undefined;
  /** Hides a submenu; `closed` is by `close()` or `stop()`. @defaultValue undoes what `onOpen` does by default */
  readonly onClose?: ((closing: Submenu & { readonly why: Why | "closed" }) => void) | undefined;
  /** Milliseconds for which the pointer has to be on an item until its submenu opens, where none is open. @defaultValue 0 */
  readonly delay?: number | undefined;
  /** Whether a submenu stays open whatever the pointer does. @defaultValue as long as the keyboard is used in it */
  readonly keep?: ((submenu: Submenu) => boolean) | undefined;
  /** Stops it. @defaultValue none */
  readonly signal?: AbortSignal | undefined;
}

/** An item and what opens beside it. */
export interface Submenu {
  readonly item: Element;
  readonly panel: Element;
}

/** What {@link menu} returns. */
export interface Menu {
  /** What is open, the outermost first. */
  readonly open: readonly Submenu[];
  /** Whether an open submenu is held because the pointer is on its way to it. */
  readonly held: boolean;
  /** Closes everything that is open. */
  close(): void;
  /** Changes options; what is left out stays, and `undefined` sets the default. */
  update(options: MenuOptions): void;
  /** Stops for good: closes what it has opened, and leaves nothing else on the page. */
  stop(): void;
  /** As {@link stop}, at the end of a `using` declaration's block. */
  [Symbol.dispose](): void;
}

/** Where something is, read when it is needed. */
export type Box = () => Bounds;
