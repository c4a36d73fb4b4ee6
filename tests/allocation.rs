//! What observing costs the memory: nothing after the first observations.
//!
//! A program of its own, because it replaces the allocator. Only this thread's allocations are counted.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used)]

use allocation_counter::{AllocationInfo, measure};
use serde_json::{Value as Json, json};
use whither::pointer::{PointerOptions, PointerTarget, pointer_scenario};
use whither::{Predictor, Scenario};

/// Targets spread over a screen, each of its own size where wanted.
fn targets(count: u32, own_sizes: bool) -> Vec<Json> {
    let target = |i: u32| {
        let size = if own_sizes { 40.0 + f64::from(i) * 0.25 } else { 80.0 };
        json!({ "id": format!("icon {i}"), "center": [100 + 150 * (i % 7), 100 + 150 * (i / 7)], "size": [size, 60.0] })
    };
    (0..count).map(target).collect()
}

fn pseudo_observation(count: u32, own_sizes: bool) -> Predictor {
    let motion = json!({ "type": "constantVelocity", "dimensions": 2, "noise": 3000 });
    read(&json!({
        "method": "pseudoObservation", "motion": motion, "observation": { "noise": 1.5 },
        "initial": { "velocity": 1000 }, "arrival": { "type": "horizon", "from": 0.05, "to": 0.5 },
        "none": 0.05, "destinations": targets(count, own_sizes),
    }))
}

fn pointing(count: u32, own_sizes: bool) -> Predictor {
    let targets = (0..count).map(|i| PointerTarget {
        id: format!("icon {i}"),
        x: f64::from(100 + 150 * (i % 7)),
        y: f64::from(100 + 150 * (i / 7)),
        width: if own_sizes { 40.0 + f64::from(i) * 0.25 } else { 80.0 },
        height: 60.0,
    });
    let options = PointerOptions { none: 0.05 };
    Predictor::new(&pointer_scenario(&targets.collect::<Vec<_>>(), options).unwrap()).unwrap()
}

fn read(scenario: &Json) -> Predictor {
    let scenario: Scenario = serde_json::from_value(scenario.clone()).unwrap();
    Predictor::new(&scenario).unwrap()
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
    assert_eq!(after_a_first_movement(pseudo_observation(21, false)).count_total, 0);
    assert_eq!(after_a_first_movement(pseudo_observation(200, true)).count_total, 0);
}

#[test]
fn pointing_allocates_nothing_after_the_first_observations() {
    assert_eq!(after_a_first_movement(pointing(21, false)).count_total, 0);
    assert_eq!(after_a_first_movement(pointing(200, true)).count_total, 0);
}
