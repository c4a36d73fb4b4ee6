/**
 * Users' values as bytes, and back: how scenarios, destinations and snapshots cross into WebAssembly and out of it.
 * `src/value/bytes.rs` is the other side, and has the table of the tags.
 *
 * All of a user's object is read here, before WebAssembly is entered: a getter or a proxy may throw or call back into
 * a predictor, and neither may happen while Rust code is on the stack.
 *
 * @module
 */
import { WhitherError } from "#error";
import { isList, MOST_ITEMS } from "./list.js";

/** The most values that cross at once. */
export const MOST_VALUES = 1 << 24;
const MOST_TEXT = 1 << 26;
const DEEPEST = 24;

/**
 * Reads `value` deeply. A key that is `undefined` is left out, an item that is becomes `null`; typed arrays become lists.
 *
 * @param value - A user's value.
 * @param name - The beginning of every path in an error; empty for a scenario.
 * @param reserve - Called with a bound of the memory, in bytes, that the value, and what is built from it, take in WebAssembly.
 */
export function toBytes(value: unknown, name: string, reserve: (bytes: number) => void): Uint8Array {
  const writer = new Writer(name);
  writer.value(value);
  reserve(writer.needed);
  return writer.bytes;
}

/** The value that WebAssembly wrote. */
export function fromBytes(bytes: Uint8Array): unknown {
  return new Reader(bytes).value();
}

class Writer {
  /** The objects around what is being read, and at least as many steps: the key or the index in each. */
  readonly #ancestors: object[] = [];
  readonly #steps: (string | number)[] = [];
  readonly #name: string;
  /** Keys in the order of their numbers, the number of each, and which came after it the last time. */
  readonly #keys: string[] = [];
  readonly #numbers = new Map<string, number>();
  readonly #following: number[] = [];
  #lastKey = 0;
  #values = 0;
  #characters = 0;
  #view = new DataView(new ArrayBuffer(256));
  #length = 0;

  constructor(name: string) {
    this.#name = name;
  }

  get needed(): number {
    return 96 * this.#values + 16 * this.#characters;
  }

  get bytes(): Uint8Array {
    return new Uint8Array(this.#view.buffer, 0, this.#length);
  }

  value(value: unknown): void {
    if (++this.#values > MOST_VALUES) {
      throw this.#error("too-large", `must have no more than ${MOST_VALUES} values in all`);
    }
    if (typeof value === "number") {
      const place = this.#tag(3, 8);
      this.#view.setFloat64(place, value, true);
    } else if (typeof value === "object" && value !== null) {
      this.#object(value);
    } else if (typeof value === "string") {
      this.#check(value);
      this.#tag(4, 0);
      this.#text(value);
    } else if (typeof value === "boolean") {
      this.#tag(value ? 2 : 1, 0);
    } else if (value === null || value === undefined) {
      this.#tag(0, 0);
    } else {
      const found = typeof value === "bigint" ? `${value}n, a bigint` : `a ${typeof value}`;
      throw this.#error("wrong-type", `must be plain data (numbers, strings, lists, objects), got ${found}`);
    }
  }

  #object(value: object): void {
    if (this.#ancestors.includes(value)) throw this.#error("wrong-type", "must be plain data, refers to itself");
    if (this.#ancestors.length === DEEPEST) {
      throw this.#error("wrong-type", `must be plain data, is nested more than ${DEEPEST} deep`);
    }
    if (isList(value)) this.#list(value);
    else this.#map(value as Record<string, unknown>);
    this.#ancestors.pop();
  }

  #list(list: ArrayLike<unknown>): void {
    const { length } = list;
    if (length > MOST_ITEMS) {
      throw this.#error("too-large", `must have no more than ${MOST_ITEMS} items, has ${length}`);
    }
    const depth = this.#ancestors.push(list) - 1;
    const place = this.#tag(5, 4);
    this.#view.setUint32(place, length, true);
    for (let i = 0; i < length; i++) {
      this.#steps[depth] = i;
      this.value(list[i]);
    }
  }

