/**
 * The part of a watcher that predicts, loaded together with the core: movements to posteriors, among the targets where they are.
 *
 * @module
 */
import type { Gaussian } from "../../core/gaussian.js";
import { notNegative } from "../../core/read.js";
import type { Hand } from "../hand.js";
import type { Intents } from "../intent.js";
import type { Outcome } from "../ledger.js";
import type { Settings } from "../options.js";
import type { Platform } from "../platform.js";
import type { Place, Sample } from "../pointers.js";
import type { Posterior } from "../snapshot.js";
import { idOf, type Target, type Targets } from "../targets.js";
import type { MakePredictor, Probable, Watcher } from "../types.js";
import { Changes } from "./changes.js";
import { Decoration } from "./decoration.js";
import { Engine, PointerPosterior } from "./engine.js";
import { answering, INSPECT, inspectionOf } from "./inspection.js";
import { Layout } from "./layout.js";
import { outcomeOf } from "./outcome.js";
import { Records } from "./records.js";
import type { Surface } from "./surface.js";
import { Track } from "./track.js";

export { surface } from "./surface.js";

/** How often the posterior is computed again in a frame because what was probable turns out to be covered. */
const ROUNDS = 3;

/** So many of the most probable targets are probed for movement in each frame. */
const LEADING = 4;

/** Above this probability a target is listed. */
const LISTED = 0.01;

/** What a prediction is made of. */
export interface Parts {
  readonly watcher: Watcher;
  readonly platform: Platform;
  readonly surface: Surface;
  readonly targets: Targets;
  settings(): Settings;
  readonly intents: Intents;
  /** There is something to look at in the next frame. */
  changed(): void;
  /** What the page did wrong. */
  failed(error: unknown): void;
  /** What a resting pointer is over after the page was scrolled under it. */
  scrolled(hand: Hand, place: Place): void;
}

export class Prediction {
  readonly ledger = new Records();
  readonly changes: Changes;
  readonly #parts: Parts;
  readonly #layout: Layout;
  readonly #engine: Engine;
  readonly #decoration = new Decoration();
  readonly #tracks = new Map<Hand, Track>();
  /** What is done in the next frame: samples of windows of which it is not known yet where they are. */
  readonly #waiting = new Map<Hand, (() => void)[]>();
  #shown: Track | null = null;
  #leading: readonly Target[] = [];
  #posterior: Posterior | null = null;

