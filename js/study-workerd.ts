/**
 * `whither/study` where code may not compile WebAssembly at run time: the module comes compiled, by import.
 *
 * @module
 */
import { learn } from "./learn.js";
import compiledModule from "./study.wasm";
import type { fit as Fit } from "./study.js";

export { WhitherError } from "./error.js";

/** As in `whither/study`. */
export const fit: typeof Fit = (tracks, scenario, options) => learn(() => compiledModule, tracks, scenario, options);
