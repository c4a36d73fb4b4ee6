/**
 * What every entry with a {@link Predictor} exports besides its own `init`.
 *
 * @module
 */
export { WhitherError, type ErrorCode } from "#error";
export type { Best } from "./best.js";
export type { Gaussian } from "./gaussian.js";
export type { Learnt } from "./learnt.js";
export { initSync } from "./loading/instance.js";
export {
  Predictor,
  type ArrivalTime,
  type ObserveOptions,
  type Position,
  type Remaining,
  type Snapshot,
} from "./predictor.js";
export type * from "./scenario.js";
export type { CompiledModule, ResponseLike, UrlLike, WasmLocation, WasmSource } from "./loading/source.js";
