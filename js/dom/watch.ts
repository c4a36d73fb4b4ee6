/**
 * Joins the other files: events to pointers, pointers to predictions, what is predicted to intents, and what came of them.
 *
 * @module
 */
import type { Gaussian } from "../core/gaussian.js";
import { dispose as disposeName } from "../core/lifetime.js";
import type { Remaining } from "../core/predictor.js";
import { refuse } from "../core/read.js";
import { Calls } from "./calls.js";
import { listenToFocus } from "./focus.js";
import { Hand } from "./hand.js";
import { Intents } from "./intent.js";
import { ledgerOf } from "./ledger.js";
import { nowhere } from "./nowhere.js";
import { readOptions, type Settings } from "./options.js";
import { browser, type Loaded, type Platform, type Stop } from "./platform.js";
import { listenToPointers, type Place, type PointerId, type PointerSinks, type Sample } from "./pointers.js";
import type { Prediction } from "./prediction/prediction.js";
import { Presence } from "./presence.js";
import { RESTING, snapshotOf } from "./snapshot.js";
import { type Exchange, release, type Target, Targets } from "./targets.js";
import type {
  MakePredictor,
  Probable,
  Snapshot,
  TargetOptions,
  Watcher,
  WatchOptions,
  WatchTarget,
  WatchTargets,
} from "./types.js";

const dispose: typeof Symbol.dispose = disposeName;

/** So many events are kept until the part that predicts is loaded. */
const MOST_KEPT = 4096;

/**
 * Watches targets on a page: which of them a pointer is on its way to, and when one of them is meant.
 *
 * Nothing waits for it, and it throws nothing into the page: what goes wrong later goes to `onError`. On a server it does nothing.
 *
 * @param targets - A selector, which is live; an element; a virtual target; or any number of elements and virtual targets.
 * @param options - What to do otherwise than by default, and what to call.
 * @throws {@link WhitherError} for an unknown option, a value that is not legal, a selector that does not parse.
 *
 * @example
 * ```ts
 * const watcher = watch("nav a, [data-card]", {
 *   onIntent: ({ target, signal }) => prefetch((target as HTMLAnchorElement).href, { signal }),
 * });
 * watcher.stop();
 * ```
 */
export function watch<T extends WatchTarget = Element>(targets: WatchTargets, options?: WatchOptions<T>): Watcher<T> {
  return watchOn(browser(), targets, options as WatchOptions) as unknown as Watcher<T>;
}

/** As {@link watch}, on any platform; null for none. */
export function watchOn(platform: Platform | null, targets: WatchTargets, options?: WatchOptions): Watcher {
  return platform ? new PageWatcher(platform, targets, options) : nowhere();
}

