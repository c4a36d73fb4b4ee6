// What predictors weigh in the memory of the WebAssembly, in a process of its own. Started by scripts/bench.mjs with the file
// to write the numbers to.
import { readFileSync, writeFileSync } from "node:fs";
import { initSync, pointerScenario, Predictor } from "whither";
import { INTERVAL, scenario, sweep } from "./scenarios.mjs";
import { step } from "./suite.mjs";

const [file, quick] = [process.argv[2], process.argv[3] === "--quick"];

// The memory is that of the one instance that is made in this process.
let memory;
const { Instance } = WebAssembly;
WebAssembly.Instance = class extends Instance {
  constructor(...args) {
    super(...args);
    memory = this.exports.memory;
  }
};
initSync({ module: readFileSync(new URL("../dist/whither.wasm", import.meta.url)) });

/** A predictor in mid-movement. */
function running(given) {
  const predictor = new Predictor(given);
  for (let k = 0; k < 5; k++) {
    predictor.observe(INTERVAL * k, sweep[k].slice(0, 2));
    predictor.probabilities();
  }
  return predictor;
}

/** Nothing is freed, so that what is weighed next finds no memory that was used before. */
const kept = [];

/** Bytes that one more of what `make` gives takes. */
function weigh(make, few, many) {
  const grow = (count) => {
    for (let k = 0; k < count; k++) kept.push(make());
    return memory.buffer.byteLength;
  };
  // the first ones fill the gaps that making them leaves
  const before = grow(few);
  return (grow(many) - before) / many;
}

function weighMethod(method) {
  console.log(`memory: ${method}`);
  const given = (count) => scenario({ method, count }, pointerScenario);
  const [small, middle, large] = [21, 1000, 3000].map(given);
  const predictor = weigh(() => running(small), 200, 1000);
  const original = running(small);
  const clone = weigh(() => original.clone(), 200, 1000);
  const each = [middle, large].map((one) => weigh(() => running(one), 5, 15));
  return { predictor, clone, destination: (each[1] - each[0]) / 2000 };
}

/** Bytes of the memory after few observations and after many. */
function stays(method) {
  const observations = quick ? 100_000 : 1_000_000;
  console.log(`memory: ${method}, ${observations} observations`);
  const { run } = step({ Predictor, pointerScenario }, { method, count: 21 });
  const before = memory.buffer.byteLength;
  run(observations);
  return { observations, grown: memory.buffer.byteLength - before };
}

const methods = ["pseudoObservation", "pointing"];
const each = (measure) => Object.fromEntries(methods.map((method) => [method, measure(method)]));
writeFileSync(file, JSON.stringify({ weights: each(weighMethod), growth: each(stays) }));
