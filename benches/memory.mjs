// What predictors take in the memory of the WebAssembly, in a process of its own. Started by scripts/bench.mjs with the file
// to write the numbers to.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
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

/** Nothing is freed, so that what is measured next finds no memory that was used before. */
const kept = [];

/** Bytes that one more result of `make` takes. */
function bytesOf(make, few, many) {
  const grow = (count) => {
    for (let k = 0; k < count; k++) kept.push(make());
    return memory.buffer.byteLength;
  };
  // the first ones fill the gaps left by making them
  const before = grow(few);
  return (grow(many) - before) / many;
}

function bytesOfMethod(method) {
  console.log(`memory: ${method}`);
  const small = scenario({ method, count: 21 }, pointerScenario);
  const predictor = bytesOf(() => running(small), 200, 1000);
  const original = running(small);
  const clone = bytesOf(() => original.clone(), 200, 1000);
  const destination = (sizes, from, to) => apart(["--destination", method, sizes, from, to]);
  const one = destination("one", 1000, 3000);
  return { predictor, clone, destination: one, own: destination("own", 1000, 3000), many: destination("one", 5000, 7000) };
}

/** The number that this file prints in a process of its own, whose memory has no gaps yet. */
function apart(args) {
  return Number(execFileSync(process.execPath, [fileURLToPath(import.meta.url), ...args.map(String)], { encoding: "utf8" }));
}

/** Bytes that one more destination takes, averaged over `from` to `to` of them. */
function bytesOfDestination([method, sizes, from, to]) {
  const given = [from, to].map((count) => scenario({ method, sizes, count: Number(count) }, pointerScenario));
  const each = given.map((one) => bytesOf(() => running(one), 60, 30));
  return (each[1] - each[0]) / (to - from);
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
if (file === "--destination") console.log(bytesOfDestination(process.argv.slice(3)));
else writeFileSync(file, JSON.stringify({ taken: each(bytesOfMethod), growth: each(stays) }));
