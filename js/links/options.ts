/**
 * Reads the options: those of `whither/links` here, the others are for `watch`, which reads them itself.
 *
 * @module
 */
import type { WatchOptions } from "#dom";
import { fields, isAbsent, list, notNegative, number, refuse, text } from "../core/read.js";
import type { Ignore, LinksOptions, Prefetch } from "./types.js";
import { unsafeRule } from "./unsafe.js";

/** From slow to fast. */
export const CONNECTIONS: readonly unknown[] = ["slow-2g", "2g", "3g", "4g"];

/** In the order in which they are tried. */
export const MECHANISMS = ["rules", "link", "fetch"] as const;

/** Options with their defaults. */
export interface Settings extends Pick<LinksOptions, "nonce" | "tag" | "noVarySearch" | "onPrefetch" | "onError"> {
  readonly selector: string;
  readonly ignore: readonly Ignore[];
  readonly unsafe: RegExp | null;
  readonly origins: readonly string[];
  /** An index of {@link CONNECTIONS}. */
  readonly slowest: number;
  readonly limit: { readonly running: number; readonly perMinute: number; readonly total: number };
  /** An index of {@link MECHANISMS}, or the page's own. */
  readonly mechanism: number | ((request: Prefetch) => unknown);
  /** A probability. */
  readonly prerender: number | false;
  readonly keep: number;
  readonly lifetime: number;
  /** What `watch` is given. */
  readonly watch: WatchOptions<Element>;
}

type Read = (value: unknown, path: string) => unknown;

/** Of each key how it is read, and its default. */
type Table = Readonly<Record<string, readonly [read: Read, otherwise?: unknown]>>;

const word =
  (words: readonly unknown[]): Read =>
  (value, path) =>
    words.includes(value) ? words.indexOf(value) : refuse("out-of-range", path, `must be one of ${words.join(", ")}`, value);

const callback: Read = (value, path) =>
  typeof value === "function" ? value : refuse("wrong-type", path, "must be a function", value);

const each =
  (read: Read): Read =>
  (value, path) =>
    Array.from(list(value, path), (one, i) => read(one, `${path}[${i}]`));

const selector: Read = (value, path) => {
  try {
    document.createDocumentFragment().querySelector(text(value, path));
    return value;
  } catch {
    return refuse("out-of-range", path, "must be a selector", value);
  }
};

const origin: Read = (value, path) => {
  try {
    if (value === "*" || new URL(text(value, path)).origin === value) return value;
  } catch {}
  return refuse("out-of-range", path, 'must be an origin such as "https://example.com", or "*"', value);
};

const ignored: Read = (value, path) => {
  if (typeof value === "string") return selector(value, path);
  if (typeof value === "function" || value instanceof RegExp) return value;
  return refuse("wrong-type", path, "must be a regular expression, a selector or a function", value);
};

const LIMIT: Table = { running: [notNegative, 2], perMinute: [notNegative, 30], total: [notNegative, Infinity] };

const share: Read = (value, path) => {
  const x = number(value, path);
  return x > 0 && x <= 1 ? x : refuse("out-of-range", path, "must be greater than 0 and at most 1", x);
};

/** Where rules have prerendering on: the posterior probability from which it is worth it. */
const PRERENDER: Table = { threshold: [share, 0.95] };

const OPTIONS: Table = {
  selector: [selector, "a[href], area[href]"],
  ignore: [(value, path) => (Array.isArray(value) ? each(ignored)(value, path) : [ignored(value, path)]), []],
  unsafe: [
    (value, path) =>
      value instanceof RegExp ? value : refuse("wrong-type", path, "must be a regular expression or null", value),
  ],
  origins: [each(origin), []],
  slowest: [word(CONNECTIONS), 2],
  limit: [(value, path) => read(value, LIMIT, path)],
  mechanism: [(value, path) => (typeof value === "function" ? value : word(MECHANISMS)(value, path)), 0],
  prerender: [
    (value, path) => value && (read(value === true ? {} : value, PRERENDER, path) as { threshold: number }).threshold,
    false,
  ],
  keep: [notNegative, 1000],
  lifetime: [notNegative, 300_000],
  nonce: [text],
  tag: [text],
  noVarySearch: [text],
  onPrefetch: [callback],
  onError: [callback],
};

/** What `watch` takes of what is given. */
const WATCH =
  "root threshold release none rest target reasons reactivate pointers raw load decorate constants predictor learning learnt record signal onPrediction onOutcome";

function read(given: unknown, table: Table, path: string, more: readonly string[] = []): Record<string, unknown> {
  const from = fields(given, path, [...Object.keys(table), ...more], path || "options");
  return Object.fromEntries(
    Object.entries(table).map(([key, [readValue, otherwise]]) => {
      const value = from[key];
      return [key, isAbsent(value) ? otherwise : readValue(value, path ? `${path}.${key}` : key)];
    }),
  );
}

/**
 * Reads all options.
 *
 * @throws {@link WhitherError} with the path of the key, where a value is not legal or a key is unknown.
 */
export function readOptions(given: LinksOptions = {}): Settings {
  const keys = WATCH.split(" ");
  const settings = read(given, OPTIONS, "", keys);
  const watch = Object.fromEntries(Object.entries(given).filter(([key]) => keys.includes(key) || key === "onError"));
  settings["limit"] ??= read({}, LIMIT, "limit");
  if (given.unsafe !== null) settings["unsafe"] ??= unsafeRule();
  return { ...settings, watch: { threshold: 0.9, ...watch } } as unknown as Settings;
}
