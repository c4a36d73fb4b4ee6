//! States and forecasts: each method answers by its own family, as the joint Gaussian has it, and conditionally Markov sequences.

use crate::batch::Batch;
use crate::problem::{Draw, choices, random};
use crate::support::{predictor, relative, value};
use proptest::prelude::*;
use serde_json::{Value as Json, json};
use whither::{Gaussian, Predictor};

const METHODS: [&str; 6] =
    ["pseudoObservation", "algorithm1", "algorithm2", "bridging", "singleFilter", "singleFilterApproximate"];

fn apart(found: &Gaussian, expected: &Gaussian) -> f64 {
    let mean = relative(found.mean.as_slice(), expected.mean.as_slice());
    mean.max(relative(found.covariance.as_slice(), expected.covariance.as_slice()))
}

/// A random walk observed at 0 and, after one of two seconds, at 1, on its way to N(4, 3); every noise is 1. By hand.
#[test]
fn a_random_walk_by_hand() {
    let walk = |method: &str| {
        let mut walk = predictor(&json!({
            "method": method, "arrival": { "type": "discrete", "times": [2], "weights": [1] },
            "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
            "destinations": [{ "id": "there", "mean": [4], "covariance": [[3]] }]
        }));
        walk.observe(0.0, &[0.0]).unwrap();
        walk.observe(1.0, &[1.0]).unwrap();
        walk
    };
    for method in METHODS {
        // pseudo-observation: N(2/3, 2/3) and a = 4 of the variance 1 + 3. Endpoint independent of the start: x_2 = (x_1 + z)/2 + e
        // is N(2, 3/2) before y_2, which has the gain 3/5.
        let ((mean, variance), (end, end_variance)) = match method {
            "bridging" | "singleFilter" => ((1.4, 0.6), (3.4, 2.1)),
            _ => ((8.0 / 7.0, 4.0 / 7.0), (2.0 / 3.0 + 25.0 / 21.0, 15.0 / 14.0)),
        };
        let mut walk = walk(method);
        let state = walk.state().unwrap();
        assert!((state.mean[0] - mean).abs() < 1e-12, "{method}: {state:?}");
        assert!((state.covariance[0] - variance).abs() < 1e-12, "{method}: {state:?}");
        // at the arrival, and after it, where it stays
        for time in [2.0, 5.0] {
            let state = walk.forecast(time).unwrap().unwrap();
            assert!((state.mean[0] - end).abs() < 1e-12, "{method}: {state:?}");
            assert!((state.covariance[0] - end_variance).abs() < 1e-12, "{method}: {state:?}");
            assert!((walk.path("there", &[time]).unwrap()[0] - end).abs() < 1e-12, "{method}");
        }
    }
}

/// A vessel at its first observation: with the endpoint independent of the start nothing is known of its velocity yet.
#[test]
fn the_state_of_a_vessel_at_the_start_is_the_initial_density() {
    for method in ["bridging", "singleFilter"] {
        let mut vessel = predictor(&json!({
            "method": method, "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 0.1 },
            "observation": { "noise": 10 }, "initial": { "velocity": 5 },
            "arrival": { "type": "uniform", "from": 4800, "to": 9000 },
            "destinations": [{ "id": "harbour", "mean": [34000, 12000, 0, 0],
                "covariance": [[5, 0, 0, 0], [0, 5, 0, 0], [0, 0, 0.1, 0], [0, 0, 0, 0.1]] }]
        }));
        vessel.observe(0.0, &[0.0, 0.0]).unwrap();
        let state = vessel.state().unwrap();
        for axis in [2, 3] {
            assert!(state.mean[axis].abs() < 1e-6, "{method}: {:?}", state.mean);
            assert!((state.covariance[(axis, axis)] - 25.0).abs() < 1e-6, "{method}: {:?}", state.covariance);
        }
    }
}

