/**
 * `whither/study` where code may not compile WebAssembly at run time: the module comes compiled, by import.
 *
 * @module
 */
import compiledModule from "#module";
import { fitWith } from "../study/fit.js";
import type { fit as Fit } from "./study.js";

export { WhitherError } from "#error";

/** As in `whither/study`. */
export const fit: typeof Fit = (tracks, scenario, options) => fitWith(() => compiledModule, tracks, scenario, options);
