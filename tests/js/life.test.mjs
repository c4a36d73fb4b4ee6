// The life of a predictor through the built package: one movement after another, copies, changes on the way, the end.
import assert from "node:assert/strict";
import { test } from "node:test";
import { init, pointerScenario, Predictor } from "whither";
import { close, movement, refuses, same, small } from "./support.mjs";

await init();

function moved(scenario, samples = movement) {
  const predictor = new Predictor(scenario);
  for (const [time, ...position] of samples) predictor.observe(time, position);
  return predictor;
}

test("ids of any characters, in as long a list as one likes", () => {
  const ids = ["a", "\0", "ß", "\ufeffid", "😀", `${"x".repeat(300)}é`, ...Array.from({ length: 300 }, (_, i) => `${i}`)];
  const named = (id, i) => ({ id, center: [i, 2], size: 3 });
  const predictor = new Predictor(small({ destinations: ids.map(named) }));
  assert.deepEqual(predictor.destinations, ids);
  assert.deepEqual(Predictor.restore(predictor.snapshot()).destinations, ids);
  predictor.setDestinations(["half\ud83d", "\ude00"].map(named));
  assert.deepEqual(predictor.destinations, ["half\ufffd", "\ufffd"]);
});

/** Everything that a predictor returns. */
function everything(predictor) {
  const { mean, deviation, times, probabilities } = predictor.arrival();
  return [
    ...predictor.probabilities(),
    ...predictor.logLikelihoods(),
    predictor.none,
    mean,
    deviation,
    ...times,
    ...probabilities,
    ...Object.values(predictor.state()).flatMap((numbers) => [...numbers]),
    ...Object.values(predictor.initialState()).flatMap((numbers) => [...numbers]),
    ...predictor.path("right", [2.5, 3]),
  ];
}

test("before the first observation there is the prior and nothing else", () => {
  const predictor = new Predictor(small({ none: 0.2 }));
  close(predictor.probabilities(), [0.2, 0.4, 0.2], 1e-15, "prior");
  close([predictor.none], [0.2], 1e-15, "none");
  assert.equal(predictor.best, null);
  assert.equal(predictor.arrival(), null);
  assert.equal(predictor.remaining, null);
  assert.equal(predictor.state(), null);
  assert.equal(predictor.initialState(), null);
  assert.equal(predictor.forecast(1), null);
  assert.deepEqual(predictor.path("left", [1]), new Float64Array(0));
  assert.equal(predictor.expired, false);
  assert.deepEqual(predictor.destinations, ["left", "middle", "right"]);
});

test("a movement to the right is going to the right", () => {
  const predictor = moved(small());
  const { id, index, probability } = predictor.best;
  assert.deepEqual([id, index], ["right", 2]);
  assert.equal(probability, predictor.probabilities()[2]);
  assert.ok(probability > 0.9);
  const sum = predictor.probabilities().reduce((a, b) => a + b);
  close([sum], [1 - predictor.none], 1e-12, "sum");
  const { mean, covariance } = predictor.state();
  assert.deepEqual([mean.length, covariance.length], [4, 16]);
  assert.ok(Math.abs(mean[0] - 628) < 3 && Math.abs(mean[2] - 750) < 60);
  const arrival = predictor.arrival("right");
  assert.deepEqual([arrival.times.length, arrival.probabilities.length], [15, 15]);
  assert.ok(arrival.times[0] === 2.5 && arrival.times[14] === 5);
  const path = predictor.path("right", [2.5, 3, 6]);
  assert.ok(path[0] < path[2] && Math.abs(path[4] - 800) < 60 && path.length === 6);
  const { low, mean: expected, high } = predictor.remaining;
  assert.ok(0 < low && low < expected && expected < high);
});

test("results are written into the caller's array", () => {
  const predictor = moved(small());
  const into = new Float64Array(3);
  assert.equal(predictor.probabilities(into), into);
  same(into, predictor.probabilities(), "probabilities");
  assert.equal(predictor.logLikelihoods(into), into);
  same(into, predictor.logLikelihoods(), "log likelihoods");
  assert.notEqual(predictor.probabilities(), predictor.probabilities());
  const shared = new Float64Array(new SharedArrayBuffer(24));
  same(predictor.probabilities(shared), predictor.probabilities(), "shared memory");
});

test("positions may be any list, and coordinates may be missing", () => {
  const [plain, typed, like] = [new Predictor(small()), new Predictor(small()), new Predictor(small())];
  for (const [time, x, y] of movement) {
    plain.observe(time, [x, y]);
    typed.observe(time, Float64Array.of(x, y), {});
    like.observe(time, { length: 2, 0: x, 1: y }, { noise: 1.5 });
  }
  same(everything(typed), everything(plain), "typed array");
  close(everything(like), everything(plain), 1e-12, "array-like, the scenario's own noise");
  const missing = [[null, 305], [520, undefined], [, 305], { length: 2, 0: 520 }];
  for (const position of missing) {
    const before = plain.state().mean;
    plain.observe(movement.at(-1)[0] + 0.01, position);
    assert.notDeepEqual(plain.state().mean, before);
    assert.ok(plain.probabilities().every(Number.isFinite));
  }
  plain.observe(movement.at(-1)[0] + 0.02, [null, null]);
});