/// One arrival time and the complete state as endpoint: the conditionally Markov sequence with independent endpoints.
#[test]
fn bridging_and_the_single_filter_are_the_conditionally_markov_sequence() {
    let (steps, step) = (12, 0.5);
    for (name, motion) in [
        ("cv", json!({ "type": "constantVelocity", "dimensions": 2, "noise": [0.7, 1.3] })),
        (
            "iou",
            json!({ "type": "integratedOrnsteinUhlenbeck", "dimensions": 1, "noise": 0.8, "damping": 0.4, "drift": [1] }),
        ),
        ("brownian", json!({ "type": "brownian", "dimensions": 3, "noise": 1 })),
    ] {
        let d = motion["dimensions"].as_u64().unwrap() as usize;
        let s = if name == "brownian" { d } else { 2 * d };
        let mut draw = Draw(5);
        let (start, start_covariance) = (draw.list(s, -2.0, 2.0), draw.covariance(s, 2.0));
        let (end, end_covariance) = (draw.list(s, 4.0, 8.0), draw.covariance(s, 0.5));
        let pinned = |i: usize, j: usize| match (i / s, j / s) {
            (0, 0) => start_covariance[i][j],
            (1, 1) => end_covariance[i - s][j - s],
            _ => 0.0,
        };
        let pinned: Vec<Vec<f64>> = (0..2 * s).map(|i| (0..2 * s).map(|j| pinned(i, j)).collect()).collect();
        let pinned_mean = [start.clone(), end.clone()].concat();
        let sequence = |motion: &Json| {
            let configuration = json!({
                "motion": motion, "timeStep": step, "steps": steps, "observation": { "noise": 0.3 },
                "pinnedMean": pinned_mean, "pinnedCovariance": pinned,
            });
            whither::internals::sequence(&value(&configuration)).unwrap()
        };
        for method in ["bridging", "singleFilter"] {
            let mut sequence = sequence(&motion);
            let mut predictor = predictor(&json!({
                "method": method, "motion": motion, "observation": { "noise": 0.3 },
                "initial": { "mean": start, "covariance": start_covariance },
                "arrival": { "type": "discrete", "times": [f64::from(steps) * step], "weights": [1] },
                "destinations": [{ "id": "there", "mean": end, "covariance": end_covariance }]
            }));
            for k in 0..steps {
                let position = draw.list(d, -2.0, 6.0);
                predictor.observe(f64::from(k) * step, &position).unwrap();
                sequence.measure(k as usize, &position).unwrap();
                for later in k..=steps {
                    let found = predictor.forecast(f64::from(later) * step).unwrap().unwrap();
                    let expected = sequence.state(later as usize).unwrap();
                    let difference = apart(&found, &expected);
                    assert!(difference < 1e-8, "{name} {method}: step {later} from {k}: {difference:e}");
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(random(200))]

    /// One family, one state: now, before, at and after the arrival, towards one destination and any, whatever was observed.
    #[test]
    fn the_single_filter_has_the_states_of_bridging(choice in choices()) {
        let problem = choice.problem();
        let mut both = ["bridging", "singleFilter"].map(|method| problem.predictor(method));
        let bits = |predictor: &mut Predictor, time: f64| {
            let mut all = Vec::new();
            for later in [0.0, 0.3, 2.0, 9.0] {
                let state = predictor.forecast(time + later).unwrap().unwrap();
                all.extend(state.mean.iter().chain(state.covariance.iter()));
            }
            all.extend(predictor.path("d1", &[time, time + 1.0]).unwrap());
            all
        };
        for observed in &problem.observations {
            let [bridging, single] = both.each_mut().map(|predictor| {
                observed.by(predictor);
                bits(predictor, observed.time)
            });
            let difference = relative(&single, &bridging);
            prop_assert!(difference < 1e-7, "{difference:e}");
        }
    }
}

proptest! {
    #![proptest_config(random(40))]

    /// The states given by the joint Gaussian of all states and observations, for every method, now and later.
    #[test]
    fn states_are_those_of_the_joint_gaussian(mut choice in choices(), later in 0.0..3.0f64) {
        choice.steps = choice.steps.min(5);
        let mut problem = choice.problem();
        problem.scenario["none"] = json!(0);
        for method in METHODS {
            let batch = Batch::new(&problem, method);
            let mut predictor = problem.followed(method);
            prop_assume!(!predictor.expired());
            let last = problem.observations[problem.observations.len() - 1].time;
            for time in [last, last + later] {
                let difference = apart(&predictor.forecast(time).unwrap().unwrap(), &batch.state(time));
                prop_assert!(difference < 1e-6, "{method}: {difference:e}");
            }
        }
    }
}
