// Everything that is refused: its code, its path, its message, as JavaScript gets them. After each error all goes on.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ConditionallyMarkovSequence, init, pointerScenario, Predictor } from "whither";
import { movement, refuses, same, small } from "./support.mjs";

await init();

const [left, middle, right] = small().destinations;
const cyclic = small();
cyclic.motion.itself = cyclic;
let deep = 1;
for (let i = 0; i < 30; i++) deep = [deep];

/** `[what, change of the scenario, code, path, message]` */
const scenarios = [
  ["no scenario", undefined, "wrong-type", "", "must be an object, got nothing"],
  ["a text", "scenario", "wrong-type", "", 'must be an object, got "scenario"'],
  ["an empty object", {}, "missing-key", "motion", 'missing key "motion"'],
  ["an unknown key", small({ metod: "bridging" }), "unknown-key", "metod", 'unknown key "metod", expected one of "motion", "observation", "initial", "arrival", "quadrature", "method", "pointing", "none", "learning", "destinations"'],
  ["an unknown key further down", small({ observation: { noise: 1, nois: 1 } }), "unknown-key", "observation.nois", 'unknown key "nois", expected one of "noise", "matrix"'],
  ["an undefined key is absent", small({ method: undefined, none: null }), null],
  ["NaN", small({ observation: { noise: Number.NaN } }), "not-finite", "observation.noise", "must be a finite number, got NaN"],
  ["infinity", small({ motion: { type: "brownian", dimensions: 2, noise: Infinity } }), "not-finite", "motion.noise", "must be a finite number, got Infinity"],
  ["a dimension too many", small({ motion: { type: "brownian", dimensions: 4, noise: 1 } }), "out-of-range", "motion.dimensions", "must be a whole number from 1 to 3, got 4"],
  ["an unknown motion", small({ motion: { type: "warp", dimensions: 2, noise: 1 } }), "out-of-range", "motion.type", 'must be one of "brownian", "constantVelocity", "constantAcceleration", "integratedOrnsteinUhlenbeck", "meanReverting", "equilibriumRevertingVelocity", "custom", got "warp"'],
  ["a negative noise", small({ motion: { type: "brownian", dimensions: 2, noise: -3 } }), "out-of-range", "motion.noise", "must be greater than 0, got -3"],
  ["too many candidates", small({ motion: { type: "brownian", dimensions: 2, noise: { candidates: new Float64Array(65).fill(1) } } }), "too-large", "motion.noise.candidates", "must have at most 64 candidates, has 65, got [1, 1, 1, 1, ...]"],
  ["a number in words", small({ none: "0.1" }), "wrong-type", "none", 'must be a number, got "0.1"'],
  ["certainly none", small({ none: 1 }), "out-of-range", "none", "must be at least 0 and less than 1, got 1"],
  ["an unknown method", small({ method: "magic" }), "out-of-range", "method", 'must be one of "pseudoObservation", "algorithm1", "algorithm2", "bridging", "singleFilter", "singleFilterApproximate", "pointing", got "magic"'],
  ["an even count for Simpson", small({ quadrature: { rule: "simpson", points: 14 } }), "out-of-range", "quadrature.points", "must be odd: Simpson's rule takes pairs of intervals, got 14"],
  ["too many points", small({ quadrature: { points: 1003 } }), "too-large", "quadrature.points", "must be a whole number from 3 to 1001, got 1003"],
  ["no arrival", small({ arrival: undefined }), "missing-key", "arrival", 'missing key "arrival"'],
  ["an arrival that ends before it begins", small({ arrival: { type: "uniform", from: 2, to: 1 } }), "out-of-range", "arrival.to", 'must be greater than "from", which is 2, got 1'],
  ["an arrival at once", small({ arrival: { type: "uniform", from: 0, to: 1 } }), "out-of-range", "arrival.from", "must be greater than 0 and at most 1e12 seconds, got 0"],
  ["a horizon with algorithm1", small({ method: "algorithm1", arrival: { type: "horizon", from: 0.1, to: 1 } }), "method-accumulates", "arrival", 'a horizon moves with every observation, but "algorithm1" accumulates evidence for each destination and arrival time; "pseudoObservation", "singleFilter" and "singleFilterApproximate" do not'],
  ["no destinations", small({ destinations: [] }), "no-destinations", "destinations", "must have at least one destination, has none"],
  ["destinations that are no list", small({ destinations: { left } }), "wrong-type", "destinations", "must be a list, got an object"],
  ["a destination twice", small({ destinations: [left, right, left] }), "duplicate-id", "destinations[2].id", 'the id "left" is taken by destinations[0]'],
  ["an id that is a number", small({ destinations: [{ ...left, id: 7 }] }), "wrong-type", "destinations[0].id", "must be a string, got 7"],
  ["a centre of the wrong length", small({ destinations: [left, { ...right, center: [1, 2, 3] }] }), "wrong-length", "destinations[1].center", "must have 2 numbers, has 3, got [1, 2, 3]"],
  ["a hole in a centre", small({ destinations: [{ ...left, center: [1, ,] }] }), "wrong-type", "destinations[0].center[1]", "must be a number, got nothing"],
  ["no size", small({ destinations: [{ id: "a", center: [1, 2] }] }), "missing-key", "destinations[0].size", 'missing key "size"'],
  ["a covariance with a center", small({ destinations: [{ ...left, covariance: [[1, 0], [0, 1]] }] }), "unknown-key", "destinations[0].covariance", "has no place beside center and size, got [[1, 0], [0, 1]]"],
  ["a covariance that is not symmetric", small({ destinations: [{ id: "a", mean: [0, 0], covariance: [[2, 1], [0, 2]] }] }), "not-positive-definite", "destinations[0].covariance", "must be symmetric and positive definite, got [[2, 1], [0, 2]]"],
  ["a covariance that is not positive definite", small({ destinations: [{ id: "a", mean: [0, 0], covariance: [[1, 2], [2, 1]] }] }), "not-positive-definite", "destinations[0].covariance", "must be symmetric and positive definite, got [[1, 2], [2, 1]]"],
  ["a covariance of the wrong shape", small({ destinations: [{ id: "a", mean: [0, 0], covariance: [[1, 0]] }] }), "wrong-length", "destinations[0].covariance", "must have 2 rows of 2 numbers, has 1 rows, got [[1, 0]]"],
  ["every prior zero", small({ destinations: [{ ...left, prior: 0 }] }), "out-of-range", "destinations", "the priors must have a finite sum above 0, it is 0"],
  ["a bigint", small({ none: 0n }), "wrong-type", "none", "must be plain data (numbers, strings, lists, objects), got 0n, a bigint"],
  ["a symbol", small({ destinations: [{ ...left, id: Symbol("x") }] }), "wrong-type", "destinations[0].id", "must be plain data (numbers, strings, lists, objects), got a symbol"],
  ["a function", small({ observation: () => 1 }), "wrong-type", "observation", "must be plain data (numbers, strings, lists, objects), got a function"],
  ["a scenario that is a function", () => small(), "wrong-type", "", "must be plain data (numbers, strings, lists, objects), got a function"],
  ["big integers", small({ destinations: [{ ...left, center: BigInt64Array.of(1n, 2n) }] }), "wrong-type", "destinations[0].center[0]", "must be plain data (numbers, strings, lists, objects), got 1n, a bigint"],
  ["an object that refers to itself", cyclic, "wrong-type", "motion.itself", "must be plain data, refers to itself"],
  ["a list that is too deep", small({ destinations: deep }), "wrong-type", `destinations${"[0]".repeat(23)}`, "must be plain data, is nested more than 24 deep"],
  ["a huge sparse list", small({ destinations: new Array(2 ** 32 - 1) }), "too-large", "destinations", "must have no more than 1000000 items, has 4294967295"],
  ["more values than memory", small({ destinations: new Array(1000).fill(new Array(1e6).fill(0)) }), "too-large", "destinations[16][777185]", "must have no more than 16777216 values in all"],
  ["a text longer than memory", small({ method: "x".repeat(2 ** 27) }), "too-large", "method", "must have no more than 67108864 characters in all"],
];

