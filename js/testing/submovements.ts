/**
 * How a hand goes to a target: a ballistic first movement that roughly gets there, and corrections until it does, each on the way before
 * the one before it is quite over. Which constants are from where: {@link CONSTANTS}.
 *
 * @module
 */
import { normal } from "./random.js";

export interface Vector {
  readonly x: number;
  readonly y: number;
}

/** A target by its centre and size, px. */
export interface Target extends Vector {
  readonly width: number;
  readonly height: number;
}

/** A movement of minimum jerk along a bow. */
interface Submovement {
  /** Seconds. */
  readonly start: number;
  readonly duration: number;
  /** px. */
  readonly by: Vector;
  /** Where the bow is highest, from the straight line, px. */
  readonly bow: Vector;
}

export interface Manner {
  readonly pace: number;
  readonly noise: number;
  readonly mistakes: boolean;
}

/**
 * Seconds, px and radians. The forms are the literature's, as named; the values without a source were fitted to recorded mice, three sets of
 * 149 users and 6401 movements together, so that the figures of docs/testing.md come near those of the recordings.
 */
const CONSTANTS = {
  /** How long the first movement takes by Fitts's law in MacKenzie's form (1992): `base + perBit log2(d/size + 1)`. */
  first: { base: 0.14, perBit: 0.01 },
  /** The same of a correction. */
  correction: { base: 0.17, perBit: 0.08 },
  /** Deviation of the logarithm of how long everything takes, from movement to movement. */
  paceSpread: 0.13,
  /** The same of a single part. */
  partSpread: 0.1,
  /** Where in the target it is aimed at: deviation, of its size. */
  aim: 0.21,
  /** Signal-dependent noise (Schmidt et al. 1979; Meyer et al. 1988; Harris and Wolpert 1998): a deviation of this times the mean speed. */
  noise: { along: 0.04, across: 0.019 },
  /** The mean share by which the first movement is too short: exponentially, so that it goes too far less often (Meyer et al. 1988). */
  short: 0.16,
  shortMost: 0.9,
  /** The height of the bow: `height (200/d)^exponent` of the way, normally distributed, its logarithm with so much `tail`. */
  bow: { height: 0.078, exponent: 0.11, tail: 0.93, most: 0.6 },
  /** A correction begins so long after the end of what it corrects; negative where they overlap (Flash and Henis 1991). */
  gap: { mean: -0.06, spread: 0.26 },
  /** But no sooner after its beginning than what is visible of it can count (Carlton 1981). */
  feedback: 0.135,
  /** There is no correction within this share of the target. */
  margin: 0.89,
  /** How well it is judged whether the pointer is within, where it may be mistaken: deviation. */
  judgement: 2,
  /** What the hand did before is still in it: a short movement somewhere else, so much ahead of the first. */
  before: { length: 32, spread: 0.7, most: 1 / 3, angle: 1.3, duration: 0.075, ahead: 0.08 },
  /** Physiological tremor, 8 to 12 Hz (McAuley and Marsden 2000): deviation. */
  tremor: { amplitude: 0.35, from: 8, to: 12 },
} as const;

/** How many movements it takes at most; the last one is exact. */
const MOST = 8;

/** Whether a place is within a share of a target, of both its sides. */
export function contains(target: Target, { x, y }: Vector, share: number): boolean {
  return Math.abs(x - target.x) <= (share * target.width) / 2 && Math.abs(y - target.y) <= (share * target.height) / 2;
}

const clamp = (value: number, most: number) => Math.max(-most, Math.min(most, value));

/** Where a hand is at any time. */
export interface Course {
  /** Seconds until its last movement is over. */
  readonly duration: number;
  at(seconds: number): Vector;
}

