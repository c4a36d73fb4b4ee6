/// <reference lib="esnext.disposable" preserve="true" />
import { gaussian, type Gaussian } from "./gaussian.js";
import { loaded, SequenceEngine } from "./loading/instance.js";
import { dispose, freed } from "./lifetime.js";
import { checkOptions } from "./options.js";
import { copyIn, reserve } from "./memory.js";
import type { Matrix, Motion, Observation, Vector } from "./scenario.js";

/** A sequence that is induced by a motion model, from an origin to a destination, by way of waypoints if there are any. */
export interface SequenceParameters {
  /** How it would move if its destination were unknown. */
  readonly motion: Motion;
  /** The length of each step in seconds: one number, or one for each of the `steps`. */
  readonly timeStep: number | Vector;
  /** `N`, up to 100 000: the states are `x_0` to `x_N`. */
  readonly steps: number;
  /** The steps whose states are pinned, ascending, from 0 to `steps`. @defaultValue `[0, steps]` */
  readonly pins?: readonly number[] | undefined;
  /** The mean of the pinned states, one behind the other. */
  readonly pinnedMean: Vector;
  /** Their joint covariance. */
  readonly pinnedCovariance: Matrix;
  /** How states are measured. */
  readonly observation: Observation;
}

/** The parameters of a sequence, matrix by matrix: `x_k = previous x_{k-1} + destination x_N + offset + e`. */
export interface GivenSequence {
  /** `G_{k,k-1}` for each step from 1 to `N - 1`, `s` by `s`. */
  readonly previous: readonly Matrix[];
  /** `G_{k,N}` for each of these steps. */
  readonly destination: readonly Matrix[];
  /** What is added in each of these steps, `s` numbers. @defaultValue 0 */
  readonly offset?: readonly Vector[] | undefined;
  /** `G_k`, the covariance of `e`, for each of these steps. */
  readonly covariance: readonly Matrix[];
  /** The two endpoints: `x_N`, and `x_0 = originMean + gain (x_N - destinationMean) + e_0`. */
  readonly boundary: {
    /** @defaultValue 0 */
    readonly originMean?: Vector | undefined;
    /** @defaultValue 0 */
    readonly destinationMean?: Vector | undefined;
    /** `G_{0,N}`. @defaultValue 0 */
    readonly gain?: Matrix | undefined;
    /** `G_0`, the covariance of `e_0`. */
    readonly originCovariance: Matrix;
    /** The covariance of `x_N`. */
    readonly destinationCovariance: Matrix;
  };
  /** How states are measured. */
  readonly observation: Observation;
  /** How many components of a state are its position. @defaultValue half of them, or all where their number is odd */
  readonly dimensions?: number | undefined;
}

/** One step of a sequence, `x_k = previous x_{k-1} + destination x_p + offset + e`, with `x_p` the next pinned state. */
export interface StepModel {
  /** `G_{k,k-1}`, `s * s` numbers, row by row. */
  readonly previous: Float64Array;
  /** `G_{k,p}`, `s * s` numbers, row by row. */
  readonly destination: Float64Array;
  /** What is added, `s` numbers. */
  readonly offset: Float64Array;
  /** `G_k`, the covariance of `e`, `s * s` numbers, row by row. */
  readonly covariance: Float64Array;
}

/**
 * A conditionally Markov sequence (Rezaie and Li): a movement whose origin and destination have a known joint density.
 *
 * Everything that can fail throws a {@link WhitherError} and leaves the sequence unchanged. After {@link free} every use
 * throws with the code `freed`.
 *
 * @example
 * ```ts
 * // From about 0 to about 10 on one axis, in 20 steps of a second.
 * const sequence = new ConditionallyMarkovSequence({
 *   motion: { type: "constantVelocity", dimensions: 1, noise: 0.1 },
 *   timeStep: 1,
 *   steps: 20,
 *   pinnedMean: [0, 0.5, 10, 0.5],
 *   pinnedCovariance: [[1, 0, 0, 0], [0, 0.1, 0, 0], [0, 0, 4, 0], [0, 0, 0, 0.1]],
 *   observation: { noise: 0.2 },
 * });
 * sequence.measure(3, [1.8]);
 * const { mean } = sequence.destination();
 * ```
 */
export class ConditionallyMarkovSequence {
  #engine: SequenceEngine | null;
  #measured = 0;

  /**
   * @param parameters - The sequence. It is copied: changing the object later changes nothing.
   * @throws {@link WhitherError} with the path of the field where something is bad; `not-initialised` before `init()`.
   */
  constructor(parameters: SequenceParameters) {
    loaded();
    // only `adopt` passes an engine: users have none
    const given: unknown = parameters;
    this.#engine = given instanceof SequenceEngine ? given : new SequenceEngine(copyIn(given));
  }

