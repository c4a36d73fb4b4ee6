/** One vessel on its way: its reports, and what was predicted up to a time. */
import { Predictor } from "whither";
import { PILOT_STATION, type Place } from "./coast.ts";
import { Lookout } from "./lookout.ts";
import { placeAt, type Report } from "./sail.ts";
import { scenario, type Settings } from "./scenario.ts";

/** Seconds between two comparisons with a forecast. */
const APART = 60;
/** When a vessel of the visitor's own is first reported: at noon. */
const NOON = 12 * 3600;

export class Pursuit {
  #reports: readonly Report[];
  #lookout: Lookout;
  #work = { reports: 0, seconds: 0 };

  constructor(reports: readonly Report[], settings: Settings) {
    this.#reports = reports;
    this.#lookout = watch(settings);
  }

  get lookout(): Lookout {
    return this.#lookout;
  }

  get reports(): readonly Report[] {
    return this.#reports;
  }

  get begins(): number {
    return this.#reports[0]?.time ?? NOON;
  }

  /** The last report's time. */
  get lasts(): number {
    return this.#reports.at(-1)?.time ?? NOON;
  }

  /** Another vessel. */
  follow(reports: readonly Report[]): void {
    this.#reports = reports;
    this.#lookout.rewind(0);
  }

  /** A vessel at the pilot station that goes where it is steered. */
  launch(): void {
    this.follow([{ ...PILOT_STATION, time: NOON }]);
  }

  /** The same reports, predicted otherwise. */
  set(settings: Settings): void {
    const lookout = watch(settings);
    this.#lookout.free();
    this.#lookout = lookout;
    this.#work = { reports: 0, seconds: 0 };
  }

  /** Goes to a time, for as long as the deadline allows: true once it is there. Milliseconds of `performance.now()`. */
  seek(time: number, deadline: number): boolean {
    const due = this.#due(time);
    if (due < this.#lookout.moments.length) this.#lookout.rewind(due);
    const from = this.#lookout.moments.length;
    const began = performance.now();
    for (const report of this.#reports.slice(from, due)) {
      this.#lookout.observe(report);
      if (performance.now() > deadline) break;
    }
    this.#work.reports += this.#lookout.moments.length - from;
    this.#work.seconds += (performance.now() - began) / 1000;
    return this.#lookout.moments.length === due;
  }

  /** Seconds that a report has taken on this machine, on average, since the last change of settings. */
  get cost(): number {
    return this.#work.seconds / Math.max(1, this.#work.reports);
  }

  /** From now on it is steered: what had been reported later never was. */
  take(time: number): void {
    this.#reports = this.#reports.slice(0, this.#due(time));
    this.#lookout.rewind(this.#reports.length);
  }

  /** One report more of a vessel that is steered. */
  add(report: Report): void {
    this.#reports = [...this.#reports, report];
  }

  place(time: number): Place {
    return placeAt(this.#reports, time);
  }

  /** How many reports there are up to a time; the first one always. */
  #due(time: number): number {
    return Math.max(1, this.#reports.findLastIndex((report) => report.time <= time) + 1);
  }
}

function watch(settings: Settings): Lookout {
  return new Lookout(new Predictor(scenario(settings)), APART);
}
