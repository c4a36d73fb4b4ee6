/**
 * A watcher where there is no page.
 *
 * @module
 */
import { dispose as disposeName } from "../core/lifetime.js";
import { ledgerOf } from "./ledger.js";
import { RESTING } from "./snapshot.js";
import type { Watcher } from "./types.js";

const dispose: typeof Symbol.dispose = disposeName;

/** Does nothing, and reads as between movements. */
export function nowhere(): Watcher {
  const nothing = () => {};
  return {
    ready: new Promise(nothing),
    targets: [],
    best: null,
    none: 1,
    remaining: null,
    ledger: ledgerOf(() => undefined),
    probability: () => 0,
    forecast: () => null,
    path: () => new Float64Array(0),
    set: nothing,
    add: nothing,
    remove: nothing,
    refresh: nothing,
    update: nothing,
    pause: nothing,
    resume: nothing,
    stop: nothing,
    subscribe: () => nothing,
    getSnapshot: () => RESTING,
    [dispose]: nothing,
  };
}
