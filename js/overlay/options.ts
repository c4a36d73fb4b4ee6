/**
 * Reads what a user gives: unknown options and wrong values are errors.
 *
 * @module
 */
import type { Watcher } from "#dom";
import { fields, isAbsent, refuse } from "../core/read.js";

/** A key with its modifiers. */
export interface Shortcut {
  /** As it is written. */
  readonly text: string;
  matches(event: KeyboardEvent): boolean;
}

/** Options with their defaults. */
export interface Settings {
  readonly theme: "auto" | "dark" | "light";
  /** Undefined: as wide as the window is. */
  readonly collapsed: boolean | undefined;
  readonly shortcut: Shortcut | null;
  readonly signal: AbortSignal | null;
}

const THEMES = ["auto", "dark", "light"];
const MODIFIERS = ["Alt", "Ctrl", "Meta", "Shift"];
const SHORTCUT = "Alt+Shift+W";

/**
 * Reads all options.
 *
 * @throws {@link WhitherError} `unknown-key`, `wrong-type`, `out-of-range` with the path of the key.
 */
export function readOptions(given: unknown): Settings {
  const keys = ["theme", "collapsed", "shortcut", "signal"];
  const read = isAbsent(given) ? {} : fields(given, "", keys, "options");
  const { collapsed, shortcut = SHORTCUT, signal } = read;
  const theme = read["theme"] ?? "auto";
  if (!THEMES.includes(theme as string)) refuse("out-of-range", "theme", `must be one of ${THEMES.join(", ")}`, theme);
  if (!isAbsent(collapsed) && typeof collapsed !== "boolean") {
    refuse("wrong-type", "collapsed", "must be a boolean", collapsed);
  }
  if (!isAbsent(signal) && typeof (signal as AbortSignal).throwIfAborted !== "function") {
    refuse("wrong-type", "signal", "must be an AbortSignal", signal);
  }
  return {
    theme: theme as Settings["theme"],
    collapsed: collapsed ?? undefined,
    shortcut: shortcut === null ? null : readShortcut(shortcut),
    signal: (signal as AbortSignal | undefined) ?? null,
  };
}

/**
 * The watchers that a user gave; null for those that the page has.
 *
 * @throws {@link WhitherError} `wrong-type` with the path of what is no watcher.
 */
export function readWatchers(given: unknown): readonly Watcher[] | null {
  if (isAbsent(given)) return null;
  const many = typeof given === "object" && Symbol.iterator in given;
  return many
    ? Array.from(given as Iterable<unknown>, (one, i) => readWatcher(one, `watchers[${i}]`))
    : [readWatcher(given, "watchers")];
}

function readWatcher(given: unknown, path: string): Watcher {
  const watcher = given as Watcher | null | undefined;
  return typeof watcher?.getSnapshot === "function" ? watcher : refuse("wrong-type", path, "must be a watcher", given);
}

function readShortcut(given: unknown): Shortcut {
  if (typeof given !== "string") refuse("wrong-type", "shortcut", "must be a string", given);
  const parts = given.split("+");
  const key = parts.pop() as string;
  if (!/^[a-z0-9]$/i.test(key) || parts.length === 0 || !parts.every((part) => MODIFIERS.includes(part))) {
    refuse("out-of-range", "shortcut", `must be some of ${MODIFIERS.join(", ")} and a letter or digit, joined by +`, given);
  }
  // the key's place on the keyboard: with Alt, letters are others on some systems
  const code = `${/\d/.test(key) ? "Digit" : "Key"}${key.toUpperCase()}`;
  const has = (name: string) => parts.includes(name);
  return {
    text: given,
    matches: ({ code: pressed, altKey, ctrlKey, metaKey, shiftKey }) =>
      pressed === code &&
      altKey === has("Alt") &&
      ctrlKey === has("Ctrl") &&
      metaKey === has("Meta") &&
      shiftKey === has("Shift"),
  };
}