for (const [what, scenario, code, path, message] of scenarios) {
  test(`scenario: ${what}`, () => {
    if (code === null) new Predictor(scenario);
    else refuses(() => new Predictor(scenario), code, path, message);
  });
}

/** `[what, use of a predictor in mid-movement, code, path, message]` */
const uses = [
  ["no time", (p) => p.observe(undefined, [1, 2]), "missing-key", "time", 'missing key "time"'],
  ["a time in words", (p) => p.observe("3", [1, 2]), "wrong-type", "time", 'must be a number, got "3"'],
  ["a time that is a bigint", (p) => p.observe(3n, [1, 2]), "wrong-type", "time", "must be plain data (numbers, strings, lists, objects), got 3n, a bigint"],
  ["NaN for a time", (p) => p.observe(Number.NaN, [1, 2]), "not-finite", "time", "must be a finite number, got NaN"],
  ["NaN for a time, in full", (p) => p.observe(Number.NaN, [1, null]), "not-finite", "time", "must be a finite number, got NaN"],
  ["time that runs backwards", (p) => p.observe(1, [1, 2]), "time-not-increasing", "time", "must be at least the last observation's, 2.304, got 1"],
  ["no position", (p) => p.observe(3), "missing-key", "position", 'missing key "position"'],
  ["a position that is null", (p) => p.observe(3, null), "missing-key", "position", 'missing key "position"'],
  ["a position that is a number", (p) => p.observe(3, 5), "wrong-type", "position", "must be a list, got 5"],
  ["a position in words", (p) => p.observe(3, "12"), "wrong-type", "position", 'must be a list, got "12"'],
  ["a position that is an event", (p) => p.observe(3, { x: 1, y: 2 }), "wrong-type", "position", "must be a list, got an object"],
  ["a coordinate too few", (p) => p.observe(3, [1]), "wrong-length", "position", "must have 2 numbers, has 1"],
  ["a coordinate too many", (p) => p.observe(3, [1, 2, 3]), "wrong-length", "position", "must have 2 numbers, has 3"],
  ["ten coordinates", (p) => p.observe(3, new Float32Array(10)), "wrong-length", "position", "must have 2 numbers, has 10"],
  ["a huge sparse position", (p) => p.observe(3, new Array(2 ** 32 - 1)), "too-large", "position", "must have no more than 1000000 items, has 4294967295"],
  ["a position that says it is huge", (p) => p.observe(3, { length: 2 ** 53 }), "wrong-type", "position", "must be a list, got an object"],
  ["NaN for a coordinate", (p) => p.observe(3, [1, Number.NaN]), "not-finite", "position[1]", "must be a finite number, got NaN"],
  ["NaN beside a missing axis", (p) => p.observe(3, [null, Number.NaN]), "not-finite", "position[1]", "must be a finite number, got NaN"],
  ["a coordinate in words", (p) => p.observe(3, [1, "2"]), "wrong-type", "position[1]", 'must be a number, got "2"'],
  ["a coordinate that is a bigint", (p) => p.observe(3, [1n, 2]), "wrong-type", "position[0]", "must be plain data (numbers, strings, lists, objects), got 1n, a bigint"],
  ["a negative noise", (p) => p.observe(3, [1, 2], { noise: -1 }), "out-of-range", "noise", "must be greater than 0, got -1"],
  ["a noise in words", (p) => p.observe(3, [1, 2], { noise: "1" }), "wrong-type", "noise", 'must be a number or a list of 2 numbers, one for each axis, got "1"'],
  ["a noise that is no covariance", (p) => p.observe(3, [1, 2], { noise: [[1, 2], [2, 1]] }), "not-positive-definite", "noise", "must be symmetric and positive definite, got [[1, 2], [2, 1]]"],
  ["an array of another kind to write to", (p) => p.probabilities([0, 0, 0]), "wrong-type", "into", "must be a Float64Array"],
  ["an array of another kind of number", (p) => p.logLikelihoods(new Float32Array(3)), "wrong-type", "into", "must be a Float64Array"],
  ["nothing to write to", (p) => p.probabilities(null), "wrong-type", "into", "must be a Float64Array"],
  ["an array that is too short", (p) => p.probabilities(new Float64Array(2)), "wrong-length", "into", "must have 3 numbers, has 2"],
  ["the arrival at an unknown place", (p) => p.arrival("nowhere"), "unknown-id", "id", 'no destination "nowhere", there are "left", "middle", "right"'],
  ["the arrival at a number", (p) => p.arrival(3), "wrong-type", "id", "must be a string, got 3"],
  ["a forecast for the past", (p) => p.forecast(1), "out-of-range", "time", "must be at least the last observation's time, 2.304, got 1"],
  ["a forecast for no time", (p) => p.forecast(), "missing-key", "time", 'missing key "time"'],
  ["a forecast for NaN", (p) => p.forecast(Number.NaN), "not-finite", "time", "must be a finite number, got NaN"],
  ["a path to nowhere", (p) => p.path("nowhere", [3]), "unknown-id", "id", 'no destination "nowhere", there are "left", "middle", "right"'],
  ["a path in the past", (p) => p.path("left", [3, 1]), "out-of-range", "times[1]", "must be at least the last observation's time, 2.304, got 1"],
  ["a path at no times", (p) => p.path("left"), "missing-key", "times", 'missing key "times"'],
  ["an addition of nothing", (p) => p.addDestination(), "missing-key", "destination", 'missing key "destination"'],
  ["an addition of the same", (p) => p.addDestination(left), "duplicate-id", "id", 'the id "left" is taken by destinations[0]'],
  ["an addition with NaN", (p) => p.addDestination({ ...left, id: "new", center: [0, Number.NaN] }), "not-finite", "destination.center[1]", "must be a finite number, got NaN"],
  ["an update of nothing", (p) => p.updateDestination("nowhere", left), "unknown-id", "id", 'no destination "nowhere", there are "left", "middle", "right"'],
  ["an update to another id", (p) => p.updateDestination("left", right), "out-of-range", "destination.id", 'must stay "left", got "right"'],
  ["a removal of nothing", (p) => p.removeDestination("nowhere"), "unknown-id", "id", 'no destination "nowhere", there are "left", "middle", "right"'],
  ["no destinations at all", (p) => p.setDestinations([]), "no-destinations", "destinations", "must have at least one destination, has none"],
  ["destinations with a mistake", (p) => p.setDestinations([left, { ...right, size: [0, 1] }]), "out-of-range", "destinations[1].size[0]", "must be greater than 0, got 0"],
];

