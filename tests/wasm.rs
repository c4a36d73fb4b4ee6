//! The library as WebAssembly, in Node: the same numbers as the reference, from SIMD code.
#![cfg(target_arch = "wasm32")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[allow(dead_code)] // It also reads files, which WebAssembly cannot.
#[path = "native/support.rs"]
mod support;

use serde_json::Value as Json;
use support::{numbers, predictor, relative, scenario_of};
use wasm_bindgen_test::wasm_bindgen_test;

const CASES: [(&str, &str); 4] = [
    ("brownian2d", include_str!("golden/brownian2d.json")),
    ("cv2d-horizon", include_str!("golden/cv2d-horizon.json")),
    ("cv2d-position", include_str!("golden/cv2d-position.json")),
    ("cv2d-position-velocity", include_str!("golden/cv2d-position-velocity.json")),
];

#[wasm_bindgen_test]
fn is_built_for_simd() {
    assert!(cfg!(target_feature = "simd128"), "RUSTFLAGS replaced the target's own flags");
}

#[wasm_bindgen_test]
fn every_method_reproduces_the_golden_cases() {
    for (name, text) in CASES {
        let case: Json = serde_json::from_str(text).unwrap();
        for (method, steps) in case["expected"]["probabilities"].as_object().unwrap() {
            let mut predictor = predictor(&scenario_of(&case, method));
            for (observation, step) in case["observations"].as_array().unwrap().iter().zip(steps.as_array().unwrap()) {
                let observation = numbers(observation);
                predictor.observe(observation[0], &observation[1..]).unwrap();
                let difference = relative(predictor.probabilities(), &numbers(step));
                assert!(difference < 1e-9, "{name} {method}: probabilities differ by {difference:e}");
            }
        }
    }
}
