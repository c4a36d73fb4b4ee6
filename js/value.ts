/**
 * Plain data as two flat things, a list of numbers and a text: how scenarios, destinations and snapshots cross into
 * WebAssembly and back. `src/wasm/value.rs` is the other half.
 *
 * All of a user's object is read here, before WebAssembly is entered: a getter or a proxy may throw or call back into
 * a predictor, and neither may happen while Rust code is on the stack.
 *
 * @module
 */
import { WhitherError } from "./error.js";

/**
 * Plain data on its way across: a kind for each value, and what belongs to it, depth first; and all keys and strings, one
 * behind the other.
 */
export type Encoded = readonly [numbers: Float64Array, text: string];

const NOTHING = 0;
const FALSE = 1;
const TRUE = 2;
const NUMBER = 3; // the number
const TEXT = 4; // its length in UTF-16 units
const LIST = 5; // the count of items, then each
const MAP = 6; // the count of entries, then for each: the key's length, the value

/** The longest list that crosses: as many destinations as a predictor may have. */
export const MOST_ITEMS = 1_000_000;
const MOST_NUMBERS = 1 << 25;
const MOST_TEXT = 1 << 26;
const DEEPEST = 24;

/**
 * Reads all of `value`. `undefined` in an object is as good as absent, in a list it is `null`; typed arrays are lists.
 *
 * @param value - What a user gave.
 * @param name - What every path in an error begins with; nothing for a scenario.
 */
export function encode(value: unknown, name = ""): Encoded {
  const encoder = new Encoder(name);
  encoder.add(value);
  return [new Float64Array(encoder.numbers), encoder.texts.join("")];
}

class Encoder {
  readonly numbers: number[] = [];
  readonly texts: string[] = [];
  readonly #steps: (string | number)[] = [];
  readonly #ancestors: object[] = [];
  readonly #name: string;
  #length = 0;

  constructor(name: string) {
    this.#name = name;
  }

  add(value: unknown): void {
    if (this.numbers.length > MOST_NUMBERS) {
      throw this.#error("too-large", `must have no more than ${MOST_NUMBERS} values in all`);
    }
    if (typeof value === "number") {
      this.numbers.push(NUMBER, value);
    } else if (typeof value === "string") {
      this.numbers.push(TEXT);
      this.#addText(value);
    } else if (value === null || value === undefined) {
      this.numbers.push(NOTHING);
    } else if (typeof value === "boolean") {
      this.numbers.push(value ? TRUE : FALSE);
    } else if (typeof value === "object") {
      this.#addObject(value);
    } else {
      const found = typeof value === "bigint" ? `${value}n, a bigint` : `a ${typeof value}`;
      throw this.#error("wrong-type", `must be plain data (numbers, strings, lists, objects), got ${found}`);
    }
  }

  #addObject(value: object): void {
    if (this.#ancestors.includes(value)) throw this.#error("wrong-type", "must be plain data, refers to itself");
    if (this.#ancestors.length === DEEPEST) {
      throw this.#error("wrong-type", `must be plain data, is nested more than ${DEEPEST} deep`);
    }
    this.#ancestors.push(value);
    if (isList(value)) this.#addList(value);
    else this.#addMap(value as Record<string, unknown>);
    this.#ancestors.pop();
  }

  #addList(list: ArrayLike<unknown>): void {
    const { length } = list;
    if (length > MOST_ITEMS) {
      throw this.#error("too-large", `must have no more than ${MOST_ITEMS} items, has ${length}`);
    }
    this.numbers.push(LIST, length);
    for (let i = 0; i < length; i++) {
      this.#steps.push(i);
      this.add(list[i]);
      this.#steps.pop();
    }
  }

  #addMap(map: Record<string, unknown>): void {
    this.numbers.push(MAP, 0);
    const count = this.numbers.length - 1;
    let entries = 0;
    for (const key of Object.keys(map)) {
      const item = map[key];
      if (item === undefined) continue;
      this.#steps.push(key);
      this.#addText(key);
      this.add(item);
      this.#steps.pop();
      entries++;
    }
    this.numbers[count] = entries;
  }

  #addText(text: string): void {
    this.#length += text.length;
    if (this.#length > MOST_TEXT) throw this.#error("too-large", `must have no more than ${MOST_TEXT} characters in all`);
    this.numbers.push(text.length);
    this.texts.push(text);
  }

  #error(code: "wrong-type" | "too-large", message: string): WhitherError {
    let path = this.#name;
    for (const step of this.#steps) path += typeof step === "number" ? `[${step}]` : path === "" ? step : `.${step}`;
    return new WhitherError(code, path, message);
  }
}

/** Whether `value` crosses as a list. */
export function isList(value: unknown): value is ArrayLike<unknown> {
  return Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));
}

/** The plain data that `encoded` stands for. */
export function decode([numbers, text]: Encoded): unknown {
  let at = 0;
  let from = 0;
  const number = (): number => numbers[at++] as number;
  const string = (): string => text.slice(from, (from += number()));
  const value = (): unknown => {
    switch (number()) {
      case NUMBER:
        return number();
      case TEXT:
        return string();
      case LIST:
        return Array.from({ length: number() }, value);
      case MAP: {
        const map: Record<string, unknown> = {};
        for (let left = number(); left > 0; left--) {
          const key = string();
          map[key] = value();
        }
        return map;
      }
      case TRUE:
        return true;
      case FALSE:
        return false;
      default:
        return null;
    }
  };
  return value();
}

/** The plain data of a tree that Rust hands out, which is freed. */
export function decodeTree(tree: { numbers(): Float64Array; text(): string; free(): void }): unknown {
  const value = decode([tree.numbers(), tree.text()]);
  tree.free();
  return value;
}
