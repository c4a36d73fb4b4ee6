/** The areas of the stacked chart: an icon has its place and its colour from where it is first noticed to the end of the movement. */
import type { Moment } from "../history.ts";

/** Icons with an area of their own; the rest share one. */
export const OWN = 5;

/** An icon as probable as the first gets an area of its own while there is one; as probable as the second, another icon's. */
const NOTICED = 0.15;
const LEADING = 0.5;

export interface Band {
  readonly label: string;
  readonly values: readonly number[];
}

/** From the bottom: the icons in the order in which they were noticed, all others, none of them. Together they are 100%. */
export function bandsOf(moments: readonly Moment[], labels: readonly string[]): Band[] {
  const own = noticed(moments);
  const of = (moment: Moment, index: number | undefined) => (index === undefined ? 0 : (moment.probabilities[index] ?? 0));
  const sum = ({ probabilities }: Moment) => probabilities.reduce((total, each) => total + each, 0);
  const bands = Array.from({ length: OWN }, (_, place) => {
    const index = own[place];
    return { label: labels[index ?? -1] ?? "", values: moments.map((moment) => of(moment, index)) };
  });
  const others = moments.map((moment) => own.reduce((rest, index) => rest - of(moment, index), sum(moment)));
  return [
    ...bands,
    { label: "Others", values: others.map((value) => Math.max(0, value)) },
    { label: "None of them", values: moments.map((moment) => Math.max(0, 1 - sum(moment))) },
  ];
}

/** The icons that have an area, by its place. */
function noticed(moments: readonly Moment[]): number[] {
  const own: number[] = [];
  const most = new Map<number, number>();
  for (const { probabilities } of moments) {
    probabilities.forEach((probability, index) => {
      most.set(index, Math.max(probability, most.get(index) ?? 0));
      if (own.includes(index) || probability < NOTICED) return;
      if (own.length < OWN) own.push(index);
      else if (probability >= LEADING) own[own.indexOf(least(own, most))] = index;
    });
  }
  return own;
}

/** The one that has never been probable. */
function least(own: readonly number[], most: ReadonlyMap<number, number>): number {
  return own.reduce((one, other) => ((most.get(other) ?? 0) < (most.get(one) ?? 0) ? other : one));
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

/** Where a name fits into an area: in x's units the middle, and how far it reaches to both sides; in shares of the height the middle and the room. */
export interface Spot {
  readonly x: number;
  readonly y: number;
  readonly room: number;
}

/** The place with most room for a name `half` wide to both sides that touches none of the lines at `avoid`; null where there is none. */
export function spotOf(
  xs: readonly number[],
  lower: readonly number[],
  upper: readonly number[],
  half: number,
  avoid: readonly number[],
): Spot | null {
  let best: Spot | null = null;
  const [from = 0, to = 0] = [xs[0], xs.at(-1)];
  for (const x of xs) {
    if (x - half < from || x + half > to || avoid.some((line) => Math.abs(line - x) < half)) continue;
    let [floor, ceiling] = [0, 1];
    xs.forEach((at, index) => {
      // the samples beside the name too: the edge goes from one to the next
      const near = Math.min(Math.abs(at - x), Math.abs((xs[index - 1] ?? at) - x), Math.abs((xs[index + 1] ?? at) - x));
      if (near > half) return;
      floor = Math.max(floor, lower[index] ?? 0);
      ceiling = Math.min(ceiling, upper[index] ?? 0);
    });
    if (ceiling - floor > (best?.room ?? 0)) best = { x, y: (floor + ceiling) / 2, room: ceiling - floor };
  }
  return best;
}