for (const [what, use, code, path, message] of uses) {
  test(`in mid-movement: ${what}`, () => {
    const [predictor, untouched] = [new Predictor(small()), new Predictor(small())];
    for (const [time, ...position] of movement) for (const one of [predictor, untouched]) one.observe(time, position);
    refuses(() => use(predictor), code, path, message);
    for (const one of [predictor, untouched]) one.observe(2.4, [520, 300]);
    same(predictor.probabilities(), untouched.probabilities(), "as if nothing had happened");
    assert.deepEqual(predictor.destinations, untouched.destinations);
  });
}

test("methods that accumulate refuse changes in mid-movement", () => {
  const predictor = new Predictor(small({ method: "algorithm1" }));
  predictor.observe(0, [1, 2]);
  for (const change of [
    () => predictor.addDestination({ ...left, id: "new" }),
    () => predictor.updateDestination("left", { ...left, center: [1, 2] }),
    () => predictor.removeDestination("left"),
    () => predictor.setDestinations([left]),
  ]) {
    refuses(change, "method-accumulates", "destinations", 'destinations cannot change in mid-movement, but "algorithm1" accumulates evidence for each destination and arrival time; "pseudoObservation", "singleFilter" and "singleFilterApproximate" do not');
  }
  predictor.reset();
  predictor.setDestinations([left]);
  refuses(() => predictor.removeDestination("left"), "no-destinations", "id", "the last destination cannot be removed");
});

