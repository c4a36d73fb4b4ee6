// The measurements that run alike in Node and in a browser, through the public class with its checks.
import { interleave } from "./measure.mjs";
import { exponents, INTERVAL, scenario, sweep } from "./scenarios.mjs";

/** How long each is measured: rounds, and the least milliseconds of one and of what comes before. */
export const effort = (quick) => (quick ? { rounds: 5, least: 3, warmUp: 30 } : { rounds: 15, least: 8, warmUp: 200 });

/** A predictor in mid-movement, and one `observe` and `probabilities(into)` of it. */
export function step({ Predictor, pointerScenario }, { length = Infinity, before = 20, ...row }) {
  const predictor = new Predictor(scenario({ ...row, length: length === Infinity ? undefined : length }, pointerScenario));
  const into = new Float64Array(row.count);
  const positions = sweep.map((position) => Float64Array.from(position.slice(0, row.dimensions ?? 2)));
  let k = 0;
  const run = (times) => {
    for (let i = 0; i < times; i++, k++) {
      if (k % length === 0) predictor.reset();
      predictor.observe(INTERVAL * k, positions[k & 255]);
      predictor.probabilities(into);
    }
  };
  run(before);
  return { run, predictor };
}

/**
 * Each case against as many `Math.exp` as it has pairs, in the same rounds: `{ microseconds, ratio }` by name.
 * `progress` is told the name of each before it begins.
 */
export async function measureCases(whither, list, clock, options, progress) {
  const results = {};
  // an engine compiles well only what has run for a while, and does so beside what runs
  await progress("warm-up");
  const first = step(whither, list[0]);
  for (const begin = clock(); clock() - begin < 10 * options.warmUp; ) first.run(100);
  first.predictor.free();
  for (const one of list) {
    await progress(one.name);
    const { run, predictor } = step(whither, one);
    const time = interleave([{ name: "exp", run: exponentials(one.pairs) }, { name: "step", run }], clock, options);
    predictor.free();
    results[one.name] = { microseconds: 1000 * time.step, ratio: time.step / time.exp };
  }
  return results;
}

/** So many calls of `Math.exp`: the unit of the tables. */
function exponentials(count) {
  const numbers = exponents(count);
  let sink = 0;
  return (times) => {
    // a little less each time, so that no call can be left out
    for (let k = 0; k < times; k++) for (let i = 0; i < count; i++) sink += Math.exp(numbers[i] - k * 1e-9);
    return sink;
  };
}
