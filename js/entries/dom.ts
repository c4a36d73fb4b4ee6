/**
 * `whither/dom`: a page's own elements know, before the press, that they are meant.
 *
 * Nothing happens at import, so a server may import it; the WebAssembly is a chunk of its own that loads later.
 *
 * @example
 * ```ts
 * import { watch } from "whither/dom";
 *
 * const watcher = watch("nav a", {
 *   onIntent: ({ target, signal }) => fetch((target as HTMLAnchorElement).href, { signal }),
 * });
 * ```
 *
 * @module
 */
export { type ErrorCode, WhitherError } from "#error";
export type { Gaussian } from "../core/gaussian.js";
export type { Remaining } from "../core/predictor.js";
export type { CalibrationBin, Ledger, LedgerSummary, Outcome } from "../dom/ledger.js";
export type {
  Bounds,
  Inspection,
  Intent,
  MakePredictor,
  PredictedTarget,
  Predictor,
  Probable,
  Reason,
  Reasons,
  Release,
  Snapshot,
  TargetOptions,
  VirtualTarget,
  Watcher,
  WatchOptions,
  WatchTarget,
  WatchTargets,
} from "../dom/types.js";
export { watch } from "../dom/watch.js";
