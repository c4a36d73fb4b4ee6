//! Reading golden cases and building scenarios from JSON.

use serde_json::{Value as Json, json};
use std::path::Path;
use whither::{Predictor, Scenario, Value};

/// The golden case of this name.
pub fn golden(name: &str) -> Json {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(format!("{name}.json"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).unwrap()
}

/// The scenario of a golden case, with another method.
pub fn scenario_of(case: &Json, method: &str) -> Json {
    let mut scenario = json!({ "method": method });
    for key in ["motion", "observation", "initial", "arrival", "quadrature", "destinations"] {
        if let Some(value) = case.get(key) {
            scenario[key] = value.clone();
        }
    }
    scenario
}

/// A value of ours from JSON.
pub fn value(json: &Json) -> Value {
    serde_json::from_value(json.clone()).unwrap()
}

/// A predictor from JSON.
pub fn predictor(scenario: &Json) -> Predictor {
    Predictor::new(&Scenario::from_value(&value(scenario)).unwrap()).unwrap()
}

/// A list of numbers; null is minus infinity, as the golden cases write it.
pub fn numbers(json: &Json) -> Vec<f64> {
    json.as_array().unwrap().iter().map(|x| x.as_f64().unwrap_or(f64::NEG_INFINITY)).collect()
}

/// The largest difference between two lists, relative to `1 + |expected|`.
pub fn relative(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let difference = |(f, e): (&f64, &f64)| if f == e { 0.0 } else { (f - e).abs() / (1.0 + e.abs()) };
    found.iter().zip(expected).map(difference).fold(0.0, |a, b| if b.is_nan() { f64::INFINITY } else { a.max(b) })
}
