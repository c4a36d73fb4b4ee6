//! The fast form against the dense one, which computes the same one pair at a time.

use super::PseudoObservation;
use crate::engine::{Engine, Observed};
use crate::likelihood::Method;
use crate::likelihood::configuration::Configuration;
use crate::likelihood::stepwise::Stepwise;
use crate::math::random::Random;
use crate::posterior::Posterior;
use crate::scenario::Setup;
use crate::{Predictor, Scenario};
use nalgebra::DMatrix;
use serde_json::{Value as Json, json};

fn read(json: &Json) -> Scenario {
    serde_json::from_value(json.clone()).unwrap()
}

/// One of a list, at random.
fn pick<T: Clone>(random: &mut Random, list: &[T]) -> T {
    list[(random.uniform() * list.len() as f64) as usize].clone()
}

fn vector(random: &mut Random, d: usize, scale: f64) -> Vec<f64> {
    (0..d).map(|_| scale * random.normal()).collect()
}

/// A covariance with correlations, of this scale in each component.
fn covariance(random: &mut Random, scales: &[f64]) -> Json {
    let n = scales.len();
    let root = DMatrix::from_fn(n, n, |i, j| if i == j { 1.5 } else { 0.4 * random.normal() });
    let square = &root * root.transpose();
    json!((0..n).map(|i| (0..n).map(|j| square[(i, j)] * scales[i] * scales[j]).collect()).collect::<Vec<Vec<f64>>>())
}

fn motion(random: &mut Random, d: usize, coupled: bool) -> (Json, usize) {
    if coupled {
        let s = 2 * d;
        let drift = DMatrix::from_fn(s, s, |i, j| match (i < d, j >= d) {
            (true, true) if j - d == i => 1.0,
            (false, true) => 0.2 * random.normal() - if i == j { 0.8 } else { 0.0 },
            _ => 0.0,
        });
        let rows: Vec<Vec<f64>> = (0..s).map(|i| (0..s).map(|j| drift[(i, j)]).collect()).collect();
        let full = covariance(random, &vec![800.0; d]);
        let diffusion: Vec<Vec<f64>> = (0..s)
            .map(|i| (0..s).map(|j| if i < d || j < d { 0.0 } else { full[i - d][j - d].as_f64().unwrap() }).collect())
            .collect();
        return (
            json!({ "type": "custom", "dimensions": d, "drift": rows, "diffusion": diffusion, "offset": vector(random, s, 5.0) }),
            s,
        );
    }
    let kind = pick(random, &["brownian", "constantVelocity", "constantAcceleration", "integratedOrnsteinUhlenbeck"]);
    let one = |random: &mut Random| 300.0 * (2.0 * random.uniform()).exp();
    let noise = match pick(random, &[0, 0, 1, 2]) {
        0 => json!(one(random)),
        1 => json!((0..d).map(|_| one(random)).collect::<Vec<_>>()),
        _ => json!({ "candidates": [one(random), one(random), one(random)], "weights": [1, 2, 0.5] }),
    };
    let mut motion = json!({ "type": kind, "dimensions": d, "noise": noise });
    if kind == "integratedOrnsteinUhlenbeck" {
        motion["damping"] = json!(2.0);
        motion["drift"] = json!(vector(random, d, 40.0));
    }
    let orders = match kind {
        "brownian" => 1,
        "constantAcceleration" => 3,
        _ => 2,
    };
    (motion, orders * d)
}

