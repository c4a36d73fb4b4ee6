/**
 * Plain copies of users' values: how scenarios, destinations and snapshots enter WebAssembly.
 *
 * All of a user's object is read here, before WebAssembly is entered: a getter or a proxy may throw or call back into
 * a predictor, and neither may happen while Rust code is on the stack. `src/wasm/data.rs` reads the copy.
 *
 * @module
 */
import { WhitherError } from "#error";

/** The longest list that crosses: as many destinations as a predictor may have. */
export const MOST_ITEMS = 1_000_000;
/** The most values that cross at once. */
export const MOST_VALUES = 1 << 24;
const MOST_TEXT = 1 << 26;
const DEEPEST = 24;

/**
 * Copies `value` deeply. A key that is `undefined` is left out, an item that is becomes `null`; typed arrays become lists.
 *
 * @param value - A user's value.
 * @param name - The beginning of every path in an error; empty for a scenario.
 * @param reserve - Called with a bound of the bytes that the copy, and what is built from it, take in WebAssembly.
 */
export function plainCopy(value: unknown, name: string, reserve: (bytes: number) => void): unknown {
  const copier = new Copier(name);
  const copied = copier.copy(value);
  reserve(copier.bytes);
  return copied;
}

class Copier {
  readonly #steps: (string | number)[] = [];
  readonly #ancestors: object[] = [];
  readonly #name: string;
  #values = 0;
  #length = 0;

  constructor(name: string) {
    this.#name = name;
  }

  get bytes(): number {
    return 96 * this.#values + 16 * this.#length;
  }

  copy(value: unknown): unknown {
    if (++this.#values > MOST_VALUES) {
      throw this.#error("too-large", `must have no more than ${MOST_VALUES} values in all`);
    }
    if (typeof value === "string") return this.#text(value);
    if (typeof value === "number" || typeof value === "boolean") return value;
    if (value === null || value === undefined) return null;
    if (typeof value === "object") return this.#object(value);
    const found = typeof value === "bigint" ? `${value}n, a bigint` : `a ${typeof value}`;
    throw this.#error("wrong-type", `must be plain data (numbers, strings, lists, objects), got ${found}`);
  }

  #object(value: object): unknown {
    if (this.#ancestors.includes(value)) throw this.#error("wrong-type", "must be plain data, refers to itself");
    if (this.#ancestors.length === DEEPEST) {
      throw this.#error("wrong-type", `must be plain data, is nested more than ${DEEPEST} deep`);
    }
    this.#ancestors.push(value);
    const copied = isList(value) ? this.#list(value) : this.#map(value as Record<string, unknown>);
    this.#ancestors.pop();
    return copied;
  }

  #list(list: ArrayLike<unknown>): unknown[] {
    const { length } = list;
    if (length > MOST_ITEMS) {
      throw this.#error("too-large", `must have no more than ${MOST_ITEMS} items, has ${length}`);
    }
    const copied: unknown[] = [];
    for (let i = 0; i < length; i++) {
      this.#steps.push(i);
      copied.push(this.copy(list[i]));
      this.#steps.pop();
    }
    return copied;
  }

  #map(map: Record<string, unknown>): Record<string, unknown> {
    // without a prototype, so that a key "__proto__" is a key like any other
    const copied = Object.create(null) as Record<string, unknown>;
    for (const key of Object.keys(map)) {
      const item = map[key];
      if (item === undefined) continue;
      this.#steps.push(key);
      copied[this.#text(key)] = this.copy(item);
      this.#steps.pop();
    }
    return copied;
  }

  #text(text: string): string {
    this.#length += text.length;
    if (this.#length > MOST_TEXT) throw this.#error("too-large", `must have no more than ${MOST_TEXT} characters in all`);
    return text;
  }

  #error(code: "wrong-type" | "too-large", message: string): WhitherError {
    let path = this.#name;
    for (const step of this.#steps) path += typeof step === "number" ? `[${step}]` : path === "" ? step : `.${step}`;
    return new WhitherError(code, path, message);
  }
}

/** Whether `value` is copied as a list. */
export function isList(value: unknown): value is ArrayLike<unknown> {
  // of all views, a DataView alone has no length; its class may be another realm's
  return Array.isArray(value) || (ArrayBuffer.isView(value) && "length" in value);
}
