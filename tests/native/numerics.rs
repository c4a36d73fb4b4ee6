//! Long and hard movements: covariances stay symmetric positive definite, probabilities finite and summing to `1 - none`.

use crate::support::predictor;
use nalgebra::DMatrix;
use serde_json::{Value as Json, json};
use whither::{Gaussian, Predictor};
use whither::{PointerOptions, PointerTarget, pointer_scenario};

/// A reproducible number in [-1, 1).
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn scenario(motion: &Json, observation: f64, none: f64) -> Json {
    json!({
        "motion": motion,
        "observation": { "noise": observation },
        "initial": {},
        "arrival": { "type": "horizon", "from": 0.1, "to": 2 },
        "quadrature": { "rule": "simpson", "points": 3 },
        "none": none,
        "destinations": [
            { "id": "a", "center": [40], "size": 20 },
            { "id": "b", "mean": [-40], "covariance": [[9]] }
        ]
    })
}

/// Symmetric to the bit, and with a Cholesky root once every component is in units of its own deviation.
fn check(Gaussian { mean, covariance }: &Gaussian) -> Result<(), String> {
    let n = mean.len();
    let deviations: Vec<f64> = (0..n).map(|i| covariance[(i, i)].sqrt()).collect();
    let fine = |x: &f64| x.is_finite() && *x > 0.0;
    if !mean.iter().all(|x| x.is_finite()) || !deviations.iter().all(fine) {
        return Err(format!("mean {mean} covariance {covariance}"));
    }
    let correlations = DMatrix::from_fn(n, n, |i, j| covariance[(i, j)] / (deviations[i] * deviations[j]));
    if *covariance != covariance.transpose() || nalgebra::Cholesky::new(correlations.clone()).is_none() {
        return Err(format!("covariance {covariance} correlations {correlations}"));
    }
    Ok(())
}

fn check_all(predictor: &mut Predictor) -> Result<(), String> {
    let sum: f64 = predictor.probabilities().iter().sum();
    let none = predictor.none();
    if (sum + none - 1.0).abs() > 1e-12 || !predictor.probabilities().iter().all(|p| (0.0..=1.0).contains(p)) {
        return Err(format!("probabilities {:?} and none {none}", predictor.probabilities()));
    }
    check(&predictor.state().unwrap()).map_err(|error| format!("state {error}"))?;
    check(&predictor.initial_state().unwrap()).map_err(|error| format!("start {error}"))
}

/// The step after each sample.
type Rhythm = fn(usize) -> f64;

/// How the samples come: evenly, each twice at one time, in steps of 1e-4, with long pauses.
const RHYTHMS: [(&str, Rhythm); 4] = [
    ("even", |_| 0.01),
    ("doubled", |k| if k % 2 == 0 { 0.01 } else { 0.0 }),
    ("short", |_| 1e-4),
    ("paused", |k| if k % 100 == 0 { 30.0 } else { 1e-3 }),
];