fn destination(random: &mut Random, i: usize, d: usize, s: usize, of: &str) -> Json {
    let far = if i % 7 == 6 { 1e5 } else { 700.0 };
    let center = vector(random, d, far);
    let prior = 0.1 + random.uniform();
    let sides: Vec<f64> = (0..d).map(|_| 10.0 + 200.0 * random.uniform()).collect();
    let mut destination = match of {
        "one" => json!({ "center": center, "size": 80 }),
        "oblong" => json!({ "center": center, "size": sides.iter().zip(1..).map(|(_, k)| 40 * k).collect::<Vec<_>>() }),
        "few" => json!({ "center": center, "size": ([40, 90, 120][i % 3]) }),
        "own" => json!({ "center": center, "size": sides }),
        "own speed" if s >= 2 * d => json!({ "center": center, "size": sides, "endVelocity": ([150, 300][i % 2]) }),
        _ => {
            let l = d + (random.uniform() * (s - d + 1) as f64) as usize;
            let scales: Vec<f64> = (0..l).map(|k| if k < d { 30.0 } else { 200.0 }).collect();
            let mean: Vec<f64> = center.iter().copied().chain(vector(random, l - d, 100.0)).collect();
            json!({ "mean": mean, "covariance": covariance(random, &scales) })
        }
    };
    destination["id"] = json!(format!("d{i}"));
    destination["prior"] = json!(prior);
    destination
}

fn arrival(random: &mut Random) -> Json {
    pick(
        random,
        &[
            json!({ "type": "horizon", "from": 0.05, "to": 0.5 }),
            json!({ "type": "uniform", "from": 0.3, "to": 2.0 }),
            // nodes that pass during the movement, the last of them at its very end
            json!({ "type": "uniform", "from": 0.04, "to": 0.400_000_1 }),
            json!({ "type": "discrete", "times": [0.9, 0.05, 0.4001], "weights": [1, 2, 3] }),
            json!({ "type": "fitts", "intercept": 0.1, "slope": 0.15, "spread": 0.4 }),
        ],
    )
}

fn scenario(random: &mut Random, seed: u64) -> Json {
    let d = 1 + (seed % 3) as usize;
    let coupled = seed % 4 == 3;
    let (motion, s) = motion(random, d, coupled);
    let of = pick(random, &["one", "one", "oblong", "few", "own", "own speed", "full"]);
    let count = pick(random, &[1, 2, 9, 21, 40]);
    let destinations: Vec<Json> = (0..count).map(|i| destination(random, i, d, s, of)).collect();
    let points = pick(random, &[3, 15, 17]);
    json!({
        "motion": motion,
        "observation": { "noise": 0.5 + 3.0 * random.uniform() },
        "arrival": arrival(random),
        "quadrature": { "rule": "simpson", "points": points },
        "none": pick(random, &[0.0, 0.0, 0.2]),
        "destinations": destinations,
    })
}

struct Difference {
    probability: f64,
    log_likelihood: f64,
}