  constructor(core: MakePredictor | null, parts: Parts) {
    this.#parts = parts;
    this.#engine = new Engine(parts.settings, core, () => parts.platform.loadCore(), parts.failed);
    const inspection = inspectionOf(parts, () => this.#tracks.values());
    this.changes = new Changes(parts.platform, parts.changed, { [INSPECT]: answering(inspection, parts.failed) });
    this.#layout = new Layout(parts, this.changes);
  }

  /** Takes samples in a window's viewport, of a pointer that was over these targets before; gives whether there was something to observe. */
  moved(hand: Hand, samples: readonly Sample[], view: Window, over: readonly Target[], now: number): boolean {
    const waiting = this.#waiting.get(hand);
    if (waiting || !this.#layout.knows(view)) {
      this.#waiting.set(hand, [...(waiting ?? []), () => this.#add(hand, samples, view, over, now)]);
      return true;
    }
    return this.#add(hand, samples, view, over, now);
  }

  #add(hand: Hand, samples: readonly Sample[], view: Window, over: readonly Target[], now: number): boolean {
    let track = this.#tracks.get(hand);
    if (!track) {
      track = new Track(hand, new PointerPosterior(this.#engine));
      this.#tracks.set(hand, track);
      hand.predicted = track;
    }
    const places = samples.map((sample) => this.#layout.toMain(view, sample));
    const observed = track.add(places, over, this.#parts.settings().rest, now);
    if (hand.over) track.moveOver(hand.over);
    if (observed) this.#shown = track;
    return observed;
  }

  /** The targets at a place, the innermost first: those on its path, and those that no path has. */
  at(place: Place, found: readonly Target[], reach: boolean): readonly Target[] {
    return this.#layout.at(place, found, reach);
  }

  /** What came of the movement that led to a press on these targets, the innermost first; null where there was none. */
  press(hand: Hand, targets: readonly Target[]): Outcome | null {
    const track = this.#tracks.get(hand);
    const movement = track?.leadingTo(targets);
    const [target] = targets;
    if (!track || !movement || !target) return null;
    const { platform, settings } = this.#parts;
    const active = settings().record ? track.posterior.targets : null;
    const probability = track.probability(target);
    track.posterior.learn(movement, target);
    const press = outcomeOf(hand, target, movement, platform.now(), probability, this.#engine.learnt, active);
    this.ledger.add(press);
    this.#engine.relist();
    return press.outcome;
  }

  /** A pointer's movement is over; what follows is another one. */
  end(hand: Hand): void {
    this.#waiting.delete(hand);
    this.#tracks.get(hand)?.end();
  }

  /** A pointer is gone. */
  drop(hand: Hand): void {
    this.#waiting.delete(hand);
    const track = this.#tracks.get(hand);
    if (!track) return;
    track.end();
    track.posterior.free();
    this.#tracks.delete(hand);
    hand.predicted = null;
    if (this.#shown === track) this.#shown = null;
  }

  /** A frame: reads the layout and computes the posteriors; gives whether another one is needed. */
  draw(): boolean {
    const { platform, settings, intents, scrolled } = this.#parts;
    for (const runs of this.#waiting.values()) for (const run of runs) run();
    this.#waiting.clear();
    if (this.changes.scrolled) {
      this.changes.scrolled = false;
      for (const { hand } of this.#tracks.values()) {
        if (!hand.place || hand.isTouch || hand.moving) continue;
        scrolled(hand, this.#layout.placeAt(this.#layout.toMain(hand.place.view, hand.place)));
      }
    }
    for (const track of this.#tracks.values()) track.restAfter(settings().rest, platform.now());
    const moving = [...this.#tracks.values()].filter((track) => track.moving);
    if (moving.length === 0) return false;
    const begun = moving.some((track) => !track.known);
    const changed = this.#layout.read(begun, this.#leading);
    for (const track of moving) {
      if (changed || track.fresh || !track.known) this.#compute(track);
      const { fresh, known, posterior } = track;
      track.fresh = false;
      if (!known) continue;
      const best = posterior.best();
      if (best && fresh) track.movement?.note(best, posterior.probability(best));
      track.candidates.consider(track.hand, track.movement, posterior, platform.now(), settings(), intents);
    }
    return true;
  }

  /** The posterior of the pointer that moved last: the same object until it changes; null between movements. */
  posterior(): Posterior | null {
    const track = this.#moving();
    this.#leading = [];
    if (!track) return (this.#posterior = null);
    const { targets, probabilities, none } = track.posterior;
    const listed: [Target, number][] = [];
    for (let i = 0; i < targets.length; i++) {
      const probability = probabilities[i] as number;
      if (probability > LISTED) listed.push([targets[i] as Target, probability]);
    }
    listed.sort(([, a], [, b]) => b - a);
    this.#leading = listed.slice(0, LEADING).map(([target]) => target);
    const best = track.posterior.best();
    const probable = listed.map(([target, probability]) => probableOf(target, probability));
    const top = probable[0] ?? (best && probableOf(best, track.posterior.probability(best)));
    if (!isSame(this.#posterior, top, none, probable)) {
      this.#posterior = Object.freeze({ best: top, none, targets: Object.freeze(probable) });
    }
    return this.#posterior;
  }

  /** Writes the probabilities on the elements, or takes them back. */
  decorate(decorated: boolean): void {
    const posterior = decorated ? this.#moving()?.posterior : null;
    this.#decoration.write(posterior?.targets ?? [], posterior?.probabilities ?? []);
  }

  /** Seconds until the pointer that moved last enters its target. */
  get remaining(): Track["remaining"] {
    return this.#moving()?.remaining ?? null;
  }

  probability(target: Target): number {
    return this.#moving()?.probability(target) ?? 0;
  }

  forecast(seconds: number): Gaussian | null {
    notNegative(seconds, "seconds");
    const posterior = this.#moving()?.posterior;
    return posterior?.predictor?.forecast(posterior.last + seconds) ?? null;
  }

  path(target: Target, seconds: readonly number[]): Float64Array {
    seconds.forEach((later, i) => notNegative(later, `seconds[${i}]`));
    const posterior = this.#moving()?.posterior;
    if (!posterior?.predictor || !posterior.targets.includes(target)) return new Float64Array(0);
    return posterior.predictor.path(
      target.key,
      seconds.map((later) => posterior.last + later),
    );
  }

  /** Takes in that targets are no longer watched. */
  forget(removed: readonly Target[]): void {
    this.#layout.forget(removed);
    for (const target of removed) this.#decoration.erase(target);
  }

  /** What holds for targets may have changed. */
  relist(): void {
    this.#engine.relist();
    this.#layout.relist();
  }

  /** Other constants, another model. */
  renew(): void {
    this.#engine.renew();
    for (const track of this.#tracks.values()) track.known = false;
  }

  free(): void {
    this.#engine.renew();
    for (const hand of [...this.#tracks.keys()]) this.drop(hand);
    this.#engine.renew();
  }

  #moving(): Track | null {
    return this.#shown?.moving && this.#shown.known ? this.#shown : null;
  }

  #compute(track: Track): void {
    const { movement, posterior } = track;
    const { learning } = this.#parts.settings();
    const presses = (target: Target) => this.ledger.presses(target);
    for (let round = 0; movement && round < ROUNDS; round++) {
      const { active } = this.#layout;
      track.known = posterior.compute(movement, active, this.#engine.list(active, learning, presses));
      if (!track.known) return;
      this.#layout.uncover(active, posterior.probabilities);
      if (this.#layout.active === active) return;
    }
  }
}

function probableOf(target: Target, probability: number): Probable {
  return Object.freeze({ target: target.node, id: idOf(target), probability });
}

function isSame(before: Posterior | null, best: Probable | null, none: number, targets: readonly Probable[]): boolean {
  return (
    before !== null &&
    none === before.none &&
    sameAs(best, before.best) &&
    targets.length === before.targets.length &&
    targets.every((probable, i) => sameAs(probable, before.targets[i]))
  );
}

function sameAs(one: Probable | null, other: Probable | null | undefined): boolean {
  return one?.target === other?.target && one?.probability === other?.probability;
}
