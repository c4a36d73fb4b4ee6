/// <reference lib="esnext.disposable" preserve="true" />
import { WhitherError } from "#error";
import type { Best } from "../core/best.js";
import { copyInto } from "../core/copy.js";
import { gaussian, type Gaussian } from "../core/gaussian.js";
import { type Learnt, learntNumbers, learntOf, readLearnt } from "../core/learnt.js";
import { dispose as disposeName, freed } from "../core/lifetime.js";
import { loaded, memory } from "../core/loading/instance.js";
import { reserve } from "../core/memory.js";
import type { Position, Remaining } from "../core/predictor.js";
import type { Scenario, Vector } from "../core/scenario.js";
import { constants, PointerEngine } from "../generated/pointing.js";
import { type PointerConstants, readConstants } from "./constants.js";
import { fields, isAbsent, list, number, quotedSome, refuse, text } from "../core/read.js";
import { type PointerTarget, readTargets, type Targets } from "./targets.js";

/** The longest movement and the farthest forecast, in seconds. */
const MOST_TIME = 1e12;

/** A name of its own, so that the declarations of this entry share none that is private. */
const dispose: typeof Symbol.dispose = disposeName;

/** What an application may want to set. */
export interface PointerOptions {
  /**
   * The prior probability that the pointer is going to none of the targets, from 0 to less than 1.
   *
   * @defaultValue that of `constants`, else 0
   */
  readonly none?: number | undefined;
  /** Constants for another device or task, as `fit` of `whither/study` learns them. @defaultValue those for a mouse */
  readonly constants?: PointerConstants | Omit<Scenario, "destinations"> | undefined;
  /** Whether {@link PointerPredictor.chosen} learns how far the model holds for the user. @defaultValue false */
  readonly learning?: boolean | undefined;
}

/**
 * Predicts which target on a screen a pointer is going to: the model of `pointerScenario` in `whither`, with the same
 * probabilities to the bit, in pixels and seconds.
 *
 * Everything here that can fail throws a {@link WhitherError}, and leaves the predictor as it was. After {@link free} every use
 * throws with the code `freed`.
 *
 * @example
 * ```ts
 * const predictor = new PointerPredictor([
 *   { id: "radio", x: 100, y: 80, width: 90, height: 90 },
 *   { id: "map", x: 600, y: 300, width: 90, height: 90 },
 * ]);
 * predictor.observe(0.0, [300, 500]);
 * predictor.observe(0.016, [306, 496]);
 * console.log(predictor.best);
 * predictor.free();
 * ```
 */
export class PointerPredictor {
  #engine: PointerEngine | null;
  #targets: Targets;
  #view: Float64Array | null = null;
  /** The times of the first and the last observation; none before the first. */
  #first: number | null = null;
  #last = 0;

  /**
   * @param targets - What may be pointed at, by centre and size in px; none at all is legal. They are copied: changing them later
   * changes nothing.
   * @param options - What to do otherwise.
   * @throws {@link WhitherError} with the path of the field; `not-initialised` before `init()`.
   */
  constructor(targets: readonly PointerTarget[], options?: PointerOptions) {
    loaded();
    // Only `clone` has a predictor to pass on.
    const other: unknown = targets;
    if (other instanceof PointerPredictor) {
      this.#targets = other.#targets;
      this.#first = other.#first;
      this.#last = other.#last;
      this.#engine = other.#ready(512).duplicate();
      return;
    }
    const read = readTargets(targets);
    const given = isAbsent(options) ? {} : fields(options, "options", ["none", "constants", "learning"]);
    const values = readConstants(given.constants, constants());
    values[0] = readNone(given);
    const learning = given.learning ?? false;
    if (typeof learning !== "boolean") refuse("wrong-type", "learning", "must be true or false", learning);
    reserve(1024 * read.ids.length);
    this.#engine = new PointerEngine(values, read.numbers);
    if (learning) this.#engine.keep_trails();
    this.#targets = read;
  }

