import { WhitherError } from "#error";
import type { ConstantVelocity, Observation, Pointing, Scenario, Vector } from "../core/scenario.js";
import { type Check, fields, isAbsent, list, notNegative, number, positive, refuse } from "../core/read.js";

/** Some of the numbers of an object, and of the objects in it. */
export type DeepPartial<T> = {
  readonly [K in keyof T]?: T[K] extends number | Vector | undefined ? T[K] : DeepPartial<NonNullable<T[K]>> | undefined;
};

/**
 * Constants in a scenario's own form: what `fit` of `whither/study` returns as `scenario`, or any part of it. What is left out
 * is as {@link index!pointerScenario} has it.
 */
export interface PointerConstants extends Partial<Pick<Scenario, "method" | "none" | "destinations">> {
  /** The filter's noise. */
  readonly motion?: DeepPartial<ConstantVelocity> | undefined;
  /** How positions are observed: a deviation, or one for each axis. */
  readonly observation?: Pick<Observation, "noise"> | undefined;
  /** The deviation of the velocity at the first observation, or one for each axis. */
  readonly initial?: { readonly velocity?: number | Vector | undefined } | undefined;
  /** The constants of the model. */
  readonly pointing?: DeepPartial<Pointing> | undefined;
}

/** A number, or one for each axis; they take two places. */
const eachAxis = Symbol();

/** What each constant must be. */
type Rules = { readonly [key: string]: Check | typeof eachAxis | Rules };

const share: Check = (value, path) => {
  const x = number(value, path);
  return x >= 0 && x <= 1 ? x : refuse("out-of-range", path, "must be from 0 to 1", x);
};

const points: Check = (value, path) => {
  const [x, must] = [number(value, path), "must be an integer from 2 to 1001"];
  if (!Number.isInteger(x) || x < 2) refuse("out-of-range", path, must, x);
  return x <= 1001 ? x : refuse("too-large", path, must, x);
};

const below: Check = (value, path) => {
  const x = number(value, path);
  return x < 0 ? x : refuse("out-of-range", path, "must be less than 0", x);
};

const above: Check = (value, path) => {
  const x = number(value, path);
  return x > 0 ? x : refuse("out-of-range", path, "must be greater than 0", x);
};

/** In the order of `constants` in `src/wasm/pointing.rs`, which has the prior of none before them and the noise scales after. */
const RULES: Rules = {
  motion: { noise: positive, speedNoise: notNegative },
  observation: { noise: eachAxis },
  initial: { velocity: eachAxis },
  pointing: {
    alongNoise: notNegative,
    acrossNoise: notNegative,
    timeToGo: { from: positive, to: positive, points, median: positive, spread: positive, speedExponent: number },
    start: { exponent: notNegative, core: positive, reach: positive },
    direction: { power: notNegative, core: positive, wide: positive, distance: positive, time: notNegative },
    power: { from: notNegative, to: notNegative, time: positive },
    near: notNegative,
    restDistance: notNegative,
    shake: notNegative,
    noneGain: number,
    noneOffset: number,
    noneShare: share,
    uniform: share,
    unit: positive,
    remaining: { offset: number, nodes: number, near: number, distance: positive, elapsed: number, low: below, high: above },
  },
};

/** What else a scenario may have there: what it must be, or nothing where it is not read. */
const OTHERS: Readonly<Record<string, Readonly<Record<string, unknown>>>> = {
  "": { method: "pointing", none: undefined, destinations: undefined },
  motion: { type: "constantVelocity", dimensions: 2 },
  pointing: { noise: undefined },
};

/**
 * The default constants with some in their place.
 *
 * @param given - What a user gave.
 * @param defaults - All constants, as `src/wasm/pointing.rs` lists them.
 */
export function readConstants(given: unknown, defaults: Float64Array): Float64Array {
  const constants = Array.from(defaults);
  let at = 1;
  const read = (value: unknown, path: string, rules: Rules): void => {
    const others = OTHERS[path] ?? {};
    const object = isAbsent(value)
      ? {}
      : fields(value, path, [...Object.keys(others), ...Object.keys(rules)], path || "constants");
    for (const [key, must] of Object.entries(others)) {
      const found = object[key];
      if (must !== undefined && !isAbsent(found) && found !== must) {
        refuse("out-of-range", path ? `${path}.${key}` : key, `must be ${JSON.stringify(must)} in whither/pointing`, found);
      }
    }
    for (const [key, rule] of Object.entries(rules)) {
      const [item, name] = [object[key], path ? `${path}.${key}` : key];
      if (rule === eachAxis) {
        if (!isAbsent(item)) constants.splice(at, 2, ...axes(item, name));
        at += 2;
      } else if (typeof rule === "function") {
        if (!isAbsent(item)) constants[at] = rule(item, name);
        at += 1;
      } else {
        read(item, name, rule as Rules);
        // the only rule between two constants
        if (key === "timeToGo" && (constants[at - 6] as number) >= (constants[at - 5] as number)) {
          refuse("out-of-range", `${name}.to`, "must be greater than from", constants[at - 5]);
        }
      }
    }
  };
  read(given, "", RULES);
  const scales = (given as PointerConstants | null | undefined)?.pointing?.noise;
  if (!isAbsent(scales)) constants.splice(at, Infinity, ...noiseScales(scales));
  return Float64Array.from(constants);
}

function axes(value: unknown, path: string): [number, number] {
  if (typeof value === "number") return [positive(value, path), positive(value, path)];
  if (typeof value !== "object") refuse("wrong-type", path, "must be a number or a list of 2 numbers, one for each axis", value);
  const items = list(value, path);
  if (items.length !== 2) throw new WhitherError("wrong-length", path, `must have 2 numbers, has ${items.length}`);
  return [positive(items[0], `${path}[0]`), positive(items[1], `${path}[1]`)];
}

function noiseScales(value: unknown): number[] {
  const path = "pointing.noise";
  const items = list(value, path);
  if (items.length < 1 || items.length > 16) {
    throw new WhitherError("wrong-length", path, `must have 1 to 16 numbers, has ${items.length}`);
  }
  return Array.from(items, (item, i) => positive(item, `${path}[${i}]`));
}
