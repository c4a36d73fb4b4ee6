/** What is predicted, in words and numbers. */
import type { Anomaly } from "./anomaly.ts";
import { NOWHERE } from "./anomaly.ts";
import { timeOfDay, type Expected } from "./clock.ts";
import type { Harbour } from "./coast.ts";

export function percent(share: number): string {
  if (share > 0 && share < 0.005) return "<1%";
  if (share < 1 && share >= 0.995) return ">99%";
  return `${Math.round(share * 100)}%`;
}

/** Of a speed in m/s. */
export function knots(speed: number): string {
  return `${(speed * 1.943844).toFixed(0)} kn`;
}

/** "14:32, between 14:20 and 14:51". */
export function arrival({ median, low, high }: Expected): string {
  return `${timeOfDay(median)}, ${between({ low, high })}`;
}

export function between({ low, high }: Pick<Expected, "low" | "high">): string {
  return `between ${timeOfDay(low)} and ${timeOfDay(high)}`;
}

/** "13:39 turned back: 11.9 deviations from its forecast". */
export function anomaly({ kind, deviations, none }: Anomaly): string {
  return kind === NOWHERE
    ? `${kind}: none of them up to ${percent(none)}`
    : `${kind}: ${deviations.toFixed(1)} deviations from its forecast`;
}

export interface State {
  readonly time: number;
  /** The harbour whose basin it is in. */
  readonly harbour: Harbour | null;
  /** The most probable one. */
  readonly leading: Harbour;
  readonly probability: number;
  readonly none: number;
  readonly expected: Expected | null;
  /** What it does at this moment that no harbour explains. */
  readonly anomaly: Anomaly | null;
  /** Reports so far. */
  readonly reports: number;
}

/** The state in one sentence. */
export function sentence({ time, harbour, leading, probability, none, expected, anomaly: found, reports }: State): string {
  const now = timeOfDay(time);
  if (harbour) return `${now}: in the harbour of ${harbour.name}.`;
  if (reports < 2) return `${now}: first reported; every harbour is as likely as any other.`;
  if (found && found.kind !== NOWHERE) return `${now}: it ${found.kind}; ${rest({ leading, probability, none })}.`;
  if (none > 0.5) return `${now}: going to none of them, ${percent(none)}.`;
  if (probability < 0.5) return `${now}: not sure yet; ${leading.name} leads with ${percent(probability)}.`;
  const when = expected ? `; there at ${arrival(expected)}` : "";
  return `${now}: heading for ${leading.name}, ${percent(probability)}${when}.`;
}

function rest({ leading, probability, none }: Pick<State, "leading" | "probability" | "none">): string {
  return none > probability ? `none of them ${percent(none)}` : `${leading.name} ${percent(probability)}`;
}