  #map(map: Record<string, unknown>): void {
    const depth = this.#ancestors.push(map) - 1;
    const place = this.#tag(6, 4);
    let entries = 0;
    for (const key of Object.keys(map)) {
      const item = map[key];
      if (item === undefined) continue;
      this.#steps[depth] = key;
      this.#key(key);
      this.value(item);
      entries++;
    }
    this.#view.setUint32(place, entries, true);
  }

  #key(key: string): void {
    this.#check(key);
    // in a list of objects that are alike the same keys follow one another: their numbers need not be looked up
    let number = this.#following[this.#lastKey] ?? 0;
    if (this.#keys[number] !== key) {
      number = this.#numbers.get(key) ?? this.#keys.length;
      this.#following[this.#lastKey] = number;
    }
    this.#lastKey = number;
    const place = this.#room(4);
    this.#view.setUint32(place, number, true);
    if (number < this.#keys.length) return;
    this.#keys.push(key);
    this.#numbers.set(key, number);
    this.#text(key);
  }

  #check({ length }: string): void {
    this.#characters += length;
    if (this.#characters > MOST_TEXT) {
      throw this.#error("too-large", `must have no more than ${MOST_TEXT} characters in all`);
    }
  }

  #text(text: string): void {
    const start = this.#length;
    const { length } = text;
    const place = this.#room(4 + length) + 4;
    this.#view.setUint32(start, length, true);
    for (let i = 0; i < length; i++) {
      const unit = text.charCodeAt(i);
      if (unit > 127) {
        this.#encoded(text, start);
        return;
      }
      this.#view.setUint8(place + i, unit);
    }
  }

  /** Writes a text with more than ASCII; half of a pair of units, which UTF-8 does not have, is replaced. */
  #encoded(text: string, start: number): void {
    const encoded = new TextEncoder().encode(text);
    this.#length = start;
    const place = this.#room(4 + encoded.length);
    this.#view.setUint32(place, encoded.length, true);
    new Uint8Array(this.#view.buffer).set(encoded, place + 4);
  }

  /** Writes a tag, and returns the place of so many bytes behind it. */
  #tag(tag: number, bytes: number): number {
    const place = this.#room(1 + bytes);
    this.#view.setUint8(place, tag);
    return place + 1;
  }

  /** The place of so many bytes more. */
  #room(bytes: number): number {
    const place = this.#length;
    this.#length += bytes;
    if (this.#length > this.#view.byteLength) {
      const larger = new Uint8Array(2 * this.#length);
      larger.set(new Uint8Array(this.#view.buffer));
      this.#view = new DataView(larger.buffer);
    }
    return place;
  }

  #error(code: "wrong-type" | "too-large", message: string): WhitherError {
    let path = this.#name;
    for (const step of this.#steps.slice(0, this.#ancestors.length)) {
      path += typeof step === "number" ? `[${step}]` : path === "" ? step : `.${step}`;
    }
    return new WhitherError(code, path, message);
  }
}

class Reader {
  readonly #decoder = new TextDecoder("utf-8", { ignoreBOM: true });
  readonly #keys: string[] = [];
  readonly #bytes: Uint8Array;
  readonly #view: DataView;
  #place = 0;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  value(): unknown {
    const tag = this.#view.getUint8(this.#skip(1));
    if (tag === 0) return null;
    if (tag < 3) return tag === 2;
    if (tag === 3) return this.#view.getFloat64(this.#skip(8), true);
    if (tag === 4) return this.#text();
    if (tag === 5) return Array.from({ length: this.#count() }, () => this.value());
    const map: Record<string, unknown> = {};
    for (let entries = this.#count(); entries > 0; entries--) {
      const number = this.#count();
      const key = (this.#keys[number] ??= this.#text());
      map[key] = this.value();
    }
    return map;
  }

  #text(): string {
    const length = this.#count();
    const place = this.#skip(length);
    return this.#decoder.decode(this.#bytes.subarray(place, place + length));
  }

  #count(): number {
    return this.#view.getUint32(this.#skip(4), true);
  }

  /** Goes on by so many bytes, and returns where they begin. */
  #skip(bytes: number): number {
    const place = this.#place;
    this.#place += bytes;
    return place;
  }
}
