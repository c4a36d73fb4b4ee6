/**
 * What a user of `whither/dom` gives and is given.
 *
 * @module
 */
import type { Gaussian } from "../core/gaussian.js";
import type { Learnt } from "../core/learnt.js";
import type { Remaining } from "../core/predictor.js";
import type { Scenario } from "../core/scenario.js";
import type { PointerConstants } from "../pointing/constants.js";
import type { Ledger, Outcome } from "./ledger.js";

/** A place on a page: px from the left and the top of the window's viewport, as `getBoundingClientRect` returns it. */
export interface Bounds {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** A target that is not an element: a shape on a canvas, an object in WebGL, a place on a map. */
export interface VirtualTarget {
  /** Its name; no two targets of a watcher have the same. */
  readonly id: string;
  /** Where it is now: called once a frame while something moves. A width or height of 0: it cannot be seen. */
  bounds(): Bounds;
}

/** What can be watched. */
export type WatchTarget = Element | VirtualTarget;

/** What is to be watched: a selector, which is live, an element, a virtual target, or any number of both. */
export type WatchTargets = string | WatchTarget | Iterable<WatchTarget>;

/** Why a target is taken to be meant. */
export type Reason = "pointer" | "hover" | "press" | "focus" | "keyboard" | "touch" | "scroll" | "viewport";

/** Which signs count; what is left out has its default. */
export interface Reasons {
  /** The posterior passed what the threshold asks for; with `after` it has to hold that many milliseconds. @defaultValue true */
  readonly pointer?: boolean | { readonly after: number } | undefined;
  /** A pointer has been over it for so many milliseconds. @defaultValue { after: 130 } */
  readonly hover?: boolean | { readonly after: number } | undefined;
  /** A mouse or a pen was pressed on it, or a finger lifted where it came down. @defaultValue true */
  readonly press?: boolean | undefined;
  /** It got the focus, and not from a press. @defaultValue true */
  readonly focus?: boolean | undefined;
  /** It is at most so many tab stops ahead of the focus. @defaultValue false */
  readonly keyboard?: boolean | { readonly tabs: number } | undefined;
  /** A finger has been on it for 80 milliseconds, so that a pan is none. @defaultValue true */
  readonly touch?: boolean | undefined;
  /** Scrolling brought it under a resting pointer, and it stayed there as long as `hover` asks for. @defaultValue true */
  readonly scroll?: boolean | undefined;
  /** It has been visible for so many milliseconds. @defaultValue false */
  readonly viewport?: boolean | { readonly after: number } | undefined;
}

/** What holds for one target. */
export interface TargetOptions {
  /** Its name, by which choices are learnt and reported; no two are the same. @defaultValue the element's `id`, else none */
  readonly id?: string | undefined;
  /** A name for people to read. @defaultValue none */
  readonly name?: string | undefined;
  /** Anything of yours that comes back with its intents and outcomes. @defaultValue none */
  readonly data?: unknown;
  /** Its weight before any movement; only the ratios matter, and with 0 it is never predicted. @defaultValue 1 */
  readonly prior?: number | undefined;
  /** In place of the watcher's. @defaultValue the watcher's */
  readonly threshold?: number | undefined;
  /** By how many px its box is larger than the element, for the posterior and for hover. @defaultValue 0 */
  readonly hitSlop?: number | Partial<Record<"top" | "right" | "bottom" | "left", number | undefined>> | undefined;
  /** `false`: it is never predicted and never meant. @defaultValue true */
  readonly enabled?: boolean | undefined;
  /** Called for this target in place of the watcher's. @defaultValue the watcher's */
  readonly onIntent?: ((intent: Intent) => unknown) | undefined;
}

/** A target that is meant: what `onIntent` gets, and the `detail` of `whither:intent` and `whither:release`. */
export interface Intent<T extends WatchTarget = WatchTarget> {
  readonly target: T;
  readonly reason: Reason;
  /** The posterior probability when it was taken to be meant; 0 where no pointer moved. */
  readonly probability: number;
  /** Seconds until the pointer enters it, as they were then; null where no pointer moved. */
  readonly remaining: Remaining | null;
  /** Aborts when the target is not meant any more; never after a press on it. */
  readonly signal: AbortSignal;
  /** As its options have it, else the element's `id`. */
  readonly id: string | undefined;
  readonly name: string | undefined;
  readonly data: unknown;
}

/** The end of an intent: what `onRelease` gets. */
export interface Release<T extends WatchTarget = WatchTarget> extends Intent<T> {
  /** Whether it ended in a press on the target; else the user turned away. */
  readonly pressed: boolean;
}

/** A target and its posterior probability. */
export interface Probable<T extends WatchTarget = WatchTarget> {
  readonly target: T;
  readonly id: string | undefined;
  readonly probability: number;
}

/** What a watcher has computed: immutable, and the same object until something changes. */
export interface Snapshot<T extends WatchTarget = WatchTarget> {
  /** Whether a pointer is on its way. */
  readonly moving: boolean;
  /** The most probable target, or null between movements. */
  readonly best: Probable<T> | null;
  /** The probability of none of them: 1 between movements. */
  readonly none: number;
  /** The targets above 1%, the most probable first. */
  readonly targets: readonly Probable<T>[];
  /** The targets that are taken to be meant now. */
  readonly intended: readonly T[];
}

/** A model of pointing in place of `PointerPredictor` of `whither/pointing`, whose methods it has. */
export interface Predictor {
  /** Takes in a position in px, at a time in seconds that is at least the last one's. */
  observe(time: number, position: readonly [number, number]): void;
  /** One for each target, in their order, written into an array of as many where one is given; they sum to `1 - none`. */
  probabilities(into?: Float64Array): Float64Array;
  readonly none: number;
  readonly remaining: Remaining | null;
  /** Position and velocity at a later time. */
  forecast(time: number): Gaussian | null;
  /** The expected positions at later times on the way to one target: `x, y, x, y, ...`. */
  path(id: string, times: readonly number[]): Float64Array;
  /** Other targets, or none at all, in mid-movement too. */
  setTargets(targets: readonly PredictedTarget[]): void;
  /** Begins a new movement. */
  reset(): void;
  /** A target was pressed, at the end of the movement. */
  chosen?(id: string): void;
  /** What the presses have taught about the user. */
  learnt?(): Learnt;
  /** Goes on with what was learnt before; null: with a user of whom nothing is known. Called at the beginning of each movement. */
  setLearnt?(learnt: Learnt | null): void;
  /** Gives back what it holds; it is not used again. */
  free(): void;
}

/** A target as a {@link Predictor} gets it: its centre and size in px. */
export interface PredictedTarget {
  readonly id: string;
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
  readonly prior: number;
}

/** Makes a predictor: `new PointerPredictor(targets, options)` unless the options have another. */
export type MakePredictor = (
  targets: readonly PredictedTarget[],
  options: { readonly none: number; readonly constants: WatchOptions["constants"]; readonly learning: boolean },
) => Predictor;

/** What `watch` takes, all of it changeable by `update`. */
export interface WatchOptions<T extends WatchTarget = WatchTarget> {
  /** Where a selector looks. @defaultValue document */
  readonly root?: ParentNode | undefined;
  /**
   * The probability at which a pointer means a target that it moves towards, 50 px before its edge, above 0 and at most 1. Farther away more
   * is asked for, nearer less: its odds times `((d + 10)/60)^0.6` at `d` px. @defaultValue 0.8
   */
  readonly threshold?: number | undefined;
  /** The probability below which it has turned away, at most the threshold. @defaultValue 0.5, or 0.625 of the threshold */
  readonly release?: number | undefined;
  /** The prior probability that a movement goes to none of the targets, at least 0 and less than 1. @defaultValue 0.2 */
  readonly none?: number | undefined;
  /** Milliseconds without displacement that end a movement. @defaultValue 300 */
  readonly rest?: number | undefined;
  /** What holds for each target: the same for all, or a function of the target. @defaultValue {} */
  readonly target?: TargetOptions | ((target: T) => TargetOptions | null | undefined) | undefined;
  /** Which signs count. */
  readonly reasons?: Reasons | undefined;
  /** When a target may be intended again: never, in another movement, or after so many milliseconds. @defaultValue "movement" */
  readonly reactivate?: "never" | "movement" | number | undefined;
  /** The most intents that run at a time, until the promise of `onIntent` is fulfilled, and that begin in a minute. @defaultValue none */
  readonly limit?: { readonly running?: number | undefined; readonly perMinute?: number | undefined } | undefined;
  /** The types of pointers that are followed. @defaultValue ["mouse", "pen", "touch"] */
  readonly pointers?: readonly string[] | undefined;
  /** Takes samples from `pointerrawupdate` too, where there is such: at the device's rate. @defaultValue false */
  readonly raw?: boolean | undefined;
  /** When the WebAssembly is fetched: now, when the page is idle, or when a pointer moves. @defaultValue "pointer" */
  readonly load?: "eager" | "idle" | "pointer" | undefined;
  /** Writes `--probability` and `data-predicted` on elements, and dispatches `whither:intent` and `whither:release`. @defaultValue true */
  readonly decorate?: boolean | undefined;
  /** Constants for another device or task, as `fit` of `whither/study` learns them. @defaultValue those for a mouse */
  readonly constants?: PointerConstants | Omit<Scenario, "destinations"> | undefined;
  /** Another model in place of `PointerPredictor`; then that is not loaded. @defaultValue none */
  readonly predictor?: MakePredictor | undefined;
  /**
   * Learns from what is pressed: the priors of targets with an id, and how far the model of pointing holds for the user. The number is how
   * many presses the priors are worth. @defaultValue false
   */
  readonly learning?: boolean | number | undefined;
  /** What was learnt of the user before, on another page or visit: the `learnt` of an {@link Outcome}. @defaultValue nothing */
  readonly learnt?: Learnt | null | undefined;
  /** Keeps the samples, for `ledger.lines()`. @defaultValue false */
  readonly record?: boolean | undefined;
  /** Stops the watcher. @defaultValue none */
  readonly signal?: AbortSignal | undefined;
  /** A target is meant. A promise that it returns is what `limit.running` waits for. */
  readonly onIntent?: ((intent: Intent<T>) => unknown) | undefined;
  /** A target is not meant any more, or was pressed. */
  readonly onRelease?: ((release: Release<T>) => void) | undefined;
  /** The posterior has changed: at most once a frame. */
  readonly onPrediction?: ((snapshot: Snapshot<T>) => void) | undefined;
  /** A pointer pressed a target, and how that was predicted. */
  readonly onOutcome?: ((outcome: Outcome<T>) => void) | undefined;
  /** What went wrong: the core cannot be loaded, a callback threw. @defaultValue reported as an uncaught error, once each */
  readonly onError?: ((error: unknown) => void) | undefined;
}

/**
 * A watcher as tools see it: what each watcher of a page gives to who asks. A tool dispatches a `CustomEvent` of the type
 * `whither:inspect` on the window, with a function as its `detail`, and each watcher whose core is loaded, and that is not paused, calls it
 * with this.
 *
 * @example
 * ```ts
 * const watchers: Watcher[] = [];
 * const detail = ({ watcher }: Inspection) => watchers.push(watcher);
 * dispatchEvent(new CustomEvent("whither:inspect", { detail }));
 * ```
 */
export interface Inspection<T extends WatchTarget = WatchTarget> {
  readonly watcher: Watcher<T>;
  /** What these options are now, stated or by default. */
  readonly options: { readonly threshold: number; readonly release: number; readonly none: number };
  /** What holds for a target now: of the watcher's options, and its own. */
  optionsOf(target: T): TargetOptions;
  /** Why a target was taken to be meant last, in the movement under way or the last one; null where it was not. */
  reasonOf(target: T): Reason | null;
}

/** Watches targets: what {@link watch} returns. */
export interface Watcher<T extends WatchTarget = WatchTarget> {
  /**
   * Fulfilled when the core is loaded, which `load` decides, rejected where it cannot be; the page never has to wait for it. On a server
   * it stays pending.
   */
  readonly ready: Promise<void>;
  /** What is watched now, in the order of the document for a selector. */
  readonly targets: readonly T[];
  /** The most probable target, or null between movements. */
  readonly best: Probable<T> | null;
  /** The probability of none of them: 1 between movements. */
  readonly none: number;
  /** Seconds until the pointer enters its target; null between movements and where that cannot be computed. */
  readonly remaining: Remaining | null;
  /** What came of the movements that ended in a press. */
  readonly ledger: Ledger<T>;
  /** The posterior probability of a target: 0 between movements and for what is not watched. */
  probability(target: T): number;
  /** Where the pointer will be in so many seconds, at least 0: mean and covariance of position and velocity; null between movements. */
  forecast(seconds: number): Gaussian | null;
  /** Where it is expected to be in so many seconds each if it goes to one target: `x, y, x, y, ...`; empty between movements. */
  path(target: T, seconds: readonly number[]): Float64Array;
  /** Changes what holds for one target; `null` sets what the watcher's options have. */
  set(target: T, options: TargetOptions | null): void;
  /** Watches more. */
  add(...targets: T[]): void;
  /** Watches these no longer. */
  remove(...targets: T[]): void;
  /** Reads the layout and a selector's elements again: for changes that nothing reports. */
  refresh(): void;
  /** Changes options; what is left out stays, and `undefined` sets the default. */
  update(options: WatchOptions<T>): void;
  /** Ends movements and aborts what runs; nothing is followed until {@link resume}. */
  pause(): void;
  /** Follows again what {@link pause} stopped following. */
  resume(): void;
  /** Stops for good: nothing is left on the page. */
  stop(): void;
  /** Calls back whenever {@link getSnapshot} has another value; returns what ends that. */
  subscribe(listener: () => void): () => void;
  /** What was computed last: for stores such as React's `useSyncExternalStore`. */
  getSnapshot(): Snapshot<T>;
  /** As {@link stop}, at the end of a `using` declaration's block. */
  [Symbol.dispose](): void;
}