test("snapshots that are damaged, truncated, of another version, or none", () => {
  const predictor = new Predictor(small());
  predictor.observe(0, [1, 2]);
  const snapshot = JSON.stringify(predictor.snapshot());
  const changed = (change) => {
    const copy = JSON.parse(snapshot);
    change(copy);
    return copy;
  };
  refuses(() => Predictor.restore(undefined), "bad-snapshot", "snapshot", "must be what snapshot() returned, got nothing");
  refuses(() => Predictor.restore(small()), "bad-snapshot", "snapshot", "must be what snapshot() returned, got an object");
  refuses(() => Predictor.restore(changed((s) => (s.version = 2))), "bad-snapshot", "snapshot.version", "must be 1, the version that this build writes, got 2");
  refuses(() => Predictor.restore(changed((s) => delete s.body)), "bad-snapshot", "snapshot", "is truncated: it has no body or no seal");
  refuses(() => Predictor.restore(changed((s) => (s.body.scenario.none = 0.5))), "bad-snapshot", "snapshot", "is damaged: its contents do not match its seal");
  Predictor.restore(JSON.parse(snapshot));
});

test("pointerScenario", () => {
  const target = { id: "a", x: 1, y: 2, width: 3, height: 4 };
  refuses(() => pointerScenario(), "missing-key", "targets", 'missing key "targets"');
  refuses(() => pointerScenario([]), "no-destinations", "destinations", "must have at least one destination, has none");
  refuses(() => pointerScenario([target, target]), "duplicate-id", "destinations[1].id", 'the id "a" is taken by destinations[0]');
  refuses(() => pointerScenario([{ ...target, width: 0 }]), "out-of-range", "targets[0].width", "must be greater than 0, got 0");
  refuses(() => pointerScenario([{ ...target, x: Number.NaN }]), "not-finite", "targets[0].x", "must be a finite number, got NaN");
  refuses(() => pointerScenario([{ ...target, z: 1 }]), "unknown-key", "targets[0].z", 'unknown key "z", expected one of "id", "x", "y", "width", "height"');
  refuses(() => pointerScenario([target], { nothing: 1 }), "unknown-key", "options.nothing", 'unknown key "nothing", expected one of "none"');
  refuses(() => pointerScenario([target], { none: 2 }), "out-of-range", "none", "must be at least 0 and less than 1, got 2");
});

