/**
 * `whither/menu`: a submenu, a hover card, any popover stays open while the pointer is on its way to it, and closes when it turns away.
 *
 * Nothing happens at import, so a server may import it.
 *
 * @example
 * ```ts
 * import { menu } from "whither/menu";
 *
 * const { stop } = menu(document.querySelector("[role=menu]") as Element);
 * ```
 *
 * @module
 */
export { type ErrorCode, WhitherError } from "#error";
export { type HandleClose, type HandleCloseContext, type HandleCloseOptions, handleClose } from "../menu/handle-close.js";
export { heldOpen } from "../menu/held-open.js";
export { menu } from "../menu/menu.js";
export type {
  Closing,
  HeldOpen,
  HeldOpenOptions,
  HoldOptions,
  Menu,
  MenuOptions,
  Panel,
  Submenu,
  Why,
} from "../menu/types.js";
