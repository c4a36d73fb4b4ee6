//! Priors that are learnt from what was chosen.

use crate::support::{predictor, value};
use serde_json::json;
use whither::study::simulate::Random;
use whither::study::{metrics::Score, simulate::Hand, track::Target};
use whither::{Code, Predictor};
use whither::{PointerOptions, PointerTarget, pointer_scenario};

fn scenario(learning: serde_json::Value) -> serde_json::Value {
    json!({
        "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 0.1 },
        "arrival": { "type": "uniform", "from": 1, "to": 2 }, "learning": learning,
        "destinations": [
            { "id": "a", "center": [0], "size": 1, "prior": 2 },
            { "id": "b", "center": [5], "size": 1, "prior": 1 },
            { "id": "c", "center": [9], "size": 1, "prior": 1 },
            { "id": "off", "center": [12], "size": 1, "prior": 0 }
        ]
    })
}

fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    assert!(found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-12), "{found:?} against {expected:?}");
}

#[test]
fn choices_are_counted_against_the_given_priors() {
    let mut predictor = predictor(&scenario(json!({ "strength": 4 })));
    close(predictor.probabilities(), &[0.5, 0.25, 0.25, 0.0]);
    predictor.chosen("b").unwrap();
    predictor.chosen("b").unwrap();
    // (2, 1 + 2, 1) of 6
    close(predictor.probabilities(), &[2.0 / 6.0, 3.0 / 6.0, 1.0 / 6.0, 0.0]);
    predictor.chosen("off").unwrap();
    close(predictor.probabilities(), &[2.0 / 6.0, 3.0 / 6.0, 1.0 / 6.0, 0.0]);
    assert_eq!(predictor.chosen("d").unwrap_err().code(), Code::UnknownId);
}

#[test]
fn what_is_long_ago_is_forgotten() {
    let mut predictor = predictor(&scenario(json!({ "strength": 4, "forgetting": 0.5 })));
    predictor.chosen("b").unwrap();
    predictor.chosen("c").unwrap();
    // (2, 1 + .5, 1 + 1) of 5.5
    close(predictor.probabilities(), &[2.0 / 5.5, 1.5 / 5.5, 2.0 / 5.5, 0.0]);
}

#[test]
fn the_last_choice_predicts_the_next_one() {
    let mut predictor = predictor(&scenario(json!({ "strength": 4, "afterLast": 2 })));
    for id in ["a", "b", "a"] {
        predictor.chosen(id).unwrap();
    }
    // at large (2 + 2, 1 + 1, 1) of 7; after "a" came "b" once: (2 * 4/7, 2 * 2/7 + 1, 2 * 1/7) of 3
    close(predictor.probabilities(), &[8.0 / 21.0, 11.0 / 21.0, 2.0 / 21.0, 0.0]);
    let text = serde_json::to_string(&predictor.snapshot()).unwrap();
    let mut restored = Predictor::restore(&serde_json::from_str(&text).unwrap()).unwrap();
    assert_eq!(restored.probabilities(), predictor.probabilities());
    for both in [&mut predictor, &mut restored] {
        both.chosen("b").unwrap();
    }
    assert_eq!(restored.probabilities(), predictor.probabilities());
}

#[test]
fn a_destination_added_again_has_its_count() {
    let mut predictor = predictor(&scenario(json!({ "strength": 4 })));
    predictor.chosen("b").unwrap();
    let before = predictor.probabilities().to_vec();
    predictor.remove_destination("b").unwrap();
    whither::internals::add_destination(
        &mut predictor,
        &value(&json!({ "id": "b", "center": [5], "size": 1, "prior": 1 })),
    )
    .unwrap();
    let place = predictor.index_of("b").unwrap();
    assert!((predictor.probabilities()[place] - before[1]).abs() < 1e-12);
}