test("sequences", () => {
  const parameters = {
    motion: { type: "constantVelocity", dimensions: 1, noise: 0.1 },
    timeStep: 1,
    steps: 20,
    pinnedMean: [0, 0.5, 10, 0.5],
    pinnedCovariance: [[1, 0, 0, 0], [0, 0.1, 0, 0], [0, 0, 4, 0], [0, 0, 0, 0.1]],
    observation: { noise: 0.2 },
  };
  refuses(() => new ConditionallyMarkovSequence({ ...parameters, steps: 2e5 }), "too-large", "steps", "must be a whole number from 1 to 100000, got 200000");
  refuses(() => new ConditionallyMarkovSequence({ ...parameters, pinnedMean: [0] }), "wrong-length", "pinnedMean", "must have 4 numbers, has 1, got [0]");
  refuses(() => ConditionallyMarkovSequence.fromParameters({}), "missing-key", "boundary", 'missing key "boundary"');
  const sequence = new ConditionallyMarkovSequence(parameters);
  sequence.measure(3, [1.8]);
  refuses(() => sequence.measure(2, [1]), "time-not-increasing", "step", "must be at least 3, the last measured step, got 2");
  refuses(() => sequence.measure(21, [1]), "out-of-range", "step", "must be a whole number from 0 to 20, got 21");
  refuses(() => sequence.measure(4.5, [1]), "out-of-range", "step", "must be a whole number from 0 to 20, got 4.5");
  refuses(() => sequence.measure(4, [1, 2]), "wrong-length", "position", "must have 1 numbers, has 2");
  refuses(() => sequence.measure(4, [Number.NaN]), "not-finite", "position[0]", "must be a finite number, got NaN");
  refuses(() => sequence.state(-1), "out-of-range", "step", "must be a whole number from 0 to 20, got -1");
  refuses(() => sequence.model(20), "out-of-range", "step", "must be a step between pins, got 20: the states at 0, 20 are drawn first, from their joint density");
  refuses(() => sequence.sample({ seed: 1.5, count: 1 }), "out-of-range", "seed", "must be a whole number from 0 to 4294967295, got 1.5");
  refuses(() => sequence.sample({ seed: 1, count: 1e9 }), "too-large", "count", "must be a whole number from 0 to 238095 for sequences of this length, got 1000000000");
  refuses(() => sequence.isMarkov(-1), "out-of-range", "tolerance", "must be at least 0, got -1");
  sequence.free();
  refuses(() => sequence.destination(), "freed", "", "this sequence was freed");
  refuses(() => sequence.free(), "freed", "", "this sequence was freed");
  sequence[Symbol.dispose]();
});

