//! The life of a predictor: destinations that come and go, a new movement, copies, snapshots, the end of all arrival times.

use crate::support::{change, golden, predictor, relative, scenario_of, value};
use serde_json::{Value as Json, json};
use whither::{Code, Predictor, Snapshot};

const METHODS: [&str; 6] =
    ["pseudoObservation", "algorithm1", "algorithm2", "bridging", "singleFilter", "singleFilterApproximate"];
const EDITABLE: [&str; 3] = ["pseudoObservation", "singleFilter", "singleFilterApproximate"];

/// Two kinds of endpoint, an arrival prior of its own, two noise candidates.
fn scenario(method: &str) -> Json {
    json!({
        "motion": { "type": "constantVelocity", "dimensions": 2, "noise": { "candidates": [2, 5], "weights": [3, 1] } },
        "observation": { "noise": [[1.5, 0.2], [0.2, 1]] },
        "initial": { "velocity": [5, 7] },
        "arrival": { "type": "uniform", "from": 1, "to": 4 },
        "quadrature": { "rule": "simpson", "points": 5 },
        "method": method,
        "none": if method == "singleFilterApproximate" { 0.0 } else { 0.1 },
        "destinations": [place("a", 10, 0), corner("b", -10, 5, 2), place("c", 3, -8), later("d", 4, 4)]
    })
}

fn place(id: &str, x: i32, y: i32) -> Json {
    json!({ "id": id, "center": [x, y], "size": [2, 3], "endVelocity": 4 })
}

fn corner(id: &str, x: i32, y: i32, prior: i32) -> Json {
    json!({ "id": id, "mean": [x, y], "covariance": [[1, 0.3], [0.3, 2]], "prior": prior })
}

fn later(id: &str, x: i32, y: i32) -> Json {
    json!({ "id": id, "center": [x, y], "size": 2, "arrival": { "type": "discrete", "times": [2, 6], "weights": [1, 2] } })
}

/// The movement: time, position; an axis is missing once, a time is repeated.
const TRACK: [(f64, [Option<f64>; 2]); 7] = [
    (100.0, [Some(0.0), Some(0.0)]),
    (100.3, [Some(1.1), Some(0.4)]),
    (100.7, [Some(2.4), None]),
    (101.0, [Some(3.0), Some(0.9)]),
    (101.0, [Some(3.2), Some(0.8)]),
    (101.6, [Some(5.5), Some(0.7)]),
    (102.1, [Some(6.9), Some(0.2)]),
];

fn follow(predictor: &mut Predictor, track: &[(f64, [Option<f64>; 2])]) {
    for (time, position) in track {
        predictor.observe_with(*time, position, None).unwrap();
    }
}

/// Everything that a predictor returns, as one list.
fn outputs(predictor: &mut Predictor, until: f64) -> Vec<f64> {
    let mut all = predictor.probabilities().to_vec();
    all.push(predictor.none());
    all.extend(predictor.log_likelihoods());
    all.push(f64::from(u8::from(predictor.expired())));
    let ids: Vec<String> = predictor.ids().map(str::to_owned).collect();
    for id in std::iter::once(None).chain(ids.iter().map(Some)) {
        if let Some(arrival) = predictor.arrival(id.map(String::as_str)).unwrap() {
            all.extend(&arrival.times);
            all.extend(&arrival.probabilities);
            all.extend([arrival.mean, arrival.deviation]);
        }
    }
    if let Some(remaining) = predictor.remaining() {
        all.extend([remaining.mean, remaining.low, remaining.high]);
    }
    for state in
        [predictor.state(), predictor.initial_state(), predictor.forecast(until + 0.5).unwrap()].into_iter().flatten()
    {
        all.extend(state.mean.iter());
        all.extend(state.covariance.iter());
    }
    for id in &ids {
        all.extend(predictor.path(id, &[until + 0.1, until + 2.0]).unwrap());
    }
    all
}

/// A bit pattern, so that minus infinity is equal to itself.
fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|x| x.to_bits()).collect()
}

fn through_text(predictor: &Predictor) -> Predictor {
    let text = serde_json::to_string(&predictor.snapshot()).unwrap();
    Predictor::restore(&serde_json::from_str(&text).unwrap()).unwrap()
}

type Edit = fn(&mut Predictor) -> whither::Result<()>;

