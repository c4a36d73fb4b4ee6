/** Times on the bay's clock. */
import type { ArrivalTime } from "whither";

const DAY = 86_400;

/** Seconds since midnight as hours and minutes. */
export function timeOfDay(seconds: number): string {
  const minutes = Math.floor((((seconds % DAY) + DAY) % DAY) / 60);
  return `${String(Math.floor(minutes / 60)).padStart(2, "0")}:${String(minutes % 60).padStart(2, "0")}`;
}

/** An arrival with the interval that holds it with a probability of 80%, in seconds on the bay's clock. */
export interface Expected {
  readonly median: number;
  readonly low: number;
  readonly high: number;
}

/**
 * Median and interval of an arrival time. The posterior is known at nodes; between them it is taken as spread evenly, each node's
 * share half way to both neighbours.
 */
export function expected({ times, probabilities }: ArrivalTime): Expected {
  return {
    median: quantile(times, probabilities, 0.5),
    low: quantile(times, probabilities, 0.1),
    high: quantile(times, probabilities, 0.9),
  };
}

function quantile(times: Float64Array, probabilities: Float64Array, share: number): number {
  let sum = 0;
  for (const [i, probability] of probabilities.entries()) {
    if (probability > 0 && sum + probability >= share) {
      const time = times[i] ?? 0;
      const from = i > 0 ? (time + (times[i - 1] ?? time)) / 2 : time;
      const to = i + 1 < times.length ? (time + (times[i + 1] ?? time)) / 2 : time;
      return from + ((share - sum) / probability) * (to - from);
    }
    sum += probability;
  }
  return times.at(-1) ?? 0;
}