test("what a user's own getter or proxy throws comes through, and everything goes on", () => {
  const own = new Error("mine");
  const thrower = () => {
    throw own;
  };
  const predictor = new Predictor(small());
  predictor.observe(0, [400, 300]);
  const getter = Object.defineProperty({}, "motion", { get: thrower, enumerable: true });
  const proxy = new Proxy({}, { ownKeys: thrower, get: thrower });
  for (const bad of [getter, proxy, small({ destinations: proxy }), small({ destinations: new Proxy([], { get: thrower }) })]) {
    for (let i = 0; i < 1000; i++) {
      assert.throws(() => new Predictor(bad), (error) => error === own);
    }
    assert.throws(() => predictor.setDestinations(bad), (error) => error === own);
    assert.throws(() => predictor.observe(1, [1, 2], { noise: bad }), (error) => error === own);
    assert.throws(() => Predictor.restore(bad), (error) => error === own);
  }
  assert.throws(() => predictor.observe(1, proxy), (error) => error === own);
  assert.throws(() => new Predictor(new Proxy({}, { ownKeys: () => ["a", "a"] })), TypeError);
  predictor.observe(1, [420, 300]);
});

test("a getter that calls back into the same predictor", () => {
  const [predictor, plain] = [new Predictor(small()), new Predictor(small())];
  predictor.observe(0, [400, 300]);
  plain.observe(0, [400, 300]);
  const position = {
    length: 2,
    get 0() {
      predictor.observe(0.5, [410, 300]);
      return 420;
    },
    1: 300,
  };
  predictor.observe(1, position);
  plain.observe(0.5, [410, 300]);
  plain.observe(1, [420, 300]);
  same(predictor.probabilities(), plain.probabilities(), "as one after the other");
  const nosy = {
    ...left,
    get center() {
      predictor.setDestinations([middle, right]);
      return left.center;
    },
  };
  predictor.setDestinations([nosy, right]);
  assert.deepEqual(predictor.destinations, ["left", "right"]);
  const suicidal = {
    length: 2,
    get 0() {
      predictor.free();
      return 1;
    },
    1: 2,
  };
  refuses(() => predictor.observe(2, suicidal), "freed", "", "this predictor was freed");
});
