//! The classes that JavaScript gets answer as the library does: constructing, observing, snapshots, sequences.

use crate::node::{Result, at, globals, json, object, parts, plain};
use crate::support::{golden, numbers, predictor, read, rows, scenario_of, sequence};
use serde_json::{Value as Json, json};
use wasm_bindgen_test::wasm_bindgen_test;
use whither::internals::DEFAULT_TOLERANCE;
use whither::wasm::{Engine, SequenceEngine, WhitherError, device_scenario};
use whither::{Gaussian, Predictor};

fn good<T>(result: Result<T>) -> T {
    result.map_err(parts).unwrap()
}

fn observed(error: Option<WhitherError>) {
    assert_eq!(error.map(parts), None);
}

/// The mean and behind it the covariance.
fn flat(gaussian: &Gaussian) -> Vec<f64> {
    [gaussian.mean.as_slice(), gaussian.covariance.as_slice()].concat()
}

/// A golden movement through both.
fn moved(method: &str) -> (Engine, Predictor, Json) {
    globals();
    let case = golden("cv2d-position-velocity");
    let scenario = scenario_of(&case, method);
    let (mut engine, mut predictor) = (good(Engine::new(&plain(&scenario))), predictor(&scenario));
    for row in rows(&case["observations"]) {
        observed(engine.observe(row[0], 2, row[1], row[2], 0.0));
        predictor.observe(row[0], &row[1..]).unwrap();
    }
    (engine, predictor, case)
}

#[wasm_bindgen_test]
fn an_engine_answers_as_its_predictor() {
    for method in ["pseudoObservation", "algorithm1", "bridging"] {
        let (mut engine, mut predictor, case) = moved(method);
        let destinations = case["destinations"].as_array().unwrap();
        assert_eq!(json!(engine.ids()), json!(destinations.iter().map(|one| &one["id"]).collect::<Vec<_>>()));
        let count = engine.len();
        assert_eq!(at(engine.probabilities(), count), predictor.probabilities());
        assert_eq!(at(engine.log_likelihoods(), count), predictor.log_likelihoods());
        assert_eq!((engine.none(), engine.expired()), (predictor.none(), predictor.expired()));
        let best = predictor.best().unwrap();
        let expected = json!({ "id": best.id, "index": best.index, "probability": best.probability });
        assert_eq!(object(&engine.best().unwrap()), expected);
        assert_eq!(engine.state(), predictor.state().as_ref().map(flat));
        assert_eq!(engine.initial_state(), predictor.initial_state().as_ref().map(flat));
        let time = 1.5 + rows(&case["observations"]).last().unwrap()[0];
        let found = good(engine.forecast(&plain(&json!({ "time": time }))));
        assert_eq!(found, predictor.forecast(time).unwrap().as_ref().map(flat));
        let found = good(engine.path(&plain(&json!({ "id": "d1", "times": [time, time + 1.0] }))));
        assert_eq!(found, predictor.path("d1", &[time, time + 1.0]).unwrap());
        let found = good(engine.arrival(&plain(&json!({ "id": "d1" })))).unwrap();
        let expected = predictor.arrival(Some("d1")).unwrap().unwrap();
        let numbers = [vec![expected.mean, expected.deviation], expected.times, expected.probabilities].concat();
        assert_eq!(found, numbers);
    }
}

#[wasm_bindgen_test]
fn an_observation_in_full_may_lack_an_axis_and_have_a_noise_of_its_own() {
    let (mut engine, mut predictor, case) = moved("pseudoObservation");
    let time = 0.1 + rows(&case["observations"]).last().unwrap()[0];
    good(engine.observe_in_full(&plain(&json!({ "time": time, "position": [null, 0.5], "noise": 0.2 }))));
    let noise = 0.2.into();
    predictor.observe_with(time, &[None, Some(0.5)], Some(&noise)).unwrap();
    assert_eq!(at(engine.probabilities(), engine.len()), predictor.probabilities());
}

