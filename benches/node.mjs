// The part in Node: processor time of this process. Started by scripts/bench.mjs with the file to write the numbers to.
import { writeFileSync } from "node:fs";
import kalman from "kalman-filter";
import { init, pointerScenario, Predictor } from "whither";
import { init as initPointing, PointerPredictor } from "whither/pointing";
import { cases, seldom } from "./cases.mjs";
import { interleave } from "./measure.mjs";
import { sweep } from "./scenarios.mjs";
import { effort, measureCases, measureSeldom, step } from "./suite.mjs";

const [file, quick] = [process.argv[2], process.argv[3] === "--quick"];
const clock = () => {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
};
const progress = (name) => console.log(`Node: ${name}`);

await Promise.all([init(), initPointing()]);
const whither = { Predictor, PointerPredictor, pointerScenario };

/** One step of the npm package kalman-filter for each of 21 destinations, constant velocity in two dimensions. */
function measureKalmanFilter(options) {
  const count = 21;
  progress(`kalman-filter, one step for each of ${count}`);
  const filter = new kalman.KalmanFilter({
    observation: { sensorDimension: 2, name: "sensor" },
    dynamic: { name: "constant-speed", timeStep: 0.016 },
  });
  const states = Array.from({ length: count }, () => null);
  let next = 0;
  const run = (times) => {
    for (let k = 0; k < times; k++) {
      const observation = sweep[next++ & 255].slice(0, 2);
      for (let i = 0; i < count; i++) states[i] = filter.filter({ previousCorrected: states[i], observation });
    }
  };
  const ours = step(whither, { count });
  const time = interleave(
    [
      { name: "theirs", run },
      { name: "ours", run: ours.run },
    ],
    clock,
    options,
  );
  ours.predictor.free();
  return { microseconds: 1000 * time.theirs, ours: 1000 * time.ours };
}

const options = effort(quick);
const result = {
  version: process.version,
  ...(await measureCases("in Node", whither, cases({ quick }), clock, options, progress)),
  seldom: {},
  kalmanFilter: measureKalmanFilter(options),
};
for (const row of seldom) {
  progress(row.name);
  result.seldom[row.name] = measureSeldom(whither, row, clock, options);
}
writeFileSync(file, JSON.stringify(result));
