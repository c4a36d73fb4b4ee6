/** Follows one vessel with a predictor of its own, and keeps what was predicted at each report. */
import type { Gaussian, Predictor } from "whither";
import { AHEAD, deviations, episodes, LIMIT, manner, NONE_LIMIT, NOWHERE, type Anomaly, type Finding } from "./anomaly.ts";
import { expected, type Expected } from "./clock.ts";
import { HARBOURS, type Place } from "./coast.ts";
import type { Report } from "./sail.ts";

/** What was predicted at one report. */
export interface Moment {
  readonly report: Report;
  /** Of each harbour. */
  readonly probabilities: Float64Array;
  readonly none: number;
  /** The index of the most probable harbour. */
  readonly best: number;
  /** Metres a second. */
  readonly velocity: Place;
  /** From the forecast at the last comparison, 0 before there was one; and what the rule found. */
  readonly deviations: number;
  readonly finding: Finding | null;
}

/** When it will be at a harbour: the interval, and the posterior that it is from. */
export interface Arriving extends Expected {
  readonly times: Float64Array;
  readonly probabilities: Float64Array;
}

/** Where it goes if it goes to one harbour. */
export interface Path {
  readonly probability: number;
  readonly places: readonly Place[];
}

/** The time over which a velocity is taken, in seconds. */
const OVER = 60;
/** How many harbours have their paths drawn, from which probability on, in how many steps. */
const PATHS = 3;
const FAINT = 0.02;
const STEPS = 6;
/** How long after now the forecast is drawn, in seconds. */
const FORECASTS = [600, 1200, 1800];

export class Lookout {
  readonly #predictor: Predictor;
  readonly #apart: number;
  /** The forecasts of reports, by their times, each made `AHEAD` before. */
  readonly #forecasts = new Map<number, Gaussian>();
  #arrivals: { at: Moment | null; of: Map<number, Arriving> } = { at: null, of: new Map() };
  readonly moments: Moment[] = [];

  /** Owns `predictor`: a clone for each vessel. Its place is compared with its forecast every so many seconds. */
  constructor(predictor: Predictor, apart: number) {
    this.#predictor = predictor;
    this.#apart = apart;
  }

  /** Goes on by one report. */
  observe(report: Report): Moment {
    this.#follow(report);
    const moment = this.#moment(report);
    this.moments.push(moment);
    return moment;
  }

  /** Back to the first `count` reports: what was predicted at them stands. */
  rewind(count: number): void {
    this.moments.length = Math.min(count, this.moments.length);
    this.#predictor.reset();
    for (const { report } of this.moments) this.#follow(report);
    const last = this.latest?.report.time ?? -Infinity;
    for (const time of this.#forecasts.keys()) if (time > last + AHEAD) this.#forecasts.delete(time);
  }

  get latest(): Moment | null {
    return this.moments.at(-1) ?? null;
  }

  /** What the rule has found so far. */
  anomalies(): Anomaly[] {
    return episodes(this.moments.flatMap(({ finding }) => finding ?? []));
  }

  /** When it will be at a harbour, if it goes there: computed once for each report. */
  arrivalAt(harbour: number): Arriving | null {
    const { latest } = this;
    if (!latest) return null;
    if (this.#arrivals.at !== latest) this.#arrivals = { at: latest, of: new Map() };
    const kept = this.#arrivals.of.get(harbour);
    if (kept) return kept;
    const arrival = this.#predictor.arrival(HARBOURS[harbour]?.id);
    if (!arrival) return null;
    const { times, probabilities } = arrival;
    const arriving = { ...expected(arrival), times, probabilities };
    this.#arrivals.of.set(harbour, arriving);
    return arriving;
  }

  /** The harbours whose paths are worth drawing, the most probable first. */
  likely(): number[] {
    const { probabilities = new Float64Array() } = this.latest ?? {};
    const share = (index: number) => probabilities[index] ?? 0;
    return [...probabilities.keys()]
      .filter((index) => share(index) >= FAINT)
      .sort((i, j) => share(j) - share(i))
      .slice(0, PATHS);
  }

  /** The expected path to a harbour from the last report on; null where it would be there by now. */
  path(harbour: number): Path | null {
    const { latest } = this;
    const { id } = HARBOURS[harbour] ?? {};
    const time = this.arrivalAt(harbour)?.median;
    if (!latest || id === undefined || time === undefined || time <= latest.report.time) return null;
    const now = latest.report.time;
    const times = Array.from({ length: STEPS }, (_, i) => now + ((time - now) * (i + 1)) / STEPS);
    const path = this.#predictor.path(id, times);
    const places = times.map((_, i) => ({ x: path[2 * i] ?? 0, y: path[2 * i + 1] ?? 0 }));
    return { probability: latest.probabilities[harbour] ?? 0, places };
  }

  /** The density of its place ten, twenty and thirty minutes from now. */
  forecasts(): Gaussian[] {
    const { latest } = this;
    return latest ? FORECASTS.flatMap((ahead) => this.#predictor.forecast(latest.report.time + ahead) ?? []) : [];
  }

  free(): void {
    this.#predictor.free();
  }

  #follow({ time, x, y }: Report): void {
    const predictor = this.#predictor;
    predictor.observe(time, [x, y]);
    if (!predictor.expired) return;
    // no arrival time is left: followed anew from here
    predictor.reset();
    predictor.observe(time, [x, y]);
  }

  #moment(report: Report): Moment {
    const predictor = this.#predictor;
    const probabilities = predictor.probabilities();
    const { none, best } = predictor;
    const index = best?.index ?? 0;
    const velocity = this.#velocity(report);
    return { report, probabilities, none, best: index, velocity, ...this.#judge(report, velocity, none) };
  }

  /** Over the last reports, so that their errors cancel. */
  #velocity(report: Report): Place {
    const since = this.moments.findLast(({ report: { time } }) => report.time - time >= OVER)?.report ?? this.moments[0]?.report;
    const seconds = since ? report.time - since.time : 0;
    return since && seconds > 0 ? { x: (report.x - since.x) / seconds, y: (report.y - since.y) / seconds } : { x: 0, y: 0 };
  }

  /** The rule of anomaly.ts. */
  #judge(report: Report, velocity: Place, none: number): Pick<Moment, "deviations" | "finding"> {
    const { time } = report;
    const before = this.latest?.deviations ?? 0;
    const nowhere = none > NONE_LIMIT ? { time, kind: NOWHERE, deviations: 0, none } : null;
    if ((time - (this.moments[0]?.report.time ?? time)) % this.#apart !== 0) return { deviations: before, finding: nowhere };
    const forecast = this.#forecasts.get(time);
    const later = this.#predictor.forecast(time + AHEAD);
    if (later) this.#forecasts.set(time + AHEAD, later);
    const error = forecast ? deviations(report, forecast) : 0;
    if (!forecast || error <= LIMIT) return { deviations: error, finding: nowhere };
    return { deviations: error, finding: { time, kind: manner(velocity, forecast), deviations: error, none } };
  }
}