class PageWatcher implements Watcher, PointerSinks {
  readonly ledger = ledgerOf(() => this.#prediction?.ledger);
  readonly ready: Promise<void>;
  readonly #platform: Platform;
  readonly #targets: Targets;
  readonly #presence: Presence;
  readonly #intents: Intents;
  readonly #calls: Calls;
  readonly #hands = new Map<number, Hand>();
  readonly #listeners = new Set<() => void>();
  #given: WatchOptions;
  #settings: Settings;
  #prediction: Prediction | null = null;
  /** Loads the part that predicts and the core, once. */
  #load!: () => void;
  /** What is done once they are loaded; null where they cannot be. */
  #kept: ((prediction: Prediction) => void)[] | null = [];
  #snapshot: Snapshot = RESTING;
  #frame: Stop | null = null;
  /** What ends with other options. */
  #stops: Stop[] = [];
  #state: "running" | "paused" | "stopped" = "running";

  constructor(platform: Platform, targets: WatchTargets, options: WatchOptions | undefined) {
    this.#platform = platform;
    this.#settings = readOptions(options);
    this.#given = { ...options };
    this.#targets = new Targets(targets, this.#settings);
    this.ready = new Promise<void>((resolve) => {
      this.#load = resolve;
    })
      .then(() => Promise.all([platform.loadPrediction(), this.#settings.predictor ? null : platform.loadCore()]))
      .then((loaded) => this.#predict(loaded));
    // nobody has to wait for it
    this.ready.catch((error: unknown) => {
      this.#kept = null;
      if (this.#state !== "stopped") this.#calls.report(error);
    });
    this.#calls = new Calls(platform, () => this.#settings.onError);
    this.#intents = new Intents(
      platform,
      () => this.#settings,
      () => this.#hands.values(),
      this.#calls,
      () => this.#request(),
    );
    this.#presence = new Presence(platform, this.#targets, {
      changed: (records) => {
        if (this.#prediction?.changes.restyle(records, this.#targets.all)) return;
        this.#targets.stale = true;
        this.#outdate();
      },
      visible: (target) => {
        this.#intents.visible(target);
        this.#prediction?.changes.move();
      },
      listen: (view) => this.#listen(view),
    });
    this.#presence.watch([...this.#targets.all], []);
    this.#begin();
  }

  get targets(): readonly WatchTarget[] {
    this.#sync();
    return Array.from(this.#targets.all, ({ node }) => node);
  }

  get best(): Probable | null {
    return this.#snapshot.best;
  }

  get none(): number {
    return this.#snapshot.none;
  }

  get remaining(): Remaining | null {
    return this.#prediction?.remaining ?? null;
  }

  probability(node: WatchTarget): number {
    const target = this.#targets.find(node);
    return (target && this.#prediction?.probability(target)) ?? 0;
  }

  forecast(seconds: number): Gaussian | null {
    return this.#prediction?.forecast(seconds) ?? null;
  }

  path(node: WatchTarget, seconds: readonly number[]): Float64Array {
    const target = this.#targets.find(node);
    return (target && this.#prediction?.path(target, seconds)) ?? new Float64Array(0);
  }

  set(node: WatchTarget, options: TargetOptions | null): void {
    this.#sync();
    this.#targets.set(node, options);
    this.#outdate();
  }

  add(...nodes: WatchTarget[]): void {
    this.#take(this.#targets.add(nodes));
  }

  remove(...nodes: WatchTarget[]): void {
    this.#take(this.#targets.remove(nodes, this.#calls.report));
  }

  refresh(): void {
    this.#targets.stale = true;
    this.#sync();
    this.#outdate();
  }

  update(options: WatchOptions): void {
    if (typeof options !== "object" || options === null) refuse("wrong-type", "options", "must be an object", options);
    const given = { ...this.#given, ...options };
    const before = this.#settings;
    const settings = readOptions(given);
    const exchange = this.#targets.change({ settings });
    this.#given = given;
    this.#settings = settings;
    this.#take(exchange);
    const differs = (key: keyof Settings) => before[key] !== settings[key];
    if (differs("root")) this.#presence.watch([], []);
    if (differs("none") || differs("constants") || differs("predictor") || differs("learning")) this.#prediction?.renew();
    if (!settings.decorate) {
      this.#prediction?.decorate(false);
      this.#intents.unmark();
    }
    if (this.#state === "running") this.#begin(before);
    this.#outdate();
  }

  pause(): void {
    if (this.#state !== "running") return;
    this.#state = "paused";
    this.#rest();
  }

  resume(): void {
    if (this.#state !== "paused") return;
    this.#state = "running";
    this.#begin();
    this.#outdate();
  }

  stop(): void {
    if (this.#state === "stopped") return;
    this.#state = "stopped";
    this.#rest();
    this.#presence.stop();
    this.#prediction?.free();
    this.#end();
    this.#listeners.clear();
  }

  // these two are passed around on their own, as stores are
  readonly subscribe = (listener: () => void): (() => void) => {
    if (typeof listener !== "function") refuse("wrong-type", "listener", "must be a function", listener);
    const own = () => listener();
    this.#listeners.add(own);
    return () => {
      this.#listeners.delete(own);
    };
  };

  readonly getSnapshot = (): Snapshot => this.#snapshot;

  [dispose](): void {
    this.stop();
  }

  moved(pointer: PointerId, samples: readonly Sample[], view: Window, place: Place | null): void {
    const hand = this.#hand(pointer);
    const over = place && this.#at(place);
    const before = hand.over ?? over ?? [];
    hand.place = place ?? hand.place;
    if (over) this.#over(hand, over, "hover");
    // the page that was called may have stopped or paused this
    if (!this.#hands.has(pointer.pointerId)) return;
    const now = this.#platform.now();
    this.#load();
    this.#predicting((prediction) => {
      if (prediction.moved(hand, samples, view, before, now)) this.#request();
    });
  }

  touched(pointer: PointerId, place: Place): void {
    const [target] = this.#at(place);
    if (target) this.#intents.touch(this.#hand(pointer), target);
  }

  pressed(pointer: PointerId, place: Place): void {
    const hand = this.#hand(pointer);
    const targets = this.#at(place, false);
    const outcome = this.#prediction?.press(hand, targets);
    this.#intents.press(hand, targets);
    if (outcome) this.#calls.call(this.#settings.onOutcome, outcome);
    this.#predicting((prediction) => prediction.end(hand));
    this.#review();
  }

  lost(pointerId: number): void {
    const hand = this.#hands.get(pointerId);
    if (hand) this.#lose(hand);
  }

  gone(pointerId: number): void {
    const hand = this.#hands.get(pointerId);
    if (!hand) return;
    this.#hands.delete(pointerId);
    this.#intents.forget(hand);
    this.#predicting((prediction) => prediction.drop(hand));
    this.#review();
  }

  hidden(): void {
    for (const hand of this.#hands.values()) this.#lose(hand);
  }

  /** A movement is over without a press, and the pointer over nothing. */
  #lose(hand: Hand): void {
    this.#intents.forget(hand);
    this.#predicting((prediction) => prediction.end(hand));
    hand.moveOver([]);
    hand.over = hand.place = null;
    this.#review();
  }

  #review(): void {
    this.#intents.review();
    this.#request();
  }

  #hand(pointer: PointerId): Hand {
    let hand = this.#hands.get(pointer.pointerId);
    if (!hand) this.#hands.set(pointer.pointerId, (hand = new Hand(pointer.pointerType)));
    return hand;
  }

  #over(hand: Hand, over: readonly Target[], by: "hover" | "scroll"): void {
    if (!hand.moveOver(over)) return;
    this.#intents.over(hand, by);
    this.#intents.review();
  }

  /** The targets at a place, the innermost first; with `reach` also those that hitSlop enlarges up to there. */
  #at(place: Place, reach = true): readonly Target[] {
    this.#sync();
    const found = this.#targets.on(place.path).filter(({ settings }) => settings.enabled !== false);
    return this.#prediction?.at(place, found, reach) ?? found;
  }

  #focused(path: readonly EventTarget[], ahead: readonly Element[]): void {
    this.#sync();
    this.#intents.focus(this.#targets.on(path)[0] ?? null, this.#targets.on(ahead));
  }

  /** Begins to follow pointers and the focus, or again with other options. */
  #begin(before?: Settings): void {
    const { signal, load, raw, reasons } = this.#settings;
    this.#end();
    if (signal?.aborted) {
      this.stop();
      return;
    }
    if (signal) this.#stops.push(this.#platform.listen(signal, { abort: () => this.stop() }));
    // a finger that is down, and how long targets have been visible, stay known
    if (raw !== before?.raw || reasons.keyboard !== before?.reasons.keyboard) this.#presence.listen();
    if (load === "eager") this.#load();
    if (load === "idle") this.#stops.push(this.#platform.idle(this.#load));
    if (reasons.viewport !== before?.reasons.viewport) for (const target of this.#targets.all) this.#intents.visible(target);
  }

  #end(): void {
    for (const stop of this.#stops.splice(0)) stop();
  }

  #listen(view: Window): Stop {
    const { raw, reasons } = this.#settings;
    const follows = ({ pointerType }: PointerId) => this.#settings.pointers.includes(pointerType);
    const stops = [
      listenToPointers(this.#platform, view, this, follows, raw),
      listenToFocus(this.#platform, view, reasons.keyboard ?? 0, (path, ahead) => this.#focused(path, ahead), this.#calls.report),
    ];
    if (this.#prediction) stops.push(this.#prediction.changes.listen(view));
    return () => {
      for (const stop of stops) stop();
    };
  }

  /** Follows nothing any more, and ends every movement and intent. */
  #rest(): void {
    this.#presence.deafen();
    this.#frame?.();
    this.#frame = null;
    this.#kept?.splice(0);
    for (const hand of this.#hands.values()) this.#prediction?.drop(hand);
    this.#hands.clear();
    this.#intents.clear();
    this.#publish();
  }

  #predict([{ Prediction, surface }, core]: readonly [Loaded, MakePredictor | null]): void {
    if (this.#state === "stopped") return;
    const prediction = new Prediction(core, {
      watcher: this,
      platform: this.#platform,
      surface: surface(),
      targets: this.#targets,
      settings: () => this.#settings,
      intents: this.#intents,
      changed: () => this.#request(),
      failed: this.#calls.report,
      scrolled: (hand, place) => this.#over(hand, this.#at(place), "scroll"),
    });
    this.#prediction = prediction;
    if (this.#state === "running") this.#presence.listen();
    for (const run of this.#kept?.splice(0) ?? []) run(prediction);
    this.#request();
  }

  /** Does something with the prediction, now or when it is loaded. */
  #predicting(run: (prediction: Prediction) => void): void {
    if (this.#prediction) run(this.#prediction);
    else if (this.#kept && this.#kept.push(run) > MOST_KEPT) this.#kept.shift();
  }

  /** Asks for a frame, if there is none yet. */
  #request(): void {
    if (this.#state !== "running") return;
    this.#frame ??= this.#platform.frame(() => {
      this.#frame = null;
      this.#calls.call(() => this.#draw(), undefined);
    });
  }

  #draw(): void {
    this.#sync();
    const again = this.#prediction?.draw();
    this.#intents.review();
    this.#publish();
    if (again) this.#request();
  }

  /** Writes on the page, and hands out what has changed. */
  #publish(): void {
    const intended = this.#intents.targets;
    const snapshot = snapshotOf(this.#prediction?.posterior() ?? null, intended, this.#snapshot);
    if (snapshot === this.#snapshot) return;
    this.#snapshot = snapshot;
    this.#prediction?.decorate(this.#settings.decorate);
    for (const listener of [...this.#listeners]) this.#calls.call(listener, undefined);
    this.#calls.call(this.#settings.onPrediction, snapshot);
  }

  /** Finds the elements of a live selector again, if there may be others. */
  #sync(): void {
    if (this.#targets.stale && this.#state !== "stopped") {
      this.#take(this.#targets.change({ report: this.#calls.report }));
    }
  }

  #take({ added, removed }: Exchange): void {
    if (this.#state === "stopped" || added.length + removed.length === 0) return;
    this.#presence.watch(added, removed);
    for (const target of removed) {
      this.#intents.leave(target);
      for (const hand of this.#hands.values()) {
        if (hand.isOver(target)) hand.moveOver((hand.over ?? []).filter((other) => other !== target));
      }
    }
    this.#prediction?.forget(removed);
    removed.forEach(release);
    this.#prediction?.changes.outdate();
    this.#request();
  }

  /** What holds for targets may have changed. */
  #outdate(): void {
    this.#prediction?.relist();
    this.#prediction?.changes.outdate();
    this.#intents.review();
    this.#request();
  }
}
