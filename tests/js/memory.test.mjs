// What a long-running page or server depends on: memory stays flat.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { pointerScenario, Predictor, initSync } from "whither";
import { refuses, small } from "./support.mjs";

// The memory is the only one that is made in this process.
const memories = [];
const { Instance } = WebAssembly;
WebAssembly.Instance = class extends Instance {
  constructor(...args) {
    super(...args);
    memories.push(this.exports.memory);
  }
};
initSync({ module: readFileSync(new URL("../../dist/whither.wasm", import.meta.url)) });
const size = () => memories[0].buffer.byteLength;

const targets = Array.from({ length: 21 }, (_, i) => ({
  id: `icon ${i}`,
  x: 100 + 150 * (i % 7),
  y: 100 + 150 * Math.floor(i / 7),
  width: 90,
  height: 90,
}));

/** Runs `step` until memory has grown as far as it should, then many times more. */
function staysFlat(warmUp, times, step) {
  for (let i = 0; i < warmUp; i++) step(i);
  const before = size();
  for (let i = warmUp; i < warmUp + times; i++) step(i);
  assert.equal(size(), before);
}

test("over a million observations, in movements of a thousand", () => {
  const predictor = new Predictor(pointerScenario(targets));
  const into = new Float64Array(targets.length);
  const position = [0, 0];
  staysFlat(2000, 1_000_000, (i) => {
    const k = i % 1000;
    if (k === 0) predictor.reset();
    position[0] = 100 + 0.9 * k;
    position[1] = 400 + 20 * Math.sin(k / 50);
    predictor.observe(i * 0.008, position);
    if (k % 50 === 0) predictor.probabilities(into);
  });
});

test("over predictors that come and go, with every call", () => {
  const scenario = pointerScenario(targets);
  staysFlat(50, 2000, () => {
    const predictor = new Predictor(scenario);
    for (let k = 0; k < 3; k++) predictor.observe(k * 0.01, [500 + k, 300]);
    predictor.arrival();
    predictor.forecast(0.1);
    predictor.path("icon 3", [0.1, 0.2]);
    predictor.setDestinations(scenario.destinations);
    const clone = predictor.clone();
    const restored = Predictor.restore(clone.snapshot());
    for (const one of [predictor, clone, restored]) one.free();
  });
});

test("over errors", () => {
  const predictor = new Predictor(small());
  staysFlat(100, 20_000, () => {
    refuses(() => predictor.observe(1, [Number.NaN, 0]), "not-finite", "position[0]", "must be a finite number, got NaN");
    assert.throws(() => new Predictor(small({ none: 7 })), { code: "out-of-range" });
  });
});
