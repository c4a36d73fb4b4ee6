/// <reference lib="esnext.disposable" preserve="true" />
import { WhitherError } from "#error";
import type { Best } from "./best.js";
import { fromBytes } from "./bytes.js";
import { copyInto } from "./copy.js";
import { gaussian, type Gaussian } from "./gaussian.js";
import { Engine, loaded, memory } from "./loading/instance.js";
import { type Learnt, learntNumbers, learntOf, readLearnt } from "./learnt.js";
import { dispose, freed } from "./lifetime.js";
import { checkOptions } from "./options.js";
import { bounds, copyIn, isScarce, reserve, type Bounds } from "./memory.js";
import type { Destination, Matrix, Scenario, Vector } from "./scenario.js";
import { isList, MOST_ITEMS } from "./list.js";

/** What one destination with arrival times of its own may take, in bytes. */
const ONE = 2 ** 23;

/**
 * One observed position: a number for each observed axis, as an array, a typed array or anything with `length` and indices.
 * An explicit `null` or `undefined` is a missing axis; NaN is an error.
 */
export type Position = ArrayLike<number | null | undefined>;

/** Options of one observation. */
export interface ObserveOptions {
  /**
   * The noise of this one observation instead of the scenario's `observation.noise`, in the same forms: a deviation, one for
   * each axis, or a covariance matrix.
   */
  readonly noise?: number | Vector | Matrix | undefined;
}

/** When the object arrives: the posterior of the arrival time. */
export interface ArrivalTime {
  /** The nodes, in seconds on the clock of the observations. */
  readonly times: Float64Array;
  /** The probability of each node; they sum to 1. */
  readonly probabilities: Float64Array;
  /** The mean, in seconds on the same clock. */
  readonly mean: number;
  /** The standard deviation, in seconds. */
  readonly deviation: number;
}

/**
 * How long it takes until the object enters its target, in seconds from the last observation, with an interval.
 *
 * With the papers' methods the interval lies between the tenth and the ninetieth percentile of the posterior of the arrival time.
 * With `pointing` it was fitted to hold four fifths of the samples of recorded mouse movements, and holds 83, 77 and 83% on three
 * sets, but does not leave a tenth on each side: 1, 3 and 9% enter before `low`, 15, 20 and 8% after `high`. On other devices it
 * holds less, until it is learnt ({@link Predictor.learnt}).
 */
export interface Remaining {
  /** The expectation; with `pointing` the median. */
  readonly mean: number;
  /** The lower end of the interval. */
  readonly low: number;
  /** The upper end of the interval. */
  readonly high: number;
}

/** The state of a predictor, as plain JSON, for {@link Predictor.restore}. */
export interface Snapshot {
  /** The version of the snapshot's form. */
  readonly version: number;
  readonly [key: string]: unknown;
}

/**
 * Predicts the destination of one moving thing from its positions.
 *
 * Everything that can fail throws a {@link WhitherError} and leaves the predictor unchanged. After {@link free} every use
 * throws with the code `freed`.
 *
 * @example
 * ```ts
 * const predictor = new Predictor({
 *   motion: { type: "constantVelocity", dimensions: 2, noise: 3000 },
 *   observation: { noise: 1.5 },
 *   initial: { velocity: 1000 },
 *   arrival: { type: "horizon", from: 0.05, to: 0.5 },
 *   destinations: [
 *     { id: "radio", center: [100, 80], size: [90, 90] },
 *     { id: "map", center: [600, 300], size: [90, 90] },
 *   ],
 * });
 * predictor.observe(0.0, [300, 500]);
 * predictor.observe(0.016, [306, 496]);
 * const [radio, map] = predictor.probabilities();
 * predictor.free();
 * ```
 */
export class Predictor {
  #engine: Engine | null;
  #view: Float64Array | null = null;
  /** Whether the memory for a movement is reserved, and a bound of it. */
  #reserved = false;
  #movement = 0;

  /**
   * @param scenario - The configuration. It is copied: changing the object later changes nothing.
   * @throws {@link WhitherError} with the path of the field where the scenario is bad; `not-initialised` before `init()`.
   */
  constructor(scenario: Scenario) {
    loaded();
    // only `adopt` passes an engine: users have none
    const given: unknown = scenario;
    this.#engine = given instanceof Engine ? given : new Engine(copyIn(given));
  }

