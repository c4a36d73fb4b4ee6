/**
 * What every entry exports besides its own `init`.
 *
 * @module
 */
export { WhitherError, type ErrorCode } from "./error.js";
export { initSync } from "./glue.js";
export { pointerScenario } from "./pointer.js";
export {
  Predictor,
  type ArrivalTime,
  type Best,
  type Gaussian,
  type ObserveOptions,
  type Position,
  type Remaining,
  type Snapshot,
} from "./predictor.js";
export type * from "./scenario.js";
export type { CompiledModule, ResponseLike, UrlLike, WasmSource } from "./source.js";
