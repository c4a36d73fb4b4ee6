/**
 * Reads the options: unknown ones and wrong values are errors, what is left out gets its default.
 *
 * @module
 */
import { type Fields, fields, isAbsent, missing, notNegative, number, positive, refuse, text } from "../core/read.js";
import type { HandleCloseOptions } from "./handle-close.js";
import type { HeldOpenOptions, HoldOptions, MenuOptions } from "./types.js";

type Needed<T, K extends keyof T> = T & { readonly [key in K]-?: NonNullable<T[key]> };

/** Options with their defaults. */
export type HoldSettings = Needed<HoldOptions, "release" | "none" | "bound" | "rest">;
export type HeldOpenSettings = Needed<HeldOpenOptions, (keyof HoldSettings & ("release" | "none" | "bound" | "rest")) | "delay">;
export type MenuSettings = Needed<MenuOptions, "release" | "none" | "bound" | "rest" | "delay">;
export type HandleCloseSettings = Needed<HandleCloseOptions, "release" | "none" | "bound" | "rest" | "blockPointerEvents">;

/** Of each key how it is read, and its default. */
type Table = Readonly<Record<string, readonly [read: (value: unknown, path: string) => unknown, otherwise?: unknown]>>;

function is(type: string) {
  return (value: unknown, path: string) =>
    typeof value === type ? value : refuse("wrong-type", path, `must be a ${type}`, value);
}

function within(must: string, legal: (x: number) => boolean) {
  return (value: unknown, path: string) => {
    const x = number(value, path);
    return legal(x) ? x : refuse("out-of-range", path, must, x);
  };
}

function signal(value: unknown, path: string): unknown {
  const throws = (value as AbortSignal | null)?.throwIfAborted;
  return typeof throws === "function" ? value : refuse("wrong-type", path, "must be an AbortSignal", value);
}

const callback = is("function");

/** A pointer that has left the trigger is followed from the trigger on, or from where it has left it. */
const holding = (release: number): Table => ({
  release: [within("must be greater than 0 and less than 1", (x) => x > 0 && x < 1), release],
  none: [within("must be at least 0 and less than 1", (x) => x >= 0 && x < 1), 0.4],
  bound: [notNegative, 1000],
  rest: [positive, 150],
  constants: [is("object")],
  predictor: [callback],
  onError: [callback],
});

const HELD_OPEN: Table = {
  ...holding(0.25),
  onClose: [callback],
  onOpen: [callback],
  delay: [notNegative, 0],
  keep: [callback],
  signal: [signal],
};

const MENU: Table = {
  ...holding(0.25),
  items: [text],
  submenu: [callback],
  onOpen: [callback],
  onClose: [callback],
  delay: [notNegative, 0],
  keep: [callback],
  signal: [signal],
};

const HANDLE_CLOSE: Table = { ...holding(0.4), blockPointerEvents: [is("boolean"), false] };

function read(given: unknown, table: Table): never {
  const from: Fields = isAbsent(given) ? {} : fields(given, "", Object.keys(table), "options");
  const settings: Record<string, unknown> = {};
  for (const [key, [readValue, otherwise]] of Object.entries(table)) {
    settings[key] = isAbsent(from[key]) ? otherwise : readValue(from[key], key);
  }
  return settings as never;
}

/** @throws {@link WhitherError} `unknown-key`, `missing-key`, `wrong-type`, `out-of-range`, `not-finite` with the path of the key. */
export function readHeldOpen(given: unknown): HeldOpenSettings {
  const settings: HeldOpenSettings = read(given, HELD_OPEN);
  return isAbsent(settings.onClose) ? missing("onClose") : settings;
}

/** @throws {@link WhitherError} as {@link readHeldOpen}. */
export function readMenu(given: unknown, root: Element): MenuSettings {
  const settings: MenuSettings = read(given, MENU);
  const { items } = settings;
  try {
    if (items !== undefined) root.matches(items);
  } catch {
    refuse("out-of-range", "items", "must be a selector", items);
  }
  return settings;
}

/** @throws {@link WhitherError} as {@link readHeldOpen}. */
export function readHandleClose(given: unknown): HandleCloseSettings {
  return read(given, HANDLE_CLOSE);
}

/** @throws {@link WhitherError} `wrong-type` at the path. */
export function readElement(value: unknown, path: string): Element {
  return (value as Node | null)?.nodeType === 1 ? (value as Element) : refuse("wrong-type", path, "must be an element", value);
}
