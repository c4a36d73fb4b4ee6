/** The areas of the stacked chart. */
import type { Moment } from "../history.ts";

/** Icons with an area of their own; the rest share one. */
export const OWN = 4;

export interface Band {
  readonly label: string;
  readonly values: readonly number[];
}

/** The one in question at the bottom, then the most probable ones over the complete movement, then all others together. */
export function bandsOf(moments: readonly Moment[], labels: readonly string[], first: number): Band[] {
  const weight = labels.map((_, index) => moments.reduce((sum, moment) => sum + (moment.probabilities[index] ?? 0), 0));
  const rest = labels.map((_, index) => index).filter((index) => index !== first);
  rest.sort((a, b) => (weight[b] ?? 0) - (weight[a] ?? 0));
  const own = [first, ...rest.slice(0, OWN - 1)];
  const others = rest.slice(OWN - 1);
  const of = (moment: Moment, index: number) => moment.probabilities[index] ?? 0;
  return [
    ...own.map((index) => ({ label: labels[index] ?? "", values: moments.map((moment) => of(moment, index)) })),
    { label: "Others", values: moments.map((moment) => others.reduce((sum, index) => sum + of(moment, index), 0)) },
  ];
}

/** Each column on top of the ones before it. */
export function stack(columns: readonly (readonly number[])[]): number[][] {
  const sums: number[][] = [];
  for (const column of columns) {
    const below = sums.at(-1);
    sums.push(column.map((value, index) => value + (below?.[index] ?? 0)));
  }
  return sums;
}
