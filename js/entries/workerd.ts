/**
 * `whither` where code may not compile WebAssembly at run time.
 *
 * @module
 */
export { init, type InitOptions } from "../core/loading/imported.js";
export * from "../core/exports.js";
export * from "../core/sequence.js";
export * from "../pointing/hand.js";
export * from "../pointing/ray.js";
export * from "../pointing/scenario.js";
