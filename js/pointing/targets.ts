import { WhitherError } from "#error";
import { MOST_ITEMS } from "../core/list.js";
import { fields, isAbsent, list, notNegative, number, positive, text } from "../core/read.js";
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
  readonly #places = new Map<number, Map<number, number>>();

  place(width: number, height: number): number {
    let places = this.#places.get(width);
    if (!places) this.#places.set(width, (places = new Map()));
    let place = places.get(height);
    if (place === undefined) {
      place = this.sides.push(width, height) / 2 - 1;
      places.set(height, place);
    }
    return place;
  }
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
  const sizes = new Sizes();
  let total = 0;
  let same = before?.ids.length === count;
  for (let i = 0; i < count; i++) {
    const path = `targets[${i}]`;
    const target = fields(items[i], path, KEYS);
    const id = text(target.id, `${path}.id`);
    numbers[4 * i] = number(target.x, `${path}.x`);
    numbers[4 * i + 1] = number(target.y, `${path}.y`);
    const width = positive(target.width, `${path}.width`);
    numbers[4 * i + 2] = sizes.place(width, positive(target.height, `${path}.height`));
    const { prior } = target;
    total += numbers[4 * i + 3] = isAbsent(prior) ? 1 : notNegative(prior, `${path}.prior`);
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
