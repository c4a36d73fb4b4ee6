// What `chosen` teaches `Predictor` and `PointerPredictor` about their user, and its way through JSON.
import assert from "node:assert/strict";
import { test } from "node:test";
import { init, pointerScenario, Predictor } from "whither";
import * as pointing from "whither/pointing";
import { close, movement as right, refuses, same, small } from "./support.mjs";

await Promise.all([init(), pointing.init()]);

const { PointerPredictor } = pointing;
const targets = Array.from({ length: 21 }, (_, i) => ({
  id: `icon ${i}`,
  x: 100 + 150 * (i % 7),
  y: 100 + 150 * Math.floor(i / 7),
  width: 60 + (i % 3),
  height: 60,
}));
// so strong that no choice changes the priors
const scenario = { ...pointerScenario(targets, { none: 0.05 }), learning: { strength: 1e50 } };
const pairOf = () => ({
  predictor: new Predictor(scenario),
  pointer: new PointerPredictor(targets, { none: 0.05, learning: true }),
});

/** A way from one icon to another by a detour, at so many samples. */
function way(from, to, count) {
  const [a, b] = [targets[from], targets[to]];
  return Array.from({ length: count + 1 }, (_, k) => {
    const u = k / count;
    const share = u * u * (3 - 2 * u);
    return [0.012 * k, [a.x + share * (b.x - a.x) + 60 * Math.sin(Math.PI * u), a.y + share * (b.y - a.y)]];
  });
}

function follow(one, samples) {
  one.reset();
  for (const [time, position] of samples) one.observe(time, position);
}

test("both classes learn the same from the same movements", () => {
  const { predictor, pointer } = pairOf();
  for (const [from, to, count] of [
    [0, 20, 60],
    [20, 3, 25],
    [3, 4, 8],
    [4, 14, 150],
  ]) {
    for (const one of [predictor, pointer]) {
      follow(one, way(from, to, count));
      one.chosen(targets[to].id);
    }
    const learnt = predictor.learnt();
    assert.deepEqual(Object.keys(learnt), ["confidence", "precision", "movements", "samples", "mean", "low", "high"]);
    // the priors of the scenario are normalised, which costs a last digit
    close(Object.values(pointer.learnt()), Object.values(learnt), 1e-12, "learnt");
    close(pointer.probabilities(), predictor.probabilities(), 1e-12, "probabilities in mid-movement");
    close(Object.values(pointer.remaining), Object.values(predictor.remaining), 1e-12, "remaining");
  }
  assert.equal(pointer.learnt().movements, 4);
  assert.notEqual(pointer.learnt().confidence, 1);
  for (const key of ["mean", "low", "high"]) assert.notEqual(pointer.learnt()[key], 0);
});

test("what was learnt goes through JSON, to another predictor, a clone and a snapshot, and is forgotten with null", () => {
  const { predictor, pointer } = pairOf();
  const fresh = pointer.learnt();
  assert.deepEqual(fresh, { confidence: 1, precision: 4, movements: 0, samples: 0, mean: 0, low: 0, high: 0 });
  for (const one of [predictor, pointer]) {
    follow(one, way(0, 20, 60));
    one.chosen("icon 20");
  }
  const saved = JSON.parse(JSON.stringify(pointer.learnt()));
  for (const other of [pairOf().predictor, pairOf().pointer, new PointerPredictor(targets, { none: 0.05 })]) {
    follow(other, way(20, 2, 30).slice(0, 15));
    const before = other.probabilities();
    other.setLearnt(saved);
    assert.deepEqual(other.learnt(), saved);
    follow(pointer, way(20, 2, 30).slice(0, 15));
    close(other.probabilities(), pointer.probabilities(), 1e-12, "in mid-movement");
    other.setLearnt(null);
    same(other.probabilities(), before, "forgotten");
    assert.deepEqual(other.learnt(), fresh);
    other.setLearnt({ confidence: 0.5 });
    assert.deepEqual(other.learnt(), { ...fresh, confidence: 0.5 });
  }
  assert.deepEqual(pointer.clone().learnt(), saved);
  assert.deepEqual(Predictor.restore(JSON.parse(JSON.stringify(predictor.snapshot()))).learnt(), predictor.learnt());
});

test("without learning choices teach nothing, and ids are checked", () => {
  const pointer = new PointerPredictor(targets);
  follow(pointer, way(0, 20, 60));
  pointer.chosen("icon 20");
  assert.equal(pointer.learnt().movements, 0);
  refuses(
    () => pointer.chosen("nobody"),
    "unknown-id",
    "id",
    'no target "nobody", there are "icon 0", "icon 1", "icon 2", "icon 3", "icon 4", ...',
  );
  refuses(() => pointer.chosen(3), "wrong-type", "id", "must be a string, got 3");
  refuses(() => new PointerPredictor(targets, { learning: 1 }), "wrong-type", "learning", "must be true or false, got 1");
  pointer.setTargets([]);
  refuses(() => pointer.chosen("icon 20"), "unknown-id", "id", 'no target "icon 20", there are none');
});

test("with another method it has no effect", () => {
  const predictor = new Predictor(small({ learning: { strength: 1 } }));
  for (const [time, ...position] of right) predictor.observe(time, position);
  const before = predictor.probabilities();
  predictor.setLearnt({ confidence: 0.3 });
  same(predictor.probabilities(), before, "probabilities");
  predictor.chosen("right");
  assert.equal(predictor.learnt().movements, 0);
});

for (const [given, code, path, message] of [
  [{}, "missing-key", "learnt.confidence", 'missing key "confidence"'],
  [{ confidence: "1" }, "wrong-type", "learnt.confidence", 'must be a number, got "1"'],
  [{ confidence: 0.1 }, "out-of-range", "learnt.confidence", "must be from 0.2 to 3, got 0.1"],
  [{ confidence: NaN }, "not-finite", "learnt.confidence", "must be a finite number, got NaN"],
  [{ confidence: 1, precision: 0 }, "out-of-range", "learnt.precision", "must be from 0.001 to 1000000000, got 0"],
  [{ confidence: 1, movements: -1 }, "out-of-range", "learnt.movements", "must be from 0 to 1000000000, got -1"],
  [{ confidence: 1, samples: Infinity }, "not-finite", "learnt.samples", "must be a finite number, got Infinity"],
  [{ confidence: 1, high: -4 }, "out-of-range", "learnt.high", "must be from -3 to 3, got -4"],
  [
    { confidence: 1, hand: "left" },
    "unknown-key",
    "learnt.hand",
    'unknown key "hand", expected one of "confidence", "precision", "movements", "samples", "mean", "low", "high"',
  ],
  [7, "wrong-type", "learnt", "must be an object, got 7"],
]) {
  test(`refuses ${JSON.stringify(given)} as learnt, in both classes alike`, () => {
    for (const one of Object.values(pairOf())) {
      refuses(() => one.setLearnt(given), code, path, message);
      assert.equal(one.learnt().confidence, 1);
    }
  });
}