#[test]
fn covariances_stay_positive_definite_over_a_million_observations() {
    let (mut observations, mut wrong) = (0, Vec::new());
    for kind in ["brownian", "constantVelocity", "constantAcceleration"] {
        for ratio in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            for (rhythm, step) in RHYTHMS {
                let motion = json!({ "type": kind, "dimensions": 1, "noise": ratio });
                let mut predictor = predictor(&scenario(&motion, 1.0, 0.1));
                let mut noise = Noise(7);
                let mut time = 1e4;
                for k in 0..17_000 {
                    time += step(k);
                    predictor.observe(time, &[20.0 * (time * 0.1).sin() + noise.next()]).unwrap();
                    observations += 1;
                    let due = k < 100 || k % 1000 == 0;
                    if due && let Err(error) = check_all(&mut predictor) {
                        wrong.push(format!("{kind} {ratio:e} {rhythm} at {k}: {error}"));
                        break;
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}: {}", wrong.len(), wrong.join("\n"));
    assert!(observations > 1_000_000);
}

/// Little known of the start, hardly any noise after it: what is known of the components spans twenty orders of magnitude.
#[test]
fn a_wide_start_and_tiny_noise_stay_positive_definite() {
    let mut wrong = Vec::new();
    for ratio in [1e-6, 1e-4, 1.0] {
        for (rhythm, step) in RHYTHMS {
            let motion = json!({ "type": "constantAcceleration", "dimensions": 1, "noise": ratio });
            let mut scenario = scenario(&motion, 1e-3, 0.1);
            scenario["initial"] = json!({ "velocity": 1e4, "acceleration": 1e7 });
            let mut predictor = predictor(&scenario);
            let mut noise = Noise(3);
            let mut time = 0.0;
            for k in 0..5000 {
                time += step(k);
                predictor.observe(time, &[1e-3 * noise.next()]).unwrap();
                if let Err(error) = check_all(&mut predictor) {
                    wrong.push(format!("{ratio:e} {rhythm} at {k}: {error}"));
                    break;
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}: {}", wrong.len(), wrong.join("\n"));
}

const METHODS: [&str; 6] =
    ["pseudoObservation", "algorithm1", "algorithm2", "bridging", "singleFilter", "singleFilterApproximate"];

fn plane(method: &str, none: f64) -> Json {
    json!({
        "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 3000 },
        "observation": { "noise": 1 },
        "initial": { "velocity": 200 },
        "arrival": { "type": "uniform", "from": 4, "to": 9 },
        "method": method,
        "none": if method == "singleFilterApproximate" { 0.0 } else { none },
        "destinations": [
            { "id": "a", "center": [100, 100], "size": 80 },
            { "id": "b", "center": [500, 100], "size": 80, "endVelocity": 200 },
            { "id": "c", "center": [100, 100], "size": 80 },
            { "id": "d", "center": [100, 400], "size": [80, 40], "prior": 0 }
        ]
    })
}

fn finite(method: &str, predictor: &mut Predictor) {
    let none = predictor.none();
    let probabilities = predictor.probabilities();
    assert!(probabilities.iter().all(|p| (0.0..=1.0).contains(p)), "{method}: {probabilities:?}");
    assert!((probabilities.iter().sum::<f64>() + none - 1.0).abs() < 1e-12, "{method}: {probabilities:?} {none}");
    let apart = (probabilities[0] - probabilities[2]).abs();
    assert!(apart <= 1e-15 && probabilities[3] == 0.0, "{method}: {probabilities:?}");
    for state in [predictor.state(), predictor.initial_state()] {
        check(&state.unwrap()).unwrap_or_else(|error| panic!("{method}: {error}"));
    }
    assert!(predictor.arrival(None).unwrap().unwrap().mean.is_finite());
}

/// Every likelihood underflows by far: 300 samples 10^5 deviations from every target, in every direction.
#[test]
fn samples_far_from_every_target_leave_probabilities_finite() {
    for method in METHODS {
        for none in [0.0, 0.3] {
            let mut predictor = predictor(&plane(method, none));
            let mut noise = Noise(1);
            for k in 0..300 {
                let angle = f64::from(k) * 2.4;
                let position = [1e5 * angle.cos() + noise.next(), 1e5 * angle.sin()];
                predictor.observe(0.01 * f64::from(k), &position).unwrap();
                finite(method, &mut predictor);
            }
        }
    }
}

/// One sample of 10^5 px among others: the next samples correct the probabilities.
#[test]
fn an_outlier_is_forgotten() {
    for method in METHODS {
        let mut predictor = predictor(&plane(method, 0.05));
        let mut at = |k: i32, x: f64| {
            predictor.observe(0.016 * f64::from(k), &[x, 100.0]).unwrap();
            finite(method, &mut predictor);
            predictor.probabilities()[1]
        };
        for k in 0..20 {
            at(k, 300.0 + 2.0 * f64::from(k));
        }
        at(20, 1e5);
        for k in 21..120 {
            at(k, 300.0 + 2.0 * f64::from(k));
        }
        let last = (120..160).map(|k| at(k, 300.0 + 2.0 * f64::from(k).min(100.0))).last().unwrap();
        assert!(last.is_finite(), "{method}");
    }
}

/// The same for the pointing model: an outlier of 10^5 px and back, and samples far from everything.
#[test]
fn the_pointing_model_survives_an_outlier() {
    let target = |id: &str, x: f64| PointerTarget { id: id.to_owned(), x, y: 100.0, width: 80.0, height: 40.0 };
    let targets = [target("a", 100.0), target("b", 500.0), target("c", 900.0)];
    let options = PointerOptions { none: 0.05, ..PointerOptions::default() };
    let mut predictor = Predictor::new(&pointer_scenario(&targets, options).unwrap());
    let mut observe = |k: i32, x: f64| {
        predictor.observe(0.016 * f64::from(k), &[x, 100.0]).unwrap();
        check_all(&mut predictor).unwrap_or_else(|error| panic!("at {k}: {error}"));
        predictor.best().unwrap().id
    };
    let glide = |k: i32| 150.0 + 4.0 * f64::from(k);
    for k in 0..20 {
        observe(k, glide(k));
    }
    observe(20, 1e5);
    let last = (21..80).map(|k| observe(k, glide(k))).last();
    assert_eq!(last.as_deref(), Some("b"));
    for k in 80..380 {
        observe(k, 1e5 * f64::from(k).sin());
    }
}

/// A layout and a track, mirrored and turned by a right angle: the same probabilities.
#[test]
fn a_mirrored_or_turned_layout_gives_the_same_probabilities() {
    let turns: [fn(f64, f64) -> [f64; 2]; 3] = [|x, y| [-x, y], |x, y| [-y, x], |x, y| [y, x]];
    for method in METHODS {
        let mut straight = predictor(&plane(method, 0.1));
        let mut turned = turns.map(|turn| {
            let mut scenario = plane(method, 0.1);
            for destination in scenario["destinations"].as_array_mut().unwrap() {
                let [x, y] = [0, 1].map(|i| destination["center"][i].as_f64().unwrap());
                destination["center"] = json!(turn(x, y));
                if let Some(size) = destination["size"].as_array() {
                    let [w, h] = turn(size[0].as_f64().unwrap(), size[1].as_f64().unwrap());
                    destination["size"] = json!([w.abs(), h.abs()]);
                }
            }
            predictor(&scenario)
        });
        let mut noise = Noise(5);
        for k in 0..60 {
            let (time, x, y) = (0.02 * f64::from(k), 250.0 + 5.0 * f64::from(k) + noise.next(), 180.0 - f64::from(k));
            straight.observe(time, &[x, y]).unwrap();
            for (predictor, turn) in turned.iter_mut().zip(turns) {
                predictor.observe(time, &turn(x, y)).unwrap();
                let pairs = predictor.probabilities().iter().zip(straight.probabilities());
                let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(apart < 1e-12, "{method} at {k}: {apart:e}");
            }
        }
    }
}

#[test]
fn after_a_pause_of_centuries_a_likelihood_is_a_number_or_nothing() {
    let mut predictor = predictor(&json!({
        "motion": { "type": "constantAcceleration", "dimensions": 1, "noise": 0.747_138_913_451_869_2 },
        "observation": { "noise": 0.507_970_635_914_7 }, "none": 0.2,
        "initial": { "velocity": 2, "acceleration": 1.8 },
        "arrival": { "type": "horizon", "from": 1.441_200_197_606_462_4, "to": 6.332_146_447_139_211 },
        "quadrature": { "rule": "simpson", "points": 5 },
        "destinations": [
            { "id": "a", "mean": [-1.7], "covariance": [[1.016]] },
            { "id": "b", "mean": [5.26, 1.77], "covariance": [[0.86, 0.26], [0.26, 0.43]] },
        ],
    }));
    predictor.observe(0.0, &[-4.7]).unwrap();
    for time in [1.1e10, 1.110_488_300_0e10, 9e10, 1e11, 5e11] {
        predictor.observe(time, &[1.0]).unwrap();
        let logs = predictor.log_likelihoods().to_vec();
        assert!(logs.iter().all(|log| *log < f64::INFINITY), "{logs:?}");
        let sum: f64 = predictor.probabilities().iter().sum::<f64>() + predictor.none();
        assert!((sum - 1.0).abs() < 1e-9, "{sum}");
    }
}
