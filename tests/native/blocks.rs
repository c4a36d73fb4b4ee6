//! Destinations as the hot loops read them: in blocks, in their own order or in another, at whatever priors.

use crate::support::{predictor, relative, value};
use serde_json::{Value as Json, json};
use whither::Predictor;
use whither::study::simulate::Random;
use whither::{PointerOptions, PointerTarget, pointer_scenario};

/// One target; every third one has a speed on arrival, where wanted.
fn place(random: &mut Random, name: usize, sizes: &[f64], speeds: bool) -> Json {
    let center = [900.0 * random.uniform(), 500.0 * random.uniform()];
    let mut place = json!({
        "id": format!("d{name}"), "center": center, "size": sizes[name % sizes.len()], "prior": 0.5 + random.uniform()
    });
    if speeds && name % 3 == 2 {
        place["endVelocity"] = json!(200);
    }
    place
}

fn scenario(method: &str, none: f64, destinations: &[Json]) -> Json {
    if method == "pointing" {
        let target = PointerTarget { id: "a".to_owned(), x: 0.0, y: 0.0, width: 50.0, height: 50.0 };
        let pointer = pointer_scenario(&[target], PointerOptions { none, ..PointerOptions::default() }).unwrap();
        let mut scenario = serde_json::to_value(pointer).unwrap();
        scenario["destinations"] = json!(destinations);
        return scenario;
    }
    json!({
        "method": method,
        "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 900 },
        "observation": { "noise": 1.5 },
        "initial": { "velocity": 800 },
        "arrival": { "type": "horizon", "from": 0.05, "to": 0.8 },
        "none": none,
        "destinations": destinations,
    })
}

fn observe(predictor: &mut Predictor, k: u32) {
    let t = 0.02 * f64::from(k);
    predictor.observe(t, &[40.0 + 700.0 * t, 60.0 + 300.0 * t]).unwrap();
}

/// The probabilities, that of none of them, and the log likelihoods.
fn posterior(predictor: &mut Predictor) -> Vec<f64> {
    let mut all = predictor.probabilities().to_vec();
    all.push(predictor.none());
    all.extend(predictor.log_likelihoods());
    assert!(all.iter().all(|x| !x.is_nan()));
    let sum = all[..=predictor.len()].iter().sum::<f64>();
    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    all
}

/// Destinations that come and go over the edge of a block leave what a list of those that are there gives.
#[test]
fn the_posterior_does_not_depend_on_how_the_destinations_came_about() {
    let mut random = Random::new(3);
    for (method, sizes, speeds) in [
        ("pseudoObservation", &[60.0][..], false),
        ("pseudoObservation", &[60.0], true),
        ("pseudoObservation", &[60.0, 90.0], false),
        ("pointing", &[60.0], false),
        ("pointing", &[60.0, 90.0], false),
    ] {
        for count in [1, 3, 4, 5, 7, 8, 9, 17] {
            let mut list: Vec<Json> = (0..count).map(|i| place(&mut random, i, sizes, speeds)).collect();
            let mut edited = predictor(&scenario(method, 0.1, &list));
            for k in 0..24 {
                observe(&mut edited, k);
                match k % 4 {
                    1 | 2 => {
                        let new = place(&mut random, count + k as usize, sizes, speeds);
                        whither::internals::add_destination(&mut edited, &value(&new)).unwrap();
                        list.push(new);
                    }
                    3 => {
                        let i = (random.uniform() * list.len() as f64) as usize;
                        edited.remove_destination(list.remove(i)["id"].as_str().unwrap()).unwrap();
                    }
                    _ => {
                        // the one that fills the last block up, among others
                        for i in [0, (list.len() - 1) / 4 * 4, list.len() - 1] {
                            let mut new = place(&mut random, i + k as usize, sizes, speeds);
                            new["id"] = list[i]["id"].clone();
                            whither::internals::update_destination(
                                &mut edited,
                                new["id"].as_str().unwrap(),
                                &value(&new),
                            )
                            .unwrap();
                            list[i] = new;
                        }
                    }
                }
                let mut fresh = predictor(&scenario(method, 0.1, &list));
                (0..=k).for_each(|k| observe(&mut fresh, k));
                let difference = relative(&posterior(&mut edited), &posterior(&mut fresh));
                assert!(difference < 1e-12, "{method} of {count}, {sizes:?}, at {k}: {difference:e}");
            }
        }
    }
}

