// Whatever takes options reads all of them: one table of what is refused, for every function that takes some.
import assert from "node:assert/strict";
import { test } from "node:test";
import * as slim from "whither/slim";
import * as pointing from "whither/pointing";
import {
  ConditionallyMarkovSequence,
  handScenario,
  init,
  initSync,
  pointerScenario,
  Predictor,
  rayMap,
  rayScenario,
  WhitherError,
} from "whither";
import { fit } from "whither/study";
import { small } from "./support.mjs";

await Promise.all([init(), pointing.init()]);

const target = { id: "a", x: 1, y: 2, width: 3, height: 4 };
const parameters = {
  motion: { type: "brownian", dimensions: 1, noise: 0.1 },
  timeStep: 1,
  steps: 2,
  pinnedMean: [0, 10],
  pinnedCovariance: [
    [1, 0],
    [0, 4],
  ],
  observation: { noise: 0.2 },
};
const predictor = new Predictor(small());
const sequence = new ConditionallyMarkovSequence(parameters);
const track = {
  targets: [[0, 0, 1, 1]],
  target: 0,
  samples: [
    [0, 5, 5],
    [1, 0, 0],
  ],
};
let time = 0;

/** Each function: how it is called with options, what it needs of them, and the keys that it reads. */
const functions = {
  init: { call: (options) => init(options), keys: ["wasm"] },
  "init of whither/slim": { call: (options) => slim.init(options), keys: ["wasm"] },
  "init of whither/pointing": { call: (options) => pointing.init(options), keys: ["wasm"] },
  initSync: { call: (options) => initSync(options), keys: ["module"] },
  "initSync of whither/pointing": { call: (options) => pointing.initSync(options), keys: ["module"] },
  observe: { call: (options) => predictor.observe(++time, [1, 2], options), keys: ["noise"] },
  "observe with a missing axis": { call: (options) => predictor.observe(++time, [1, null], options), keys: ["noise"] },
  pointerScenario: { call: (options) => pointerScenario([target], options), keys: ["none", "shake"], prefix: "options." },
  rayScenario: {
    call: (options) => rayScenario([{ id: "a", azimuth: 1, elevation: 2, width: 3, height: 4 }], options),
    keys: ["none", "shake", "noise", "unit"],
    prefix: "options.",
  },
  handScenario: {
    call: (options) => handScenario([target], options),
    keys: ["none", "shake", "noise", "unit"],
    prefix: "options.",
  },
  rayMap: { call: (options) => rayMap([0, 0, -1], options), keys: ["unit"], prefix: "options." },
  PointerPredictor: {
    call: (options) => new pointing.PointerPredictor([target], options),
    keys: ["none", "constants", "learning"],
    prefix: "options.",
  },
  sample: { call: (options) => sequence.sample(options), keys: ["seed", "count"], needs: { seed: 1, count: 1 } },
  fit: {
    call: (options) => fit([track], { ...small(), destinations: undefined }, options),
    keys: ["constants", "evaluations", "destination", "progress"],
    // it reads all of its options, and then finds too few tracks
    fine: "out-of-range",
  },
};

/** What comes of a call: the error of one that throws or rejects. */
async function outcome(call, options) {
  try {
    await call(options);
    return null;
  } catch (error) {
    assert.ok(error instanceof WhitherError || error.name === "WhitherError", `${error}`);
    return error;
  }
}

for (const [name, { call, keys, needs = {}, prefix = "", fine }] of Object.entries(functions)) {
  test(`${name} refuses what it does not read`, async () => {
    const expected = `expected one of ${keys.map((key) => `"${key}"`).join(", ")}`;
    // a slip of the pen in each key, a key of another function, one that every object seems to have
    const slips = keys.map((key) => key.slice(0, -1));
    for (const key of [...slips, "signal", "toString", "__proto__", ""]) {
      for (const value of [1, null, "words", {}]) {
        const options = Object.defineProperty({ ...needs }, key, { value, enumerable: true });
        const { code, path, message } = await outcome(call, options);
        assert.deepEqual([code, path], ["unknown-key", prefix + key]);
        assert.equal(message, `${path === "" ? "" : `${path}: `}unknown key "${key}", ${expected}`);
      }
    }
  });

  test(`${name} refuses options that are none`, async () => {
    const cases = [
      [9, "must be an object, got 9"],
      [Number.NaN, "must be an object, got NaN"],
      ["noise", 'must be an object, got "noise"'],
      ["", 'must be an object, got ""'],
      [true, "must be an object, got true"],
      [false, "must be an object, got false"],
      [[1, 2], /^must be an object, got (a list|\[1, 2\])$/],
      [Float64Array.of(1, 2), /^must be an object, got (a list|\[1, 2\])$/],
      [5n, /, got (a bigint|5n, a bigint)$/],
      [Symbol("x"), /, got a symbol$/],
      [() => 1, /, got a function$/],
    ];
    for (const [options, expected] of cases) {
      const error = await outcome(call, options);
      assert.ok(error !== null, `${String(options)} was taken`);
      assert.deepEqual([error.code, error.path], ["wrong-type", "options"], `${String(options)}: ${error.message}`);
      const message = error.message.slice("options: ".length);
      if (expected instanceof RegExp) assert.match(message, expected);
      else assert.equal(message, expected);
    }
  });

  test(`${name} takes no options, and keys that are undefined`, async () => {
    const gone = {
      ...needs,
      ...Object.fromEntries(keys.filter((key) => !(key in needs)).map((key) => [key, undefined])),
      signal: undefined,
    };
    for (const options of [gone, ...(Object.keys(needs).length > 0 ? [needs] : [undefined, null, {}, Object.create(null)])]) {
      const error = await outcome(call, options);
      assert.equal(error?.code, fine, `${error?.message}`);
    }
  });
}

test("an option that is wrong is named, with its value", async () => {
  const cases = [
    [() => predictor.observe(++time, [1, 2], { noise: "1" }), "wrong-type", "noise", /got "1"$/],
    [() => pointerScenario([target], { none: "1" }), "wrong-type", "options.none", /got "1"$/],
    [() => sequence.sample({ seed: 1 }), "missing-key", "count", /missing key "count"$/],
    [() => sequence.sample(), "missing-key", "seed", /missing key "seed"$/],
    [() => sequence.sample({ seed: -1, count: 1 }), "out-of-range", "seed", /got -1$/],
    [() => fit([track], small(), { evaluations: 0.5 }), "out-of-range", "evaluations", /got 0.5$/],
    [() => fit([track], small(), { constants: "motion.noise" }), "wrong-type", "constants", /got "motion.noise"$/],
    [() => fit([track], small(), { tracks: [] }), "unknown-key", "tracks", /unknown key "tracks"/],
    [() => fit([track], small(), { destination: 3 }), "wrong-type", "destination", /got 3$/],
  ];
  for (const [call, code, path, message] of cases) {
    const error = await outcome(call);
    assert.deepEqual([error?.code, error?.path], [code, path], `${call}`);
    assert.match(error.message, message);
  }
});

test("after all that was refused, the predictor is as it was", () => {
  const [used, untouched] = [new Predictor(small()), new Predictor(small())];
  for (const one of [used, untouched]) one.observe(0, [400, 300]);
  for (const options of [9, { nosie: 1 }, [1], "x"]) assert.throws(() => used.observe(1, [500, 300], options), WhitherError);
  for (const one of [used, untouched]) one.observe(1, [420, 300], {});
  assert.deepEqual(used.probabilities(), untouched.probabilities());
});