/// Runs both over one movement and compares them after every observation.
fn compare(json: &Json, random: &mut Random, worst: &mut Difference) {
    let scenario = read(json);
    let (destinations, model) = (&scenario.destinations, &scenario.observation);
    let d = scenario.motion.dimensions();
    let mut velocity = vector(random, d, 800.0);
    let mut position = vector(random, d, 50.0);
    let observe = |position: &[f64], random: &mut Random| -> Vec<Option<f64>> {
        position.iter().map(|x| Some(x + random.normal())).collect()
    };
    let first = observe(&position, random);
    let first = scenario.initial.posterior(model, &model.measurement(&first, None).unwrap()).unwrap();
    let Setup::Papers { arrival, quadrature, .. } = &scenario.setup else { panic!() };
    let configuration = || Configuration {
        motion: scenario.motion.clone(),
        method: Method::PseudoObservation,
        arrival: arrival.clone(),
        quadrature: quadrature.clone(),
        observes_position: true,
        first_counts: false,
        start: first.mean.as_slice()[..d].to_vec(),
    };
    let mut dense = Stepwise::begin(configuration(), destinations, first.clone());
    let mut fast = PseudoObservation::begin(configuration(), destinations, &first);
    let [mut expected, mut found] = [Posterior::default(), Posterior::default()];
    let [mut log_expected, mut log_found] = [Vec::new(), Vec::new()];
    let mut elapsed = 0.0;
    let variance = model.noise()[(0, 0)];
    for k in 1..=25 {
        let step = if k % 6 == 0 { 0.0 } else { 0.016 + 0.001 * random.normal() };
        for axis in 0..d {
            velocity[axis] += 60.0 * random.normal();
            position[axis] += step * velocity[axis];
        }
        let mut observed = observe(&position, random);
        let (mut noise, mut variances) = (None, [variance; 3]);
        match (k % 9, d) {
            (4, 2..) => observed[1] = None,
            (5, _) => variances = [9.0, 4.0, 25.0],
            (8, 2..) if k > 20 && random.uniform() < 0.3 => {
                noise = Some(DMatrix::from_fn(d, d, |i, j| if i == j { 4.0 } else { 1.0 }));
            }
            _ => {}
        }
        let diagonal = DMatrix::from_fn(d, d, |i, j| if i == j { variances[i] } else { 0.0 });
        elapsed += step;
        let observed = Observed { elapsed, position: &observed, noise: noise.as_ref().unwrap_or(&diagonal), model };
        dense.advance(&observed).unwrap();
        fast.advance(&observed).unwrap();
        assert_eq!(fast.expired(), dense.expired());
        if dense.expired() {
            break;
        }
        dense.probabilities(scenario.none, &mut expected);
        fast.probabilities(scenario.none, &mut found);
        dense.log_likelihoods(&mut log_expected);
        fast.log_likelihoods(&mut log_found);
        let both = found.probabilities.iter().zip(&expected.probabilities);
        for (p, expected) in both.chain([(&found.none, &expected.none)]) {
            worst.probability = worst.probability.max((p - expected).abs());
            assert!((p - expected).abs() < 1e-12, "{p:e} {expected:e} after {k} observations of {json}");
        }
        for (l, expected) in log_found.iter().zip(&log_expected) {
            let difference = (l - expected).abs() / (1.0 + expected.abs());
            worst.log_likelihood = worst.log_likelihood.max(difference);
            assert!(difference < 1e-12, "{l} {expected} after {k} observations of {json}");
        }
    }
}

#[test]
fn it_equals_the_dense_form() {
    let mut worst = Difference { probability: 0.0, log_likelihood: 0.0 };
    for seed in 0..36 {
        let mut random = Random::new(seed);
        let json = scenario(&mut random, seed);
        compare(&json, &mut random, &mut worst);
    }
    println!(
        "largest differences: {:e} in probability, {:e} in log likelihood",
        worst.probability, worst.log_likelihood
    );
    assert!(worst.probability > 0.0, "compared with itself");
}

/// Destinations fill blocks, the last one seldom to its end: what fills it up must not count, near or far.
#[test]
fn full_and_partial_blocks_equal_the_dense_form() {
    let mut worst = Difference { probability: 0.0, log_likelihood: 0.0 };
    let mut random = Random::new(5);
    for d in 1..=3 {
        for count in [1, 3, 4, 5, 7, 8, 9, 17] {
            for of in ["one", "few", "own speed"] {
                let mut destinations: Vec<Json> =
                    (0..count).map(|i| destination(&mut random, i, d, 2 * d, of)).collect();
                // the last block's first one, which fills it up
                if count % 2 == 1 {
                    destinations[(count - 1) / 4 * 4]["center"] = json!(vector(&mut random, d, 1e6));
                }
                let json = json!({
                    "motion": { "type": "constantVelocity", "dimensions": d, "noise": 900 },
                    "observation": { "noise": 1.5 },
                    "arrival": { "type": "horizon", "from": 0.05, "to": 0.5 },
                    "quadrature": { "rule": "simpson", "points": 5 },
                    "none": 0.1,
                    "destinations": destinations,
                });
                compare(&json, &mut random, &mut worst);
            }
        }
    }
    assert!(worst.probability > 0.0, "compared with itself");
}

