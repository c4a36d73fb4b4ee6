//! `initial.evidence`: the evidence of the first observation, `p(y_1 | D_i, T)` in Liang (5), counts in every method.

use crate::batch::Batch;
use crate::problem::{Problem, apart, choices, random};
use crate::support::{numbers, predictor, relative};
use proptest::prelude::*;
use serde_json::{Value as Json, json};
use whither::Predictor;

const PSEUDO: [&str; 3] = ["pseudoObservation", "algorithm1", "algorithm2"];
const INDEPENDENT: [&str; 2] = ["bridging", "singleFilter"];

fn counting(problem: &Problem) -> Problem {
    let mut counting = problem.clone();
    counting.scenario["initial"]["evidence"] = json!(true);
    counting
}

/// A random walk that begins around 0 with the variance 4, one second before it arrives at one of two places.
fn walk(method: &str, evidence: bool) -> Predictor {
    let place = |id: &str, x: i32| json!({ "id": id, "mean": [x], "covariance": [[1]] });
    predictor(&json!({
        "method": method, "arrival": { "type": "discrete", "times": [1], "weights": [1] },
        "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
        "initial": { "mean": [0], "covariance": [[4]], "evidence": evidence },
        "destinations": [place("left", -5), place("right", 5)]
    }))
}

/// By hand: given a = 5 the start is N(10/3, 4/3), so y_1 = 3 is of N(10/3, 7/3); given -5 of N(-10/3, 7/3).
#[test]
fn a_start_near_a_destination_makes_it_more_probable() {
    let log = |mean: f64| -0.5 * (2.0 * std::f64::consts::PI * 7.0 / 3.0).ln() - (3.0 - mean).powi(2) / (14.0 / 3.0);
    let expected = [log(-10.0 / 3.0), log(10.0 / 3.0)];
    for method in PSEUDO {
        let mut counting = walk(method, true);
        counting.observe(0.0, &[3.0]).unwrap();
        assert!(relative(counting.log_likelihoods(), &expected) < 1e-12, "{method}: {:?}", counting.log_likelihoods());
        let right = (1.0 + (-60.0f64 / 7.0).exp()).recip();
        assert!((counting.probabilities()[1] - right).abs() < 1e-12, "{method}");
        // it stays counted, and by default it never is
        let mut default = walk(method, false);
        for predictor in [&mut counting, &mut default] {
            predictor.observe(0.5, &[3.0]).unwrap();
        }
        assert!(counting.probabilities()[1] > 0.9999 && default.probabilities()[1] < 0.93, "{method}");
    }
    // an endpoint that is independent of the start: the same of every destination, N(3; 0, 5)
    for method in INDEPENDENT {
        let mut counting = walk(method, true);
        counting.observe(0.0, &[3.0]).unwrap();
        let same = -0.5 * (10.0 * std::f64::consts::PI).ln() - 0.9;
        assert!(relative(counting.log_likelihoods(), &[same; 2]) < 1e-12, "{method}");
        assert!((counting.probabilities()[1] - 0.5).abs() < 1e-12, "{method}");
    }
    // Table 1's l_(d,1): a of N(12/5, 4/5 + 1 + 1) where it is 5, and the same for y_1 as above
    let mut approximate = walk("singleFilterApproximate", true);
    approximate.observe(0.0, &[3.0]).unwrap();
    let density = |a: f64| (-(a - 2.4f64).powi(2) / (2.0 * 2.8)).exp();
    let right = density(5.0) / (density(5.0) + density(-5.0));
    assert!((approximate.probabilities()[1] - right).abs() < 1e-12);
}

proptest! {
    #![proptest_config(random(150))]

    /// Within a family the methods stay the same, from the first observation on; with an endpoint
    /// independent of the start the first observation is equally likely for every destination.
    #[test]
    fn the_families_count_it_alike(choice in choices()) {
        let default = choice.problem();
        let problem = counting(&default);
        for family in [&PSEUDO[..], &INDEPENDENT] {
            let apart = apart(&problem, family);
            prop_assert!(apart < 1e-8, "{family:?}: {apart:e}");
        }
        for method in INDEPENDENT {
            let (mut with, mut without) = (problem.followed(method), default.followed(method));
            let apart = relative(with.probabilities(), without.probabilities());
            prop_assert!(apart < 1e-9, "{method}: {apart:e}");
        }
    }

    /// `log p(y_1:k | D_i)` and the states are those of the joint Gaussian of all observations and the endpoint.
    #[test]
    fn the_evidence_is_the_batch_density(mut choice in choices()) {
        choice.steps = choice.steps.min(4);
        let mut problem = counting(&choice.problem());
        problem.scenario["none"] = json!(0);
        for method in ["pseudoObservation", "algorithm2", "bridging", "singleFilter"] {
            let batch = Batch::new(&problem, method);
            let mut predictor = problem.followed(method);
            prop_assume!(!predictor.expired());
            let expected: Vec<f64> = (0..4).map(|i| batch.log_likelihood(i)).collect();
            let apart = relative(predictor.log_likelihoods(), &expected);
            prop_assert!(apart < 1e-8, "{method}: {apart:e}: {:?} {expected:?}", predictor.log_likelihoods());
            let time = problem.observations[problem.observations.len() - 1].time + 0.5;
            let (found, expected) = (predictor.forecast(time).unwrap().unwrap(), batch.state(time));
            let apart = relative(found.mean.as_slice(), expected.mean.as_slice());
            prop_assert!(apart < 1e-6, "{method}: {apart:e}");
        }
    }

    /// A snapshot keeps it to the bit, in mid-movement and at the first observation; so does a scenario.
    #[test]
    fn a_snapshot_keeps_it(choice in choices(), at in 1..8usize) {
        let problem = counting(&choice.problem());
        for method in PSEUDO.iter().chain(&INDEPENDENT) {
            let mut predictor = problem.predictor(method);
            let (before, after) = problem.observations.split_at(at.min(problem.observations.len()));
            before.iter().for_each(|observed| observed.by(&mut predictor));
            let mut restored = Predictor::restore(&predictor.snapshot()).unwrap();
            prop_assert_eq!(restored.log_likelihoods(), predictor.log_likelihoods());
            for observed in after {
                observed.by(&mut predictor);
                observed.by(&mut restored);
                prop_assert_eq!(restored.probabilities(), predictor.probabilities());
                prop_assert_eq!(restored.log_likelihoods(), predictor.log_likelihoods());
            }
        }
    }
}

