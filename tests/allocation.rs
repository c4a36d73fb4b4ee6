//! What observing costs the memory: nothing after the first observations.
//!
//! A program of its own, because it replaces the allocator. Only this thread's allocations are counted.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used)]

use allocation_counter::{AllocationInfo, measure};
use serde_json::{Value as Json, json};
use whither::{PointerOptions, PointerTarget, pointer_scenario};
use whither::{Predictor, Scenario};

/// The sizes of the targets.
#[derive(Clone, Copy)]
enum Sizes {
    One,
    /// In turns, so that targets of one size have to be brought together.
    Two,
    Own,
}

impl Sizes {
    fn of(self, i: u32) -> f64 {
        match self {
            Self::One => 80.0,
            Self::Two => 80.0 - f64::from(i % 2 * 30),
            Self::Own => 40.0 + f64::from(i) * 0.25,
        }
    }
}

/// Targets spread over a screen.
fn targets(count: u32, sizes: Sizes) -> Vec<Json> {
    let target = |i: u32| {
        let size = sizes.of(i);
        json!({ "id": format!("icon {i}"), "center": [100 + 150 * (i % 7), 100 + 150 * (i / 7)], "size": [size, 60.0] })
    };
    (0..count).map(target).collect()
}

fn pseudo_observation(count: u32, sizes: Sizes) -> Predictor {
    let motion = json!({ "type": "constantVelocity", "dimensions": 2, "noise": 3000 });
    read(&json!({
        "method": "pseudoObservation", "motion": motion, "observation": { "noise": 1.5 },
        "initial": { "velocity": 1000 }, "arrival": { "type": "horizon", "from": 0.05, "to": 0.5 },
        "none": 0.05, "destinations": targets(count, sizes),
    }))
}

fn pointing(count: u32, sizes: Sizes) -> Predictor {
    let targets = (0..count).map(|i| PointerTarget {
        id: format!("icon {i}"),
        x: f64::from(100 + 150 * (i % 7)),
        y: f64::from(100 + 150 * (i / 7)),
        width: sizes.of(i),
        height: 60.0,
    });
    let options = PointerOptions { none: 0.05, ..PointerOptions::default() };
    Predictor::new(&pointer_scenario(&targets.collect::<Vec<_>>(), options).unwrap())
}

/// The same, which keeps what it may learn from.
fn learning(count: u32, sizes: Sizes) -> Predictor {
    let mut scenario = serde_json::to_value(pointing(count, sizes).scenario()).unwrap();
    scenario["learning"] = json!({ "strength": 5 });
    read(&scenario)
}

fn read(scenario: &Json) -> Predictor {
    let scenario: Scenario = serde_json::from_value(scenario.clone()).unwrap();
    Predictor::new(&scenario)
}

/// A movement of so many observations over the screen, and its probabilities after each.
fn movement(predictor: &mut Predictor, from: u32, observations: u32) {
    for k in from..from + observations {
        let t = 0.008 * f64::from(k);
        let position = [500.0 + 300.0 * (2.0 * t).sin(), 400.0 + 200.0 * t.cos()];
        predictor.observe(t, &position).unwrap();
        assert!(predictor.probabilities()[0].is_finite());
    }
}

fn after_a_first_movement(mut predictor: Predictor) -> AllocationInfo {
    movement(&mut predictor, 0, 30);
    measure(|| movement(&mut predictor, 30, 1000))
}

#[test]
fn pseudo_observation_allocates_nothing_after_the_first_observations() {
    for (count, sizes) in [(21, Sizes::One), (200, Sizes::Own), (200, Sizes::Two)] {
        assert_eq!(after_a_first_movement(pseudo_observation(count, sizes)).count_total, 0);
    }
}

#[test]
fn pointing_allocates_nothing_after_the_first_observations() {
    for (count, sizes) in [(21, Sizes::One), (200, Sizes::Own), (200, Sizes::Two)] {
        assert_eq!(after_a_first_movement(pointing(count, sizes)).count_total, 0);
    }
}

#[test]
fn what_a_movement_keeps_to_learn_from_is_allocated_when_it_begins_and_small() {
    for (count, sizes) in [(21, Sizes::One), (200, Sizes::Two)] {
        assert_eq!(after_a_first_movement(learning(count, sizes)).count_total, 0);
    }
    let begin = |make: fn(u32, Sizes) -> Predictor| {
        let mut predictor = make(21, Sizes::One);
        movement(&mut predictor, 0, 5);
        predictor.reset();
        measure(|| movement(&mut predictor, 0, 1)).bytes_total
    };
    assert!(begin(learning) - begin(pointing) < 5000);
}

/// Bytes that the beginning of a movement allocates for each target, after one before it.
fn bytes_to_begin(make: fn(u32, Sizes) -> Predictor, sizes: Sizes) -> u64 {
    let begin = |predictor: &mut Predictor| {
        predictor.reset();
        predictor.probabilities();
        measure(|| movement(predictor, 0, 1)).bytes_total
    };
    let bytes = |count: u32| {
        let mut predictor = make(count, sizes);
        movement(&mut predictor, 0, 5);
        let mut copy = predictor.clone();
        let once = begin(&mut predictor);
        assert_eq!([begin(&mut predictor), begin(&mut copy)], [once; 2], "every movement, and a copy's, begins alike");
        once
    };
    (bytes(30_000) - bytes(10_000)) / 20_000
}

#[test]
fn a_movement_begins_with_what_the_one_before_left() {
    for sizes in [Sizes::One, Sizes::Two, Sizes::Own] {
        assert_eq!(bytes_to_begin(pseudo_observation, sizes), 0);
        // six numbers that depend on where it begins
        assert_eq!(bytes_to_begin(pointing, sizes), 48);
    }
}

/// Bytes that one more target takes, of a predictor in mid-movement.
fn bytes_of_one_more(make: fn(u32, Sizes) -> Predictor, sizes: Sizes) -> i64 {
    let bytes = |count: u32| {
        let running = || {
            let mut predictor = make(count, sizes);
            movement(&mut predictor, 0, 5);
            std::mem::forget(predictor);
        };
        measure(running).bytes_current
    };
    (bytes(3000) - bytes(1000)) / 2000
}

#[test]
fn one_more_destination_takes_few_bytes() {
    // a plain struct and its id, and the numbers of the arrays that the hot loops run over
    for (sizes, most) in [(Sizes::One, [120, 196]), (Sizes::Two, [132, 208]), (Sizes::Own, [192, 348])] {
        let found = [bytes_of_one_more(pseudo_observation, sizes), bytes_of_one_more(pointing, sizes)];
        assert!(found[0] <= most[0] && found[1] <= most[1], "{found:?}");
    }
}
