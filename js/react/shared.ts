/**
 * One watcher for the elements of many components. What a commit of React attaches, detaches and changes is taken over once, after the
 * commit: a ref that is a new function at every render detaches and attaches the same element, which comes to nothing.
 *
 * @module
 */
import {
  type Intent,
  type Release,
  type Snapshot,
  type TargetOptions,
  type Watcher,
  type WatchOptions,
  type WatchTarget,
  WhitherError,
  watch,
} from "#dom";
import type { Entry } from "./entry.js";
import { same } from "./same.js";
import type { IntentProviderProps } from "./types.js";

/** What a provider gives. */
type Options = Omit<IntentProviderProps<never>, "children">;

type Values = Readonly<Record<string, unknown>>;
type Forward = (...given: unknown[]) => unknown;

/** What holds for a target: as its components ask, and as it is; another thing where that was wrong. */
interface Held {
  readonly asked: TargetOptions;
  readonly settings: TargetOptions;
}

/** Options of `watch` that are not for a provider. */
const ELSEWHERE: readonly string[] = ["root", "signal", "target"] satisfies (keyof WatchOptions)[];

const NOTHING: readonly never[] = Object.freeze([]);

/** What there is without a watcher: on a server, and before anything is watched. */
export const RESTING: Snapshot = Object.freeze({ moving: false, best: null, none: 1, targets: NOTHING, intended: NOTHING });

export class Shared {
  /** A provider's lives as long as that is mounted; the page's own as long as a component needs it. */
  readonly #owned: boolean;
  readonly #begin: typeof watch;
  #mounted = false;
  #options: Options = {};
  /** What the watcher was given last. */
  #applied: Values = {};
  #watcher: Watcher<WatchTarget> | null = null;
  readonly #entries = new Map<WatchTarget, Set<Entry>>();
  /** What is watched. */
  readonly #held = new Map<WatchTarget, Held>();
  #intended: ReadonlySet<WatchTarget> = new Set();
  /** Whom an intent began for, so that it ends for the same. */
  readonly #begun = new Map<WatchTarget, readonly Entry[]>();
  readonly #listeners = new Set<() => void>();
  /** What may have changed in this commit. */
  readonly #touched = new Set<WatchTarget>();
  readonly #moved = new Set<Entry>();
  #scheduled = false;
  readonly #forwards = new Map<string, Forward>();

  constructor(owned: boolean, begin: typeof watch = watch) {
    this.#owned = owned;
    this.#begin = begin;
  }

  /** The watcher, or null while there is none. */
  readonly getWatcher = (): Watcher<WatchTarget> | null => this.#watcher;

  readonly getSnapshot = (): Snapshot => this.#watcher?.getSnapshot() ?? RESTING;

