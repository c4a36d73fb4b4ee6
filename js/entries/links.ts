/**
 * `whither/links`: the documents of a page's links are loaded ahead, once a pointer is on its way to them.
 *
 * Nothing happens at import, so a server may import it.
 *
 * @example
 * ```ts
 * import { links } from "whither/links";
 *
 * links();
 * ```
 *
 * @module
 */
export { type ErrorCode, WhitherError } from "#error";
export { links } from "../links/links.js";
export type {
  ConnectionType,
  Exclusion,
  Ignore,
  Links,
  LinksOptions,
  LinksStats,
  Mechanism,
  Prefetch,
} from "../links/types.js";
