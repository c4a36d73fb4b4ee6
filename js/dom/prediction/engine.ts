/**
 * One predictor for each pointer.
 *
 * @module
 */
import type { Learnt } from "../../core/learnt.js";
import type { Settings } from "../options.js";
import type { Target } from "../targets.js";
import type { MakePredictor, PredictedTarget, Predictor } from "../types.js";
import type { Movement } from "./movements.js";

export class Engine {
  readonly #settings: () => Settings;
  readonly #load: () => Promise<MakePredictor>;
  readonly #failed: (error: unknown) => void;
  #core: MakePredictor | null;
  /** Of pointers that are gone, for those that come. */
  readonly #idle: Predictor[] = [];
  #generation = 0;
  #list: readonly PredictedTarget[] = [];
  #listed: readonly Target[] | null = null;
  /** What the options have, and what is known since. */
  #stated: Learnt | null | undefined;
  #learnt: Learnt | null = null;
  /** The generation in which no predictor could be made. */
  #refused = -1;

  /** `core` makes predictors where the options do not; null where it is not loaded, since they did: `load` loads it when they do not. */
  constructor(
    settings: () => Settings,
    core: MakePredictor | null,
    load: () => Promise<MakePredictor>,
    failed: (error: unknown) => void,
  ) {
    this.#settings = settings;
    this.#core = core;
    this.#load = load;
    this.#failed = failed;
  }

  /** Counts how often the options that predictors are made with have changed. */
  get generation(): number {
    return this.#generation;
  }

  /** Other constants, another model: what follows is predicted by new predictors. */
  renew(): void {
    this.#generation++;
    for (const predictor of this.#idle.splice(0)) predictor.free();
  }

  /**
   * A predictor with these targets; null where the core is not loaded yet, and where the options have constants that it refuses, with an
   * error the first time.
   */
  borrow(targets: readonly PredictedTarget[]): Predictor | null {
    if (this.#refused === this.#generation) return null;
    const { none, constants, predictor, learning } = this.#settings();
    const idle = this.#idle.pop();
    idle?.setTargets(targets);
    if (idle) return idle;
    this.#refused = this.#generation;
    const make = predictor ?? this.#core;
    if (!make) {
      this.#load().then((core) => {
        this.#core = core;
        this.#refused = -1;
      }, this.#failed);
      return null;
    }
    const made = make(targets, { none, constants, learning: learning !== null });
    this.#refused = -1;
    return made;
  }

  /** What is known of the user; null where nothing is, and without `learning`. */
  get learnt(): Learnt | null {
    return this.#settings().learning === null ? null : this.#learnt;
  }

  /** A predictor goes on with what is known of the user: by the options, or from presses since. */
  brief(predictor: Predictor): void {
    const { learnt } = this.#settings();
    if (learnt !== this.#stated) this.#learnt = (this.#stated = learnt) ?? null;
    const known = this.#learnt;
    // what the core refuses is reported once, and forgotten
    this.#learnt = null;
    this.#attempt(() => {
      predictor.setLearnt?.(known);
      this.#learnt = known;
    });
  }

