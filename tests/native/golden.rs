//! The golden cases: what an independent reference, written literally from the papers, got for movements and sequences.
//! `tests/golden/index.json` lists them by kind, with their tolerances.

use crate::support::{cases, close, golden, numbers, predictor, rows, scenario_of, sequence};
use serde_json::{Value as Json, json};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;
use whither::Gaussian;

fn close_density(what: &str, found: &Gaussian, expected: &Json, tolerance: f64) {
    close(&format!("{what}, mean"), found.mean.as_slice(), &numbers(&expected["mean"]), tolerance);
    // symmetric: by rows or by columns is the same
    close(
        &format!("{what}, covariance"),
        found.covariance.as_slice(),
        &rows(&expected["covariance"]).concat(),
        tolerance,
    );
}

#[test]
fn every_method_reproduces_every_movement() {
    let mut compared = 0;
    for (name, tolerances) in cases("predictor") {
        let case = golden(&name);
        let expected = &case["expected"];
        for (method, likelihoods) in expected["logLikelihoods"].as_object().unwrap() {
            let mut predictor = predictor(&scenario_of(&case, method));
            let likelihoods = rows(likelihoods);
            let probabilities = rows(&expected["probabilities"][method]);
            for (k, observation) in rows(&case["observations"]).iter().enumerate() {
                let what = |what| format!("{name} {method} k = {k}: {what}");
                predictor.observe(observation[0], &observation[1..]).unwrap();
                let found = predictor.log_likelihoods();
                close(&what("log likelihoods"), found, &likelihoods[k], tolerances["logLikelihoods"]);
                let found = predictor.probabilities();
                close(&what("probabilities"), found, &probabilities[k], tolerances["probabilities"]);
                compared += 1;
            }
        }
    }
    assert!(compared > 800, "only {compared} comparisons");
}

#[test]
fn arrival_state_and_forecast_are_reproduced() {
    for (name, tolerances) in cases("predictor") {
        let case = golden(&name);
        let expected = &case["expected"];
        let mut predictor = predictor(&scenario_of(&case, "pseudoObservation"));
        let observations = rows(&case["observations"]);
        for observation in &observations {
            predictor.observe(observation[0], &observation[1..]).unwrap();
        }
        let (first, last) = (observations[0][0], observations[observations.len() - 1][0]);
        let found = predictor.arrival(None).unwrap().unwrap();
        let times: Vec<f64> = found.times.iter().map(|t| t - first).collect();
        close_arrival(
            &name,
            &times,
            &found.probabilities,
            found.mean - first,
            &expected["arrival"],
            tolerances["arrival"],
        );
        let forecast = predictor.forecast(last + expected["forecast"]["after"].as_f64().unwrap()).unwrap();
        for (what, found) in [("state", predictor.state()), ("forecast", forecast)] {
            close_density(&format!("{name} {what}"), &found.unwrap(), &expected[what], tolerances["states"]);
        }
    }
}

fn close_arrival(name: &str, times: &[f64], probabilities: &[f64], mean: f64, expected: &Json, tolerance: f64) {
    close(&format!("{name}: arrival times"), times, &numbers(&expected["times"]), tolerance);
    close(&format!("{name}: arrival"), probabilities, &numbers(&expected["probabilities"]), tolerance);
    close(&format!("{name}: mean arrival"), &[mean], &[expected["mean"].as_f64().unwrap()], tolerance);
}

#[test]
fn the_pointing_model_is_reproduced() {
    for (name, tolerances) in cases("pointing") {
        let case = golden(&name);
        let expected = &case["expected"];
        let mut predictor = predictor(&case["scenario"]);
        for (k, observation) in rows(&case["observations"]).iter().enumerate() {
            predictor.observe(observation[0], &observation[1..]).unwrap();
            let mut found = predictor.probabilities().to_vec();
            found.push(predictor.none());
            let mut wanted = numbers(&expected["probabilities"][k]);
            wanted.push(expected["none"][k].as_f64().unwrap());
            close(&format!("{name} k = {k}: probabilities"), &found, &wanted, tolerances["probabilities"]);
            let sum: f64 = found.iter().sum();
            assert!((sum - 1.0).abs() < 1e-12, "{name} k = {k}: they sum to {sum}");
        }
        let found = predictor.arrival(None).unwrap().unwrap();
        close_arrival(
            &name,
            &found.times,
            &found.probabilities,
            found.mean,
            &expected["arrival"],
            tolerances["arrival"],
        );
    }
}

#[test]
fn sequences_are_reproduced() {
    let mut models = 0;
    for (name, tolerances) in cases("sequence") {
        let case = golden(&name);
        let expected = &case["expected"];
        let mut configuration = json!({});
        for key in ["motion", "timeStep", "steps", "pins", "pinnedMean", "pinnedCovariance", "observation"] {
            configuration[key] = case[key].clone();
        }
        let mut sequence = sequence(&configuration);
        let step = |json: &Json| json["step"].as_u64().unwrap() as usize;
        for expected in expected["model"].as_array().into_iter().flatten() {
            let model = sequence.model(step(expected)).unwrap();
            let parts =
                [("previous", model.previous), ("destination", model.destination), ("covariance", model.covariance)];
            for (key, found) in parts {
                let wanted = rows(&expected[key]).concat();
                close(&format!("{name}, {key}"), found.transpose().as_slice(), &wanted, tolerances["model"]);
            }
            models += 1;
        }
        let measurements = case["measurements"].as_array().unwrap();
        let filtered = expected["filtered"].as_array().unwrap();
        assert!(!measurements.is_empty() && measurements.len() == filtered.len());
        for (measurement, expected) in measurements.iter().zip(filtered) {
            let step = step(measurement);
            sequence.measure(step, &numbers(&measurement["position"])).unwrap();
            let (state, destination) = (sequence.state(step).unwrap(), sequence.destination());
            close_density(&format!("{name}, state {step}"), &state, expected, tolerances["states"]);
            let wanted = &expected["destination"];
            close_density(&format!("{name}, destination after {step}"), &destination, wanted, tolerances["states"]);
        }
        for expected in expected["predicted"].as_array().unwrap() {
            let step = step(expected);
            let state = sequence.state(step).unwrap();
            close_density(&format!("{name}, predicted {step}"), &state, expected, tolerances["states"]);
        }
    }
    assert_eq!(models, 9);
}

#[cfg(not(target_arch = "wasm32"))]
#[test]
fn every_case_is_of_a_kind_that_is_run() {
    let index = golden("index");
    let kinds: Vec<&String> = index.as_object().unwrap().keys().collect();
    assert_eq!(kinds, ["predictor", "pointing", "sequence"]);
    let mut listed: Vec<String> =
        kinds.iter().flat_map(|kind| cases(kind)).map(|(name, _)| format!("{name}.json")).collect();
    listed.push("index.json".to_owned());
    listed.sort();
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap());
    let mut files: Vec<String> = files.filter(|name| name.ends_with(".json")).collect();
    files.sort();
    assert_eq!(files, listed, "files and tests/golden/index.json");
}
