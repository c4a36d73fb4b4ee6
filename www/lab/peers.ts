/** Methods that name one target and give no probabilities: nearest, linear extrapolation, the browser's own prediction. */
import type { Prediction } from "./metrics.ts";
import { places, type Box, type Movement, type Place } from "./movement.ts";

/** The velocity between the newest of so many samples and the oldest, so many seconds ahead. */
export interface Extrapolation {
  readonly samples: number;
  readonly ahead: number;
}

/** The grid of `npm run evaluate` for pointers. */
export const GRID: readonly Extrapolation[] = [0.03, 0.06, 0.12, 0.2, 0.4, 0.6].flatMap((ahead) =>
  [2, 3, 4, 8].map((samples) => ({ samples, ahead })),
);

/** The target with the nearest middle, the first of equals. */
export function nearestTo([x, y]: Place, targets: readonly Box[]): number {
  let best = 0;
  let least = Infinity;
  targets.forEach((target, index) => {
    const distance = Math.hypot(target[0] - x, target[1] - y);
    if (distance < least) [best, least] = [index, distance];
  });
  return best;
}

export function nearest(movement: Movement, length: number): number[] {
  return places(movement)
    .slice(0, length)
    .map((place) => nearestTo(place, movement.targets));
}

export function extrapolation(movement: Movement, length: number, { samples, ahead }: Extrapolation): number[] {
  const all = places(movement);
  const end = (k: number): Place => {
    const back = Math.max(0, k - samples + 1);
    const here: Place = all[k] ?? [0, 0];
    const past = all[back] ?? here;
    const interval = (movement.samples[k]?.[0] ?? 0) - (movement.samples[back]?.[0] ?? 0);
    if (interval <= 0) return here;
    const factor = ahead / interval;
    return [here[0] + (here[0] - past[0]) * factor, here[1] + (here[1] - past[1]) * factor];
  };
  return Array.from({ length }, (_, k) => nearestTo(end(k), movement.targets));
}

/** The target nearest to where the browser expected the pointer; before it expected anything, nearest to the pointer. */
export function expected(movement: Movement, length: number): number[] | null {
  const ahead = movement.expected?.slice(0, length);
  if (!ahead?.some((place) => place !== null)) return null;
  const here = places(movement);
  return ahead.map((place, k) => nearestTo(place ?? here[k] ?? [0, 0], movement.targets));
}

/** Targets as predictions. */
export function named(tops: readonly number[] | null): Prediction[] | null {
  return tops?.map((top) => ({ top, probabilities: null })) ?? null;
}