  /** The movement that a predictor gets to its end by `observe` has led to a press on the target of this key. */
  learn(predictor: Predictor, key: string, observe: () => void): void {
    if (this.#settings().learning === null) return;
    this.brief(predictor);
    this.#attempt(() => {
      observe();
      predictor.chosen?.(key);
      this.#learnt = predictor.learnt?.() ?? this.#learnt;
    });
  }

  /** A page's own predictor, and what it was given to learn, must not fail into the page. */
  #attempt(run: () => void): void {
    try {
      run();
    } catch (error) {
      this.#failed(error);
    }
  }

  /** Takes back a predictor that was made in a generation. */
  giveBack(predictor: Predictor, generation: number): void {
    if (generation === this.#generation && this.#idle.length === 0) this.#idle.push(predictor);
    else predictor.free();
  }

  /**
   * What a predictor is given for these targets. With `learning`, so many presses are worth what the options have as priors, and
   * `presses` counts those of a target: `p(i) = (learning a_i + n_i) / (learning + sum n)` with `a_i` the shares of the priors.
   */
  list(active: readonly Target[], learning: number | null, presses: (target: Target) => number): readonly PredictedTarget[] {
    if (active === this.#listed) return this.#list;
    this.#listed = active;
    const stated = active.map(({ settings }) => settings.prior ?? 1);
    const total = stated.reduce((sum, prior) => sum + prior, 0);
    this.#list = active.map((target, i) => {
      const { x, y, width, height } = target.box as NonNullable<Target["box"]>;
      const share = stated[i] as number;
      const prior = learning === null ? share : (learning * share) / total + presses(target);
      return { id: target.key, x: x + width / 2, y: y + height / 2, width, height, prior };
    });
    return this.#list;
  }

  /** Priors may have changed. */
  relist(): void {
    this.#listed = null;
  }
}

/** The posterior of one pointer's movements. */
export class PointerPosterior {
  readonly #engine: Engine;
  #predictor: Predictor | null = null;
  #generation = 0;
  #movement: Movement | null = null;
  #observed = 0;
  #targets: readonly PredictedTarget[] | null = null;
  #places = new Map<Target, number>();
  /** When the pointer was last observed, in seconds. */
  last = 0;
  /** In the order of {@link targets}. */
  probabilities = new Float64Array(0);
  targets: readonly Target[] = [];
  none = 1;

  constructor(engine: Engine) {
    this.#engine = engine;
  }

  get predictor(): Predictor | null {
    return this.#predictor;
  }

  /** Observes what is new of a movement, and computes the posterior; gives whether there is one. */
  compute(movement: Movement, active: readonly Target[], list: readonly PredictedTarget[]): boolean {
    if (this.#predictor && this.#generation !== this.#engine.generation) this.free();
    if (!this.#predictor) {
      this.#predictor = this.#engine.borrow(list);
      if (!this.#predictor) return false;
      this.#generation = this.#engine.generation;
      this.#movement = null;
    } else if (this.#targets !== list) this.#predictor.setTargets(list);
    this.#targets = list;
    const predictor = this.#predictor;
    if (this.#movement !== movement) {
      predictor.reset();
      this.#engine.brief(predictor);
      this.#movement = movement;
      this.#observed = 0;
    }
    this.#observe(predictor, movement);
    if (this.targets !== active) {
      this.targets = active;
      this.#places = new Map(active.map((target, i) => [target, i]));
      this.probabilities = new Float64Array(active.length);
    }
    predictor.probabilities(this.probabilities);
    this.none = predictor.none;
    return true;
  }

  #observe(predictor: Predictor, movement: Movement): void {
    for (const { time, x, y } of movement.after(this.#observed)) predictor.observe((this.last = time), [x, y]);
    this.#observed = movement.count;
  }

  /** Learns that a movement has led to a press on a target. */
  learn(movement: Movement, target: Target): void {
    const predictor = this.#predictor;
    if (!predictor || this.#movement !== movement || !this.#places.has(target)) return;
    this.#engine.learn(predictor, target.key, () => this.#observe(predictor, movement));
  }

  /** The prior probability of the target at a place, given that it goes to one of them. */
  prior(place: number): number {
    const list = this.#targets ?? [];
    return (list[place]?.prior ?? 0) / list.reduce((sum, { prior }) => sum + prior, 0);
  }

  probability(target: Target): number {
    const place = this.#places.get(target);
    return place === undefined ? 0 : (this.probabilities[place] as number);
  }

  /** The most probable target. */
  best(): Target | null {
    const { probabilities } = this;
    let best = 0;
    for (let i = 1; i < probabilities.length; i++) if ((probabilities[i] as number) > (probabilities[best] as number)) best = i;
    return this.targets[best] ?? null;
  }

  free(): void {
    if (this.#predictor) this.#engine.giveBack(this.#predictor, this.#generation);
    this.#predictor = null;
  }
}
