/** Movements of the simulated hand of `whither/testing` through a field, one after the other. */
import { hand } from "whither/testing";
import { nextTarget, type Layout, randomOf } from "./layouts.ts";
import type { Box, Movement } from "./movement.ts";

/** Who has moved, in the lines. */
export const SIMULATED = "simulated hand";

export interface Task {
  readonly layout: Layout;
  readonly targets: readonly Box[];
}

/** So many movements, from the middle of the target `from` on; another seed, other movements. */
export function simulate({ layout, targets }: Task, count: number, seed: number, from = 0): Movement[] {
  const random = randomOf(seed);
  const movements: Movement[] = [];
  let at = from;
  let [x, y] = targets[at] ?? [0, 0];
  for (let k = 0; k < count; k += 1) {
    const target = nextTarget(layout, at, targets.length, random);
    const [tx = 0, ty = 0, width = 1, height = 1] = targets[target] ?? [];
    const samples = hand({ x, y }, { x: tx - width / 2, y: ty - height / 2, width, height }, { seed: 1000 * seed + k });
    movements.push({ id: `${layout}-${seed}-${k + 1}`, user: SIMULATED, targets, target, samples });
    [, x, y] = samples.at(-1) ?? [0, x, y];
    at = target;
  }
  return movements;
}
