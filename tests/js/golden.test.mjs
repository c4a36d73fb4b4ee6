// The golden cases, through the built package: what an independent reference got for whole movements.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ConditionallyMarkovSequence, init, Predictor } from "whither";
import { close, golden, scenarioOf } from "./support.mjs";

await init();

const papers = [
  "brownian2d",
  "ca2d",
  "custom2d",
  "cv2d-expiring-nodes",
  "cv2d-horizon",
  "cv2d-pixels",
  "cv2d-position",
  "cv2d-position-velocity",
  "cv2d-same-timestamp",
  "cv3d-position",
  "erv2d",
  "iou2d",
  "mean-reverting2d",
];

for (const name of papers) {
  const { observations, expected, ...given } = golden(name);

  for (const method of Object.keys(expected.logLikelihoods)) {
    test(`${name}: ${method}`, () => {
      const predictor = new Predictor(scenarioOf(given, method));
      observations.forEach(([time, ...position], k) => {
        predictor.observe(time, position);
        close(predictor.logLikelihoods(), expected.logLikelihoods[method][k], 1e-8, `log likelihoods after ${k}`);
        close(predictor.probabilities(), expected.probabilities[method][k], 1e-9, `probabilities after ${k}`);
      });
    });
  }

  test(`${name}: arrival, state and forecast`, () => {
    const predictor = new Predictor(scenarioOf(given, "pseudoObservation"));
    for (const [time, ...position] of observations) predictor.observe(time, position);
    const [first] = observations[0];
    const [last] = observations.at(-1);
    const arrival = predictor.arrival();
    close(arrival.times.map((time) => time - first), expected.arrival.times, 1e-7, "arrival times");
    close(arrival.probabilities, expected.arrival.probabilities, 1e-7, "arrival");
    close([arrival.mean - first], [expected.arrival.mean], 1e-7, "arrival mean");
    isGaussian(predictor.state(), expected.state, "state");
    isGaussian(predictor.forecast(last + expected.forecast.after), expected.forecast, "forecast");
  });
}

for (const name of ["grid21", "none", "repeats", "ring12", "sizes40"]) {
  test(`pointing-${name}`, () => {
    const { scenario, observations, expected } = golden(`pointing-${name}`);
    const predictor = new Predictor(scenario);
    observations.forEach(([time, ...position], k) => {
      predictor.observe(time, position);
      close(predictor.probabilities(), expected.probabilities[k], 1e-9, `probabilities after ${k}`);
      close([predictor.none], [expected.none[k]], 1e-9, `none after ${k}`);
    });
    const arrival = predictor.arrival();
    close(arrival.times, expected.arrival.times, 1e-7, "arrival times");
    close(arrival.probabilities, expected.arrival.probabilities, 1e-7, "arrival");
    close([arrival.mean], [expected.arrival.mean], 1e-7, "arrival mean");
  });
}

for (const name of ["correlated", "independent", "irregular", "waypoint"]) {
  test(`cm-${name}`, () => {
    const { name: _, note, measurements, expected, ...parameters } = golden(`cm-${name}`);
    const sequence = new ConditionallyMarkovSequence(parameters);
    measurements.forEach(({ step, position }, i) => {
      sequence.measure(step, position);
      assert.equal(expected.filtered[i].step, step);
      isGaussian(sequence.state(step), expected.filtered[i], `state ${step}`);
      isGaussian(sequence.destination(), expected.filtered[i].destination, `destination after ${step}`);
    });
    for (const predicted of expected.predicted) {
      isGaussian(sequence.state(predicted.step), predicted, `predicted state ${predicted.step}`);
    }
    for (const model of expected.model ?? []) {
      for (const part of ["previous", "destination", "covariance"]) {
        close(sequence.model(model.step)[part], model[part].flat(), 1e-9, `${part} of step ${model.step}`);
      }
    }
  });
}

function isGaussian(found, expected, what) {
  close(found.mean, expected.mean, 1e-7, `${what}: mean`);
  close(found.covariance, expected.covariance.flat(), 1e-7, `${what}: covariance`);
}
