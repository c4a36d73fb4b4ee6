/**
 * Options of a watcher that are changed while it runs, and put back.
 *
 * @module
 */
import type { Inspection, TargetOptions, Watcher, WatchTarget } from "#dom";

/** What can be changed. */
export type Values = Inspection["options"];

/** By default the release is this share of the threshold, and goes with it. */
const RELEASE = 0.625;

export class Tuning {
  readonly #watcher: Watcher;
  readonly #inspection: Inspection;
  /** What was, since something is changed. */
  #before: Values | null = null;
  /** Whether nobody has stated a release, as far as can be known. */
  #follows = false;
  readonly #targets = new Map<WatchTarget, TargetOptions>();

  constructor(inspection: Inspection) {
    this.#watcher = inspection.watcher;
    this.#inspection = inspection;
  }

  get values(): Values {
    return this.#inspection.options;
  }

  get isChanged(): boolean {
    return this.#before !== null || this.#targets.size > 0;
  }

  /** The changed options as code. */
  get code(): string {
    const { values } = this;
    const differ = (["threshold", "release", "none"] as const).filter((key) => this.#before && values[key] !== this.#before[key]);
    const stated = differ.filter((key) => key !== "release" || !this.#follows);
    return stated.length > 0 ? `{ ${stated.map((key) => `${key}: ${Number(values[key].toFixed(3))}`).join(", ")} }` : "";
  }

  /**
   * Changes options. A release that goes with the threshold goes on doing so, another one is never above it.
   *
   * @throws {@link WhitherError} for what is not legal.
   */
  set(changes: Partial<Values>): void {
    const { values } = this;
    if (!this.#before) {
      this.#before = { ...values };
      this.#follows = follows(values);
    }
    const { threshold = values.threshold, release = values.release } = changes;
    if (changes.release !== undefined) this.#follows = false;
    const legal =
      changes.release === undefined ? { release: Math.min(threshold, release) } : { threshold: Math.max(threshold, release) };
    this.#watcher.update({ ...changes, ...(this.#follows ? { release: undefined } : legal) });
  }

  prior(target: WatchTarget): number {
    return this.#inspection.optionsOf(target).prior ?? 1;
  }

  /** Sets the prior of a target. */
  setPrior(target: WatchTarget, prior: number): void {
    const options = this.#inspection.optionsOf(target);
    if (!this.#targets.has(target)) this.#targets.set(target, options);
    this.#watcher.set(target, { ...options, prior });
  }

  /** Puts back what was. */
  restore(): void {
    const before = this.#before;
    this.#before = null;
    if (before) this.#watcher.update({ ...before, release: follows(before) ? undefined : before.release });
    const watched = new Set(this.#watcher.targets);
    for (const [target, options] of this.#targets) {
      if (!watched.has(target)) continue;
      // that is what it has of the watcher's options, or else it had its own
      this.#watcher.set(target, null);
      if (!isSame(this.#inspection.optionsOf(target), options)) this.#watcher.set(target, options);
    }
    this.#targets.clear();
  }
}

function follows({ threshold, release }: Values): boolean {
  return release === RELEASE * threshold;
}

function isSame(one: TargetOptions, other: TargetOptions): boolean {
  const keys = new Set([...Object.keys(one), ...Object.keys(other)] as (keyof TargetOptions)[]);
  return [...keys].every(
    (key) => one[key] === other[key] || (key === "hitSlop" && JSON.stringify(one[key]) === JSON.stringify(other[key])),
  );
}
