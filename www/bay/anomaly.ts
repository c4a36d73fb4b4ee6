/**
 * When a vessel does what no harbour explains. The rule, as the page states it: its place is compared with where it was forecast
 * six minutes before; more than six deviations are an anomaly, and so is "none of them" above 80%.
 */
import type { Gaussian } from "whither";
import type { Place } from "./coast.ts";
import { REPORTED } from "./scenario.ts";

/** How long before a report it is forecast, in seconds. */
export const AHEAD = 360;
/** Deviations. */
export const LIMIT = 6;
/** Episodes less than so many seconds apart are one. */
const PAUSE = 900;
/** Of the expected speed: less is a stop. */
const STOPPED = 0.35;

export type Kind = "turned back" | "stopped" | "sped up" | "left its course" | "goes where no harbour is";

/** From this probability of "none of them" on. */
export const NONE_LIMIT = 0.8;

export const NOWHERE: Kind = "goes where no harbour is";

/** What was found at one report. */
export interface Finding {
  readonly time: number;
  readonly kind: Kind;
  /** From the forecast; 0 where none was made. */
  readonly deviations: number;
  readonly none: number;
}

/** One episode: from its first report to its last, with its largest numbers. */
export interface Anomaly extends Finding {
  readonly until: number;
}

/** How many deviations a reported place is from its forecast: the Mahalanobis distance, with the report's own error. */
export function deviations({ x, y }: Place, forecast: Gaussian): number {
  const [dx, dy] = [x - part(forecast, 0), y - part(forecast, 1)];
  const states = forecast.mean.length;
  const xx = (forecast.covariance[0] ?? 0) + REPORTED ** 2;
  const xy = forecast.covariance[1] ?? 0;
  const yy = (forecast.covariance[states + 1] ?? 0) + REPORTED ** 2;
  return Math.sqrt((yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / (xx * yy - xy * xy));
}

/** What happened, from the velocity now, in m/s, and the one that was forecast. */
export function manner({ x, y }: Place, forecast: Gaussian): Kind {
  const [u, v] = [part(forecast, 2), part(forecast, 3)];
  if (Math.hypot(x, y) < STOPPED * Math.hypot(u, v)) return "stopped";
  const along = (x * u + y * v) / Math.hypot(u, v);
  // faster than forecast by more than it is off to the side
  if (along - Math.hypot(u, v) > Math.abs(x * v - y * u) / Math.hypot(u, v)) return "sped up";
  return along < 0 ? "turned back" : "left its course";
}

function part({ mean }: Gaussian, index: number): number {
  return mean[index] ?? 0;
}

/**
 * Joins findings, in the order of time, to episodes. What a vessel does on leaving its forecast is one episode, called after its
 * largest deviation; that it goes where no harbour is is another.
 */
export function episodes(findings: Iterable<Finding>): Anomaly[] {
  const found: Anomaly[] = [];
  for (const finding of findings) {
    const index = found.findLastIndex(({ kind, until }) => alike(kind, finding.kind) && finding.time - until <= PAUSE);
    const before = found[index];
    if (!before) found.push({ ...finding, until: finding.time });
    else {
      found[index] = {
        time: before.time,
        until: finding.time,
        kind: finding.deviations > before.deviations ? finding.kind : before.kind,
        deviations: Math.max(before.deviations, finding.deviations),
        none: Math.max(before.none, finding.none),
      };
    }
  }
  return found;
}

function alike(one: Kind, other: Kind): boolean {
  return (one === NOWHERE) === (other === NOWHERE);
}
