/** Follows a hundred vessels at once, each with a predictor of its own, and keeps the books of the harbours. */
import { Predictor } from "whither";
import { AHEAD } from "./anomaly.ts";
import type { Expected } from "./clock.ts";
import { HARBOURS } from "./coast.ts";
import { fleet, type Vessel } from "./fleet.ts";
import { Lookout, type Moment } from "./lookout.ts";
import { DEFAULT, scenario } from "./scenario.ts";

export interface Followed extends Vessel {
  readonly lookout: Lookout;
  /** What was predicted half way to its last report, once that was made. */
  readonly half: Half | null;
  /** All its reports were made. */
  readonly arrived: boolean;
  /** When it will be at its most probable harbour, as computed after some report, the last one or one shortly before. */
  readonly expected: { readonly of: Moment; readonly at: Expected } | null;
}

interface Half {
  readonly moment: Moment;
  /** Whether the interval stated then holds the arrival. */
  readonly within: boolean;
}

/** One line of a harbour's board. */
export interface Arrival {
  readonly vessel: Followed;
  readonly probability: number;
  readonly median: number;
  readonly low: number;
  readonly high: number;
}

/** How the predictions stand against what the simulation knows. */
export interface Books {
  readonly reporting: number;
  readonly arrived: number;
  /** Of the vessels that are half way to a harbour or farther: how many there are, were right, and stated an interval that held. */
  readonly half: number;
  readonly right: number;
  readonly within: number;
  /** Vessels that the rule has marked: those that go to a harbour, and those that pass. */
  readonly marked: number;
  readonly markedPassing: number;
  readonly passing: number;
}

/** From this probability on a vessel is on a harbour's board. */
export const LISTED = 0.5;

export class HarbourMaster {
  readonly #all: Mutable[];
  /** Every report of the day, in the order of time. */
  readonly #reports: readonly { readonly vessel: Mutable; readonly index: number; readonly time: number }[];
  #next = 0;
  /** Whose expected arrival was brought up to date last. */
  #turn = 0;
  #now: number;
  /** Reports that were predicted from, and the seconds that took. */
  readonly #work = { reports: 0, seconds: 0 };

