import { ConditionallyMarkovSequence, init } from "whither";

await init();
const sequence = new ConditionallyMarkovSequence({
  motion: { type: "constantVelocity", dimensions: 2, noise: 0.1 }, // m, s
  timeStep: 15,
  steps: 100,
  pins: [0, 100], // the state is known at take-off and at landing, as well as this:
  pinnedMean: [2e3, 5e3, 70, 0, 130e3, 10e3, 70, 0],
  pinnedCovariance: [1e3, 1e3, 10, 10, 1e3, 1e3, 10, 10].map((variance, i, all) => all.map((_, j) => (i === j ? variance : 0))),
  observation: { noise: 30 },
});
sequence.measure(1, [3050, 5010]);
console.log(sequence.state(50).mean, sequence.destination().covariance);
