import { WhitherError } from "#error";
import { MOST_ITEMS } from "../core/list.js";
import { type Check, fields, isAbsent, list, notNegative, number, positive, text } from "../core/read.js";
import type { PointerTarget as ScenarioTarget } from "./scenario.js";

/** Something on a screen that a pointer may be going to. */
export interface PointerTarget extends ScenarioTarget {
  /** Its weight before any observation; only the ratios matter. @defaultValue 1 */
  readonly prior?: number | undefined;
}

/** Targets as `src/wasm/pointing.rs` takes them. */
export interface Targets {
  readonly ids: readonly string[];
  /** The place of each id. */
  readonly places: ReadonlyMap<string, number>;
  /** Width and height of each different size. */
  readonly sides: Float64Array;
  /** Of each target `x`, `y`, the place of its size among the sizes, its prior. */
  readonly numbers: Float64Array;
}

const KEYS = ["id", "x", "y", "width", "height", "prior"];

/** Of each width and height the place among the sizes. */
class Sizes {
  readonly sides: number[] = [];
  /** A hash table: of each size one more than its place, where its hash points or the next free slot after that. */
  readonly #slots: Int32Array;
  readonly #size = new Float64Array(2);
  readonly #words = new Int32Array(this.#size.buffer);

  constructor(most: number) {
    // at least half of it stays free
    this.#slots = new Int32Array(2 << (32 - Math.clz32(most)));
  }

  place(width: number, height: number): number {
    this.#size[0] = width;
    this.#size[1] = height;
    const { 0: a = 0, 1: b = 0, 2: c = 0, 3: d = 0 } = this.#words;
    const last = this.#slots.length - 1;
    for (let slot = mixed(mixed(mixed(mixed(0, a), b), c), d) & last; ; slot = (slot + 1) & last) {
      const place = (this.#slots[slot] as number) - 1;
      if (place < 0) return (this.#slots[slot] = this.sides.push(width, height) / 2) - 1;
      if (this.sides[2 * place] === width && this.sides[2 * place + 1] === height) return place;
    }
  }
}

/** A hash with one word more; its upper bits, which depend on all of the word, are mixed into the lower ones. */
function mixed(hash: number, word: number): number {
  const product = Math.imul(hash ^ word, 0x9e3779b1);
  return product ^ (product >>> 15);
}

/** A number from `least` up that passes `check`: the path, which takes longer than the check, is made where it may not. */
function checked(value: unknown, least: number, check: Check, i: number, key: string): number {
  return typeof value === "number" && value >= least && value <= 1e50 ? value : check(value, `targets[${i}].${key}`);
}

/**
 * Reads targets.
 *
 * @param given - What a user gave.
 * @param before - The targets that they replace: ids in the same order need no new places.
 */
export function readTargets(given: unknown, before?: Targets): Targets {
  const items = list(given, "targets");
  const count = items.length;
  if (count > MOST_ITEMS)
    throw new WhitherError("too-large", "targets", `must have no more than ${MOST_ITEMS} items, has ${count}`);
  const ids: string[] = [];
  const numbers = new Float64Array(4 * count);
  const sizes = new Sizes(count);
  let total = 0;
  let same = before?.ids.length === count;
  for (let i = 0; i < count; i++) {
    const target = fields(items[i], `targets[${i}]`, KEYS);
    const given = target.id;
    const id = typeof given === "string" ? given : text(given, `targets[${i}].id`);
    numbers[4 * i] = checked(target.x, -1e50, number, i, "x");
    numbers[4 * i + 1] = checked(target.y, -1e50, number, i, "y");
    const width = checked(target.width, 1e-50, positive, i, "width");
    numbers[4 * i + 2] = sizes.place(width, checked(target.height, 1e-50, positive, i, "height"));
    const { prior } = target;
    total += numbers[4 * i + 3] = isAbsent(prior) ? 1 : checked(prior, 0, notNegative, i, "prior");
    same &&= id === before?.ids[i];
    ids.push(id);
  }
  const places = before && same ? before.places : placesOf(ids);
  if (count > 0 && !(total > 0)) {
    throw new WhitherError("out-of-range", "targets", `the priors must have a finite sum above 0, it is ${total}`);
  }
  return { ids, places, sides: Float64Array.from(sizes.sides), numbers };
}

function placesOf(ids: readonly string[]): Map<string, number> {
  const places = new Map<string, number>();
  ids.forEach((id, i) => {
    const first = places.get(id);
    if (first !== undefined) {
      throw new WhitherError("duplicate-id", `targets[${i}].id`, `the id ${JSON.stringify(id)} is taken by targets[${first}]`);
    }
    places.set(id, i);
  });
  return places;
}
