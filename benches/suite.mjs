// The measurements that run alike in Node and in a browser, through the public class with its checks.
import { interleave } from "./measure.mjs";
import { seldomGrowth } from "./cases.mjs";
import { exponents, INTERVAL, scenario, sweep, targets } from "./scenarios.mjs";
import { check, checkUnit, unit, ways } from "./yardstick.mjs";

/** How long each is measured: rounds, and the least milliseconds of one and of what comes before. */
export const effort = (quick) => (quick ? { rounds: 5, least: 3, warmUp: 30 } : { rounds: 15, least: 8, warmUp: 200 });

/** A predictor in mid-movement, and one `observe` and `probabilities(into)` of it. */
export function step({ Predictor, PointerPredictor, pointerScenario }, { length = Infinity, before = 20, ...row }) {
  const predictor = row.pointer
    ? new PointerPredictor(targets(row))
    : new Predictor(scenario({ ...row, length: length === Infinity ? undefined : length }, pointerScenario));
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
 * Each case against as many `Math.exp` as it has pairs, in the same rounds: `{ microseconds, ratio }` by name, and what a call
 * takes in each way, in nanoseconds. `progress` gets the name of each before it begins; `where` names the engine.
 */
export async function measureCases(where, whither, list, clock, options, progress) {
  const results = {};
  const units = [];
  const checks = [];
  const numbers = exponents(1000);
  const nanoseconds = (milliseconds, calls) => (1e6 * milliseconds) / calls;
  const keep = (time, calls) => {
    units.push({ plain: nanoseconds(time.plain, calls), unrolled: nanoseconds(time.unrolled, calls) });
  };
  /** Before and after all cases, so that a bad unit is reported at once. */
  const checked = () => {
    const time = interleave([...ways(numbers), check(numbers)], clock, options);
    keep(time, numbers.length);
    checks.push(nanoseconds(time.check, numbers.length));
    return checkUnit(where, units, checks);
  };
  // an engine optimises only what has run for a while, and does so concurrently
  await progress("warm-up");
  const first = step(whither, list[0]);
  for (const begin = clock(); clock() - begin < 10 * options.warmUp; ) first.run(100);
  first.predictor.free();
  checked();
  for (const one of list) {
    await progress(one.name);
    const { run, predictor } = step(whither, one);
    const time = interleave([...ways(exponents(one.pairs)), { name: "step", run }], clock, options);
    predictor.free();
    results[one.name] = { microseconds: 1000 * time.step, ratio: time.step / unit(time) };
    keep(time, one.pairs);
  }
  return { cases: results, exp: checked() };
}

/** How a predictor is made, and how all its destinations are set: every second time they have moved by one unit. */
function making({ Predictor, PointerPredictor, pointerScenario }, row) {
  if (row.pointer) {
    const given = targets(row);
    const lists = [given, given.map((one) => ({ ...one, x: one.x + 1 }))];
    return { make: () => new PointerPredictor(given), setTargets: (of, k) => of.setTargets(lists[k & 1]) };
  }
  const given = scenario(row, pointerScenario);
  const moved = given.destinations.map((one) => ({ ...one, center: one.center.map((x) => x + 1) }));
  const lists = [given.destinations, moved];
  return { make: () => new Predictor(given), setDestinations: (of, k) => of.setDestinations(lists[k & 1]) };
}

/** What is done once a movement or less, each with the observation and the probabilities that follow, and a step: milliseconds. */
function timeSeldom(whither, row, clock, options) {
  const { run, predictor } = step(whither, row);
  const { make, ...setting } = making(whither, row);
  const into = new Float64Array(row.count);
  let k = 0;
  const begin = (of) => {
    of.observe(INTERVAL * k, [960, 540]);
    of.probabilities(into);
  };
  const repeat = (work) => (times) => {
    for (let i = 0; i < times; i++, k++) work();
  };
  const others = make();
  const entries = [
    { name: "step", run },
    { name: "first", run: repeat(() => (others.reset(), begin(others))) },
    ...Object.entries(setting).map(([name, set]) => ({ name, run: repeat(() => (set(others, k), begin(others))) })),
    {
      name: "constructing",
      run: repeat(() => {
        const made = make();
        begin(made);
        made.free();
      }),
    },
  ];
  const time = interleave(entries, clock, options);
  for (const one of [predictor, others]) one.free();
  return time;
}

/**
 * What is done once a movement or less, by name: `{ microseconds, ratio, growth }`, the ratio to an ordinary step in the same rounds;
 * the growth is the time for each destination where there are several times as many, against that where there are not, 1 if linear.
 */
export function measureSeldom(whither, row, clock, options) {
  const { times } = seldomGrowth;
  const time = timeSeldom(whither, row, clock, options);
  const large = timeSeldom(whither, { ...row, count: times * row.count }, clock, options);
  const result = ([name, milliseconds]) => {
    const growth = large[name] / (times * milliseconds);
    return [name, { microseconds: 1000 * milliseconds, ratio: milliseconds / time.step, growth }];
  };
  return Object.fromEntries(Object.entries(time).map(result));
}
