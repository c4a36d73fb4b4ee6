/** One simulated gesture and what is predicted all along it, with and without `shake`. */
import type { Position } from "./cabin.ts";
import { follow, type Moment } from "./forecast.ts";
import { type Gesture, gesture } from "./gesture.ts";
import type { Road } from "./road.ts";
import { between } from "./vector.ts";

/** What is the case at one time of it. */
export interface Instant {
  /** Seconds since it began. */
  readonly seconds: number;
  /** The hand, and where it was before; in mm. */
  readonly trail: readonly Position[];
  /** The index of the last sample. */
  readonly at: number;
}

export class Replay {
  readonly gesture: Gesture;
  /** What is predicted by who expects shake, and by who does not. */
  readonly moments: { readonly shake: readonly Moment[]; readonly calm: readonly Moment[] };

  constructor(seed: number, road: Road) {
    this.gesture = gesture(seed, road);
    const { samples } = this.gesture;
    this.moments = { shake: follow(samples, true), calm: follow(samples, false) };
  }

  /** Seconds until the touch. */
  get duration(): number {
    return this.gesture.samples.at(-1)?.[0] ?? 0;
  }

  /** At a share of its time, from 0 to 1. The hand is drawn between samples; what is predicted is that of the last one. */
  instant(share: number): Instant {
    const { samples } = this.gesture;
    const seconds = share * this.duration;
    const at = Math.max(
      0,
      samples.findLastIndex(([time]) => time <= seconds + 1e-9),
    );
    const places = samples.slice(0, at + 2).map(([, x, y, z]): Position => [x, y, Math.max(0, z)]);
    const [from, to] = [places[at], places[at + 1]];
    if (!from || !to) return { seconds, trail: places, at };
    const [before = 0, after = 1] = [samples[at]?.[0], samples[at + 1]?.[0]];
    const way = (seconds - before) / (after - before);
    return { seconds, trail: [...places.slice(0, at + 1), between(from, to, Math.max(0, way))], at };
  }
}
