/**
 * What a watcher has computed, as an immutable object that stays the same until something changes.
 *
 * @module
 */
import type { Target } from "./targets.js";
import type { Snapshot } from "./types.js";

/** The posterior of a movement. */
export type Posterior = Pick<Snapshot, "best" | "none" | "targets">;

const NOTHING: readonly never[] = Object.freeze([]);

/** Between movements, while nothing is meant. */
export const RESTING: Snapshot = Object.freeze({ moving: false, best: null, none: 1, targets: NOTHING, intended: NOTHING });

/** The snapshot of a posterior, or with null of a rest; the one before where nothing has changed. */
export function snapshotOf(posterior: Posterior | null, intended: readonly Target[], before: Snapshot): Snapshot {
  const { best, none, targets } = posterior ?? RESTING;
  const meant = intended.map(({ node }) => node);
  const sameMeant = meant.length === before.intended.length && meant.every((node, i) => node === before.intended[i]);
  if (sameMeant && targets === before.targets && none === before.none) return before;
  if (!posterior && meant.length === 0) return RESTING;
  return Object.freeze({ moving: posterior !== null, best, none, targets, intended: Object.freeze(meant) });
}