/// An edit, and the destinations that are there after it.
fn edits() -> [(Edit, Json); 5] {
    [
        (
            |p| whither::internals::add_destination(p, &value(&corner("e", 7, 7, 1))),
            json!([
                place("a", 10, 0),
                corner("b", -10, 5, 2),
                place("c", 3, -8),
                later("d", 4, 4),
                corner("e", 7, 7, 1)
            ]),
        ),
        (
            |p| whither::internals::update_destination(p, "c", &value(&corner("c", 2, 9, 3))),
            json!([place("a", 10, 0), corner("b", -10, 5, 2), corner("c", 2, 9, 3), later("d", 4, 4)]),
        ),
        (
            |p| {
                whither::internals::update_destination(
                    p,
                    "a",
                    &value(&json!({ "center": [9, 1], "size": [2, 3], "endVelocity": 4 })),
                )
            },
            json!([place("a", 9, 1), corner("b", -10, 5, 2), place("c", 3, -8), later("d", 4, 4)]),
        ),
        (|p| p.remove_destination("b"), json!([place("a", 10, 0), place("c", 3, -8), later("d", 4, 4)])),
        (
            |p| {
                whither::internals::set_destinations(
                    p,
                    &value(&json!([later("f", -5, -5), place("c", 3, -8), place("a", 11, 0)])),
                )
            },
            json!([later("f", -5, -5), place("c", 3, -8), place("a", 11, 0)]),
        ),
    ]
}

/// The same numbers as a new predictor that had these destinations from the start.
#[test]
fn destinations_change_exactly_in_mid_movement() {
    for method in EDITABLE {
        for (number, (edit, destinations)) in edits().into_iter().enumerate() {
            for when in 0..=TRACK.len() {
                let mut edited = predictor(&scenario(method));
                follow(&mut edited, &TRACK[..when]);
                edited.probabilities();
                edit(&mut edited).unwrap();
                let mut fresh = predictor(&change(&scenario(method), &json!({ "/destinations": destinations })));
                follow(&mut fresh, &TRACK[..when]);
                for rest in when..=TRACK.len() {
                    if rest > when {
                        follow(&mut edited, &TRACK[rest - 1..rest]);
                        follow(&mut fresh, &TRACK[rest - 1..rest]);
                    }
                    let difference = relative(&outputs(&mut edited, 102.1), &outputs(&mut fresh, 102.1));
                    assert!(difference < 1e-12, "{method}, edit {number} after {when}, at {rest}: {difference:e}");
                }
            }
        }
    }
}

#[test]
fn what_accumulates_refuses_other_destinations_in_mid_movement_only() {
    for method in METHODS.into_iter().filter(|method| !EDITABLE.contains(method)) {
        for (number, (edit, destinations)) in edits().into_iter().enumerate() {
            let mut edited = predictor(&scenario(method));
            edit(&mut edited).unwrap();
            let mut fresh = predictor(&change(&scenario(method), &json!({ "/destinations": destinations })));
            follow(&mut edited, &TRACK);
            follow(&mut fresh, &TRACK);
            assert_eq!(edited.probabilities(), fresh.probabilities(), "{method}, edit {number}");

            let before = fresh.snapshot();
            let error = fresh.remove_destination("a").unwrap_err();
            assert_eq!(error.code(), Code::MethodAccumulates);
            assert_eq!(
                error.to_string(),
                format!(
                    "destinations: destinations cannot change in mid-movement, but \"{method}\" accumulates evidence for each \
                     destination and arrival time; \"pseudoObservation\", \"singleFilter\" and \"singleFilterApproximate\" do \
                     not"
                )
            );
            assert_eq!(fresh.snapshot(), before);
            fresh.reset();
            fresh.remove_destination("a").unwrap();
        }
    }
}

