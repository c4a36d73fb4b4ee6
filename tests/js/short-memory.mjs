// In a thread of its own: WebAssembly with little memory, and every call of a predictor while little is left of it.
// Started by short-memory.test.mjs with `{ scenario, megabytes }`; answers with what went wrong.
import { parentPort, workerData } from "node:worker_threads";
import { initSync, pointerScenario, Predictor } from "whither";
import { limited } from "./limited.mjs";

const { scenario: given, megabytes } = workerData;
initSync({ module: limited(megabytes) });

const faults = [];
const counts = { done: 0, refused: 0 };

/** What a call returns; null where it is refused for lack of memory. Any other error is a fault. */
function attempt(what, call) {
  try {
    const result = call();
    counts.done++;
    return result ?? true;
  } catch (error) {
    if (error?.code === "too-large" && /^this may take \d+ MB of memory, more than is left/.test(error.message)) counts.refused++;
    else faults.push(`${what}: ${error?.name} ${error?.code} ${error?.message}`);
    return null;
  }
}

const pointing = pointerScenario([{ id: "any", x: 0, y: 0, width: 1, height: 1 }]);
const { destinations } = given;
const noiseOfOne =
  given.method === "pointing"
    ? [2, 1]
    : [
        [2, 1],
        [1, 2],
      ];
const scenario = given.method === "pointing" ? { ...pointing, destinations } : given;

/** Fills the memory: predictors in mid-movement, large ones first, of which some are freed again to leave a little room. */
const ballast = [];
for (const count of [3000, 300, 30]) {
  const filling = Array.from({ length: count }, (_, i) => ({ id: `${i}`, center: [i % 100, i], size: [9 + i, 9] }));
  for (;;) {
    const one = attempt("ballast", () => new Predictor({ ...pointing, destinations: filling }));
    if (one === null) break;
    ballast.push(one);
    const moved = attempt("ballast moves", () => (one.observe(0, [1, 2]), one.observe(0.1, [2, 3]), one.probabilities()));
    if (moved === null) break;
  }
}
const most = ballast.length;

const untouched = (predictor) => predictor.probabilities().join();
const first = untouched(ballast[0]);

for (const share of [1, 0.95, 0.8, 0.5, 0.2]) {
  while (ballast.length > 2 && ballast.length > share * most) ballast.pop().free();
  const predictor = attempt("new", () => new Predictor(scenario));
  if (predictor === null) continue;
  const ask = {
    probabilities: () => predictor.probabilities(),
    logLikelihoods: () => predictor.logLikelihoods(),
    best: () => predictor.best,
    arrival: () => predictor.arrival(),
    "arrival at one": () => predictor.arrival(destinations[6].id),
    remaining: () => predictor.remaining,
    state: () => predictor.state(),
    initialState: () => predictor.initialState(),
    forecast: () => predictor.forecast(1e6),
    path: () => predictor.path(destinations[6].id, new Float64Array(20).fill(1e6)),
    destinations: () => predictor.destinations,
    clone: () => predictor.clone().free(),
    "snapshot and restore": () => Predictor.restore(predictor.snapshot()).free(),
  };
  const askAll = (when) => {
    for (const [name, call] of Object.entries(ask)) attempt(`${when}: ${name}`, call);
  };
  const times = [0, 0.1, 0.2, 1e5];
  for (const [k, time] of times.entries()) {
    const moved = attempt(`observe ${k}`, () =>
      predictor.observe(time, [300 + k, k === 2 ? null : 200], k === 2 ? { noise: noiseOfOne } : undefined),
    );
    if (moved !== null) askAll(`after ${k}`);
  }
  const changes = {
    add: () => predictor.addDestination({ ...destinations[0], id: "added" }),
    update: () => predictor.updateDestination(destinations[2].id, { ...destinations[2], prior: 2 }),
    remove: () => predictor.removeDestination(destinations[3].id),
    "set fewer": () => predictor.setDestinations(destinations.slice(5)),
    "set all": () => predictor.setDestinations(destinations),
  };
  predictor.reset();
  for (const [name, call] of Object.entries(changes)) attempt(name, call);
  if (attempt("observe again", () => predictor.observe(0, [300, 200])) !== null) askAll("again");
  predictor.free();
  if (untouched(ballast[0]) !== first) faults.push("another predictor has changed");
}

// with room again, all goes on
for (const one of ballast.splice(1)) one.free();
const refused = counts.refused;
const predictor = attempt("new, with room", () => new Predictor(scenario));
attempt("observe, with room", () => (predictor.observe(0, [300, 200]), predictor.observe(0.1, [310, 200])));
attempt("answers, with room", () => (predictor.arrival(), predictor.state(), predictor.clone()));
if (counts.refused > refused) faults.push("refused although there is room");
parentPort.postMessage({ faults: [...new Set(faults)].slice(0, 20), ...counts });
