import { WhitherError } from "#error";
import { isList, MOST_ITEMS } from "../core/list.js";
import { type Check, type Fields, fields, isAbsent, list, notNegative, number, positive, text } from "../core/read.js";
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
  /** Of each target `x`, `y`, width, height and prior. */
  readonly numbers: Float64Array;
}

const KEYS = ["id", "x", "y", "width", "height", "prior"];

/** Whether `fields` would return a value, with {@link KEYS}, found without a list of the keys and without a path. */
function isUsual(value: unknown): value is Fields {
  if (typeof value !== "object" || value === null || isList(value) || ArrayBuffer.isView(value)) return false;
  for (const key in value) {
    switch (key) {
      case "id":
      case "x":
      case "y":
      case "width":
      case "height":
      case "prior":
        continue;
      default:
        // it may be inherited, or undefined
        return false;
    }
  }
  return true;
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
  const numbers = new Float64Array(5 * count);
  let total = 0;
  let same = before?.ids.length === count;
  for (let i = 0; i < count; i++) {
    const item = items[i];
    const target = isUsual(item) ? item : fields(item, `targets[${i}]`, KEYS);
    const given = target.id;
    const id = typeof given === "string" ? given : text(given, `targets[${i}].id`);
    numbers[5 * i] = checked(target.x, -1e50, number, i, "x");
    numbers[5 * i + 1] = checked(target.y, -1e50, number, i, "y");
    numbers[5 * i + 2] = checked(target.width, 1e-50, positive, i, "width");
    numbers[5 * i + 3] = checked(target.height, 1e-50, positive, i, "height");
    const { prior } = target;
    total += numbers[5 * i + 4] = isAbsent(prior) ? 1 : checked(prior, 0, notNegative, i, "prior");
    same &&= id === before?.ids[i];
    ids.push(id);
  }
  const places = before && same ? before.places : placesOf(ids);
  if (count > 0 && !(total > 0)) {
    throw new WhitherError("out-of-range", "targets", `the priors must have a finite sum above 0, it is ${total}`);
  }
  return { ids, places, numbers };
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
