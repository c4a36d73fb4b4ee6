/**
 * Reads the options: unknown ones and wrong values are errors, what is left out gets its default.
 *
 * @module
 */
import { fields, isAbsent, notNegative, number, positive, refuse, text } from "../core/read.js";
import type { TargetOptions, WatchOptions, WatchTarget } from "./types.js";

/** How much larger a box is than its element: top, right, bottom, left. */
export type Slop = readonly [number, number, number, number];

/** What holds for a target: what is absent is as in the watcher's options. */
export interface TargetSettings extends Omit<TargetOptions, "hitSlop"> {
  readonly hitSlop?: Slop;
}

/** Milliseconds after which a sign counts; null: never. */
type After = number | null;

/** Options with their defaults. */
export interface Settings
  extends Pick<
    WatchOptions,
    "constants" | "predictor" | "learnt" | "signal" | "onIntent" | "onRelease" | "onPrediction" | "onOutcome" | "onError"
  > {
  readonly root: ParentNode & Node;
  readonly threshold: number;
  readonly release: number;
  readonly none: number;
  readonly rest: number;
  readonly target: TargetSettings | ((target: WatchTarget) => TargetOptions | null | undefined);
  readonly reasons: {
    readonly pointer: After;
    readonly hover: After;
    readonly viewport: After;
    readonly press: boolean;
    readonly focus: boolean;
    readonly touch: boolean;
    readonly scroll: boolean;
    /** Tab stops. */
    readonly keyboard: After;
  };
  /** Milliseconds; null: in another movement. */
  readonly reactivate: After;
  readonly limit: { readonly running: number; readonly perMinute: number };
  readonly pointers: readonly string[];
  readonly raw: boolean;
  readonly load: "eager" | "idle" | "pointer";
  readonly decorate: boolean;
  /** How many presses the priors are worth; null: nothing is learnt. */
  readonly learning: After;
  readonly record: boolean;
}

type Read = (value: unknown, path: string) => unknown;

/** Of each key how it is read, and its default. */
type Table = Readonly<Record<string, readonly [read: Read, otherwise?: unknown]>>;

/** How many presses the priors of targets are worth. */
const STRENGTH = 5;

function within(must: string, legal: (x: number) => boolean): Read {
  return (value, path) => {
    const x = number(value, path);
    return legal(x) ? x : refuse("out-of-range", path, must, x);
  };
}

function is(type: string): Read {
  return (value, path) => (typeof value === type ? value : refuse("wrong-type", path, `must be a ${type}`, value));
}

/** An object that has a method. */
function has(method: string, name: string): Read {
  return (value, path) =>
    typeof (value as Record<string, unknown>)[method] === "function"
      ? value
      : refuse("wrong-type", path, `must be ${name}`, value);
}

/** A word, read as what it stands for; `or` reads what is none. */
function word(words: Readonly<Record<string, unknown>>, or: Read = text): Read {
  return (value, path) => {
    if (typeof value !== "string") return or(value, path);
    const names = Object.keys(words);
    return names.includes(value) ? words[value] : refuse("out-of-range", path, `must be one of ${names.join(", ")}`, value);
  };
}

/** `{ [key]: number }`; `true` stands for `yes`, `false` for never. */
function amount(key: string, yes: number): Read {
  return (value, path) => {
    if (typeof value === "boolean") return value ? yes : null;
    return notNegative(fields(value, path, [key])[key], `${path}.${key}`);
  };
}

function read(given: unknown, table: Table, path: string, name = path): never {
  const from = isAbsent(given) ? {} : fields(given, path, Object.keys(table), name);
  const settings: Record<string, unknown> = {};
  for (const [key, [readValue, otherwise]] of Object.entries(table)) {
    const value = isAbsent(from[key]) ? otherwise : readValue(from[key], path ? `${path}.${key}` : key);
    // what is not stated must not hide what is
    if (value !== undefined) settings[key] = value;
  }
  return settings as never;
}

const flag = is("boolean");
const callback = is("function");
const share = within("must be greater than 0 and at most 1", (x) => x > 0 && x <= 1);

/** In the order of {@link Slop}. */
const SIDES: Table = { top: [notNegative, 0], right: [notNegative, 0], bottom: [notNegative, 0], left: [notNegative, 0] };

const TARGET: Table = {
  id: [text],
  name: [text],
  data: [(value) => value],
  prior: [notNegative],
  threshold: [share],
  hitSlop: [
    (value, path) =>
      typeof value === "object" ? Object.values(read(value, SIDES, path)) : Array(4).fill(notNegative(value, path)),
  ],
  enabled: [flag],
  onIntent: [callback],
};

const REASONS: Table = {
  pointer: [amount("after", 0), 0],
  hover: [amount("after", 130), 130],
  viewport: [amount("after", 0), null],
  keyboard: [amount("tabs", 1), null],
  press: [flag, true],
  focus: [flag, true],
  touch: [flag, true],
  scroll: [flag, true],
};

const LIMIT: Table = { running: [notNegative, Infinity], perMinute: [notNegative, Infinity] };

const OPTIONS: Table = {
  root: [has("querySelectorAll", "a document or a root")],
  threshold: [share, 0.8],
  release: [share],
  none: [within("must be at least 0 and less than 1", (x) => x >= 0 && x < 1), 0.2],
  rest: [positive, 300],
  target: [(value, path) => (typeof value === "function" ? value : readTarget(value, path)), {}],
  reasons: [(value, path) => read(value, REASONS, path), read(undefined, REASONS, "")],
  reactivate: [word({ never: Infinity, movement: null }, notNegative), null],
  limit: [(value, path) => read(value, LIMIT, path), read(undefined, LIMIT, "")],
  pointers: [
    (value, path) =>
      Array.isArray(value)
        ? value.map((type, i) => text(type, `${path}[${i}]`))
        : refuse("wrong-type", path, "must be a list", value),
    ["mouse", "pen", "touch"],
  ],
  raw: [flag, false],
  load: [word({ eager: "eager", idle: "idle", pointer: "pointer" }), "pointer"],
  decorate: [flag, true],
  constants: [is("object")],
  predictor: [callback],
  learnt: [is("object")],
  learning: [
    (value, path) =>
      typeof value === "boolean" ? (value ? STRENGTH : null) : within("must be greater than 0", (x) => x > 0)(value, path),
    null,
  ],
  record: [flag, false],
  signal: [has("throwIfAborted", "an AbortSignal")],
  onIntent: [callback],
  onRelease: [callback],
  onPrediction: [callback],
  onOutcome: [callback],
  onError: [callback],
};

/**
 * Reads what holds for one target.
 *
 * @throws {@link WhitherError} with the path of the key.
 */
export function readTarget(given: unknown, path: string): TargetSettings {
  return read(given, TARGET, path);
}

/**
 * Reads all options.
 *
 * @throws {@link WhitherError} `unknown-key`, `wrong-type`, `out-of-range`, `not-finite` with the path of the key.
 */
export function readOptions(given: unknown): Settings {
  const settings: Settings = read(given, OPTIONS, "", "options");
  const { threshold, release = 0.625 * threshold, root = document as ParentNode & Node } = settings;
  if (release > threshold) refuse("out-of-range", "release", `must be at most the threshold, ${threshold}`, release);
  return { ...settings, release, root };
}