  /**
   * Corrects the state by one observation.
   *
   * Equal times are legal. With the method `pointing` an observation at the time of the last one replaces it, in the axes that it
   * has, and at the first time the movement begins with it: rounded clocks and events stamped by the frame give several places
   * one time. The methods of the papers count each as an observation of its own.
   *
   * @param time - Seconds, at least the last observation's.
   * @param position - A number for each observed axis; `null` or `undefined` for one that is missing.
   * @param options - Options of this observation alone.
   * @throws {@link WhitherError} `time-not-increasing`, `wrong-type`, `wrong-length`, `not-finite`, `not-positive-definite`,
   * `unknown-key`. The state is then what it was, and the next good observation works.
   */
  observe(time: number, position: Position, options?: ObserveOptions): void {
    if (options !== undefined) checkOptions(options, ["noise"]);
    // Nearly all observations take this path, which allocates nothing; the other validates everything.
    const noise = options?.noise;
    const count = position?.length;
    if (typeof time === "number" && (count === 1 || count === 2 || count === 3) && noise === undefined) {
      const x = position[0];
      const y = count > 1 ? position[1] : 0;
      const z = count > 2 ? position[2] : 0;
      if (typeof x === "number" && typeof y === "number" && typeof z === "number") {
        const error = this.#observing().observe(time, count, x, y, z);
        if (error !== undefined) throw error;
        return;
      }
    }
    const list = !isList(position) && typeof position === "object" && count <= MOST_ITEMS;
    const observation = copyIn({ time, position: list ? Array.from(position) : position, noise });
    this.#observing().observe_in_full(observation);
  }