/// Only ratios of priors matter, however large or small they are.
#[test]
fn priors_of_any_scale_give_the_same_posterior() {
    let mut random = Random::new(4);
    for (method, none) in [("pseudoObservation", 0.0), ("pseudoObservation", 0.2), ("pointing", 0.2)] {
        for count in [1, 4, 5, 8, 9] {
            let mut list: Vec<Json> = (0..count).map(|i| place(&mut random, i, &[60.0], false)).collect();
            // one that soon is most improbable
            list[0]["center"] = json!([-600, 900]);
            let scaled = |scale: f64| {
                let mut list = list.clone();
                for place in &mut list {
                    place["prior"] = json!(place["prior"].as_f64().unwrap() * scale);
                }
                let mut scenario = scenario(method, none, &list);
                if method == "pseudoObservation" {
                    scenario["motion"]["noise"] = json!(200);
                }
                predictor(&scenario)
            };
            let mut plain = scaled(1.0);
            let mut others = [1e-300, 1e-25, 1e-17, 1e-3, 1e4, 1e17, 1e25, 1e49].map(scaled);
            for k in 0..20 {
                observe(&mut plain, k);
                for other in &mut others {
                    observe(other, k);
                    let difference = relative(&posterior(other), &posterior(&mut plain));
                    assert!(difference < 1e-12, "{method} of {count} at {k}: {difference:e}");
                    // the small ones keep their digits
                    for (p, expected) in other.probabilities().iter().zip(plain.probabilities()) {
                        assert!(
                            (p - expected).abs() <= 1e-10 * expected,
                            "{method} of {count} at {k}: {p:e} {expected:e}"
                        );
                    }
                }
            }
        }
    }
}

/// Priors that are learnt in mid-movement against the same priors given from the start: few destinations in one block and a
/// broken one, and so many on a line that those out of reach are left out, in their own order.
#[test]
fn learnt_priors_apply_at_once() {
    let few: Vec<Json> = (0..9).map(|i| json!({ "id": format!("d{i}"), "center": [100 * i], "size": 60 })).collect();
    let many: Vec<Json> = (0..5003).map(|i| json!({ "id": format!("d{i}"), "center": [90 * i], "size": 60 })).collect();
    for list in [few, many] {
        let line = |list: &[Json]| {
            json!({
                "motion": { "type": "constantVelocity", "dimensions": 1, "noise": 900 },
                "observation": { "noise": 1.5 }, "initial": { "velocity": 800 },
                "arrival": { "type": "horizon", "from": 0.05, "to": 0.8 },
                "none": 0.1, "learning": { "strength": 2 }, "destinations": list,
            })
        };
        let track = |k: u32| (0.02 * f64::from(k), [300.0 + 10.0 * f64::from(k)]);
        let (mut learning, mut expected) = (predictor(&line(&list)), vec![2.0 / list.len() as f64; list.len()]);
        for k in 0..12 {
            let (time, position) = track(k);
            learning.observe(time, &position).unwrap();
            if k > 2 {
                // also the last one, which is far out of reach
                let chosen = [8, 5, list.len() - 1, 7][k as usize % 4];
                learning.chosen(&format!("d{chosen}")).unwrap();
                expected[chosen] += 1.0;
            }
            let mut given = list.clone();
            given.iter_mut().zip(&expected).for_each(|(place, prior)| place["prior"] = json!(prior));
            let mut given = predictor(&line(&given));
            for k in 0..=k {
                let (time, position) = track(k);
                given.observe(time, &position).unwrap();
            }
            let difference = relative(&posterior(&mut learning), &posterior(&mut given));
            assert!(difference < 1e-12, "{} destinations at {k}: {difference:e}", list.len());
        }
    }
}

/// The order in which destinations are given does not matter: runs of one size are kept in order, alternating sizes are
/// brought together.
#[test]
fn destinations_in_another_order_have_the_same_probabilities() {
    let mut random = Random::new(6);
    for method in ["pseudoObservation", "pointing"] {
        for count in [16, 17, 40] {
            let in_turns: Vec<Json> = (0..count).map(|i| place(&mut random, i, &[60.0, 90.0], false)).collect();
            let order: Vec<usize> = (0..count).step_by(2).chain((1..count).step_by(2)).collect();
            let sorted: Vec<Json> = order.iter().map(|&i| in_turns[i].clone()).collect();
            let [mut in_turns, mut sorted] = [in_turns, sorted].map(|list| predictor(&scenario(method, 0.1, &list)));
            for k in 0..20 {
                observe(&mut in_turns, k);
                observe(&mut sorted, k);
                let found: Vec<f64> = order.iter().map(|&i| in_turns.probabilities()[i]).collect();
                let difference = relative(&found, sorted.probabilities());
                assert!(difference < 1e-12, "{method} of {count} at {k}: {difference:e}");
            }
        }
    }
}