/** Plans a course. `uniform` gives numbers from 0 to 1. */
export function plan(from: Vector, target: Target, manner: Manner, uniform: () => number): Course {
  const parts = submovements(from, target, manner, uniform);
  const duration = Math.max(0, ...parts.map((part) => part.start + part.duration));
  const tremor = { x: trembling(uniform), y: trembling(uniform) };
  return {
    duration,
    at(seconds) {
      let { x, y } = from;
      for (const part of parts) {
        const time = Math.min(1, Math.max(0, (seconds - part.start) / part.duration));
        // minimum jerk (Flash and Hogan 1985)
        const way = time ** 3 * (10 - 15 * time + 6 * time ** 2);
        const height = Math.sin(Math.PI * way);
        x += way * part.by.x + height * part.bow.x;
        y += way * part.by.y + height * part.bow.y;
      }
      const moves = seconds > 0 && seconds < duration ? manner.noise : 0;
      return { x: x + moves * tremor.x(seconds), y: y + moves * tremor.y(seconds) };
    },
  };
}

function submovements(from: Vector, target: Target, { pace, noise, mistakes }: Manner, uniform: () => number): Submovement[] {
  const c = CONSTANTS;
  const draw = normal(uniform);
  const n = () => noise * draw();
  const slowness = pace * Math.exp(c.paceSpread * n());
  const aside = () => clamp(c.aim * n(), c.margin / 2);
  const aim = { x: target.x + target.width * aside(), y: target.y + target.height * aside() };
  const judge = ({ x, y }: Vector) => (mistakes ? { x: x + c.judgement * n(), y: y + c.judgement * n() } : { x, y });
  const parts: Submovement[] = [];
  let place = from;
  let start = 0;
  const add = (part: Submovement) => {
    parts.push(part);
    place = { x: place.x + part.by.x, y: place.y + part.by.y };
  };
  if (noise > 0) {
    add(before(from, aim, slowness, noise, draw));
    start = Math.min(1, noise) * slowness * c.before.ahead;
  }
  for (let count = 1; count <= MOST; count += 1) {
    const isFirst = count === 1;
    const way = { x: aim.x - place.x, y: aim.y - place.y };
    const distance = Math.hypot(way.x, way.y);
    if (distance === 0) break;
    const { base, perBit } = isFirst ? c.first : c.correction;
    const bits = Math.log2(distance / Math.min(target.width, target.height) + 1);
    const duration = slowness * (base + perBit * bits) * Math.exp(c.partSpread * n());
    const error = () => (count === MOST ? 0 : (pace / duration) * n());
    const short = isFirst ? Math.min(c.shortMost, -noise * c.short * Math.log(1 - uniform())) : 0;
    const [along, across] = [1 - short + c.noise.along * error(), c.noise.across * error()];
    const high = c.bow.height * (200 / Math.max(50, distance)) ** c.bow.exponent * n() * Math.exp(c.bow.tail * n());
    const bow = clamp(high, c.bow.most);
    add({
      start,
      duration,
      by: { x: along * way.x - across * way.y, y: along * way.y + across * way.x },
      bow: { x: -bow * way.y, y: bow * way.x },
    });
    if (contains(target, judge(place), c.margin)) break;
    start += Math.max(c.feedback, duration + pace * (c.gap.mean + c.gap.spread * n()));
  }
  return parts;
}

/** What is left of the movement before. */
function before(from: Vector, aim: Vector, slowness: number, noise: number, draw: () => number): Submovement {
  const { length, spread, most, angle, duration } = CONSTANTS.before;
  const [x, y] = [aim.x - from.x, aim.y - from.y];
  const direction = Math.atan2(y, x) + noise * angle * draw();
  const way = Math.min(most * Math.hypot(x, y), noise * length * Math.exp(spread * draw()));
  const by = { x: way * Math.cos(direction), y: way * Math.sin(direction) };
  return { start: 0, duration: slowness * duration, by, bow: { x: 0, y: 0 } };
}

function trembling(uniform: () => number): (seconds: number) => number {
  const { amplitude, from, to } = CONSTANTS.tremor;
  const frequency = from + (to - from) * uniform();
  const phase = 2 * Math.PI * uniform();
  return (seconds) => Math.SQRT2 * amplitude * Math.sin(2 * Math.PI * frequency * seconds + phase);
}