/// A model that depends on the destination has a filter for each: they may be removed, and change place, prior and size.
#[test]
fn destinations_that_the_model_depends_on_can_be_removed_but_not_added() {
    let knowing = json!({
        "/motion": { "type": "meanReverting", "dimensions": 2, "noise": [2, 3], "rate": 0.4 },
        "/initial": null,
        "/destinations": [corner("a", 10, 0, 1), corner("b", -10, 5, 2), later("d", 4, 4)]
    });
    for method in EDITABLE {
        let start = || {
            let mut predictor = predictor(&change(&scenario(method), &knowing));
            follow(&mut predictor, &TRACK[..4]);
            predictor
        };
        let mut edited = start();
        whither::internals::set_destinations(&mut edited, &value(&json!([later("d", 4, 4), corner("a", 10, 0, 5)])))
            .unwrap();
        let fewer = json!({ "/destinations": [later("d", 4, 4), corner("a", 10, 0, 5)] });
        let mut fresh = predictor(&change(&change(&scenario(method), &knowing), &fewer));
        follow(&mut fresh, &TRACK[..4]);
        for rest in 4..=TRACK.len() {
            assert!(relative(&outputs(&mut edited, 102.1), &outputs(&mut fresh, 102.1)) < 1e-12);
            if rest < TRACK.len() {
                follow(&mut edited, &TRACK[rest..=rest]);
                follow(&mut fresh, &TRACK[rest..=rest]);
            }
        }
        for edit in [
            |p: &mut Predictor| whither::internals::add_destination(p, &value(&corner("e", 7, 7, 1))),
            |p: &mut Predictor| whither::internals::update_destination(p, "a", &value(&corner("a", 7, 7, 1))),
        ] {
            let mut refusing = start();
            let before = refusing.snapshot();
            assert_eq!(edit(&mut refusing).unwrap_err().code(), Code::MethodAccumulates);
            assert_eq!(refusing.snapshot(), before);
        }
    }
}

#[test]
fn a_reset_predictor_is_a_new_one() {
    for method in METHODS {
        let mut used = predictor(&scenario(method));
        follow(&mut used, &TRACK);
        used.reset();
        let mut fresh = predictor(&scenario(method));
        assert_eq!(used.probabilities(), fresh.probabilities());
        assert!(used.best().is_none() && used.state().is_none() && used.arrival(None).unwrap().is_none());
        follow(&mut used, &TRACK[1..]);
        follow(&mut fresh, &TRACK[1..]);
        assert_eq!(bits(&outputs(&mut used, 102.1)), bits(&outputs(&mut fresh, 102.1)), "{method}");
    }
}

#[test]
fn a_clone_is_independent() {
    for method in METHODS {
        let mut one = predictor(&scenario(method));
        follow(&mut one, &TRACK[..3]);
        let mut other = one.clone();
        let before = outputs(&mut one, 102.1);
        other.observe(101.0, &[-9.0, 4.0]).unwrap();
        if EDITABLE.contains(&method) {
            other.remove_destination("c").unwrap();
        }
        other.reset();
        follow(&mut other, &TRACK[4..]);
        assert_eq!(bits(&outputs(&mut one, 102.1)), bits(&before), "{method}");
    }
}

/// What is returned does not depend on earlier queries.
#[test]
fn queries_change_nothing() {
    for method in METHODS {
        let (mut queried, mut plain) = (predictor(&scenario(method)), predictor(&scenario(method)));
        for observation in TRACK.chunks(1) {
            follow(&mut queried, observation);
            follow(&mut plain, observation);
            outputs(&mut queried, 102.1);
        }
        assert_eq!(bits(&outputs(&mut queried, 102.1)), bits(&outputs(&mut plain, 102.1)), "{method}");
    }
}

fn observations(case: &Json) -> Vec<Vec<f64>> {
    case["observations"].as_array().unwrap().iter().map(crate::support::numbers).collect()
}

/// At every step of every kind of case, through JSON text; then both go on.
#[test]
fn a_restored_predictor_is_the_same_to_the_bit() {
    for name in ["cv2d-expiring-nodes", "cv2d-same-timestamp", "custom2d", "erv2d", "mean-reverting2d"] {
        let case = golden(name);
        for method in METHODS {
            let mut original = predictor(&scenario_of(&case, method));
            let observations = observations(&case);
            for (k, observation) in observations.iter().enumerate() {
                let mut restored = through_text(&original);
                for predictor in [&mut original, &mut restored] {
                    predictor.observe(observation[0], &observation[1..]).unwrap();
                }
                let until = observation[0];
                assert_eq!(
                    bits(&outputs(&mut original, until)),
                    bits(&outputs(&mut restored, until)),
                    "{name} {method} k = {k}"
                );
                assert_eq!(original.snapshot(), restored.snapshot(), "{name} {method} k = {k}");
            }
        }
    }
    for method in METHODS {
        let mut original = predictor(&scenario(method));
        for observation in TRACK.chunks(1) {
            let mut restored = through_text(&original);
            follow(&mut original, observation);
            follow(&mut restored, observation);
            assert_eq!(bits(&outputs(&mut original, 102.1)), bits(&outputs(&mut restored, 102.1)), "{method}");
        }
    }
}

