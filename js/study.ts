/**
 * `whither/study`: learns the constants of a scenario from recorded movements. It has a WebAssembly file of its own, so that
 * what only predicts does not carry it.
 *
 * @module
 */
import { WhitherError, type ErrorCode } from "./error.js";
import { base64 } from "./generated/study-bytes.js";
import { learn } from "./learn.js";
import type { Scenario } from "./scenario.js";
import { unpack } from "./unpack.js";

export { WhitherError, type ErrorCode };

/**
 * One recorded movement, from its start to at least its entry into the target. In the plane a target is
 * `[x, y, width, height]` about its centre and a sample `[time, x, y]`; in space `[x, y, z, diameter]` and `[time, x, y, z]`.
 * Seconds, and your own unit of length.
 */
export interface Track {
  /** Its name. */
  readonly id?: string | number | undefined;
  /** Who moved. With two users or more, what is gained is told on other users than it was learnt from. */
  readonly user?: string | number | undefined;
  /** What could have been the target. */
  readonly targets: readonly (readonly number[])[];
  /** Which one it was: its place in `targets`, counted from 0. */
  readonly target: number;
  /** When and where, in order of time; `null` for a coordinate that is missing. */
  readonly samples: readonly (readonly (number | null)[])[];
}

/** How far a search has come. */
export interface FitProgress {
  /** From 0 to 1. */
  readonly share: number;
  /** The smallest mean loss so far, in nats. */
  readonly loss: number;
}

/** What {@link fit} takes beside tracks and scenario. */
export interface FitOptions {
  /**
   * The paths of the constants to learn, such as `"pointing.power.to"`; numbers above 0 in the scenario.
   *
   * @defaultValue five of the method `pointing`; else `motion.noise` and `observation.noise`
   */
  readonly constants?: readonly string[] | undefined;
  /** How often the tracks are run through, at most, for each of the two searches. @defaultValue 60 */
  readonly evaluations?: number | undefined;
  /** Keys that every destination gets, such as `{ endVelocity: 200 }`. @defaultValue none */
  readonly destination?: Readonly<Record<string, unknown>> | undefined;
  /**
   * Is told after every pass over the tracks how far the search is. Where it returns `false` all ends with the best so far
   * (within the first third of the work that is what half of the tracks say); where it throws, `fit` rejects with what was thrown.
   */
  readonly progress?: ((progress: FitProgress) => unknown) | undefined;
}

/** One constant that was learnt. */
export interface FittedConstant {
  /** Its path in the scenario. */
  readonly path: string;
  /** What it was. */
  readonly before: number;
  /** What it is. */
  readonly after: number;
}

/** What {@link fit} has learnt. */
export interface Fitted<S> {
  /** The scenario with the new constants, learnt from all tracks. All else in it is as it was, the destinations too. */
  readonly scenario: S;
  /** The constants. */
  readonly constants: readonly FittedConstant[];
  /**
   * Mean loss, in nats, on the half that was left out (every second user; with one user every second track): with the old
   * constants, and with constants learnt from the other half. Where `after` is not below `before`, keep the old ones.
   */
  readonly leftOut: { readonly before: number; readonly after: number };
  /** How many tracks were used: those that enter their target. */
  readonly tracks: number;
}

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
 * @param options - What to learn, for how long, and whom to tell.
 * @throws {@link WhitherError} `out-of-range` for too few tracks, saying how many it needs, and for a constant that is no number
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
  return learn(() => unpack(base64, "learn where it does"), tracks, scenario, options);
}
