/**
 * `whither` where code may not compile WebAssembly at run time.
 *
 * @module
 */
export { init, type InitOptions } from "./imported.js";
export * from "./exports.js";
