/**
 * One watcher, with what the overlay knows of it.
 *
 * @module
 */
import type { Inspection, TargetOptions, Watcher, WatchTarget } from "#dom";
import { Log } from "./log.js";
import { isElement, Places } from "./places.js";
import { Tuning } from "./tuning.js";

/** A name is cut after so many characters. */
const LONGEST = 48;

export class Subject {
  readonly watcher: Watcher;
  readonly places: Places;
  readonly log: Log;
  /** What it answers, and by that changes of its options; null before its core is loaded. */
  inspection: Inspection | null = null;
  tuning: Tuning | null = null;
  readonly #names = new WeakMap<WatchTarget, string>();

  constructor(watcher: Watcher) {
    this.watcher = watcher;
    this.places = new Places(watcher);
    this.log = new Log(watcher);
  }

  /** Takes in what it answers. */
  inspect(inspection: Inspection): void {
    if (this.inspection) return;
    this.inspection = inspection;
    this.tuning = new Tuning(inspection);
  }

  optionsOf(target: WatchTarget): TargetOptions {
    return this.inspection?.optionsOf(target) ?? {};
  }

  /** A name for people to read. */
  nameOf(target: WatchTarget): string {
    const { name, id } = this.optionsOf(target);
    if (name || !isElement(target)) return name || id || (target as { readonly id: string }).id;
    // a name of its own is read again only when the element is another one: the text of a card may be long
    const known = this.#names.get(target);
    if (known !== undefined) return known;
    const words = target.getAttribute("aria-label") || target.textContent || target.getAttribute("title") || "";
    const found = words.trim().replace(/\s+/g, " ").slice(0, LONGEST) || target.id || target.localName;
    this.#names.set(target, found);
    return found;
  }

  /** What it is called among several. */
  get title(): string {
    const [first] = this.places.targets;
    const { count } = this.places;
    return `${count} ${count === 1 ? "target" : "targets"}${first ? `, ${this.nameOf(first)}` : ""}`;
  }

  stop(): void {
    this.tuning?.restore();
    this.places.stop();
  }
}
