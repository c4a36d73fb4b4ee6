/**
 * What a user of `whither/overlay` gives and is given.
 *
 * @module
 */

/** What `overlay` takes. */
export interface OverlayOptions {
  /** Dark, light, or as the system has it. @defaultValue "auto" */
  readonly theme?: "auto" | "dark" | "light" | undefined;
  /** Whether the panel begins as its first lines alone. @defaultValue on windows narrower than 600 px */
  readonly collapsed?: boolean | undefined;
  /**
   * What hides and shows everything: modifiers (`Alt`, `Ctrl`, `Meta`, `Shift`) and a letter or digit, joined by `+`; null for none.
   * @defaultValue "Alt+Shift+W"
   */
  readonly shortcut?: string | null | undefined;
  /** Closes the overlay. @defaultValue none */
  readonly signal?: AbortSignal | undefined;
}

/** What is drawn over a page: what {@link overlay} returns. */
export interface Overlay {
  /** Whether it can be looked at; once closed it stays so. */
  readonly state: "shown" | "hidden" | "closed";
  /** Shows what {@link Overlay.hide} hid. */
  show(): void;
  /** Draws nothing; the controls hold, and intents are noted. */
  hide(): void;
  /** Ends it for good: nothing is left on the page, and options that were changed by its controls are as before. */
  close(): void;
  /** As {@link Overlay.close}, at the end of a `using` declaration's block. */
  [Symbol.dispose](): void;
}
