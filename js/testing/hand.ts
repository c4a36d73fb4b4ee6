/**
 * The samples that a device reports while a hand goes to a target and presses.
 *
 * @module
 */
import { type Check, fields, isAbsent, missing, notNegative, number, positive, refuse } from "../core/read.js";
import { normal, random } from "./random.js";
import { type Course, contains, plan, type Target } from "./submovements.js";

/** Seconds since the movement's beginning, and px from the left and the top of the viewport. */
export type Sample = readonly [seconds: number, x: number, y: number];

/** A place, px from the left and the top of the viewport. */
export interface Point {
  readonly x: number;
  readonly y: number;
}

/**
 * A box by its left and top corner, px, as `element.getBoundingClientRect()` and Playwright's and Puppeteer's `boundingBox()` give it.
 */
export interface Box extends Point {
  readonly width: number;
  readonly height: number;
}

/** How a hand moves; all have defaults. */
export interface HandOptions {
  /** Another number, another movement; the same number, the same movement. @defaultValue 1 */
  readonly seed?: number | undefined;
  /** The width and height of a target that is given as a point, px. @defaultValue 40 */
  readonly size?: number | undefined;
  /** Samples a second while the pointer moves, at most 10 000. @defaultValue 125, as of a common mouse */
  readonly rate?: number | undefined;
  /**
   * What coordinates are multiples of, px; nothing is reported while they stay the same. 0: coordinates as they are, in every sample, as pens
   * and trackers have them. @defaultValue 1, as of a common mouse
   */
  readonly resolution?: number | undefined;
  /** How many times as long everything takes as it does a person with a mouse, at most 100. @defaultValue 1 */
  readonly pace?: number | undefined;
  /**
   * How much of what makes movements differ: 0 is one straight movement of minimum jerk to the middle of the target, 1 a person's, more (at
   * most 3) one with less skill. @defaultValue 1
   */
  readonly noise?: number | undefined;
  /** Seconds for which the pointer rests before the press. @defaultValue drawn: a median of 0.12 */
  readonly dwell?: number | undefined;
  /**
   * What share of the time to the arrival there are samples of, above 0 and at most 1: less than 1 stops on the way, with no dwell.
   * @defaultValue 1
   */
  readonly share?: number | undefined;
  /** Whether the press may be beside the target, as about one in a hundred of a person's is. @defaultValue false */
  readonly mistakes?: boolean | undefined;
}

const KEYS = ["seed", "size", "rate", "resolution", "pace", "noise", "dwell", "share", "mistakes"];

/** The median seconds of the dwell, and the deviation of its logarithm: as recorded. */
const DWELL = { median: 0.12, spread: 0.7 };

/** What reports a hand's movement. */
interface Device {
  readonly rate: number;
  readonly resolution: number;
}

/** A mouse that is pushed by less than this, of its resolution, stays where it is: as recorded, a pointer at rest does not tremble. */
const FRICTION = 0.75;

/**
 * The samples of a hand that goes to a target and presses there: what a mouse reports, so integer pixels, and none while the pointer does not
 * move. The first is where it is from, at 0 s. The last is the press, after a rest; with `share` it is on the way.
 *
 * @param from - Where the pointer is: a point, or the middle of a box.
 * @param to - What is pressed: a box, or a point in the middle of a target of `options.size`. `null`, which `boundingBox()` gives for an
 * element that is not visible, is an error.
 * @param options - The seed and the manner.
 * @throws {@link WhitherError} `missing-key`, `unknown-key`, `wrong-type`, `not-finite`, `out-of-range`, with the path of what is wrong.
 *
 * @example
 * ```ts
 * import { hand } from "whither/testing";
 *
 * const samples = hand({ x: 100, y: 600 }, { x: 700, y: 80, width: 90, height: 40 }, { seed: 3 });
 * for (const [seconds, x, y] of samples) console.log(`${seconds.toFixed(3)} s: ${x}, ${y}`);
 * ```
 */
