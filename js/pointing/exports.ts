/**
 * What the entries of `whither/pointing` export besides their own `init`.
 *
 * @module
 */
export { type ErrorCode, WhitherError } from "#error";
export type { Best } from "../core/best.js";
export type { Gaussian } from "../core/gaussian.js";
export type { Learnt } from "../core/learnt.js";
export { initSync } from "../core/loading/instance.js";
export type { CompiledModule, ResponseLike, UrlLike, WasmLocation, WasmSource } from "../core/loading/source.js";
export type { Position, Remaining } from "../core/predictor.js";
export type { DeepPartial, PointerConstants } from "./constants.js";
export { type PointerOptions, PointerPredictor } from "./predictor.js";
export type { PointerTarget } from "./targets.js";