  /**
   * A sequence from its parameters, matrix by matrix.
   *
   * @throws {@link WhitherError} as the constructor does.
   */
  static fromParameters(parameters: GivenSequence): ConditionallyMarkovSequence {
    loaded();
    return adopt(SequenceEngine.from_parameters(copyIn(parameters)));
  }

  /**
   * The model of one step.
   *
   * @param step - A step whose state is not pinned.
   * @throws {@link WhitherError} `out-of-range`.
   */
  model(step: number): StepModel {
    const engine = this.#live();
    const numbers = engine.model(copyIn({ step }));
    const size = engine.states() ** 2;
    return {
      previous: numbers.slice(0, size),
      destination: numbers.slice(size, 2 * size),
      offset: numbers.slice(3 * size),
      covariance: numbers.slice(2 * size, 3 * size),
    };
  }

  /**
   * Corrects the state by one measurement. Steps may be skipped, and measured twice.
   *
   * @param step - Which state was measured: no earlier one than the last.
   * @param position - A number for each measured axis.
   * @throws {@link WhitherError} `time-not-increasing`, `out-of-range`, `wrong-length`, `not-finite`.
   */
  measure(step: number, position: Vector): void {
    const given = copyIn({ step, position });
    // the list of measurements, which doubles its capacity when it is full
    this.#withMemory(256 * ++this.#measured).measure(given);
  }

  /**
   * The state at any step given all measurements so far: filtered at the last measured step, predicted after it, smoothed
   * before it.
   *
   * @throws {@link WhitherError} `out-of-range`.
   */
  state(step: number): Gaussian {
    const given = copyIn({ step });
    return gaussian(this.#withMemory().state(given));
  }

  /** The state at the end, given all measurements so far. */
  destination(): Gaussian {
    return gaussian(this.#live().destination());
  }

  /** Removes all measurements. */
  reset(): void {
    this.#live().reset();
    this.#measured = 0;
  }

  /**
   * Draws sequences from the prior: measurements have no influence.
   *
   * @param options - `seed`: an integer from 0 to less than 2^32, the same one gives the same numbers; `count`: how many.
   * @returns `(steps + 1) * s` numbers for each, state by state.
   * @throws {@link WhitherError} `too-large` for more than 10 million numbers; `missing-key`, `unknown-key`, `out-of-range`.
   */
  sample(options: { readonly seed: number; readonly count: number }): Float64Array[] {
    checkOptions(options, ["seed", "count"]);
    const given = copyIn(options ?? {});
    const engine = this.#live();
    const length = (engine.steps() + 1) * engine.states();
    // capped: more than may be drawn has an error of its own
    this.#withMemory(16 * Math.min(1.5e7, (length + 4) * options?.count || 0));
    const numbers = engine.sample(given);
    return Array.from({ length: numbers.length / length }, (_, i) => numbers.slice(i * length, (i + 1) * length));
  }

  /**
   * Whether the sequence is reciprocal: given the states at any two steps, what lies between is independent of what lies
   * outside (Theorem 3.2).
   *
   * @param tolerance - How far both sides of the theorem may differ, relative to the larger one. @defaultValue 1e-6
   */
  isReciprocal(tolerance?: number): boolean {
    const given = copyIn({ tolerance });
    return this.#withMemory().is_reciprocal(given);
  }

  /**
   * Whether the sequence is Markov (Theorem 3.2).
   *
   * @param tolerance - How far both sides of the theorem may differ, relative to the larger one. @defaultValue 1e-6
   */
  isMarkov(tolerance?: number): boolean {
    const given = copyIn({ tolerance });
    return this.#withMemory().is_markov(given);
  }

  /**
   * Frees its memory. A sequence that is not freed is freed when it is garbage-collected, at an unknown time.
   *
   * @throws {@link WhitherError} `freed`, where that was done before.
   */
  free(): void {
    this.#live().free();
    this.#engine = null;
  }

  /** Frees the sequence at the end of a `using` declaration's block; does nothing where it was freed before. */
  [dispose](): void {
    if (this.#engine) this.free();
  }

  /** The engine, with memory reserved for a computation and so many bytes `more`. */
  #withMemory(more = 0): SequenceEngine {
    const engine = this.#live();
    reserve(64 * engine.size() + more);
    return engine;
  }

  #live(): SequenceEngine {
    return this.#engine ?? freed("sequence");
  }
}

function adopt(engine: unknown): ConditionallyMarkovSequence {
  return new ConditionallyMarkovSequence(engine as SequenceParameters);
}
