// Little memory: what would take more than there is throws `too-large`, and the object that was called, and every other, goes on.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Worker } from "node:worker_threads";
import { ConditionallyMarkovSequence, init, pointerScenario, Predictor } from "whither";
import { limited } from "./limited.mjs";
import { refuses, same, small } from "./support.mjs";

const place = (i) => [i % 100, Math.floor(i / 100)];
const kinds = {
  alike: (i) => ({ id: `d${i}`, center: place(i), size: [9, 9] }),
  sizes: (i) => ({ id: `d${i}`, center: place(i), size: [9 + i / 7, 9] }),
  covariances: (i) => ({
    id: `d${i}`,
    mean: place(i),
    covariance: [
      [20 + i, i % 7],
      [i % 7, 30 + i],
    ],
  }),
  times: (i) => ({ id: `d${i}`, center: place(i), size: [9, 9], arrival: { type: "uniform", from: 1 + i / 1e6, to: 4 } }),
  velocities: (i) => ({ id: `d${i}`, center: place(i), size: [9 + i, 9], endVelocity: 100 + i }),
};
const plane = { dimensions: 2, noise: 300 };
const motions = {
  constantVelocity: { type: "constantVelocity", ...plane },
  meanReverting: { type: "meanReverting", ...plane, rate: 0.5 },
  candidates: { type: "constantVelocity", dimensions: 2, noise: { candidates: [100, 200, 300, 400] } },
};
const arrivals = {
  uniform: { type: "uniform", from: 0.5, to: 3 },
  fitts: { type: "fitts", intercept: 0.1, slope: 0.2, spread: 0.3 },
};

/** `[method, motion, kind of destinations, how many, arrival]`: each with another part that takes the most memory. */
const cases = [
  ["pointing", "constantVelocity", "covariances", 10_000, "uniform"],
  ["pseudoObservation", "constantVelocity", "alike", 1500, "fitts"],
  ["pseudoObservation", "constantVelocity", "covariances", 400, "uniform"],
  ["pseudoObservation", "meanReverting", "sizes", 120, "uniform"],
  ["pseudoObservation", "candidates", "velocities", 400, "uniform"],
  ["algorithm1", "constantVelocity", "times", 200, "uniform"],
  ["algorithm2", "candidates", "alike", 80, "fitts"],
  ["bridging", "constantVelocity", "velocities", 60, "uniform"],
  ["bridging", "candidates", "covariances", 30, "uniform"],
  ["singleFilter", "constantVelocity", "velocities", 100, "fitts"],
  ["singleFilterApproximate", "meanReverting", "times", 150, "uniform"],
];

/** What the thread answers that is given this. */
function inThread(workerData) {
  return new Promise((resolve, reject) => {
    const worker = new Worker(new URL("./short-memory.mjs", import.meta.url), { workerData });
    worker.once("message", resolve).once("error", reject);
  });
}

for (const [method, motion, kind, count, arrival] of cases) {
  test(`${method} with ${motion}, ${count} destinations (${kind}), ${arrival}`, async (t) => {
    const destinations = Array.from({ length: count }, (_, i) => kinds[kind](i));
    const scenario = { method, motion: motions[motion], observation: { noise: 1.5 }, arrival: arrivals[arrival], destinations };
    const { faults, done, refused } = await inThread({ scenario, megabytes: 66 });
    t.diagnostic(`${done} calls done, ${refused} refused`);
    assert.deepEqual(faults, []);
    assert.ok(refused > 0 && done > 100);
  });
}

test("sequences, as many as there is room for, and what is drawn of them", async () => {
  const program = `
    const { ConditionallyMarkovSequence, initSync } = await import("whither");
    initSync({ module: workerData });
    const { parentPort } = await import("node:worker_threads");
    const steps = 100_000;
    const parameters = {
      motion: { type: "constantVelocity", dimensions: 1, noise: 0.1 },
      timeStep: new Float64Array(steps).fill(1),
      steps,
      pinnedMean: [0, 0.5, 10, 0.5],
      pinnedCovariance: [[1, 0, 0, 0], [0, 0.1, 0, 0], [0, 0, 4, 0], [0, 0, 0, 0.1]],
      observation: { noise: 0.2 },
    };
    const codes = new Set();
    const attempt = (call) => {
      try {
        return call();
      } catch (error) {
        codes.add(error.code + ": " + error.message.replace(/[0-9]+/g, "#"));
        return null;
      }
    };
    const sequences = [];
    for (let made; sequences.length < 1000 && (made = attempt(() => new ConditionallyMarkovSequence(parameters))); ) sequences.push(made);
    const [one] = sequences;
    const drawn = [1, 5, 10, 40, 50].map((count) => attempt(() => one.sample({ seed: 1, count }))?.length ?? null);
    for (let k = 0; k < 100_000; k++) if (attempt(() => (one.measure(k, [k / 1e4]), true)) === null) break;
    const before = one.state(100_000).mean.join();
    for (const other of sequences.splice(1)) other.free();
    const again = attempt(() => one.sample({ seed: 1, count: 5 }).length);
    parentPort.postMessage({ made: sequences.length, drawn, codes: [...codes], again, goes: one.state(100_000).mean.join() === before });`;
  const worker = new Worker(`(async () => { const { workerData } = require("node:worker_threads"); ${program} })()`, {
    eval: true,
    workerData: limited(100),
  });
  const { drawn, codes, again, goes } = await new Promise((resolve, reject) =>
    worker.once("message", resolve).once("error", reject),
  );
  assert.deepEqual(codes, ["too-large: this may take # MB of memory, more than is left: free() what is not needed any more"]);
  assert.deepEqual([drawn.at(-1), again, goes], [null, 5, true], `${drawn}`);
});

test("lists and texts beyond all bounds are refused before they are copied", async () => {
  await init();
  const [used, untouched] = [new Predictor(small()), new Predictor(small())];
  for (const one of [used, untouched]) one.observe(0, [400, 300]);
  const times = new Float64Array(1e8);
  refuses(() => used.path("left", times), "too-large", "times", "must have no more than 1000000 items, has 100000000");
  const many = Array.from({ length: 1_000_001 }, () => small().destinations[0]);
  refuses(() => used.setDestinations(many), "too-large", "destinations", "must have no more than 1000000 items, has 1000001");
  const icon = { id: "a", x: 0, y: 0, width: 9, height: 9 };
  refuses(() => pointerScenario(many.fill(icon)), "too-large", "targets", "must have no more than 1000000 items, has 1000001");
  const sequence = {
    motion: small().motion,
    timeStep: 1,
    steps: 1e9,
    pinnedMean: [],
    pinnedCovariance: [],
    observation: { noise: 1 },
  };
  assert.throws(() => new ConditionallyMarkovSequence(sequence), { code: "too-large" });
  for (const one of [used, untouched]) one.observe(1, [420, 300]);
  same(used.probabilities(), untouched.probabilities(), "it goes on");
});

test("a snapshot that could not be restored is not written", () => {
  const destinations = Array.from({ length: 2000 }, (_, i) => kinds.alike(i));
  const predictor = new Predictor(small({ method: "bridging", quadrature: { rule: "trapezoid", points: 1001 }, destinations }));
  predictor.observe(0, [1, 2]);
  assert.throws(() => predictor.snapshot(), { code: "too-large" });
  assert.ok(predictor.probabilities().every(Number.isFinite));
  predictor.free();
});
