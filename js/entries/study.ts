/**
 * `whither/study`: learns the constants of a scenario from recorded movements. It has a WebAssembly file of its own, so that
 * what only predicts does not carry it.
 *
 * @module
 */
import { base64 } from "#bytes";
import { unpack } from "../core/loading/unpack.js";
import type { Scenario } from "../core/scenario.js";
import { fitWith, type FitOptions, type Fitted, type Track } from "../study/fit.js";

export { WhitherError, type ErrorCode } from "#error";
export type { FitOptions, FitProgress, Fitted, FittedConstant, Track } from "../study/fit.js";

/**
 * Learns the few constants of a scenario from recorded movements, for another device, unit or task: for the method `pointing`
 * those of the least mean log loss on the approaches, for the papers' methods those of the most evidence
 * `log p(y_2:k | y_1, D)` for the true destination. The search is Powell's COBYLA over the logarithms of the constants, none
 * moved by more than 20 times.
 *
 * It needs no `init()`. While it searches it keeps its thread busy (half a minute for a thousand pointing movements on a fast machine), so
 * on a page call it in a worker.
 *
 * For one more person with a mouse there is nothing to gain: the defaults were learnt from 149 of them, and constants from
 * other users are about .01 nats better at most on users left out (`docs/pointing.md`). For another device or task it was .15 to .2.
 *
 * @param tracks - At least ten for each constant that enter their target.
 * @param scenario - What to start from; its destinations, if it has any, are replaced by each track's targets.
 * @param options - What to learn, for how long, and what to call on the way.
 * @throws {@link WhitherError} `out-of-range` for too few tracks, with the number that it needs, and for a constant that is no number
 * above 0; for a track or the scenario with the path of the field (`tracks[3].samples[7]`).
 *
 * @example
 * ```ts
 * import { init, pointerScenario } from "whither";
 * import { fit } from "whither/study";
 *
 * await init();
 * const { scenario, leftOut } = await fit(tracks, pointerScenario(targets), {
 *   progress: ({ share, loss }) => console.log(`${Math.round(100 * share)}%, ${loss.toFixed(3)} nats`),
 * });
 * const better = leftOut.after < leftOut.before ? scenario : pointerScenario(targets);
 * ```
 */
export function fit<S extends Omit<Scenario, "destinations">>(
  tracks: readonly Track[],
  scenario: S,
  options?: FitOptions,
): Promise<Fitted<S>> {
  return fitWith(() => unpack(base64, "learn where it does"), tracks, scenario, options);
}
