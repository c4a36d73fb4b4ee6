/** Recorded movements, and the lines of JSON that `npm run evaluate` and `fit` of `whither/study` read. */

/** A target by its middle and its size, in px. */
export type Box = readonly [x: number, y: number, width: number, height: number];

export type Place = readonly [x: number, y: number];

/** Seconds, and px from the left and the top; null for a coordinate that was not recorded. */
export type Sample = readonly [seconds: number, x: number | null, y: number | null];

/** One movement to one of several targets. */
export interface Movement {
  readonly id: string;
  /** Who moved. */
  readonly user: string;
  readonly targets: readonly Box[];
  /** The place in `targets` of the one that was pressed. */
  readonly target: number;
  readonly samples: readonly Sample[];
  /**
   * Where the browser expected the pointer by `getPredictedEvents`, sample by sample: the last place of its latest list, null
   * before there was one. Lines do not carry it.
   */
  readonly expected?: readonly (Place | null)[];
}

/** What is wrong with a line of a file, counted from 1. */
export interface Broken {
  readonly line: number;
  readonly message: string;
}

export function contains([x, y, width, height]: Box, [px, py]: Place): boolean {
  return Math.abs(px - x) <= width / 2 && Math.abs(py - y) <= height / 2;
}

/** Where the pointer was at each sample; a coordinate that is missing repeats the one before it, at the start the one after it. */
export function places({ samples }: Pick<Movement, "samples">): Place[] {
  let x = samples.find((sample) => sample[1] !== null)?.[1] ?? 0;
  let y = samples.find((sample) => sample[2] !== null)?.[2] ?? 0;
  return samples.map((sample) => [(x = sample[1] ?? x), (y = sample[2] ?? y)]);
}

/**
 * How many samples the approach has: up to and with the last entry into the target. Null where the movement never enters it, or
 * begins in it and stays.
 */
export function approachOf({ targets, target, samples }: Movement): number | null {
  const box = targets[target];
  let entry = 0;
  let inside = false;
  samples.forEach(([, x, y], index) => {
    if (!box || x === null || y === null) return;
    const now = contains(box, [x, y]);
    if (now && !inside) entry = index;
    inside = now;
  });
  return entry > 0 ? entry + 1 : null;
}

export function writeLine({ id, user, targets, target, samples }: Movement): string {
  return JSON.stringify({ id, user, targets, target, samples });
}

/** Reads a file: what can be read, and what is wrong with each of the other lines. Empty lines are skipped. */
export function readLines(text: string): { movements: Movement[]; broken: Broken[] } {
  const movements: Movement[] = [];
  const broken: Broken[] = [];
  text.split("\n").forEach((line, index) => {
    if (line.trim() === "") return;
    try {
      movements.push(readLine(line));
    } catch (error) {
      broken.push({ line: index + 1, message: error instanceof Error ? error.message : String(error) });
    }
  });
  return { movements, broken };
}

const KEYS = ["id", "user", "targets", "target", "samples"];

function readLine(line: string): Movement {
  let value: unknown;
  try {
    value = JSON.parse(line);
  } catch {
    throw new Error(`is no JSON: ${quoted(line)}`);
  }
  if (typeof value !== "object" || value === null || Array.isArray(value)) throw wrong("", "must be an object", value);
  const unknown = Object.keys(value).find((key) => !KEYS.includes(key));
  if (unknown) throw new Error(`${unknown}: unknown key, expected one of ${KEYS.join(", ")}`);
  const { id, user, targets, target, samples } = value as Record<string, unknown>;
  const boxes = list(targets, "targets").map(readBox);
  if (typeof target !== "number" || !Number.isInteger(target) || target < 0 || target >= boxes.length) {
    throw wrong("target", `must be the place of one of the ${boxes.length} targets, counted from 0`, target);
  }
  return { id: readName(id, "id"), user: readName(user, "user"), targets: boxes, target, samples: readSamples(samples) };
}

/** A text, or a number as one; empty where it was left out. */
function readName(value: unknown, path: string): string {
  if (value === undefined) return "";
  if (typeof value !== "string" && typeof value !== "number") throw wrong(path, "must be a text or a number", value);
  return String(value);
}

function readBox(value: unknown, index: number): Box {
  const path = `targets[${index}]`;
  const [x, y, width, height] = four(value, path);
  if (!(width > 0 && height > 0)) throw wrong(path, "must have a width and a height above 0", value);
  return [x, y, width, height];
}

function four(value: unknown, path: string): [number, number, number, number] {
  const numbers = list(value, path).map((each, i) => finite(each, `${path}[${i}]`));
  const [x, y, width, height] = numbers;
  if (numbers.length !== 4 || x === undefined || y === undefined || width === undefined || height === undefined) {
    throw wrong(path, "must be [x, y, width, height]", value);
  }
  return [x, y, width, height];
}

function readSamples(value: unknown): Sample[] {
  const samples = list(value, "samples").map((each, index): Sample => {
    const path = `samples[${index}]`;
    const [time, x = null, y = null, ...more] = list(each, path);
    if (more.length > 0) throw new Error(`${path}: has ${more.length + 2} coordinates; the lab reads movements in the plane`);
    const axis = (coordinate: unknown, place: number) => (coordinate === null ? null : finite(coordinate, `${path}[${place}]`));
    return [finite(time, `${path}[0]`), axis(x, 1), axis(y, 2)];
  });
  samples.forEach(([time], index) => {
    const before = samples[index - 1]?.[0] ?? time;
    if (time < before) throw wrong(`samples[${index}]`, `must not be before the sample at ${before}`, samples[index]);
  });
  for (const axis of [1, 2] as const) {
    if (samples.every((sample) => sample[axis] === null)) {
      throw wrong("samples", `must have a number at least once for axis ${axis - 1}`, value);
    }
  }
  return samples;
}

function list(value: unknown, path: string): readonly unknown[] {
  if (value === undefined) throw new Error(`${path}: is missing`);
  if (!Array.isArray(value)) throw wrong(path, "must be a list", value);
  if (value.length === 0) throw wrong(path, "must not be empty", value);
  return value;
}

function finite(value: unknown, path: string): number {
  return typeof value === "number" && Number.isFinite(value)
    ? value
    : (() => {
        throw wrong(path, "must be a number", value);
      })();
}

function wrong(path: string, must: string, value: unknown): Error {
  return new Error(`${path ? `${path}: ` : ""}${must}, got ${quoted(value)}`);
}

/** A value in a message, cut where it is long. */
function quoted(value: unknown): string {
  const text = typeof value === "string" ? value : (JSON.stringify(value) ?? String(value));
  return text.length > 60 ? `${text.slice(0, 60)}…` : text;
}
