/**
 * The intents of a watcher as they come, and how each ended.
 *
 * @module
 */
import type { Inspection, Intent, Outcome, Reason, Release, Snapshot, Watcher, WatchTarget } from "#dom";

/** So many are kept. */
const MOST = 100;

/** An intent; what is unknown is null. */
export interface Entry {
  readonly target: WatchTarget;
  /** When it began, in milliseconds on the clock of `performance.now()`. */
  readonly time: number;
  readonly reason: Reason | null;
  readonly probability: number;
  /** How it ended: the user turned away, or pressed it; null while it runs. */
  end: "released" | "pressed" | null;
  /** Seconds until it ended; of a press the ledger's lead. */
  seconds: number;
  /** What the ledger has of the press. */
  verdict: Outcome["verdict"] | null;
}

/**
 * Elements dispatch their intents. What dispatches nothing, a virtual target or any with `decorate: false`, is found in the snapshots;
 * presses are in the ledger, too.
 */
export class Log {
  /** The last first. */
  readonly entries: Entry[] = [];
  /** How many there were. */
  count = 0;
  /** Another number after each change. */
  revision = 0;
  readonly #watcher: Watcher;
  readonly #running = new Map<WatchTarget, Entry>();
  #last: Outcome | undefined;

  constructor(watcher: Watcher) {
    this.#watcher = watcher;
    this.#last = watcher.ledger.outcomes.at(-1);
  }

  /** Takes in what an element dispatched, if the watcher has that element. */
  begin({ target, reason, probability }: Intent): void {
    if (this.#watcher.targets.includes(target)) this.#add(target, reason, probability);
  }

  /** Takes in the end of an intent that an element dispatched. */
  release({ target, pressed }: Release): void {
    this.#end(target, pressed ? "pressed" : "released");
  }

  /** Takes in a snapshot: what is meant now, and what was pressed since the last one. */
  look({ intended }: Snapshot, inspection: Inspection | null): void {
    for (const target of intended) {
      if (!this.#running.has(target)) this.#add(target, inspection?.reasonOf(target) ?? null, this.#watcher.probability(target));
    }
    for (const outcome of this.#outcomes()) this.#judge(outcome);
    for (const target of this.#running.keys()) if (!intended.includes(target)) this.#end(target, "released");
  }

  #outcomes(): readonly Outcome[] {
    const { outcomes } = this.#watcher.ledger;
    // it is bounded: the last one that is known may be gone
    const fresh = outcomes.slice(this.#last ? outcomes.lastIndexOf(this.#last) + 1 : 0);
    this.#last = outcomes.at(-1);
    return fresh;
  }

  #judge({ target, time, verdict, lead, probability }: Outcome): void {
    const recent = this.entries.find((entry) => entry.target === target && entry.end !== "released");
    const entry = recent && !recent.verdict ? recent : this.#add(target, "press", probability, time);
    this.#end(target, "pressed");
    this.revision++;
    Object.assign(entry, { end: "pressed", seconds: lead, verdict });
  }

  #add(target: WatchTarget, reason: Reason | null, probability: number, time = performance.now()): Entry {
    const entry: Entry = { target, time, reason, probability, end: null, seconds: 0, verdict: null };
    this.#running.set(target, entry);
    this.count++;
    this.revision++;
    this.entries.unshift(entry);
    this.entries.length = Math.min(this.entries.length, MOST);
    return entry;
  }

  #end(target: WatchTarget, end: "released" | "pressed"): void {
    const entry = this.#running.get(target);
    if (!entry) return;
    this.#running.delete(target);
    this.revision++;
    entry.end = end;
    entry.seconds = (performance.now() - entry.time) / 1000;
  }
}