  /**
   * Takes in one observation. One at the time of the last one replaces it, in the axes that it has, and at the first time the
   * movement begins with it: rounded clocks and events stamped by the frame give several places one time.
   *
   * @param time - Seconds, at least the last observation's.
   * @param position - `x` and `y` in px; `null` or `undefined` for one that is missing.
   * @throws {@link WhitherError} `time-not-increasing`, `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`. The state is
   * then what it was, and the next good observation works.
   */
  observe(time: number, position: Position): void {
    const engine = this.#live();
    const usual = typeof time === "number" && typeof position === "object" && position?.length === 2;
    const pair = usual ? position : readPosition(time, position);
    const x = coordinate(pair[0], 0);
    const y = coordinate(pair[1], 1);
    if (!Number.isFinite(time)) refuse("not-finite", "time", "must be a finite number", time);
    if (this.#first === null) {
      if (Number.isNaN(x + y)) {
        throw new WhitherError("missing-key", "position", "the first observation must have both axes");
      }
      this.#ready(256);
      engine.observe(0, x, y);
      this.#first = time;
    } else {
      if (time < this.#last) {
        throw new WhitherError(
          "time-not-increasing",
          "time",
          `must be at least the last observation's, ${this.#last}, got ${time}`,
        );
      }
      const elapsed = time - this.#first;
      if (elapsed > MOST_TIME) {
        refuse("out-of-range", "time", `must be at most 1e12 seconds after the first observation's, ${this.#first}`, time);
      }
      engine.observe(elapsed, x, y);
    }
    this.#last = time;
  }