export function hand(from: Point | Box | null, to: Point | Box | null, options: HandOptions = {}): Sample[] {
  const { seed, size, rate, resolution, dwell, share, ...manner } = readOptions(options);
  const { x, y } = readPlace(from, "from", size);
  const target = readPlace(to, "to", size);
  const uniform = random(seed);
  const course = plan({ x, y }, target, manner, uniform);
  const samples = report(course, target, { rate, resolution }, manner.mistakes);
  if (share < 1) {
    const arrival = arrivalOf(samples, target);
    return samples.filter(([time]) => time <= share * arrival);
  }
  const drawn = manner.pace * DWELL.median * Math.exp(DWELL.spread * manner.noise * normal(uniform)());
  const rest = dwell ?? drawn;
  const [end, ...place] = samples.at(-1) as Sample;
  if (rest > 0) samples.push([end + rest, ...place]);
  return samples;
}

/** What a device reports of a course. */
function report(course: Course, target: Target, device: Device, mistakes: boolean): Sample[] {
  const { rate, resolution } = device;
  const start = course.at(0);
  let [x, y] = [start.x, start.y].map((at) => rounded(at, resolution)) as [number, number];
  const samples: Sample[] = [[0, x, y]];
  const count = Math.ceil(course.duration * rate - 1e-9);
  for (let k = 1; k <= count; k += 1) {
    const hand = course.at(k / rate);
    const isLast = k === count;
    const pushed = (pointer: number, to: number) =>
      isLast || Math.abs(to - pointer) >= FRICTION * resolution ? rounded(to, resolution) : pointer;
    let [nextX, nextY] = [pushed(x, hand.x), pushed(y, hand.y)];
    // without mistakes it comes to rest in the target, however small that is
    if (isLast && !mistakes) {
      nextX = within(nextX, target.x, target.width);
      nextY = within(nextY, target.y, target.height);
    }
    if (resolution > 0 && nextX === x && nextY === y) continue;
    [x, y] = [nextX, nextY];
    samples.push([k / rate, x, y]);
  }
  return samples;
}

/** To a multiple of the resolution, never -0. */
function rounded(x: number, resolution: number): number {
  return resolution === 0 ? x : resolution * Math.round(x / resolution) + 0;
}

function within(x: number, middle: number, size: number): number {
  return Math.max(middle - size / 2, Math.min(middle + size / 2, x));
}

/** When the pointer enters the target for the last time; where it does not, when it stops. */
function arrivalOf(samples: readonly Sample[], target: Target): number {
  const inside = samples.map(([, x, y]) => contains(target, { x, y }, 1));
  const entry = inside.lastIndexOf(false) + 1;
  const [time] = samples[entry === 0 || entry === samples.length ? samples.length - 1 : entry] as Sample;
  return time;
}

function readOptions(given: unknown) {
  const options = isAbsent(given) ? {} : fields(given, "", KEYS, "options");
  const read = <T>(key: keyof HandOptions, otherwise: T, check: (value: unknown, path: string) => T) =>
    isAbsent(options[key]) ? otherwise : check(options[key], key);
  return {
    seed: read("seed", 1, number),
    size: read("size", 40, positive),
    rate: read("rate", 125, atMost(10_000, positive)),
    resolution: read("resolution", 1, atMost(100, notNegative)),
    pace: read("pace", 1, atMost(100, positive)),
    noise: read("noise", 1, atMost(3, notNegative)),
    dwell: read<number | null>("dwell", null, notNegative),
    share: read("share", 1, atMost(1, positive)),
    mistakes: read("mistakes", false, flag),
  };
}

function atMost(most: number, check: Check): Check {
  return (value, path) => {
    const x = check(value, path);
    return x <= most ? x : refuse("out-of-range", path, `must be at most ${most}`, x);
  };
}

function flag(value: unknown, path: string): boolean {
  return typeof value === "boolean" ? value : refuse("wrong-type", path, "must be a boolean", value);
}

/** A place by its middle and size. Boxes may be of a class with more properties, such as DOMRect. */
function readPlace(given: unknown, path: string, size: number): Target {
  if (isAbsent(given)) missing(path);
  if (typeof given !== "object") refuse("wrong-type", path, "must be a point or a box", given);
  const place = given as Partial<Box>;
  const [x, y] = [number(place.x, `${path}.x`), number(place.y, `${path}.y`)];
  if (place.width === undefined && place.height === undefined) return { x, y, width: size, height: size };
  const [width, height] = [positive(place.width, `${path}.width`), positive(place.height, `${path}.height`)];
  return { x: x + width / 2, y: y + height / 2, width, height };
}