/// A bit of each byte of the text, and each length that is too short.
#[test]
fn a_damaged_snapshot_is_refused() {
    let small = json!({ "/motion/noise": 2, "/quadrature/points": 3, "/destinations": [place("a", 10, 0), corner("b", -1, 5, 2)] });
    for method in ["pseudoObservation", "algorithm1", "bridging"] {
        let mut original = predictor(&change(&scenario(method), &small));
        follow(&mut original, &TRACK[..3]);
        let snapshot = original.snapshot();
        let text = serde_json::to_string(&snapshot).unwrap().into_bytes();
        let mut refused = 0;
        let mut damaged = |text: &[u8], what: &str| {
            let Ok(damaged) = serde_json::from_slice::<Snapshot>(text) else { return };
            match Predictor::restore(&damaged) {
                Err(error) => {
                    assert_eq!(error.code(), Code::BadSnapshot, "{method} {what}: {error}");
                    refused += 1;
                }
                // other last digits may be the same number
                Ok(restored) => assert_eq!(restored.snapshot(), snapshot, "{method} {what}"),
            }
        };
        for i in 0..text.len() {
            damaged(&text[..i], &format!("truncated to {i}"));
            let mut flipped = text.clone();
            flipped[i] ^= 1 << (i % 3);
            damaged(&flipped, &format!("byte {i} flipped"));
        }
        assert!(refused > text.len() / 2, "{method}: {refused} of {}", text.len());
    }
}

/// After the last arrival time the probabilities stay; the state goes on; destinations may still change.
#[test]
fn after_every_arrival_time_the_probabilities_stay() {
    let past = [(104.5, [Some(8.0), Some(0.0)]), (106.5, [Some(10.0), Some(0.2)]), (107.0, [Some(3.0), Some(-9.0)])];
    for method in METHODS {
        let mut predictor = predictor(&scenario(method));
        follow(&mut predictor, &TRACK);
        follow(&mut predictor, &past[..1]);
        assert!(!predictor.expired(), "one destination can still be reached");
        let last = predictor.probabilities().to_vec();
        assert!(last[3] > 0.0 && last[0] == 0.0);
        for observation in past[1..].chunks(1) {
            follow(&mut predictor, observation);
            assert!(predictor.expired() && predictor.remaining().is_none());
            assert_eq!(predictor.probabilities(), last, "{method}");
        }
        let position = predictor.state().unwrap().mean;
        assert!((position[0] - 3.0).abs() < 5.0 && position.iter().all(|x| x.is_finite()), "{method}: {position}");
        let mut restored = through_text(&predictor);
        assert_eq!(bits(&outputs(&mut restored, 107.0)), bits(&outputs(&mut predictor, 107.0)), "{method}");
    }
    for method in EDITABLE {
        let all: Vec<_> = TRACK.iter().chain(&past).copied().collect();
        let mut expired = predictor(&scenario(method));
        follow(&mut expired, &all);
        // an addition that expires with the others
        whither::internals::add_destination(&mut expired, &value(&place("e", -3, 3))).unwrap();
        let five =
            json!([place("a", 10, 0), corner("b", -10, 5, 2), place("c", 3, -8), later("d", 4, 4), place("e", -3, 3)]);
        let mut fresh = predictor(&change(&scenario(method), &json!({ "/destinations": five })));
        follow(&mut fresh, &all);
        assert!(expired.expired());
        assert!(relative(&outputs(&mut expired, 107.0), &outputs(&mut fresh, 107.0)) < 1e-12, "{method}");
        // one that can still be reached
        let reachable =
            json!({ "id": "f", "center": [3, -9], "size": 1, "arrival": { "type": "uniform", "from": 6, "to": 9 } });
        whither::internals::add_destination(&mut expired, &value(&reachable)).unwrap();
        assert!(!expired.expired());
        let best = expired.best().unwrap();
        assert_eq!(best.id, "f");
        let mut fresh = predictor(&change(&change(&scenario(method), &json!({ "/destinations": five })), &json!({})));
        whither::internals::add_destination(&mut fresh, &value(&reachable)).unwrap();
        follow(&mut fresh, &all);
        assert!(relative(&outputs(&mut expired, 107.0), &outputs(&mut fresh, 107.0)) < 1e-12, "{method}");
        // and gone again: nothing can be reached, so nothing is known
        whither::internals::set_destinations(&mut expired, &value(&json!([place("a", 10, 0), place("c", 3, -8)])))
            .unwrap();
        assert!(expired.expired());
        let rest = 1.0 - expired.none();
        assert!(expired.probabilities().iter().all(|p| (p - 0.5 * rest).abs() < 1e-15), "{method}");
    }
}
