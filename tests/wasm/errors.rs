//! Every row of `tests/errors.json` through the boundary: what a row is, `tests/native/errors.rs` has.

use crate::node::{Result, globals, json, parts, plain};
use crate::support::{change, read};
use serde_json::{Value as Json, json};
use wasm_bindgen_test::wasm_bindgen_test;
use whither::wasm::{Engine, SequenceEngine, device_scenario};

enum Subject {
    Predictor(Engine),
    Sequence(SequenceEngine),
}

impl Subject {
    fn build(base: &str, from: &Json) -> Result<Self> {
        let given = &plain(from);
        Ok(match base {
            "scenario" | "pointing" => Self::Predictor(Engine::new(given)?),
            "snapshot" => Self::Predictor(Engine::restore(given)?),
            "pointer" => Self::Predictor(Engine::new(&device_scenario(0, given)?)?),
            "ray" => Self::Predictor(Engine::new(&device_scenario(1, given)?)?),
            "hand" => Self::Predictor(Engine::new(&device_scenario(2, given)?)?),
            "sequence" => Self::Sequence(SequenceEngine::new(given)?),
            "parameters" => Self::Sequence(SequenceEngine::from_parameters(given)?),
            other => panic!("no base {other}"),
        })
    }

    /// After the calls that a base begins with.
    fn begun(bases: &Json, base: &str, from: &Json) -> Self {
        let mut subject = Self::build(base, from).unwrap_or_else(|error| panic!("{base}: {}", parts(error)));
        for call in bases[base]["before"].as_array().into_iter().flatten() {
            subject.call(call["call"].as_str().unwrap(), &call["with"]).map_err(parts).unwrap();
        }
        subject
    }

    fn call(&mut self, name: &str, with: &Json) -> Result<()> {
        let given = &plain(with);
        match (self, name) {
            (Self::Predictor(engine), "observe") => engine.observe_in_full(given),
            (Self::Predictor(engine), "arrival") => engine.arrival(given).map(drop),
            (Self::Predictor(engine), "forecast") => engine.forecast(given).map(drop),
            (Self::Predictor(engine), "path") => engine.path(given).map(drop),
            (Self::Predictor(engine), "addDestination") => engine.add_destination(given),
            (Self::Predictor(engine), "updateDestination") => engine.update_destination(given),
            (Self::Predictor(engine), "removeDestination") => engine.remove_destination(given),
            (Self::Predictor(engine), "setDestinations") => engine.set_destinations(given),
            (Self::Predictor(engine), "chosen") => engine.chosen(given),
            (Self::Sequence(engine), "measure") => engine.measure(given),
            (Self::Sequence(engine), "state") => engine.state(given).map(drop),
            (Self::Sequence(engine), "model") => engine.model(given).map(drop),
            (Self::Sequence(engine), "sample") => engine.sample(given).map(drop),
            (Self::Sequence(engine), "isMarkov") => engine.is_markov(given).map(drop),
            (Self::Sequence(engine), "isReciprocal") => engine.is_reciprocal(given).map(drop),
            (_, other) => panic!("no call {other}"),
        }
    }

    /// All that a call could have changed.
    fn everything(&self) -> Json {
        match self {
            Self::Predictor(engine) => json(&engine.snapshot()),
            Self::Sequence(engine) => json!(engine.destination()),
        }
    }
}

#[wasm_bindgen_test]
fn everything_wrong_is_refused_by_name_and_changes_nothing() {
    globals();
    let mut table = read("errors.json");
    let (mut bases, rows) = (table["bases"].take(), table["rows"].take());
    bases["snapshot"]["from"] = Subject::begun(&bases, "scenario", &bases["scenario"]["from"]).everything();
    for base in bases.as_object().unwrap().keys() {
        Subject::begun(&bases, base, &bases[base]["from"]);
    }
    let mut wrong = Vec::new();
    for row in rows.as_array().unwrap() {
        let base = row["base"].as_str().unwrap();
        let from = change(&bases[base]["from"], row.get("change").unwrap_or(&json!({})));
        let found = match row["call"].as_str() {
            None => Subject::build(base, &from).map(drop),
            Some(name) => {
                let mut subject = Subject::begun(&bases, base, &from);
                let before = subject.everything();
                let found = subject.call(name, &row["with"]);
                assert_eq!(subject.everything(), before, "{row}");
                found
            }
        };
        let found = found.map_or_else(parts, |()| "nothing wrong".to_owned());
        if found != ["code", "path", "message"].map(|key| row[key].as_str().unwrap()).join(" | ") {
            wrong.push(format!("{row}\n  found {found}"));
        }
    }
    assert!(wrong.is_empty(), "{} rows:\n{}", wrong.len(), wrong.join("\n"));
}