/// Of a destination that comes in mid-movement it counts as of one that was always there.
#[test]
fn destinations_that_come_later_have_it_too() {
    let place = |id: &str, x: i32| json!({ "id": id, "mean": [x], "covariance": [[1]] });
    for method in ["pseudoObservation", "singleFilter"] {
        let mut all = walk(method, true);
        let mut scenario = serde_json::to_value(all.scenario()).unwrap();
        scenario["destinations"].as_array_mut().unwrap().pop();
        let mut grown = predictor(&scenario);
        for predictor in [&mut all, &mut grown] {
            predictor.observe(0.0, &[3.0]).unwrap();
        }
        whither::internals::add_destination(&mut grown, &crate::support::value(&place("right", 5))).unwrap();
        for (time, position) in [(0.0, None), (0.25, Some(3.5)), (0.5, Some(4.0))] {
            for predictor in [&mut all, &mut grown] {
                predictor.observe_with(time, &[position], None).unwrap();
            }
            assert!(relative(grown.probabilities(), all.probabilities()) < 1e-12, "{method}");
        }
    }
}

/// The golden cases hold for the scenario without the key, and with it false.
#[test]
fn by_default_the_first_observation_does_not_count() {
    let case = crate::support::golden("cv2d-position");
    for evidence in [None, Some(false)] {
        for method in PSEUDO.iter().chain(&INDEPENDENT).chain(&["singleFilterApproximate"]) {
            let mut scenario = crate::support::scenario_of(&case, method);
            if let Some(evidence) = evidence {
                scenario["initial"]["evidence"] = json!(evidence);
            }
            let mut predictor = predictor(&scenario);
            let first = numbers(&case["observations"][0]);
            predictor.observe(first[0], &first[1..]).unwrap();
            assert!(predictor.log_likelihoods().iter().all(|log| *log == 0.0), "{method}");
            let priors = |destination: &Json| destination["prior"].as_f64().unwrap_or(1.0);
            let priors: Vec<f64> = case["destinations"].as_array().unwrap().iter().map(priors).collect();
            let total: f64 = priors.iter().sum();
            let expected: Vec<f64> = priors.iter().map(|prior| prior / total).collect();
            assert!(relative(predictor.probabilities(), &expected) < 1e-14, "{method}");
        }
    }
}

/// With axes that do not mix the default method goes its fast way; Algorithm 1 never does.
#[test]
fn the_fast_form_counts_it_as_the_dense_one() {
    let places = [[300.0, 40.0], [-80.0, 260.0], [420.0, -90.0]];
    let place = |(i, center): (usize, &[f64; 2])| {
        let size = [40 + 10 * i, 30];
        json!({ "id": format!("d{i}"), "center": center, "size": size, "endVelocity": 100 })
    };
    let diagonal = [900.0, 1600.0, 1e4, 2e4];
    let covariance: Vec<Vec<f64>> =
        (0..4).map(|i| (0..4).map(|j| if i == j { diagonal[i] } else { 0.0 }).collect()).collect();
    let [mut fast, mut dense] = ["pseudoObservation", "algorithm1"].map(|method| {
        predictor(&json!({
            "method": method, "motion": { "type": "constantVelocity", "dimensions": 2, "noise": [300, 500] },
            "observation": { "noise": 2 }, "arrival": { "type": "uniform", "from": 0.6, "to": 1.4 }, "none": 0.1,
            "initial": { "mean": [10, 20, 100, 0], "covariance": covariance, "evidence": true },
            "destinations": places.iter().enumerate().map(place).collect::<Vec<_>>(),
        }))
    });
    for k in 0..8 {
        let t = 0.05 * f64::from(k);
        let position = [60.0 + 300.0 * t, 30.0 + 10.0 * t];
        let missing = [Some(position[0]), None];
        for predictor in [&mut fast, &mut dense] {
            match k {
                2 => predictor.observe_with(t, &missing, None).unwrap(),
                // noise that couples the axes, and the way back from it
                5 => predictor.observe_with(t, &position.map(Some), Some(&coupled_noise())).unwrap(),
                _ => predictor.observe(t, &position).unwrap(),
            }
        }
        assert!(relative(fast.log_likelihoods(), dense.log_likelihoods()) < 1e-9, "k = {k}");
        assert!(relative(fast.probabilities(), dense.probabilities()) < 1e-9, "k = {k}");
        assert!((fast.none() - dense.none()).abs() < 1e-9, "k = {k}");
        if k == 0 {
            assert!(fast.probabilities()[0] > 1.5 * fast.probabilities()[1], "{:?}", fast.probabilities());
        }
    }
}

fn coupled_noise() -> whither::ObservationNoise {
    whither::Matrix::from([[4.0, 1.0], [1.0, 3.0]]).into()
}