/// Many destinations on a map, of which those far from where the object can get are pruned.
#[test]
fn of_a_large_map_only_what_can_be_reached_is_evaluated() {
    let mut worst = Difference { probability: 0.0, log_likelihood: 0.0 };
    let mut random = Random::new(77);
    let map = |random: &mut Random, d: usize, size: Json, noise: Json| {
        let one = |random: &mut Random, i: usize| {
            let center = vector(random, d, 30_000.0);
            json!({ "id": format!("h{i}"), "center": center, "size": size, "prior": 0.1 + random.uniform() })
        };
        let destinations: Vec<Json> = (0..5000).map(|i| one(random, i)).collect();
        json!({
            "motion": { "type": "constantVelocity", "dimensions": d, "noise": noise },
            "observation": { "noise": 1.5 },
            "initial": { "velocity": 1000 },
            "arrival": { "type": "horizon", "from": 0.5, "to": 4 },
            "quadrature": { "points": 5 },
            "none": 0.1,
            "destinations": destinations,
        })
    };
    for json in [
        map(&mut random, 2, json!(300), json!(90)),
        map(&mut random, 2, json!([300, 200]), json!([90, 50])),
        map(&mut random, 3, json!(900), json!(90)),
        map(&mut random, 1, json!(20), json!(90)),
    ] {
        compare(&json, &mut random, &mut worst);
        let mut predictor = Predictor::new(&read(&json));
        let zeros = |predictor: &mut Predictor| predictor.probabilities().iter().filter(|p| **p == 0.0).count();
        let d = predictor.dimensions();
        for k in 0..4 {
            assert_eq!(zeros(&mut predictor), 0, "at first every one is possible");
            let t = f64::from(k) * 0.5;
            predictor.observe(t, &[900.0 * t, -400.0 * t, 100.0 * t][..d]).unwrap();
            if k > 0 {
                assert!(zeros(&mut predictor) > 2000, "{d} axes: {} pruned", zeros(&mut predictor));
                break;
            }
        }
        let sum = predictor.probabilities().iter().sum::<f64>() + predictor.none();
        assert!((sum - 1.0).abs() < 1e-12);
    }
    assert!(worst.probability > 0.0, "compared with itself");
}

/// Twenty destinations whose arrival times have all passed, and one that can still be reached.
#[test]
fn what_can_no_longer_be_reached_in_time_has_no_likelihood() {
    let gone = |i: usize| {
        json!({ "id": format!("gone{i}"), "center": [100 * i, 50], "size": 40,
                "arrival": { "type": "uniform", "from": 0.1, "to": 0.2 } })
    };
    let mut destinations: Vec<Json> = (0..20).map(gone).collect();
    destinations.push(json!({ "id": "left", "center": [500, 300], "size": 40 }));
    let scenario = json!({
        "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 900 },
        "observation": { "noise": 1.5 },
        "arrival": { "type": "uniform", "from": 1, "to": 3 },
        "destinations": destinations,
    });
    let mut predictor = Predictor::new(&read(&scenario));
    for k in 0..5 {
        predictor.observe(0.1 * f64::from(k), &[3.0 * f64::from(k), 2.0]).unwrap();
    }
    let (gone, left) = predictor.log_likelihoods().split_at(20);
    assert!(gone.iter().all(|l| *l == f64::NEG_INFINITY), "{gone:?}");
    assert!(left[0].is_finite());
    assert!((predictor.probabilities()[20] - 1.0).abs() < 1e-15);
}

/// Whatever the priors sum to, one destination that has it all has a probability of one, and not a bit more.
#[test]
fn no_probability_is_above_one() {
    for k in 1..400 {
        let scenario = json!({
            "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 90 },
            "observation": { "noise": 1.5 },
            "arrival": { "type": "uniform", "from": 0.9, "to": 1.1 },
            "destinations": [
                { "id": "there", "center": [3000, 50], "size": 40, "prior": 0.37 * f64::from(k) },
                { "id": "behind", "center": [-9000, 50], "size": 40 },
            ],
        });
        let mut predictor = Predictor::new(&read(&scenario));
        for step in 0..4 {
            let t = 0.1 * f64::from(step);
            predictor.observe(t, &[3000.0 * t, 50.0 * t]).unwrap();
        }
        let [there, behind] = predictor.probabilities() else { panic!() };
        assert!(
            *there <= 1.0 && *there > 1.0 - 1e-15 && *behind == 0.0,
            "{there} with the prior {}",
            0.37 * f64::from(k)
        );
    }
}
