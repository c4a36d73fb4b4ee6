// `whither/pointing`: the pointing model alone, with a WebAssembly of its own. It must return what `whither` returns, to the bit.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import * as whither from "whither";
import * as pointing from "whither/pointing";
import { close, golden, movement, refuses, same, small } from "./support.mjs";

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
  refuses(() => new pointing.Predictor(whither.pointerScenario(targets)), "not-initialised", "", message);
  await assert.rejects(pointing.init({ wasm: readFileSync(new URL("../../dist/whither.wasm", import.meta.url)) }), (error) => {
    assert.ok(error instanceof whither.WhitherError);
    assert.match(error.message, /^the module is not this version's pointing\.wasm: /);
    return true;
  });
});

test("init loads once, besides that of whither", async (t) => {
  const compile = t.mock.method(WebAssembly, "compile");
  await Promise.all([pointing.init(), pointing.init(), whither.init()]);
  assert.equal(compile.mock.callCount(), 1);
});

for (const name of ["grid21", "none", "repeats", "ring12", "sizes40"]) {
  test(`pointing-${name}`, () => {
    const { scenario, observations, expected } = golden(`pointing-${name}`);
    const predictor = new pointing.Predictor(scenario);
    observations.forEach(([time, ...position], k) => {
      predictor.observe(time, position);
      close(predictor.probabilities(), expected.probabilities[k], 1e-9, `probabilities after ${k}`);
    });
  });
}

test("everything is what whither returns, to the bit", () => {
  const options = { none: 0.05 };
  assert.deepEqual(pointing.pointerScenario(targets, options), whither.pointerScenario(targets, options));
  const scenario = { ...whither.pointerScenario(targets, options), learning: { strength: 5 } };
  const [one, other] = [whither, pointing].map(({ Predictor }) => new Predictor(scenario));
  const both = (ask) => [one, other].map(ask);
  both((predictor) => predictor.chosen("icon 3"));
  const [time] = movement.at(-1);
  const numbers = ({ mean, covariance }) => [...mean, ...covariance];
  const questions = {
    probabilities: (predictor) => predictor.probabilities(),
    none: (predictor) => [predictor.none],
    logLikelihoods: (predictor) => predictor.logLikelihoods(),
    arrival: (predictor) => [...predictor.arrival().times, ...predictor.arrival("icon 2").probabilities],
    remaining: (predictor) => Object.values(predictor.remaining),
    state: (predictor) => numbers(predictor.state()),
    initialState: (predictor) => numbers(predictor.initialState()),
    forecast: (predictor) => numbers(predictor.forecast(time + 0.1)),
    path: (predictor) => predictor.path("icon 5", [time, time + 0.05, time + 5]),
  };
  for (const [t, ...position] of movement) both((predictor) => predictor.observe(t, position));
  for (const [name, ask] of Object.entries(questions)) {
    const [expected, found] = both(ask);
    assert.ok(expected.length > 0, name);
    same(found, expected, name);
  }
  assert.deepEqual(...both((predictor) => predictor.best));
  assert.deepEqual(...both((predictor) => predictor.snapshot()));

  const restored = pointing.Predictor.restore(one.snapshot());
  both((predictor) => predictor.removeDestination("icon 4"));
  restored.removeDestination("icon 4");
  same(restored.probabilities(), one.probabilities(), "restored");
  same(other.probabilities(), one.probabilities(), "with a target less");
});

test("what it does not have is refused by name", () => {
  const scenario = pointing.pointerScenario(targets);
  const make = (changes) => () => new pointing.Predictor({ ...scenario, ...changes });
  refuses(make({ method: "bridging" }), "out-of-range", "method", 'must be one of "pointing", got "bridging"');
  refuses(() => new pointing.Predictor(small()), "missing-key", "method", 'missing key "method"');
  const motion = { ...scenario.motion, type: "brownian" };
  refuses(make({ motion }), "out-of-range", "motion.type", 'must be one of "constantVelocity", got "brownian"');
  const arrival = { type: "uniform", from: 1, to: 2 };
  refuses(make({ arrival }), "unknown-key", "arrival", 'cannot be combined with the method "pointing", got an object');
  const [first] = scenario.destinations;
  const message = 'unknown key "arrival", expected one of "id", "mean", "covariance", "center", "size", "endVelocity", "prior"';
  refuses(make({ destinations: [{ ...first, arrival }] }), "unknown-key", "destinations[0].arrival", message);
  assert.equal(pointing.ConditionallyMarkovSequence, undefined);
});

test("it exports what whither does, but for the sequences", () => {
  const names = Object.keys(whither).filter((name) => name !== "ConditionallyMarkovSequence");
  assert.deepEqual(Object.keys(pointing).sort(), names.sort());
  assert.equal(pointing.WhitherError, whither.WhitherError);
});
