import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Hand } from "../hand.js";
import { readOptions } from "../options.js";
import type { Target } from "../targets.js";
import type { WatchOptions } from "../types.js";
import { Candidates } from "./candidates.js";
import { Movement } from "./movements.js";

const target = (key: string, x: number, threshold?: number): Target =>
  ({ key, settings: { threshold }, box: { x, y: -10, width: 20, height: 20 } }) as never;

/** A pointer that moves to the right and is at a place, and what it is taken to mean. */
function open(x: number, options: WatchOptions = {}) {
  const settings = readOptions({ root: { querySelectorAll() {} } as never, ...options });
  const movement = new Movement({ time: 0, x: x - 10, y: 0 }, []);
  for (const step of [0, 1]) movement.add({ time: step / 100, x: x - 10 + 10 * step, y: 0 });
  const hand = new Hand("mouse");
  hand.predicted = { movement } as never;
  const candidates = new Candidates();
  const meant: string[] = [];
  const intents = { begin: ({ key }: Target) => meant.push(key) } as never;
  return (now: number, ...list: readonly (readonly [Target, number])[]) => {
    const [targets, probabilities] = [list.map(([each]) => each), list.map(([, probability]) => probability)];
    const posterior = { targets, probabilities, prior: () => 1 / targets.length } as never;
    candidates.consider(hand, movement, posterior, now, settings, intents);
    return meant.splice(0);
  };
}

describe("targets that a pointer is sure enough of", () => {
  it("are asked for more while they are far, and for less when they are near", () => {
    const [near, far, other] = [target("near", 60), target("far", 600), target("other", 300)];
    const consider = open(50);
    assert.deepEqual(consider(0, [near, 0.7], [far, 0.2], [other, 0]), ["near"]);
    assert.deepEqual(consider(0, [near, 0.1], [far, 0.85], [other, 0]), []);
    assert.deepEqual(consider(0, [near, 0], [far, 0.97], [other, 0]), ["far"]);
  });

  it("lie ahead", () => {
    const [left, right] = [target("left", 0), target("right", 60)];
    const consider = open(50);
    assert.deepEqual(consider(0, [left, 0.99], [right, 0.01]), []);
    assert.deepEqual(consider(0, [left, 0.01], [right, 0.99]), ["right"]);
  });

  it("are none that would be released at once, unless their own threshold is below the release", () => {
    const [near, other] = [target("near", 60), target("other", 300)];
    assert.deepEqual(open(55, { threshold: 0.8, release: 0.7 })(0, [near, 0.69], [other, 0]), []);
    assert.deepEqual(open(55, { threshold: 0.8, release: 0.7 })(0, [near, 0.71], [other, 0]), ["near"]);
    const own = target("own", 60, 0.3);
    assert.deepEqual(open(55, { threshold: 0.8, release: 0.7 })(0, [own, 0.31], [near, 0], [other, 0], [other, 0]), ["own"]);
  });

  it("have to stay so for as long as reasons.pointer asks", () => {
    const [near, other] = [target("near", 60), target("other", 300)];
    const consider = open(50, { reasons: { pointer: { after: 50 } } });
    assert.deepEqual(consider(0, [near, 0.9], [other, 0]), []);
    assert.deepEqual(consider(30, [near, 0.4], [other, 0]), []);
    assert.deepEqual(consider(60, [near, 0.9], [other, 0]), []);
    assert.deepEqual(consider(110, [near, 0.9], [other, 0]), ["near"]);
  });

  it("have to have become more probable where the prior is enough already", () => {
    const consider = open(50);
    const only = target("only", 60);
    // the prior is .8, odds of 4
    assert.deepEqual(consider(0, [only, 0.85]), []);
    assert.deepEqual(consider(0, [only, 0.86]), ["only"]);
  });
});
