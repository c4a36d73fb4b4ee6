// States by each method's own family, and the evidence of the first observation, through the package: numbers by hand.
import assert from "node:assert/strict";
import { before, test } from "node:test";
import { init, Predictor } from "whither";

const near = (found, expected) => assert.ok(Math.abs(found - expected) < 1e-12, `${found}, expected ${expected}`);

/** A random walk with every noise 1. */
const walk = (method, more) =>
  new Predictor({ method, motion: { type: "brownian", dimensions: 1, noise: 1 }, observation: { noise: 1 }, ...more });

before(() => init());

for (const [method, mean, variance, end, endVariance] of [
  // x_2 ~ N(2/3, 2/3), and a = 4 of the variance 1 + 3
  ["pseudoObservation", 8 / 7, 4 / 7, 2 / 3 + 25 / 21, 15 / 14],
  ["algorithm1", 8 / 7, 4 / 7, 2 / 3 + 25 / 21, 15 / 14],
  ["singleFilterApproximate", 8 / 7, 4 / 7, 2 / 3 + 25 / 21, 15 / 14],
  // x_2 = (x_1 + z)/2 + N(0, 1/2) ~ N(2, 3/2) before y_2 = 1
  ["bridging", 1.4, 0.6, 3.4, 2.1],
  ["singleFilter", 1.4, 0.6, 3.4, 2.1],
]) {
  test(`${method} has the states of its own family`, () => {
    const predictor = walk(method, {
      arrival: { type: "discrete", times: [2], weights: [1] },
      destinations: [{ id: "there", mean: [4], covariance: [[3]] }],
    });
    predictor.observe(0, [0]);
    predictor.observe(1, [1]);
    near(predictor.state().mean[0], mean);
    near(predictor.state().covariance[0], variance);
    near(predictor.forecast(2).mean[0], end);
    near(predictor.forecast(9).covariance[0], endVariance);
    near(predictor.path("there", [2])[0], end);
    predictor.free();
  });
}

for (const evidence of [true, false, undefined]) {
  test(`the first observation ${evidence ? "counts" : "does not count"} where evidence is ${evidence}`, () => {
    const predictor = walk("pseudoObservation", {
      arrival: { type: "discrete", times: [1], weights: [1] },
      initial: { mean: [0], covariance: [[4]], evidence },
      destinations: [-5, 5].map((x) => ({ id: `${x}`, mean: [x], covariance: [[1]] })),
    });
    predictor.observe(0, [3]);
    // given a = 5 the start is N(10/3, 4/3), so y_1 = 3 is of N(10/3, 7/3); given -5 of N(-10/3, 7/3)
    const log = (mean) => -0.5 * Math.log((14 / 3) * Math.PI) - (3 - mean) ** 2 / (14 / 3);
    const [left, right] = predictor.logLikelihoods();
    near(left, evidence ? log(-10 / 3) : 0);
    near(right, evidence ? log(10 / 3) : 0);
    near(predictor.probabilities()[1], evidence ? 1 / (1 + Math.exp(-60 / 7)) : 0.5);
    const restored = Predictor.restore(JSON.parse(JSON.stringify(predictor.snapshot())));
    assert.deepEqual(restored.logLikelihoods(), predictor.logLikelihoods());
    predictor.free();
    restored.free();
  });
}