#[wasm_bindgen_test]
fn destinations_are_added_moved_and_removed() {
    let (mut engine, mut predictor, case) = moved("pseudoObservation");
    let new = json!({ "id": "new", "mean": [0.5, 1], "covariance": [[0.02, 0], [0, 0.02]] });
    good(engine.add_destination(&plain(&json!({ "destination": new }))));
    let mut moved = new.clone();
    moved["mean"] = json!([1, 1]);
    good(engine.update_destination(&plain(&json!({ "id": "new", "destination": moved }))));
    good(engine.remove_destination(&plain(&json!({ "id": "d0" }))));
    let mut left = case["destinations"].as_array().unwrap()[1..].to_vec();
    left.push(moved);
    whither::internals::set_destinations(&mut predictor, &crate::support::value(&json!(left))).unwrap();
    let probabilities = at(engine.probabilities(), engine.len());
    let difference = crate::support::relative(&probabilities, predictor.probabilities());
    assert!(difference < 1e-12, "{difference:e}");
    good(engine.set_destinations(&plain(&json!({ "destinations": left }))));
    assert_eq!(engine.ids(), ["d1", "d2", "d3", "new"]);
}

#[wasm_bindgen_test]
fn a_snapshot_and_a_copy_go_on_to_the_bit() {
    let (mut engine, _, case) = moved("algorithm1");
    let snapshot = json(&engine.snapshot());
    let mut copies = [engine.duplicate(), good(Engine::restore(&plain(&snapshot)))];
    let time = 0.1 + rows(&case["observations"]).last().unwrap()[0];
    observed(engine.observe(time, 2, 0.0, 1.0, 0.0));
    for copy in &mut copies {
        observed(copy.observe(time, 2, 0.0, 1.0, 0.0));
        assert_eq!(at(copy.probabilities(), copy.len()), at(engine.probabilities(), engine.len()));
        assert_eq!(json(&copy.snapshot()), json(&engine.snapshot()));
    }
    engine.reset();
    assert!(engine.best().is_none() && engine.state().is_none());
    assert_ne!(json(&engine.snapshot()), snapshot);
}

#[wasm_bindgen_test]
fn the_pointer_scenario_is_a_scenario() {
    globals();
    let given = &read("errors.json")["bases"]["pointer"]["from"];
    let scenario = good(device_scenario(0, &plain(given)));
    let mut engine = good(Engine::new(&scenario));
    assert_eq!(engine.ids(), ["a", "b"]);
    assert_eq!(engine.none(), given["options"]["none"]);
    observed(engine.observe(0.0, 2, 40.0, 2.0, 0.0));
    observed(engine.observe(0.016, 2, 50.0, 2.0, 0.0));
    assert_eq!(object(&engine.best().unwrap())["id"], "b");
    let [mean, low, high] = engine.remaining().unwrap()[..] else { panic!("not three numbers") };
    assert!(0.0 < low && low < mean && mean < high);
}

#[wasm_bindgen_test]
fn a_sequence_engine_answers_as_its_sequence() {
    globals();
    let configuration = &read("errors.json")["bases"]["sequence"]["from"];
    let (mut engine, mut sequence) = (good(SequenceEngine::new(&plain(configuration))), sequence(configuration));
    good(engine.measure(&plain(&json!({ "step": 3, "position": [1] }))));
    sequence.measure(3, &[1.0]).unwrap();
    assert_eq!((engine.states(), engine.steps()), (2, 10));
    assert_eq!(good(engine.state(&plain(&json!({ "step": 7 })))), flat(&sequence.state(7).unwrap()));
    assert_eq!(engine.destination(), flat(&sequence.destination()));
    let model = sequence.model(6).unwrap();
    let parts = [&model.previous, &model.destination, &model.covariance].map(|matrix| matrix.transpose());
    let expected = [parts[0].as_slice(), parts[1].as_slice(), parts[2].as_slice(), model.offset.as_slice()].concat();
    assert_eq!(good(engine.model(&plain(&json!({ "step": 6 })))), expected);
    let drawn = good(engine.sample(&plain(&json!({ "seed": 5, "count": 2 }))));
    assert_eq!(drawn, sequence.sample(5, 2).unwrap().concat());
    let reciprocal = good(engine.is_reciprocal(&plain(&json!({}))));
    let markov = good(engine.is_markov(&plain(&json!({ "tolerance": 1e-3 }))));
    assert_eq!(
        (reciprocal, markov),
        (sequence.is_reciprocal(DEFAULT_TOLERANCE).unwrap(), sequence.is_markov(1e-3).unwrap())
    );
    engine.reset();
    assert_eq!(engine.destination()[..2], numbers(&configuration["pinnedMean"])[4..]);
}
