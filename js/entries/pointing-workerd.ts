/**
 * `whither/pointing` where code may not compile WebAssembly at run time.
 *
 * @module
 */
export { init, type InitOptions } from "../core/loading/imported.js";
export * from "../pointing/exports.js";