#[test]
fn a_choice_in_mid_movement_counts_at_once_and_survives_a_snapshot() {
    let mut learning = scenario(json!({ "strength": 4 }));
    let mut given = learning.clone();
    given.as_object_mut().unwrap().remove("learning");
    for (i, prior) in [2.0, 3.0, 1.0, 0.0].iter().enumerate() {
        given["destinations"][i]["prior"] = json!(prior);
    }
    for method in ["pseudoObservation", "algorithm1", "bridging"] {
        learning["method"] = json!(method);
        given["method"] = json!(method);
        let (mut learner, mut known) = (predictor(&learning), predictor(&given));
        for both in [&mut learner, &mut known] {
            both.observe(0.0, &[1.0]).unwrap();
            both.observe(0.3, &[1.5]).unwrap();
        }
        learner.chosen("b").unwrap();
        learner.chosen("b").unwrap();
        close(learner.probabilities(), known.probabilities());
        let text = serde_json::to_string(&learner.snapshot()).unwrap();
        let mut restored = Predictor::restore(&serde_json::from_str(&text).unwrap()).unwrap();
        for each in [&mut learner, &mut known, &mut restored] {
            each.observe(0.5, &[2.0]).unwrap();
        }
        close(learner.probabilities(), known.probabilities());
        assert_eq!(restored.probabilities(), learner.probabilities(), "{method}");
    }
}

#[test]
fn without_learning_a_choice_changes_nothing() {
    let mut scenario = scenario(json!({ "strength": 4 }));
    scenario.as_object_mut().unwrap().remove("learning");
    let mut predictor = predictor(&scenario);
    predictor.chosen("b").unwrap();
    close(predictor.probabilities(), &[0.5, 0.25, 0.25, 0.0]);
}

#[test]
fn bad_learning_is_named() {
    for (learning, expected) in [
        (json!({}), "learning.strength: missing key \"strength\""),
        (json!({ "strength": 0 }), "learning.strength: must be greater than 0, got 0"),
        (json!({ "strength": 1, "forgetting": 1 }), "learning.forgetting: must be at least 0 and less than 1, got 1"),
        (json!({ "strength": 1, "last": 1 }), "learning.last: unknown key \"last\""),
    ] {
        let error = whither::internals::scenario(&value(&scenario(learning))).unwrap_err();
        assert!(error.to_string().starts_with(expected), "{error}");
    }
}

/// A simulated user with habits: after each target one of the others in six of ten cases.
#[test]
fn a_users_habits_are_worth_more_than_a_better_model_of_the_hand() {
    let targets: Vec<Target> = (0..21)
        .map(|i| Target {
            center: vec![140.0 + 160.0 * f64::from(i % 7), 160.0 + 190.0 * f64::from(i / 7)],
            size: vec![96.0, 96.0],
        })
        .collect();
    let boxes: Vec<PointerTarget> = targets
        .iter()
        .enumerate()
        .map(|(i, t)| PointerTarget { id: i.to_string(), x: t.center[0], y: t.center[1], width: 96.0, height: 96.0 })
        .collect();
    let plain = pointer_scenario(&boxes, PointerOptions::default()).unwrap();
    let whither::internals::Value::Map(mut entries) = whither::internals::data(&plain) else {
        panic!("a scenario is an object")
    };
    entries.push(("learning".into(), value(&json!({ "strength": 10, "forgetting": 0.01, "afterLast": 3 }))));
    let learning = whither::internals::scenario(&whither::internals::Value::Map(entries)).unwrap();
    let mut random = Random::new(11);
    let mut learner = Predictor::new(&learning);
    let (mut with, mut without) = (0.0, 0.0);
    let mut last = 0usize;
    for movement in 0..240 {
        let next = if random.uniform() < 0.6 { (last * 5 + 3) % 21 } else { (random.uniform() * 21.0) as usize };
        let start = [targets[last].center[0], targets[last].center[1]];
        if next != last {
            let track = Hand::default().reach(&mut random, start, &targets, next);
            if let Some(approach) = track.approach().filter(|_| movement >= 120) {
                let score = Score::of_scenario(&track, approach, &plain).unwrap();
                without += score.loss / score.samples;
                learner.reset();
                let mut loss = 0.0;
                for sample in &track.samples[..approach] {
                    learner.observe(sample.time, &sample.position).unwrap();
                    loss -= learner.probabilities()[next].max(1e-4).ln();
                }
                with += loss / approach as f64;
            }
            learner.chosen(&next.to_string()).unwrap();
            last = next;
        }
    }
    assert!(with < 0.75 * without, "{with} with habits, {without} without");
}
