//! One movement after the other: what is kept from one to the next must hold for the destinations as they are then.

use crate::support::{predictor, value};
use serde_json::{Value as Json, json};
use whither::internals::set_destinations;
use whither::{Matrix, ObservationNoise, PointerOptions, PointerTarget, Predictor, pointer_scenario};

/// What a predictor has to do with.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Pointing,
    /// Arrival priors that do not depend on where a movement begins.
    Papers,
    /// Some that do.
    PapersWithFitts,
}

const KINDS: [Kind; 3] = [Kind::Pointing, Kind::Papers, Kind::PapersWithFitts];

/// Targets of one size and of their own, some with an end velocity or an arrival prior of their own.
fn destinations(count: i32, kind: Kind) -> Json {
    let one = |i: i32| {
        let side = if i % 3 == 0 { 60 } else { 40 + i };
        let center = [(37 * i) % 900 + count, (53 * i) % 700];
        let mut one = json!({ "id": format!("d{i}"), "center": center, "size": [side, 50], "prior": 1 + i % 4 });
        if kind == Kind::Pointing {
            return one;
        }
        if i % 5 == 4 {
            one["endVelocity"] = json!(150);
        }
        if i % 11 == 10 {
            one["arrival"] = json!({ "type": "discrete", "times": [0.1, 0.5], "weights": [1, 2] });
        }
        if kind == Kind::PapersWithFitts && i % 7 == 6 {
            one["arrival"] = json!({ "type": "fitts", "intercept": 0.2, "slope": 0.1, "spread": 0.3 });
        }
        one
    };
    (0..count).map(one).collect()
}

fn begin(kind: Kind) -> Predictor {
    let mut scenario = if kind == Kind::Pointing {
        let target = PointerTarget { id: "d0".to_owned(), x: 0.0, y: 0.0, width: 1.0, height: 1.0 };
        serde_json::to_value(pointer_scenario(&[target], PointerOptions::default()).unwrap()).unwrap()
    } else {
        json!({
            "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 900 },
            "observation": { "noise": 1.5 },
            "initial": { "velocity": 800 },
            "arrival": { "type": "horizon", "from": 0.05, "to": 0.5 },
            "quadrature": { "rule": "simpson", "points": 5 },
        })
    };
    scenario["none"] = json!(0.1);
    scenario["learning"] = json!({ "strength": 3, "forgetting": 0.1, "afterLast": 2 });
    scenario["destinations"] = destinations(40, kind);
    let mut predictor = predictor(&scenario);
    // from now on its priors are the learnt ones, which sum to one
    predictor.chosen("d1").unwrap();
    predictor
}

fn set(predictor: &mut Predictor, destinations: &Json) {
    set_destinations(predictor, &value(destinations)).unwrap();
}

/// A movement from a place of its own, and all numbers of each destination, bit by bit. Where `coupled`, the noise of one
/// observation couples the axes.
fn follow(predictor: &mut Predictor, number: u32, coupled: bool) -> Vec<u64> {
    let correlated = ObservationNoise::from(Matrix::from([[4.0, 1.0], [1.0, 4.0]]));
    let mut bits = Vec::new();
    for k in 0..6 {
        let (t, from) = (0.02 * f64::from(k), 40.0 * f64::from(number));
        let noise = (coupled && k == 3).then_some(&correlated);
        predictor.observe_with(t, &[Some(from + 900.0 * t), Some(300.0 - from * t)], noise).unwrap();
        bits.extend(predictor.probabilities().iter().map(|p| p.to_bits()));
        bits.extend(predictor.log_likelihoods().iter().map(|l| l.to_bits()));
    }
    bits
}

/// What happens between two movements, or in the middle of the first of them.
type Edit = fn(&mut Predictor, Kind);

const EDITS: [Edit; 6] = [
    |_, _| {},
    |predictor, kind| set(predictor, &destinations(25, kind)),
    |predictor, _| predictor.chosen("d3").unwrap(),
    |_, _| {},
    |predictor, _| predictor.remove_destination("d0").unwrap(),
    |predictor, _| predictor.chosen("d7").unwrap(),
];

#[test]
fn each_is_as_the_first_of_a_new_predictor() {
    for kind in KINDS {
        for in_movement in [false, true] {
            let mut used = begin(kind);
            for (number, edit) in (0..).zip(EDITS) {
                if in_movement {
                    edit(&mut used, kind);
                }
                used.reset();
                if !in_movement {
                    edit(&mut used, kind);
                }
                let mut new = Predictor::restore(&used.snapshot()).unwrap();
                let coupled = kind != Kind::Pointing && number % 2 == 0;
                let same = follow(&mut used, number, coupled) == follow(&mut new, number, coupled);
                assert!(same, "{kind:?}, movement {number}");
            }
        }
    }
}

#[test]
fn a_copy_with_other_destinations_leaves_those_of_the_original() {
    for kind in KINDS {
        let mut one = begin(kind);
        let before = follow(&mut one, 1, false);
        one.reset();
        let mut copy = one.clone();
        set(&mut copy, &destinations(25, kind));
        let mut new = Predictor::restore(&copy.snapshot()).unwrap();
        assert!(follow(&mut copy, 1, false) == follow(&mut new, 1, false), "{kind:?}, the copy");
        assert!(follow(&mut one, 1, false) == before, "{kind:?}, the original");
    }
}
