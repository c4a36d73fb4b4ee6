/**
 * Simulated gestures of a driver's hand from the steering wheel or the gear lever to an icon, in mm and seconds: the same as
 * those with which `npm run reproduce` repeats the papers' experiments, but for the road, which can be chosen.
 */
import { random } from "whither/testing";
import { ICON, type Position, STARTS, TARGETS } from "./cabin.ts";
import { type Road, shaking } from "./road.ts";
import { between, cross, length, minus, plus, times, unit } from "./vector.ts";

/** What a tracker reports: seconds, then mm. */
export type Sample = readonly [seconds: number, x: number, y: number, z: number];

export interface Gesture {
  /** The last one is the touch. */
  readonly samples: readonly Sample[];
  /** The index of the icon that is touched. */
  readonly target: number;
}

/** Samples a second. */
export const RATE = 50;
/** The deviation of a tracked coordinate. */
export const TRACKED = 2;

const CONSTANTS = {
  /** Deviation of where the hand is before. */
  start: 25,
  /** Fitts's law, MacKenzie's form: seconds, and the deviation of their logarithm. */
  duration: { base: 0.3, perBit: 0.12, spread: 0.2 },
  /** Two movements of minimum jerk (Flash and Hogan): the first in this share of the time, the second from this share on. */
  first: 0.7,
  second: 0.55,
  /** The first falls short by this share of the way, and misses by these. */
  short: 0.04,
  along: 0.06,
  across: 0.025,
  /** The bow's height, of the way. */
  bow: 0.03,
  /** Tremor, a sine on each axis. */
  tremor: { amplitude: 0.7, from: 8, to: 11 },
} as const;

export function gesture(seed: number, road: Road): Gesture {
  const c = CONSTANTS;
  const uniform = random(seed);
  const normal = () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
  const vector = (deviation: number): Position => [deviation * normal(), deviation * normal(), deviation * normal()];

  const target = Math.floor(uniform() * TARGETS.length);
  const { x, y } = TARGETS[target] as (typeof TARGETS)[0];
  const origin = STARTS[Math.floor(uniform() * STARTS.length)] as Position;
  const start = plus(origin, vector(c.start));
  const [aimX, aimY] = vector(ICON / 8);
  const end: Position = [x + aimX, y + aimY, 0];
  const way = minus(end, start);
  const distance = length(way);
  const { base, perBit, spread } = c.duration;
  const duration = (base + perBit * Math.log2(distance / ICON + 1)) * Math.exp(spread * normal());
  const first = plus(end, plus(vector(c.across * distance), times(c.along * normal() - c.short, way)));
  const bow = times(c.bow * distance * normal(), unit(cross(way, vector(1))));
  const axis = () => ({ rate: c.tremor.from + (c.tremor.to - c.tremor.from) * uniform(), phase: 2 * Math.PI * uniform() });
  const axes = [axis(), axis(), axis()] as const;
  const shaken = shaking(road, seed + 0.5);

  const at = (seconds: number): Sample => {
    const share = seconds / duration;
    const planned = plus(
      plus(
        between(start, first, minimumJerk(share / c.first)),
        times(minimumJerk((share - c.second) / (1 - c.second)), minus(end, first)),
      ),
      times(Math.sin(Math.PI * Math.min(1, share)), bow),
    );
    const tremble = (of: (typeof axes)[0]) => c.tremor.amplitude * Math.sin(2 * Math.PI * of.rate * seconds + of.phase);
    const hand = plus(planned, [tremble(axes[0]), tremble(axes[1]), tremble(axes[2])]);
    return [seconds, ...plus(plus(hand, shaken(seconds)), vector(TRACKED))];
  };
  return { samples: Array.from({ length: Math.ceil(duration * RATE) + 1 }, (_, k) => at(k / RATE)), target };
}

/** The share of the way at a share of the time. */
function minimumJerk(share: number): number {
  const time = Math.min(1, Math.max(0, share));
  return time ** 3 * (10 - 15 * time + 6 * time ** 2);
}