test("the noise of one observation", () => {
  const [exact, vague] = [moved(small()), moved(small())];
  const next = [2.32, [900, 300]];
  exact.observe(...next);
  vague.observe(...next, {
    noise: [
      [1e6, 0],
      [0, 1e6],
    ],
  });
  const [near, far] = [vague, exact].map((predictor) => predictor.state().mean[0]);
  assert.ok(near < 660 && far > near + 20, `${near} ${far}`);
});

test("reset begins a new movement", () => {
  const predictor = moved(small());
  const first = everything(predictor);
  predictor.reset();
  assert.equal(predictor.best, null);
  for (const [time, ...position] of movement) predictor.observe(time, position);
  same(everything(predictor), first, "the same movement again");
});

test("a clone is independent", () => {
  const predictor = moved(small());
  const before = everything(predictor);
  const clone = predictor.clone();
  same(everything(clone), before, "clone");
  clone.observe(2.4, [300, 100]);
  clone.removeDestination("left");
  same(everything(predictor), before, "the first one");
  predictor.free();
  assert.equal(clone.destinations.length, 2);
  clone.observe(2.5, [200, 50]);
});

for (const [name, scenario] of Object.entries({
  pseudoObservation: small({ none: 0.1 }),
  algorithm1: small({ method: "algorithm1" }),
  bridging: small({ method: "bridging" }),
  singleFilter: small({ method: "singleFilter" }),
})) {
  test(`a snapshot restores ${name} to the bit, through JSON`, () => {
    const half = movement.slice(0, 10);
    const predictor = moved(scenario, half);
    const text = JSON.stringify(predictor.snapshot());
    const restored = Predictor.restore(JSON.parse(text));
    same(everything(restored), everything(predictor), "restored");
    assert.equal(JSON.stringify(restored.snapshot()), text);
    for (const [time, ...position] of movement.slice(10)) {
      predictor.observe(time, position);
      restored.observe(time, position);
      same(everything(restored), everything(predictor), `after ${time}`);
    }
  });
}

test("a snapshot restores the pointing model to the bit, and one without observations", () => {
  const targets = [
    { id: "a", x: 0, y: 0, width: 50, height: 50 },
    { id: "right", x: 900, y: 300, width: 50, height: 50 },
  ];
  const predictor = moved(pointerScenario(targets));
  const restored = Predictor.restore(JSON.parse(JSON.stringify(predictor.snapshot())));
  for (const one of [predictor, restored]) one.observe(2.4, [640, 301]);
  same(everything(restored), everything(predictor), "restored");
  const fresh = Predictor.restore(new Predictor(small()).snapshot());
  same(fresh.probabilities(), new Predictor(small()).probabilities(), "fresh");
});

test("destinations added, moved, set and removed in mid-movement are as if they had always been there", () => {
  const [left, middle, right] = small().destinations;
  const far = { id: "far", center: Float64Array.of(1200, 300), size: 100, endVelocity: 200, prior: 0.5 };
  const expected = everything(moved(small({ destinations: [left, far, right] })));
  const predictor = moved(small({ destinations: [left, { ...middle, id: "far" }, middle] }));
  predictor.removeDestination("middle");
  predictor.addDestination(right);
  const { id, ...placeless } = far;
  predictor.updateDestination("far", placeless);
  same(everything(predictor), expected, "one by one");
  const at_once = moved(small());
  at_once.setDestinations([left, far, right]);
  same(everything(at_once), expected, "all at once");
  assert.deepEqual(at_once.destinations, ["left", "far", "right"]);
  assert.deepEqual(at_once.best.id, at_once.destinations[at_once.best.index]);
});

test("when every arrival time has passed, the probabilities stay", () => {
  const predictor = moved(small());
  const last = predictor.probabilities();
  predictor.observe(9, [0, 0]);
  assert.equal(predictor.expired, true);
  same(predictor.probabilities(), last, "probabilities");
});

test("after free() there is a clear error, and dispose does it once", () => {
  const predictor = moved(small());
  predictor.free();
  const uses = {
    observe: () => predictor.observe(3, [1, 2]),
    "observe in full": () => predictor.observe(3, [1, null]),
    probabilities: () => predictor.probabilities(),
    none: () => predictor.none,
    best: () => predictor.best,
    logLikelihoods: () => predictor.logLikelihoods(),
    arrival: () => predictor.arrival(),
    remaining: () => predictor.remaining,
    expired: () => predictor.expired,
    destinations: () => predictor.destinations,
    state: () => predictor.state(),
    initialState: () => predictor.initialState(),
    forecast: () => predictor.forecast(3),
    path: () => predictor.path("left", [3]),
    addDestination: () => predictor.addDestination(small().destinations[0]),
    updateDestination: () => predictor.updateDestination("left", small().destinations[0]),
    removeDestination: () => predictor.removeDestination("left"),
    setDestinations: () => predictor.setDestinations(small().destinations),
    reset: () => predictor.reset(),
    clone: () => predictor.clone(),
    snapshot: () => predictor.snapshot(),
    free: () => predictor.free(),
  };
  for (const use of Object.values(uses)) refuses(use, "freed", "", "this predictor was freed");
  predictor[Symbol.dispose]();
  const other = moved(small());
  other[Symbol.dispose]();
  other[Symbol.dispose]();
  refuses(() => other.none, "freed", "", "this predictor was freed");
});
