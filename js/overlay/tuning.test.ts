import assert from "node:assert/strict";
import { describe, it } from "node:test";
import type { Inspection, TargetOptions, WatchOptions, WatchTarget } from "#dom";
import { Tuning } from "./tuning.js";

const target = { id: "a" } as unknown as WatchTarget;

/** A watcher with these options, of which every target has `shared`. */
function tuned(stated: WatchOptions, shared: TargetOptions = {}, own: TargetOptions | null = null) {
  let given: WatchOptions = stated;
  const owned = new Map<WatchTarget, TargetOptions | null>([[target, own]]);
  const watcher = {
    targets: [target],
    update: (options: WatchOptions) => (given = { ...given, ...options }),
    set: (one: WatchTarget, options: TargetOptions | null) => owned.set(one, options),
  };
  const inspection = {
    watcher,
    get options() {
      const { threshold = 0.8, release = 0.625 * threshold, none = 0.2 } = given;
      return { threshold, release, none };
    },
    optionsOf: (one: WatchTarget) => ({ ...shared, ...owned.get(one) }),
  };
  const tuning = new Tuning(inspection as unknown as Inspection);
  return { tuning, watcher, own: () => owned.get(target), given: () => given };
}

describe("tuning", () => {
  it("a release that nobody stated goes with the threshold, and is nobody's afterwards", () => {
    const { tuning, given } = tuned({});
    tuning.set({ threshold: 0.4 });
    assert.deepEqual(tuning.values, { threshold: 0.4, release: 0.25, none: 0.2 });
    assert.equal(tuning.code, "{ threshold: 0.4 }");
    tuning.restore();
    assert.deepEqual([given().release, tuning.values], [undefined, { threshold: 0.8, release: 0.5, none: 0.2 }]);
  });

  it("one that is stated stays, also where the threshold passes the one that it would go with", () => {
    const { tuning } = tuned({ threshold: 0.9, release: 0.5 });
    for (const threshold of [0.85, 0.8, 0.7]) tuning.set({ threshold });
    assert.deepEqual(tuning.values, { threshold: 0.7, release: 0.5, none: 0.2 });
    tuning.set({ threshold: 0.3 });
    assert.equal(tuning.values.release, 0.3);
    tuning.set({ release: 0.6 });
    assert.deepEqual(tuning.values, { threshold: 0.6, release: 0.6, none: 0.2 });
    assert.equal(tuning.code, "{ threshold: 0.6, release: 0.6 }");
    tuning.restore();
    assert.deepEqual(tuning.values, { threshold: 0.9, release: 0.5, none: 0.2 });
    assert.deepEqual([tuning.isChanged, tuning.code], [false, ""]);
  });

  it("a prior is set beside what the target has, and put back: as the watcher's options have it, or its own", () => {
    for (const own of [null, { name: "own", hitSlop: { top: 1, right: 0, bottom: 0, left: 0 } }]) {
      const kept = tuned({}, { prior: 2, name: "shared" }, own);
      kept.tuning.setPrior(target, 4);
      kept.tuning.setPrior(target, 8);
      assert.deepEqual([kept.tuning.prior(target), kept.own()?.name], [8, own?.name ?? "shared"]);
      kept.tuning.restore();
      assert.equal(kept.tuning.prior(target), 2);
      assert.deepEqual(kept.own(), own === null ? null : { prior: 2, ...own });
    }
  });

  it("passes over targets that are gone", () => {
    const { tuning, watcher, own } = tuned({});
    tuning.setPrior(target, 4);
    watcher.targets = [];
    tuning.restore();
    assert.deepEqual(own(), { prior: 4 });
  });
});