  /** Calls back when there is another watcher, or it has computed something else. */
  readonly subscribe = (listener: () => void): (() => void) => {
    this.#listeners.add(listener);
    if (!this.#owned) this.#start();
    return () => {
      this.#listeners.delete(listener);
      this.#schedule();
    };
  };

  /** A component's ref was given a node. */
  attach(entry: Entry, node: WatchTarget): void {
    this.detach(entry);
    entry.node = node;
    const entries = this.#entries.get(node);
    if (entries) entries.add(entry);
    else this.#entries.set(node, new Set([entry]));
    this.touch(entry);
  }

  /** A component's ref was given null. */
  detach(entry: Entry): void {
    const { node } = entry;
    if (node === null) return;
    this.touch(entry);
    entry.node = null;
    const entries = this.#entries.get(node);
    entries?.delete(entry);
    if (entries?.size === 0) this.#entries.delete(node);
  }

  /** A component was rendered with options that may be others. */
  touch(entry: Entry): void {
    if (entry.node === null) return;
    this.#touched.add(entry.node);
    this.#moved.add(entry);
    this.#schedule();
  }

  /** The provider was rendered: its functions are called from now on. */
  render(options: Options): void {
    this.#options = options;
  }

  /**
   * The provider is mounted; returns what is done when it no longer is.
   *
   * @throws {@link WhitherError} where an option is wrong.
   */
  mount(): () => void {
    this.#start();
    this.#mounted = true;
    this.#take();
    return () => {
      this.#mounted = false;
      // StrictMode mounts again in this very task
      this.#schedule();
    };
  }

  /**
   * Takes over what the provider was rendered with last.
   *
   * @throws {@link WhitherError} where an option is wrong; then nothing is changed.
   */
  update(): void {
    const before = this.#applied;
    const values = this.#values();
    const keys = new Set([...Object.keys(before), ...Object.keys(values)]);
    const changed = [...keys].filter((key) => !same(before[key], values[key]));
    if (!this.#watcher || changed.length === 0) return;
    this.#watcher.update(Object.fromEntries(changed.map((key) => [key, values[key]])));
    this.#applied = values;
  }

  /** What the watcher is given: the options, with functions that stay the same. */
  #values(): Values {
    const values: Record<string, unknown> = { onIntent: this.#onIntent, onRelease: this.#onRelease };
    for (const [key, value] of Object.entries(this.#options)) {
      if (ELSEWHERE.includes(key)) {
        throw new WhitherError(
          "unknown-key",
          key,
          `unknown key "${key}": the watcher of a provider has the elements of its components`,
        );
      }
      const isOwn = key === "onIntent" || key === "onRelease";
      if (typeof value === "function") values[key] = isOwn ? values[key] : this.#forward(key);
      // what is absent must not hide these two
      else if (value !== null && value !== undefined) values[key] = value;
    }
    return { ...values, target: this.#settingsOf };
  }

  /** A function in place of one of the provider's, which is another at every render. */
  #forward(key: string): Forward {
    const forward = this.#forwards.get(key) ?? ((...given) => (this.#options as Record<string, Forward>)[key]?.(...given));
    this.#forwards.set(key, forward);
    return forward;
  }

  readonly #settingsOf = (node: WatchTarget): TargetOptions | undefined => this.#held.get(node)?.settings;

  readonly #onIntent = (intent: Intent): unknown => {
    const entries = [...(this.#entries.get(intent.target) ?? [])];
    this.#begun.set(intent.target, entries);
    return this.#call(entries, "onIntent", intent);
  };

  readonly #onRelease = (release: Release): void => {
    const entries = this.#begun.get(release.target) ?? [];
    this.#begun.delete(release.target);
    this.#call(entries, "onRelease", release).catch(this.#report);
  };

  /** Calls the components', or the provider's where there is none. What one throws keeps no other from being called. */
  #call(entries: readonly Entry[], name: "onIntent" | "onRelease", given: Intent | Release): Promise<unknown> {
    const own = entries.flatMap(({ options }) => options[name] ?? []) as Forward[];
    const calls = own.length > 0 ? own : [this.#options[name] as Forward | undefined];
    return Promise.all(calls.map(async (call) => call?.(given)));
  }

  readonly #report = (error: unknown): void => {
    const { onError } = this.#options;
    // not where it was caught, or the rest would not go on
    setTimeout(() => {
      if (!onError) throw error;
      onError(error);
    });
  };

  #schedule(): void {
    if (this.#scheduled) return;
    this.#scheduled = true;
    queueMicrotask(() => {
      this.#scheduled = false;
      const wanted = this.#owned ? this.#mounted : this.#entries.size + this.#listeners.size > 0;
      if (wanted) this.#start();
      else this.#stop();
      this.#take();
    });
  }

  #start(): void {
    if (this.#watcher) return;
    const values = this.#values();
    const watcher = this.#begin<WatchTarget>([], values as WatchOptions<WatchTarget>);
    [this.#watcher, this.#applied] = [watcher, values];
    watcher.subscribe(() => this.#publish());
    for (const node of this.#entries.keys()) this.#touched.add(node);
    this.#publish();
  }

  #stop(): void {
    if (!this.#watcher) return;
    this.#watcher.stop();
    this.#watcher = null;
    this.#held.clear();
    this.#publish();
  }

  /** The watcher has computed something else, or is another one. */
  #publish(): void {
    const before = this.#intended;
    this.#intended = new Set(this.getSnapshot().intended);
    for (const node of new Set([...before, ...this.#intended])) this.#entries.get(node)?.forEach(this.#mean);
    for (const listener of [...this.#listeners]) listener();
  }

  readonly #mean = (entry: Entry): void => entry.mean(entry.node !== null && this.#intended.has(entry.node));

  /** Takes over what came, went and changed in a commit. */
  #take(): void {
    const gone: WatchTarget[] = [];
    const asked = new Map<WatchTarget, TargetOptions>();
    for (const node of this.#watcher ? this.#touched : []) {
      const entries = this.#entries.get(node);
      const held = this.#held.get(node);
      const settings = entries && settingsOf(entries);
      if (!settings && this.#held.delete(node)) gone.push(node);
      if (settings && !same(held?.asked, settings)) asked.set(node, settings);
    }
    if (gone.length > 0) this.#watcher?.remove(...gone);
    if (asked.size > 0) this.#hold(asked);
    this.#moved.forEach(this.#mean);
    this.#moved.clear();
    this.#touched.clear();
  }

  /** Watches targets with these settings: all at once, or where one of them is wrong each by itself, and reports that. */
  #hold(asked: ReadonlyMap<WatchTarget, TargetOptions>): void {
    const before = Array.from(asked.keys(), (node) => [node, this.#held.get(node)] as const);
    const added = before.flatMap(([node, held]) => (held ? [] : node));
    for (const [node, settings] of asked) this.#held.set(node, { asked: settings, settings });
    try {
      if (added.length > 0) this.#watcher?.add(...added);
      if (added.length < asked.size) this.#watcher?.update({});
    } catch (error) {
      for (const [node, held] of before) {
        if (held) this.#held.set(node, held);
        else this.#held.delete(node);
      }
      if (asked.size > 1) for (const each of asked) this.#hold(new Map([each]));
      else for (const [node, settings] of asked) this.#refuse(node, settings, error);
    }
  }

  /** Reports that the settings of one target are wrong: it stays as it was, or is watched as if there were none. */
  #refuse(node: WatchTarget, asked: TargetOptions, error: unknown): void {
    this.#report(error);
    const held = this.#held.get(node);
    this.#held.set(node, { asked, settings: held?.settings ?? {} });
    if (held) return;
    try {
      this.#watcher?.add(node);
    } catch {
      // neither an element nor a virtual target, which is what was reported
    }
  }
}

/** What holds for a target: where several components state the same option, that of the one which was attached last. */
function settingsOf(entries: Iterable<Entry>): TargetOptions {
  const settings: Record<string, unknown> = {};
  for (const { options } of entries) {
    for (const [key, value] of Object.entries(options)) {
      if (value !== undefined && key !== "onIntent" && key !== "onRelease") settings[key] = value;
    }
  }
  return settings;
}