  /**
   * The probability of each target, in their order. They sum to `1 - none`; before the second observation they are the prior.
   *
   * @param into - Where to write them, so that nothing is allocated: as long as there are targets.
   * @returns `into`, or a new array.
   * @throws {@link WhitherError} `wrong-type`, `wrong-length`.
   */
  probabilities(into?: Float64Array): Float64Array {
    return copyInto(this.#probabilities(), into);
  }

  /** The probability that the pointer goes to none of the targets: 0 unless the options have a `none`, 1 without any target. */
  get none(): number {
    return this.#live().none();
  }

  /** The most probable target, or null before the first observation and without any target. */
  get best(): Best | null {
    const probabilities = this.#probabilities();
    if (this.#first === null || probabilities.length === 0) return null;
    let index = 0;
    for (let i = 1; i < probabilities.length; i++) {
      if ((probabilities[i] as number) > (probabilities[index] as number)) index = i;
    }
    return { id: this.#targets.ids[index] as string, index, probability: probabilities[index] as number };
  }

  /** How long it takes until the pointer enters its target; null before the second observation and without any target. */
  get remaining(): Remaining | null {
    const [mean, low, high] = this.#ready(64).remaining() as unknown as [number?, number?, number?];
    return mean === undefined || low === undefined || high === undefined ? null : { mean, low, high };
  }

  /**
   * The state at a later time, given that the pointer goes to one of the targets and stays there: `x`, `y` and the velocity.
   *
   * @param time - Seconds on the clock of the observations, at least the last observation's.
   * @returns null before the first observation and without any target.
   * @throws {@link WhitherError} `out-of-range`, `not-finite`.
   */
  forecast(time: number): Gaussian | null {
    const later = this.#later(number(time, "time"), "time");
    const numbers = this.#ready(64).forecast(later);
    return numbers.length ? gaussian(numbers) : null;
  }

  /**
   * Where the pointer is expected to be at later times if it goes to one target: for drawing.
   *
   * @param id - The target.
   * @param times - Seconds on the clock of the observations, at least the last observation's.
   * @returns `x` and `y` for each time, one time behind the other; empty before the first observation.
   * @throws {@link WhitherError} `unknown-id`, `out-of-range`, `not-finite`.
   */
  path(id: string, times: Vector): Float64Array {
    const place = this.#place(id);
    const numbers = Array.from(list(times, "times"), (time, i) => number(time, `times[${i}]`));
    const later = Float64Array.from(numbers, (time, i) => this.#later(time, `times[${i}]`));
    return this.#ready(64, 64 * later.length).path(place, later);
  }

  /**
   * Sets all targets at once, in the middle of a movement too: for icons that move and lists that scroll. Nothing accumulates for
   * a target, so what was observed stays, without any target too: those that are set later have the probabilities that they would
   * have, had they been there from the start.
   *
   * @throws {@link WhitherError} as the constructor does.
   */
  setTargets(targets: readonly PointerTarget[]): void {
    const read = readTargets(targets, this.#targets);
    const engine = this.#live();
    reserve(1024 * read.ids.length);
    engine.set_targets(read.numbers);
    this.#targets = read;
    this.#view = null;
  }

  /**
   * Records what was selected: with the option `learning` it teaches how far the model holds for the user ({@link PointerPredictor.learnt}), which holds
   * from now on; without it has no effect. The movement up to the last entry into the target counts, once: a second choice before
   * {@link reset} teaches nothing. Where something was chosen by other means than this movement, such as a key, reset before.
   *
   * @throws {@link WhitherError} `unknown-id`.
   */
  chosen(id: string): void {
    const place = this.#place(id);
    this.#ready(64).chosen(place);
  }

  /** What the outcomes of movements have taught about the user, by {@link chosen} or set by {@link setLearnt}: plain numbers, for an application to keep. */
  learnt(): Learnt {
    return learntOf(learntNumbers(this.#live().learnt()));
  }

  /**
   * Goes on with what was learnt before, or by another predictor; `{ confidence: 0.8 }` alone is enough. It holds at once, in
   * mid-movement too.
   *
   * @param learnt - What {@link PointerPredictor.learnt} returned; null: a new user, what was learnt is forgotten.
   * @throws {@link WhitherError} `missing-key`, `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`, `unknown-key`.
   */
  setLearnt(learnt: Learnt | null): void {
    const numbers = readLearnt(learnt);
    const engine = this.#live();
    learntNumbers(engine.learnt()).set(numbers);
    engine.apply_learnt();
  }

  /** Begins a new movement with the same targets. */
  reset(): void {
    this.#live().reset();
    this.#first = null;
  }

  /** A second predictor in the same state, which goes its own way from here. */
  clone(): PointerPredictor {
    return new PointerPredictor(this as never);
  }

  /**
   * Gives the memory back. What is not freed is freed when it is garbage-collected, at no particular time.
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

  #live(): PointerEngine {
    return this.#engine ?? freed("predictor");
  }

  #place(id: string): number {
    const name = text(id, "id");
    const place = this.#targets.places.get(name);
    if (place !== undefined) return place;
    const message = `no target ${quotedSome([name])}, there are ${quotedSome(this.#targets.ids) || "none"}`;
    throw new WhitherError("unknown-id", "id", message);
  }

  /** The engine, with memory for a call that takes so many bytes for each target, and some more. */
  #ready(each: number, more = 0): PointerEngine {
    const engine = this.#live();
    reserve(each * this.#targets.ids.length + more);
    return engine;
  }

  /** The probabilities in the module's memory: good until the next call into it. */
  #probabilities(): Float64Array {
    const address = this.#live().probabilities();
    const view = this.#view;
    // as long as the memory has not grown, which leaves the view without a length
    if (view !== null && view.byteOffset === address && view.length > 0) return view;
    return (this.#view = new Float64Array(memory(), address, this.#targets.ids.length));
  }

  /** Seconds after the last observation; 0 before the first. */
  #later(time: number, path: string): number {
    if (this.#first === null) return 0;
    if (time < this.#last) refuse("out-of-range", path, `must be at least the last observation's time, ${this.#last}`, time);
    const later = time - this.#last;
    return later <= MOST_TIME
      ? later
      : refuse("out-of-range", path, "must be at most 1e12 seconds after the last observation", time);
  }
}

/** The two coordinates of an observation that is not as usual. */
function readPosition(time: unknown, position: unknown): ArrayLike<unknown> {
  number(time, "time");
  const given =
    typeof position === "object" && position !== null && "length" in position
      ? Array.from(position as ArrayLike<unknown>)
      : position;
  const items = Array.from(list(given, "position"));
  items.forEach(coordinate);
  if (items.length !== 2) throw new WhitherError("wrong-length", "position", `must have 2 numbers, has ${items.length}`);
  return items;
}

/** A coordinate; NaN for one that is missing. */
function coordinate(value: unknown, axis: number): number {
  return typeof value === "number" && Math.abs(value) <= 1e50
    ? value
    : isAbsent(value)
      ? NaN
      : number(value, `position[${axis}]`);
}

/** The prior of none: that of the options, else that of the constants, which may be a scenario. */
function readNone(given: { readonly none?: unknown; readonly constants?: unknown }): number {
  const learnt = (given.constants as PointerConstants | null | undefined)?.none;
  const stated = isAbsent(given.none) ? learnt : given.none;
  const none = isAbsent(stated) ? 0 : number(stated, "none");
  if (!(none >= 0 && none < 1)) refuse("out-of-range", "none", "must be at least 0 and less than 1", none);
  return none;
}
