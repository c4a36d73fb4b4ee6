/** Numbers and results in words, the same everywhere on the page. */
import type { Movement } from "./movement.ts";
import type { Comparison, Row, Trace } from "./tally.ts";
import { methodOf } from "./methods.ts";

export const NOTHING = "–";

export function percent(value: number | null): string {
  return value === null ? NOTHING : `${value.toFixed(0)}%`;
}

export function milliseconds(value: number): string {
  return `${value.toFixed(0)} ms`;
}

export function nats(value: number | null): string {
  return value === null ? NOTHING : value.toFixed(3);
}

/** A number that may be below 0. */
export function signed(value: number, digits: number): string {
  return value.toFixed(digits).replace("-", "−");
}

export function count(number: number, one: string, many = `${one}s`): string {
  return `${number.toLocaleString("en")} ${number === 1 ? one : many}`;
}

/** Which method leads, as far as the movements show. */
export function leading(comparison: Comparison | null, rows: readonly Row[]): string {
  const first = rows[0];
  if (!first || first.figures.movements === 0) return "No movement yet.";
  if (!comparison) return "One movement shows nothing about which method is better.";
  const { leader, next, mean, half } = comparison;
  const interval = `${signed(mean - half, 1)} to ${signed(mean + half, 1)}`;
  const names = `${methodOf(leader).name} leads ${methodOf(next).name} by ${mean.toFixed(1)} points`;
  return mean - half > 0
    ? `${names} of time (95% interval ${interval}).`
    : `${names} of time, which is within chance: the 95% interval is ${interval}.`;
}

/** Why a method was not scored on all movements; null where it was. */
export function reasonFor(row: Row, movements: number, isOwn: boolean): string | null {
  if (row.figures.movements === movements) return null;
  if (row.id !== "predicted") return `on ${row.figures.movements} of ${movements} movements`;
  if (row.figures.movements > 0) return `the browser predicted in ${row.figures.movements} of ${movements} movements`;
  if (!isOwn) return "a simulated hand has no browser that predicts it";
  return "getPredictedEvents" in PointerEvent.prototype ? "not recorded with these movements" : "this browser does not have it";
}

/** That a movement was recorded, and once it is scored how it was predicted. */
export function recorded({ samples }: Pick<Movement, "samples">, trace: Pick<Trace, "lead"> | null): string {
  const seconds = (samples.at(-1)?.[0] ?? 0) - (samples[0]?.[0] ?? 0);
  const taken = `Recorded, ${seconds.toFixed(2)} s`;
  if (!trace) return `${taken}.`;
  return trace.lead > 0
    ? `${taken}: the pointing model was right for the last ${milliseconds(1000 * trace.lead)} before the entry.`
    : `${taken}: the pointing model was not right before the entry.`;
}