  /**
   * The probability of each destination, in the order of {@link destinations}. They sum to `1 - none`; before the first
   * observation, and after it alone unless its evidence counts (`initial.evidence`), they are the prior. Of 4096 destinations
   * and more, `pseudoObservation` returns 0 for those that together have less than 1e-14.
   *
   * @param into - Where to write them, so that nothing is allocated: as long as there are destinations.
   * @returns `into`, or a new array.
   * @throws {@link WhitherError} `wrong-type`, `wrong-length`.
   */
  probabilities(into?: Float64Array): Float64Array {
    const engine = this.#live();
    return copyInto(this.#viewAt(engine, engine.probabilities()), into);
  }

  /** The probability that the object goes to none of the destinations: 0 unless the scenario has a `none`. */
  get none(): number {
    return this.#live().none();
  }

  /** The most probable destination, or null before the first observation. */
  get best(): Best | null {
    return this.#live().best() ?? null;
  }

  /**
   * `log p(y_2:k | y_1, D_i)` of each destination, marginalised over the arrival time, in the order of {@link destinations};
   * `log p(y_1:k | D_i)` where the first observation's evidence counts (`initial.evidence`). A destination that can no
   * longer be reached in time has `-Infinity`.
   *
   * @param into - Where to write them: as long as there are destinations.
   * @returns `into`, or a new array.
   * @throws {@link WhitherError} `wrong-type`, `wrong-length`.
   */
  logLikelihoods(into?: Float64Array): Float64Array {
    const engine = this.#live();
    return copyInto(this.#viewAt(engine, engine.log_likelihoods()), into);
  }

  /**
   * When the object arrives: the posterior of the arrival time.
   *
   * @param id - Given that it goes to this destination; left out: over all of them by their probabilities.
   * @returns null before the first observation.
   * @throws {@link WhitherError} `unknown-id`.
   */
  arrival(id?: string): ArrivalTime | null {
    const given = copyIn({ id });
    const numbers = this.#withMemory("answer").arrival(given);
    if (numbers === undefined) return null;
    const nodes = (numbers.length - 2) / 2;
    return {
      times: numbers.slice(2, 2 + nodes),
      probabilities: numbers.slice(2 + nodes),
      mean: numbers[0] as number,
      deviation: numbers[1] as number,
    };
  }

  /** How long it takes until the object enters its target; null before that can be computed. */
  get remaining(): Remaining | null {
    const numbers = this.#withMemory("answer").remaining();
    if (numbers === undefined) return null;
    const [mean, low, high] = numbers as unknown as [number, number, number];
    return { mean, low, high };
  }

  /**
   * True when every node of the arrival time has passed. The probabilities then stay as they last were.
   */
  get expired(): boolean {
    return this.#live().expired();
  }

  /** The ids of the destinations, in the order of {@link probabilities}. */
  get destinations(): string[] {
    return this.#withMemory("ids").ids();
  }

  /**
   * The state now, given that the object goes to one of the destinations: by the method's own family, Liang (10) for
   * `pseudoObservation`, `algorithm1`, `algorithm2` and `singleFilterApproximate`, the bridged posterior for `bridging` and
   * `singleFilter`; mixed over destinations and arrival times, mean and covariance by moment matching.
   *
   * @returns null before the first observation.
   */
  state(): Gaussian | null {
    const numbers = this.#withMemory("answer").state();
    return numbers ? gaussian(numbers) : null;
  }

  /** The state at the first observation, given all that came since; null before it. */
  initialState(): Gaussian | null {
    const numbers = this.#withMemory("answer").initial_state();
    return numbers ? gaussian(numbers) : null;
  }

  /**
   * The state at a later time, given that the object goes to one of the destinations and stays there; by the method's own family,
   * as {@link state}.
   *
   * @param time - Seconds on the clock of the observations, at least the last observation's.
   * @returns null before the first observation.
   * @throws {@link WhitherError} `out-of-range`, `not-finite`.
   */
  forecast(time: number): Gaussian | null {
    const given = copyIn({ time });
    const numbers = this.#withMemory("answer").forecast(given);
    return numbers ? gaussian(numbers) : null;
  }

  /**
   * Where the object is expected to be at later times if it goes to one destination: for drawing.
   *
   * @param id - The destination.
   * @param times - Seconds on the clock of the observations, at least the last observation's.
   * @returns `d` coordinates for each time, one time behind the other.
   * @throws {@link WhitherError} `unknown-id`, `out-of-range`, `not-finite`.
   */
  path(id: string, times: Vector): Float64Array {
    const given = copyIn({ id, times });
    return this.#withMemory("answer", 1, 64 * (times?.length ?? 0)).path(given);
  }

  /**
   * Adds one destination at the end of {@link destinations}, in the middle of a movement too.
   *
   * @throws {@link WhitherError} `duplicate-id`; `method-accumulates` in the middle of a movement, where the scenario's method
   * accumulates evidence for each destination; and as the constructor does.
   */
  addDestination(destination: Destination): void {
    const given = copyIn({ destination });
    this.#withMemory("change", 1, ONE).add_destination(given);
  }

  /**
   * Replaces one destination: its position, size, prior. It keeps its index.
   *
   * @param id - The destination that is replaced.
   * @param destination - What it is from now on; its `id` may be left out.
   * @throws {@link WhitherError} `unknown-id`, and as {@link addDestination} does.
   */
  updateDestination(id: string, destination: Omit<Destination, "id"> & { readonly id?: string }): void {
    const given = copyIn({ id, destination });
    this.#withMemory("change", 1, ONE).update_destination(given);
  }

  /**
   * Removes one destination.
   *
   * @throws {@link WhitherError} `unknown-id`; `no-destinations` for the last one; `method-accumulates`.
   */
  removeDestination(id: string): void {
    const given = copyIn({ id });
    this.#withMemory("change").remove_destination(given);
  }

  /**
   * Sets all destinations at once, in one crossing into WebAssembly: for icons that move and lists that scroll. Those whose id
   * stays keep their evidence and learnt prior.
   *
   * @throws {@link WhitherError} as {@link addDestination} does.
   */
  setDestinations(destinations: readonly Destination[]): void {
    const given = copyIn({ destinations });
    this.#withMemory("change", 1 + (destinations?.length ?? 0) / this.#live().len()).set_destinations(given);
  }

  /** Begins a new movement with the same scenario and the destinations as they are now. */
  reset(): void {
    this.#live().reset();
    this.#reserved = false;
  }

  /**
   * Records the selection: learnt from where the scenario has `learning`, without effect where it does not. What is learnt holds from
   * now on, and {@link snapshot} keeps it: priors, and with the method `pointing` how far the model holds for the user ({@link Predictor.learnt}).
   * For that the movement up to the last entry into the destination counts, once: a second choice before {@link reset} teaches priors
   * alone. Where something was chosen by other means than this movement, such as a key, reset before.
   *
   * @throws {@link WhitherError} `unknown-id`.
   */
  chosen(id: string): void {
    const given = copyIn({ id });
    this.#withMemory("change").chosen(given);
  }

  /**
   * What the outcomes of movements have taught about the user, by {@link chosen} or set by {@link setLearnt}: plain numbers, for an
   * application to keep.
   *
   * @example
   * ```ts
   * predictor.setLearnt(JSON.parse(localStorage.getItem("hand") ?? "null"));
   * predictor.chosen("map");
   * localStorage.setItem("hand", JSON.stringify(predictor.learnt()));
   * ```
   */
  learnt(): Learnt {
    return learntOf(learntNumbers(this.#live().learnt()));
  }

  /**
   * Goes on with what was learnt before, or by another predictor; `{ confidence: 0.8 }` alone is enough. It holds at once, in
   * mid-movement too, with the method `pointing`; others have no use for it.
   *
   * @param learnt - What {@link Predictor.learnt} returned; null: a new user, what was learnt is forgotten. The counts of choices stay.
   * @throws {@link WhitherError} `missing-key`, `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`, `unknown-key`.
   */
  setLearnt(learnt: Learnt | null): void {
    const numbers = readLearnt(learnt);
    const engine = this.#live();
    learntNumbers(engine.learnt()).set(numbers);
    engine.apply_learnt();
  }

  /** A second predictor in the same state, which goes its own way from here: one for each vessel, or each pointer. */
  clone(): Predictor {
    return adopt(this.#withMemory("change").duplicate());
  }

  /**
   * The state of the predictor, as plain JSON.
   *
   * @example
   * ```ts
   * const text = JSON.stringify(predictor.snapshot());
   * const again = Predictor.restore(JSON.parse(text));
   * ```
   */
  snapshot(): Snapshot {
    return fromBytes(this.#withMemory("snapshot").snapshot()) as Snapshot;
  }

  /**
   * The predictor that {@link Predictor.snapshot} was taken of. What follows is identical to the bit.
   *
   * @throws {@link WhitherError} `bad-snapshot` where it is damaged or from another version.
   */
  static restore(snapshot: Snapshot): Predictor {
    loaded();
    return adopt(Engine.restore(copyIn(snapshot, "snapshot", 2)));
  }

  /**
   * Frees its memory. A predictor that is not freed is freed when it is garbage-collected, at an unknown time.
   *
   * @throws {@link WhitherError} `freed`, where that was done before.
   */
  free(): void {
    this.#live().free();
    this.#engine = null;
  }

  /** Frees the predictor at the end of a `using` declaration's block; does nothing where it was freed before. */
  [dispose](): void {
    if (this.#engine) this.free();
  }

  #live(): Engine {
    return this.#engine ?? freed("predictor");
  }

  /** The engine, with memory reserved for an observation: a movement allocates when it begins, and when its last node passes. */
  #observing(): Engine {
    const engine = this.#live();
    if (this.#reserved && !isScarce()) return engine;
    if (!this.#reserved) this.#movement = bounds(engine).movement;
    reserve(this.#movement);
    this.#reserved = true;
    return engine;
  }

  /** The engine, with memory reserved: `times` the bound with the present destinations, and so many bytes `more`. */
  #withMemory(what: keyof Bounds, times = 1, more = 0): Engine {
    const engine = this.#live();
    const bound = bounds(engine);
    reserve(times * bound[what] + more);
    // with other destinations a movement needs another amount, and their numbers have another length
    this.#movement = times * bound.movement;
    this.#view = null;
    return engine;
  }

  /** One number for each destination, at `address` in the module's memory: valid until the next call into it. */
  #viewAt(engine: Engine, address: number): Float64Array {
    const view = this.#view;
    // as long as the memory has not grown, which leaves the view without a length
    if (view !== null && view.byteOffset === address && view.length > 0) return view;
    return (this.#view = new Float64Array(memory(), address, engine.len()));
  }
}

function adopt(engine: unknown): Predictor {
  return new Predictor(engine as Scenario);
}