  constructor() {
    const first = new Predictor(scenario(DEFAULT));
    this.#all = fleet().map((vessel) => ({
      ...vessel,
      lookout: new Lookout(first.clone(), AHEAD),
      half: null,
      arrived: false,
      expected: null,
    }));
    first.free();
    this.#reports = this.#all
      .flatMap((vessel) => vessel.reports.map(({ time }, index) => ({ vessel, index, time })))
      .sort((one, other) => one.time - other.time);
    this.#now = this.begins;
  }

  get vessels(): readonly Followed[] {
    return this.#all;
  }

  get begins(): number {
    return this.#reports[0]?.time ?? 0;
  }

  get lasts(): number {
    return this.#reports.at(-1)?.time ?? 0;
  }

  /** How far it has come on the bay's clock. */
  get now(): number {
    return this.#now;
  }

  /** Reports a second that this machine predicts from: filter, probabilities, and every sixth time a forecast. */
  get throughput(): number {
    return this.#work.seconds > 0 ? this.#work.reports / this.#work.seconds : 0;
  }

  /** Goes to a time, for as long as the deadline allows: true once it is there. */
  seek(time: number, deadline: number): boolean {
    if (time < this.#now) this.#back(time);
    const began = performance.now();
    const from = this.#next;
    for (let report = this.#reports[from]; report && report.time <= time; report = this.#reports[this.#next]) {
      this.#next += 1;
      this.#observe(report.vessel, report.index);
      this.#now = report.time;
      if (performance.now() > deadline) break;
    }
    const next = this.#reports[this.#next];
    const there = !next || next.time > time;
    if (there) this.#now = time;
    if (this.#next > from) {
      this.#work.reports += this.#next - from;
      this.#work.seconds += (performance.now() - began) / 1000;
    }
    return there;
  }

  /**
   * Brings the expected arrivals up to date, one vessel after the other, for as long as the deadline allows; the next time it goes on
   * where it was. True where all are up to date.
   */
  expect(deadline: number): boolean {
    for (let turn = 0; turn < this.#all.length; turn += 1) {
      this.#turn = (this.#turn + 1) % this.#all.length;
      const vessel = this.#all[this.#turn];
      const of = vessel?.lookout.latest;
      if (!vessel || !of || vessel.expected?.of === of || !isListed(vessel)) continue;
      const at = vessel.lookout.arrivalAt(of.best);
      vessel.expected = at && { of, at };
      if (performance.now() > deadline) return false;
    }
    return true;
  }

  /** The next arrivals at each harbour, the earliest first, as they are expected so far. */
  board(): Arrival[][] {
    const boards: Arrival[][] = HARBOURS.map(() => []);
    for (const vessel of this.#all) {
      const { lookout, expected } = vessel;
      const { latest } = lookout;
      if (!latest || !expected || expected.of.best !== latest.best || !isListed(vessel)) continue;
      boards[latest.best]?.push({ vessel, probability: latest.probabilities[latest.best] ?? 0, ...expected.at });
    }
    for (const board of boards) board.sort((one, other) => one.median - other.median);
    return boards;
  }

  /** How many vessels are expected at each harbour: the sum of their probabilities. */
  due(): Float64Array {
    const due = new Float64Array(HARBOURS.length);
    for (const { lookout, arrived } of this.#all) {
      if (arrived) continue;
      for (const [harbour, probability] of lookout.latest?.probabilities.entries() ?? [])
        due[harbour] = (due[harbour] ?? 0) + probability;
    }
    return due;
  }

  books(): Books {
    const bound = this.#all.filter(({ harbour }) => harbour);
    const half = bound.flatMap((vessel) => (vessel.half ? { ...vessel.half, vessel } : []));
    const marked = this.#all.filter(({ lookout }) => lookout.moments.some(({ finding }) => finding));
    return {
      reporting: this.#all.filter(({ lookout, arrived }) => lookout.latest && !arrived).length,
      arrived: this.#all.filter(({ arrived, harbour }) => arrived && harbour).length,
      half: half.length,
      right: half.filter(({ moment, vessel }) => HARBOURS[moment.best]?.id === vessel.harbour?.id).length,
      within: half.filter(({ within }) => within).length,
      marked: marked.filter(({ harbour }) => harbour).length,
      markedPassing: marked.filter(({ harbour }) => !harbour).length,
      passing: this.#all.length - bound.length,
    };
  }

  free(): void {
    for (const { lookout } of this.#all) lookout.free();
  }

  #observe(vessel: Mutable, index: number): void {
    const report = vessel.reports[index];
    if (!report) return;
    const moment = vessel.lookout.observe(report);
    if (index === Math.floor(vessel.reports.length / 2)) {
      const { low, high } = vessel.lookout.arrivalAt(moment.best) ?? { low: 0, high: 0 };
      const end = vessel.reports.at(-1)?.time ?? 0;
      vessel.half = { moment, within: low <= end && end <= high };
    }
    vessel.arrived = index === vessel.reports.length - 1;
  }

  #back(time: number): void {
    for (const vessel of this.#all) {
      const kept = vessel.reports.findLastIndex((report) => report.time <= time) + 1;
      vessel.lookout.rewind(kept);
      vessel.arrived = kept === vessel.reports.length;
      if (kept <= Math.floor(vessel.reports.length / 2)) vessel.half = null;
    }
    this.#next = this.#reports.findLastIndex((report) => report.time <= time) + 1;
    this.#now = time;
  }
}

/** On its way, and more likely than not to one harbour. */
function isListed({ lookout: { latest }, arrived }: Followed): boolean {
  return !arrived && latest !== null && (latest.probabilities[latest.best] ?? 0) >= LISTED;
}

type Mutable = { -readonly [Key in keyof Followed]: Followed[Key] };
