/**
 * `whither/overlay`: draws over a page what its watchers predict, for those who build the page.
 *
 * Nothing happens at import. It needs nothing of the page but a watcher of `whither/dom`, and nothing is left of it once it is closed.
 *
 * @example
 * ```ts
 * import { watch } from "whither/dom";
 * import { overlay } from "whither/overlay";
 *
 * const drawn = overlay(watch("nav a, button"), { theme: "dark" });
 * drawn.close();
 * ```
 *
 * @module
 */
export { type ErrorCode, WhitherError } from "#error";
export { overlay } from "../overlay/overlay.js";
export type { Overlay, OverlayOptions } from "../overlay/types.js";
