/**
 * What `fit` takes and returns, and how it runs.
 *
 * @module
 */
import { WhitherError } from "#error";
import { fromBytes, toBytes } from "../core/bytes.js";
import { load } from "../core/loading/instance.js";
import type { WasmSource } from "../core/loading/source.js";
import { checkOptions } from "../core/options.js";
import type { Scenario } from "../core/scenario.js";
import { fit, reserve_memory } from "../generated/study.js";

/**
 * One recorded movement, from its start to at least its entry into the target. In the plane a target is
 * `[x, y, width, height]` about its centre and a sample `[time, x, y]`; in space `[x, y, z, diameter]` and `[time, x, y, z]`.
 * Seconds, and your own unit of length.
 */
export interface Track {
  /** Its name. */
  readonly id?: string | number | undefined;
  /** Who moved. With two users or more, the gain is measured on other users than those learnt from. */
  readonly user?: string | number | undefined;
  /** What could have been the target. */
  readonly targets: readonly (readonly number[])[];
  /** Which one it was: its index in `targets`, from 0. */
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

/** What `fit` takes besides tracks and scenario. */
export interface FitOptions {
  /**
   * The paths of the constants to learn, such as `"pointing.power.to"`; numbers above 0 in the scenario.
   *
   * @defaultValue five of the method `pointing`; else `motion.noise` and `observation.noise`
   */
  readonly constants?: readonly string[] | undefined;
  /** The most passes over the tracks in each of the two searches. @defaultValue 60 */
  readonly evaluations?: number | undefined;
  /** Keys that every destination gets, such as `{ endVelocity: 200 }`. @defaultValue none */
  readonly destination?: Readonly<Record<string, unknown>> | undefined;
  /**
   * Called after every pass over the tracks. Where it returns `false`, the search stops with the best so far (within the first
   * third of the work that is the best of half of the tracks); where it throws, `fit` rejects with what was thrown.
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

/** What `fit` has learnt. */
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

/** `fit`, with the WebAssembly from `source`. */
export async function fitWith<S extends Omit<Scenario, "destinations">>(
  source: () => WasmSource,
  tracks: readonly Track[],
  scenario: S,
  options: FitOptions | undefined,
): Promise<Fitted<S>> {
  checkOptions(options, ["constants", "evaluations", "destination", "progress"]);
  const { progress, ...others } = options ?? {};
  if (progress !== undefined && typeof progress !== "function") {
    throw new WhitherError("wrong-type", "progress", "must be a function");
  }
  let bytes = 0;
  const given = toBytes({ ...others, tracks, scenario }, "", (needed) => void (bytes = 2 * needed));
  await load(source);
  if (!reserve_memory(bytes)) {
    throw new WhitherError("too-large", "tracks", `may take ${Math.ceil(bytes / 2 ** 20)} MB of memory, more than is left`);
  }
  // Rust code is on the stack: what `progress` throws is kept until it has returned
  let thrown: { readonly error: unknown } | undefined;
  const listener = {
    report(share: number, loss: number): boolean {
      try {
        return progress?.({ share, loss }) !== false;
      } catch (error) {
        thrown = { error };
        return false;
      }
    },
  };
  const fitted = fit(given, listener);
  if (thrown) throw thrown.error;
  return fromBytes(fitted) as Fitted<S>;
}
