// The golden cases, through the built package: what an independent reference computed for complete movements.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ConditionallyMarkovSequence, init, Predictor } from "whither";
import { close, golden, scenarioOf } from "./support.mjs";

await init();

/** How each kind of case in `tests/golden/index.json` is run: the tests of a case, by name. */
const kinds = {
  predictor({ observations, expected, ...given }, tolerances) {
    const methods = Object.keys(expected.logLikelihoods).map((method) => [
      method,
      () => {
        const predictor = new Predictor(scenarioOf(given, method));
        observations.forEach(([time, ...position], k) => {
          predictor.observe(time, position);
          const [likelihoods, probabilities] = [expected.logLikelihoods[method][k], expected.probabilities[method][k]];
          close(predictor.logLikelihoods(), likelihoods, tolerances.logLikelihoods, `log likelihoods after ${k}`);
          close(predictor.probabilities(), probabilities, tolerances.probabilities, `probabilities after ${k}`);
        });
      },
    ]);
    const states = () => {
      const predictor = new Predictor(scenarioOf(given, "pseudoObservation"));
      for (const [time, ...position] of observations) predictor.observe(time, position);
      const [first] = observations[0];
      const [last] = observations.at(-1);
      const { times, probabilities, mean } = predictor.arrival();
      const arrival = { times: times.map((time) => time - first), probabilities, mean: mean - first };
      isArrival(arrival, expected.arrival, tolerances.arrival);
      isGaussian(predictor.state(), expected.state, tolerances.states, "state");
      isGaussian(predictor.forecast(last + expected.forecast.after), expected.forecast, tolerances.states, "forecast");
    };
    return Object.fromEntries([...methods, ["arrival, state and forecast", states]]);
  },

  pointing({ scenario, observations, expected }, tolerances) {
    const movement = () => {
      const predictor = new Predictor(scenario);
      observations.forEach(([time, ...position], k) => {
        predictor.observe(time, position);
        close(predictor.probabilities(), expected.probabilities[k], tolerances.probabilities, `probabilities after ${k}`);
        close([predictor.none], [expected.none[k]], tolerances.probabilities, `none after ${k}`);
      });
      isArrival(predictor.arrival(), expected.arrival, tolerances.arrival);
    };
    return { movement };
  },

  sequence({ name, note, measurements, expected, ...parameters }, tolerances) {
    const steps = () => {
      const sequence = new ConditionallyMarkovSequence(parameters);
      for (const model of expected.model ?? []) {
        for (const part of ["previous", "destination", "covariance"]) {
          close(sequence.model(model.step)[part], model[part].flat(), tolerances.model, `${part} of step ${model.step}`);
        }
      }
      assert.equal(measurements.length, expected.filtered.length);
      measurements.forEach(({ step, position }, i) => {
        const { destination, ...state } = expected.filtered[i];
        sequence.measure(step, position);
        isGaussian(sequence.state(step), state, tolerances.states, `state ${step}`);
        isGaussian(sequence.destination(), destination, tolerances.states, `destination after ${step}`);
      });
      for (const predicted of expected.predicted) {
        isGaussian(sequence.state(predicted.step), predicted, tolerances.states, `predicted state ${predicted.step}`);
      }
    };
    return { steps };
  },
};

for (const [kind, { tolerances, cases }] of Object.entries(golden("index"))) {
  for (const name of cases) {
    for (const [what, run] of Object.entries(kinds[kind](golden(name), tolerances))) test(`${name}: ${what}`, run);
  }
}

function isArrival(found, expected, tolerance) {
  close(found.times, expected.times, tolerance, "arrival times");
  close(found.probabilities, expected.probabilities, tolerance, "arrival");
  close([found.mean], [expected.mean], tolerance, "arrival mean");
}

function isGaussian(found, expected, tolerance, what) {
  close(found.mean, expected.mean, tolerance, `${what}: mean`);
  close(found.covariance, expected.covariance.flat(), tolerance, `${what}: covariance`);
}
