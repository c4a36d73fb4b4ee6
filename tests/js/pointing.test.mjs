// `whither/pointing`: an entry with a WebAssembly of its own, what it refuses, and the life of a `PointerPredictor`. That its
// probabilities are those of `whither` is in pointer-predictor.test.mjs.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import * as whither from "whither";
import * as pointing from "whither/pointing";
import { changed, movement, read, refuses, same } from "./support.mjs";

const targets = Array.from({ length: 21 }, (_, i) => ({
  id: `icon ${i}`,
  x: 100 + 150 * (i % 7),
  y: 100 + 150 * Math.floor(i / 7),
  width: 60 + 5 * (i % 3),
  height: 60,
}));

test("nothing works before init, even where whither is loaded", async () => {
  await whither.init();
  const message = "call init() and wait for it first: await init()";
  refuses(() => new pointing.PointerPredictor(targets), "not-initialised", "", message);
  await assert.rejects(pointing.init({ wasm: readFileSync(new URL("../../dist/whither.wasm", import.meta.url)) }), (error) => {
    assert.ok(error instanceof whither.WhitherError);
    assert.match(error.message, /^the module is not this version's pointing\.wasm: /);
    return true;
  });
});

test("init loads once, beside that of whither", async (t) => {
  const compile = t.mock.method(WebAssembly, "compile");
  await Promise.all([pointing.init(), pointing.init(), whither.init()]);
  assert.equal(compile.mock.callCount(), 1);
});

test("it exports the predictor of pointers and what belongs to it", () => {
  assert.deepEqual(Object.keys(pointing).sort(), ["PointerPredictor", "WhitherError", "init", "initSync"]);
  assert.equal(pointing.WhitherError, whither.WhitherError);
});

const { bases, rows } = read("errors.json");

/** Errors of a scenario for pointers name destinations, those of a `PointerPredictor` the targets that it was given. */
const ofTargets = (text) => text.replace(/^destinations/, "targets").replace(/destinations\[/, "targets[");

/** A `PointerPredictor` may have no targets. */
const isWrong = ({ base, code }) => base === "pointer" && code !== "no-destinations";

for (const { change, code, path, message } of rows.filter(isWrong)) {
  test(`as pointerScenario: ${JSON.stringify(change)}`, () => {
    const { targets, options } = changed(bases.pointer.from, change);
    const keys = { "options.nothing": ', "constants", "learning"', "targets[0].z": ', "prior"' };
    const run = () => new pointing.PointerPredictor(targets, options);
    // shake is one of its constants
    refuses(run, code, ofTargets(path), `${ofTargets(message).replace(', "shake"', "")}${keys[path] ?? ""}`);
  });
}

/** Rows of the scenario that a `PointerPredictor` words for itself: its own keys, and one form fewer of each noise. */
const OWN = [
  "/pointing",
  "/motion/type",
  "/method",
  "/motion/noise",
  "/observation/noise",
  "/destinations/0/endVelocity",
  "/arrival",
  "/pointing/speed",
];

for (const { change, code, path, message } of rows.filter((row) => row.base === "pointing" && !row.call)) {
  const [pointer] = Object.keys(change);
  if (OWN.includes(pointer)) continue;
  test(`constants as in a scenario: ${JSON.stringify(change)}`, () => {
    const constants = changed(bases.pointing.from, change);
    refuses(() => new pointing.PointerPredictor(targets, { constants }), code, path, message);
  });
}

test("what else is wrong with targets, options and constants", () => {
  const make = (given, options) => () => new pointing.PointerPredictor(given, options);
  const [first, second] = targets;
  refuses(make("all"), "wrong-type", "targets", 'must be a list, got "all"');
  refuses(make([first, null]), "wrong-type", "targets[1]", "must be an object, got nothing");
  refuses(make([first, { ...second, id: 7 }]), "wrong-type", "targets[1].id", "must be a string, got 7");
  refuses(make([first, { ...second, width: -3 }]), "out-of-range", "targets[1].width", "must be greater than 0, got -3");
  refuses(make([first, { ...second, height: 1e-60 }]), "out-of-range", "targets[1].height", "must be at least 1e-50, got 1e-60");
  refuses(make([first, { ...second, y: 1e51 }]), "out-of-range", "targets[1].y", "must be from -1e50 to 1e50, got 1e+51");
  refuses(make([first, { ...second, x: undefined }]), "missing-key", "targets[1].x", 'missing key "x"');
  refuses(make([first, { ...second, prior: -1 }]), "out-of-range", "targets[1].prior", "must be at least 0, got -1");
  const without = [first, second].map((target) => ({ ...target, prior: 0 }));
  refuses(make(without), "out-of-range", "targets", "the priors must have a finite sum above 0, it is 0");
  refuses(make(targets, [1, "two", [], {}, 5]), "wrong-type", "options", 'must be an object, got [1, "two", [], an object, ...]');
  refuses(make(targets, { none: "x" }), "wrong-type", "none", 'must be a number, got "x"');
  refuses(make(targets, { constants: { none: 1 } }), "out-of-range", "none", "must be at least 0 and less than 1, got 1");
  const constants = (given) => make(targets, { constants: given });
  refuses(constants(3), "wrong-type", "constants", "must be an object, got 3");
  refuses(constants({ method: "bridging" }), "out-of-range", "method", 'must be "pointing" in whither/pointing, got "bridging"');
  refuses(
    constants({ motion: { type: "brownian" } }),
    "out-of-range",
    "motion.type",
    'must be "constantVelocity" in whither/pointing, got "brownian"',
  );
  refuses(constants({ motion: { dimensions: 3 } }), "out-of-range", "motion.dimensions", "must be 2 in whither/pointing, got 3");
  refuses(constants({ motion: { noise: [1, 2] } }), "wrong-type", "motion.noise", "must be a number, got [1, 2]");
  refuses(constants({ observation: { noise: [1] } }), "wrong-length", "observation.noise", "must have 2 numbers, has 1");
  refuses(
    constants({
      observation: {
        noise: [
          [1, 0],
          [0, 1],
        ],
      },
    }),
    "wrong-type",
    "observation.noise[0]",
    "must be a number, got [1, 0]",
  );
  refuses(
    constants({ initial: { velocity: "x" } }),
    "wrong-type",
    "initial.velocity",
    'must be a number or a list of 2 numbers, one for each axis, got "x"',
  );
  refuses(constants({ pointing: { noise: [1, 0] } }), "out-of-range", "pointing.noise[1]", "must be greater than 0, got 0");
  refuses(
    constants({ pointing: { timeToGo: { points: 1002 } } }),
    "too-large",
    "pointing.timeToGo.points",
    "must be an integer from 2 to 1001, got 1002",
  );
  const words = '"method", "none", "destinations", "motion", "observation", "initial", "pointing"';
  refuses(
    constants({ learning: { strength: 5 } }),
    "unknown-key",
    "learning",
    `unknown key "learning", expected one of ${words}`,
  );
});

test("what is wrong with an observation or a question changes nothing", () => {
  const pointer = new pointing.PointerPredictor(targets, { none: 0.1 });
  const wrong = (run, ...error) => {
    const before = [...pointer.probabilities(), pointer.none];
    refuses(run, ...error);
    same([...pointer.probabilities(), pointer.none], before, error.join());
  };
  assert.deepEqual(
    [pointer.best, pointer.remaining, pointer.forecast(1), pointer.path("icon 1", [2]).length],
    [null, null, null, 0],
  );
  wrong(() => pointer.observe(1, [5, null]), "missing-key", "position", "the first observation must have both axes");
  for (const [time, ...position] of movement) pointer.observe(time, position);
  const time = movement.at(-1)[0];
  wrong(() => pointer.observe(NaN, [1, 2]), "not-finite", "time", "must be a finite number, got NaN");
  wrong(() => pointer.observe("1", [1, 2]), "wrong-type", "time", 'must be a number, got "1"');
  wrong(
    () => pointer.observe(1, [1, 2]),
    "time-not-increasing",
    "time",
    `must be at least the last observation's, ${time}, got 1`,
  );
  wrong(
    () => pointer.observe(2e12, [1, 2]),
    "out-of-range",
    "time",
    `must be at most 1e12 seconds after the first observation's, 2, got 2000000000000`,
  );
  wrong(() => pointer.observe(time, [1, 2, 3]), "wrong-length", "position", "must have 2 numbers, has 3");
  wrong(() => pointer.observe(time, [1, Infinity]), "not-finite", "position[1]", "must be a finite number, got Infinity");
  wrong(() => pointer.observe(time, [-1e51, 1]), "out-of-range", "position[0]", "must be from -1e50 to 1e50, got -1e+51");
  wrong(() => pointer.observe(time, ["1", 1]), "wrong-type", "position[0]", 'must be a number, got "1"');
  wrong(() => pointer.observe(time), "missing-key", "position", 'missing key "position"');
  wrong(() => pointer.observe(time, "12"), "wrong-type", "position", 'must be a list, got "12"');
  wrong(() => pointer.probabilities([]), "wrong-type", "into", "must be a Float64Array");
  wrong(() => pointer.probabilities(new Float64Array(20)), "wrong-length", "into", "must have 21 numbers, has 20");
  wrong(() => pointer.forecast(1), "out-of-range", "time", `must be at least the last observation's time, ${time}, got 1`);
  wrong(
    () => pointer.forecast(2e12),
    "out-of-range",
    "time",
    "must be at most 1e12 seconds after the last observation, got 2000000000000",
  );
  wrong(() => pointer.forecast(), "missing-key", "time", 'missing key "time"');
  wrong(
    () => pointer.path("icon", [time]),
    "unknown-id",
    "id",
    'no target "icon", there are "icon 0", "icon 1", "icon 2", "icon 3", "icon 4", ...',
  );
  wrong(
    () => pointer.path("icon 1", [time, 1]),
    "out-of-range",
    "times[1]",
    `must be at least the last observation's time, ${time}, got 1`,
  );
  wrong(() => pointer.path("icon 1", [null]), "wrong-type", "times[0]", "must be a number, got nothing");
  wrong(
    () => pointer.setTargets([targets[0], targets[0]]),
    "duplicate-id",
    "targets[1].id",
    'the id "icon 0" is taken by targets[0]',
  );
});

test("a predictor is freed once, and used no more", () => {
  const pointer = new pointing.PointerPredictor(targets);
  const copy = pointer.clone();
  pointer.free();
  const uses = {
    observe: () => pointer.observe(0, [1, 2]),
    probabilities: () => pointer.probabilities(),
    none: () => pointer.none,
    best: () => pointer.best,
    remaining: () => pointer.remaining,
    forecast: () => pointer.forecast(1),
    path: () => pointer.path("icon 1", [1]),
    setTargets: () => pointer.setTargets(targets),
    reset: () => pointer.reset(),
    clone: () => pointer.clone(),
    free: () => pointer.free(),
  };
  for (const use of Object.values(uses)) refuses(use, "freed", "", "this predictor was freed");
  if (Symbol.dispose) {
    pointer[Symbol.dispose]();
    copy[Symbol.dispose]();
    refuses(() => copy.best, "freed", "", "this predictor was freed");
  }
});

test("memory stays flat over a hundred thousand observations, changes of targets and copies", () => {
  const pointer = new pointing.PointerPredictor(targets);
  const into = new Float64Array(21);
  const size = () => process.memoryUsage().arrayBuffers;
  const round = (k) => {
    for (let i = 0; i < 1000; i++) {
      pointer.observe(k + i / 1000, [300 + i / 10, 200]);
      pointer.probabilities(into);
    }
    pointer.setTargets(targets.slice(0, 20));
    pointer.setTargets(targets);
    pointer.clone().free();
    pointer.reset();
  };
  for (let k = 0; k < 20; k++) round(k);
  const before = size();
  for (let k = 20; k < 100; k++) round(k);
  assert.ok(size() <= before + 2 ** 20, `${size() - before} bytes more`);
});
