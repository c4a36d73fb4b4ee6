//! The golden cases: what an independent reference, written literally from the papers, got for whole movements.

use crate::support::{golden, numbers, predictor, relative, scenario_of};
use serde_json::Value as Json;

/// Every golden case of a predictor: sequences (`cm-`) and the pointing model have tests of their own.
const CASES: [&str; 13] = [
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

fn rows(json: &Json) -> Vec<Vec<f64>> {
    json.as_array().unwrap().iter().map(numbers).collect()
}

#[test]
fn every_method_reproduces_every_case() {
    let mut compared = 0;
    for name in CASES {
        let case = golden(name);
        let expected = &case["expected"];
        for (method, likelihoods) in expected["logLikelihoods"].as_object().unwrap() {
            let mut predictor = predictor(&scenario_of(&case, method));
            let likelihoods = rows(likelihoods);
            let probabilities = rows(&expected["probabilities"][method]);
            for (k, observation) in rows(&case["observations"]).iter().enumerate() {
                predictor.observe(observation[0], &observation[1..]).unwrap();
                let difference = relative(predictor.log_likelihoods(), &likelihoods[k]);
                assert!(difference < 1e-8, "{name} {method} k = {k}: log likelihoods differ by {difference:e}");
                let difference = relative(predictor.probabilities(), &probabilities[k]);
                assert!(difference < 1e-9, "{name} {method} k = {k}: probabilities differ by {difference:e}");
                compared += 1;
            }
        }
    }
    assert!(compared > 800, "only {compared} comparisons");
}

#[test]
fn arrival_state_and_forecast_are_reproduced() {
    for name in CASES {
        let case = golden(name);
        let expected = &case["expected"];
        let mut predictor = predictor(&scenario_of(&case, "pseudoObservation"));
        let observations = rows(&case["observations"]);
        for observation in &observations {
            predictor.observe(observation[0], &observation[1..]).unwrap();
        }
        let (first, last) = (observations[0][0], observations[observations.len() - 1][0]);
        let close = |what: &str, found: &[f64], expected: &[f64]| {
            let difference = relative(found, expected);
            assert!(difference < 1e-7, "{name}: {what} differs by {difference:e}");
        };
        let arrival = predictor.arrival(None).unwrap().unwrap();
        let times: Vec<f64> = arrival.times.iter().map(|t| t - first).collect();
        close("arrival times", &times, &numbers(&expected["arrival"]["times"]));
        close("arrival", &arrival.probabilities, &numbers(&expected["arrival"]["probabilities"]));
        close("arrival mean", &[arrival.mean - first], &[expected["arrival"]["mean"].as_f64().unwrap()]);
        let forecast = predictor.forecast(last + expected["forecast"]["after"].as_f64().unwrap()).unwrap();
        for (what, found) in [("state", predictor.state()), ("forecast", forecast)] {
            let found = found.unwrap();
            close(what, found.mean.as_slice(), &numbers(&expected[what]["mean"]));
            close(what, found.covariance.as_slice(), &rows(&expected[what]["covariance"]).concat());
        }
    }
}
