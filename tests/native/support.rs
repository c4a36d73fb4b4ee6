//! Reading golden cases and building scenarios from JSON; for the tests in WebAssembly too.

use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use whither::internals::Value;
use whither::{ConditionallyMarkovSequence, Predictor};

/// What a file in `tests/` holds.
pub fn read(path: &str) -> Json {
    let path = format!("{}/tests/{path}", env!("CARGO_MANIFEST_DIR"));
    #[cfg(not(target_arch = "wasm32"))]
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    #[cfg(target_arch = "wasm32")]
    let text = crate::node::read_file(&path, "utf8");
    serde_json::from_str(&text).unwrap()
}

/// The golden case of this name.
pub fn golden(name: &str) -> Json {
    read(&format!("golden/{name}.json"))
}

/// The golden cases of one kind in `tests/golden/index.json`, each with the tolerances of its kind.
pub fn cases(kind: &str) -> Vec<(String, BTreeMap<String, f64>)> {
    let kind = &golden("index")[kind];
    let tolerances: BTreeMap<String, f64> = serde_json::from_value(kind["tolerances"].clone()).unwrap();
    let cases: Vec<String> = serde_json::from_value(kind["cases"].clone()).unwrap();
    cases.into_iter().map(|name| (name, tolerances.clone())).collect()
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

/// A value of ours from JSON, with the numbers that JSON does not have.
pub fn value(json: &Json) -> Value {
    fn named(value: &mut Value) {
        match value {
            Value::Text(text) => match text.as_str() {
                "NaN" => *value = Value::Number(f64::NAN),
                "Infinity" => *value = Value::Number(f64::INFINITY),
                "-Infinity" => *value = Value::Number(f64::NEG_INFINITY),
                _ => {}
            },
            Value::List(items) => items.iter_mut().for_each(named),
            Value::Map(entries) => entries.iter_mut().for_each(|(_, item)| named(item)),
            _ => {}
        }
    }
    let mut value = serde_json::from_value(json.clone()).unwrap();
    named(&mut value);
    value
}

/// A predictor from JSON.
pub fn predictor(scenario: &Json) -> Predictor {
    Predictor::new(&whither::internals::scenario(&value(scenario)).unwrap())
}

/// A sequence from JSON.
pub fn sequence(configuration: &Json) -> ConditionallyMarkovSequence {
    whither::internals::sequence(&value(configuration)).unwrap()
}

/// The lists of numbers in a list.
pub fn rows(json: &Json) -> Vec<Vec<f64>> {
    json.as_array().unwrap().iter().map(numbers).collect()
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

/// Asserts that two lists differ by no more than `tolerance`, relative to `1 + |expected|`.
pub fn close(what: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    let difference = relative(found, expected);
    assert!(difference < tolerance, "{what}: off by {difference:e}");
}

/// A scenario with changes: JSON pointers and what is put there (null takes a key away). In what is put, `"NaN"`,
/// `"Infinity"` and `"-Infinity"` become numbers in [`value`], and `["*1002", x]` is a list of so many `x`.
pub fn change(scenario: &Json, changes: &Json) -> Json {
    let mut changed = scenario.clone();
    for (pointer, put) in changes.as_object().unwrap() {
        let Some((parent, key)) = pointer.rsplit_once('/') else { return put.clone() };
        match changed.pointer_mut(parent).unwrap() {
            Json::Array(items) => items[key.parse::<usize>().unwrap()] = repeated(put),
            Json::Object(entries) => {
                entries.insert(key.to_owned(), repeated(put));
            }
            other => panic!("nothing has a key in {other}"),
        }
    }
    changed
}

fn repeated(json: &Json) -> Json {
    match json {
        Json::Array(items) => match items.as_slice() {
            [Json::String(count), item] if count.starts_with('*') => {
                Json::Array(vec![item.clone(); count[1..].parse().unwrap()])
            }
            _ => Json::Array(items.iter().map(repeated).collect()),
        },
        Json::Object(entries) => entries.iter().map(|(key, item)| (key.clone(), repeated(item))).collect(),
        other => other.clone(),
    }
}
