//! Everything that is refused, by its code, path and message, and that nothing has changed after it: `tests/errors.json`.
//!
//! The table's bases are what is right: `from` is what something is built from, `before` the calls that are made on it, `after`
//! one more. A row changes its base, or makes a call, and has the error that this makes. Rows marked `boundary` are about
//! values that Rust's types rule out; they and all others are run in WebAssembly and through JavaScript.

use crate::support::{change, predictor, read, value};
use serde_json::{Value as Json, json};
use whither::internals::Value;
use whither::{ConditionallyMarkovSequence, Error, Predictor, Result, Scenario};
use whither::{HandOptions, HandTarget, hand_scenario};
use whither::{PointerOptions, PointerTarget, pointer_scenario};
use whither::{RayOptions, RayTarget, ray_scenario};

const METHODS: [&str; 6] =
    ["pseudoObservation", "algorithm1", "algorithm2", "bridging", "singleFilter", "singleFilterApproximate"];

/// What is built from a base: something that takes calls, or nothing more than a scenario.
trait Subject {
    fn call(&mut self, name: &str, with: &Json) -> Result<()>;
    /// All that a call could have changed.
    fn everything(&mut self) -> Json;
}

impl Subject for Predictor {
    fn call(&mut self, name: &str, with: &Json) -> Result<()> {
        let id = with["id"].as_str();
        match name {
            "observe" => {
                let (time, position) = (number(&with["time"]).unwrap(), list(&with["position"]));
                let noise = with.get("noise").map(|noise| whither::internals::noise(&value(noise), self.axes()));
                let noise = noise.transpose()?;
                match position.iter().copied().collect::<Option<Vec<f64>>>() {
                    Some(position) if noise.is_none() => self.observe(time, &position),
                    _ => self.observe_with(time, &position, noise.as_ref()),
                }
            }
            "arrival" => self.arrival(id).map(drop),
            "forecast" => self.forecast(number(&with["time"]).unwrap()).map(drop),
            "path" => self.path(id.unwrap(), &full(&with["times"])).map(drop),
            "addDestination" => whither::internals::add_destination(self, &value(&with["destination"])),
            "updateDestination" => {
                whither::internals::update_destination(self, id.unwrap(), &value(&with["destination"]))
            }
            "removeDestination" => self.remove_destination(id.unwrap()),
            "setDestinations" => whither::internals::set_destinations(self, &value(&with["destinations"])),
            "chosen" => self.chosen(id.unwrap()),
            other => panic!("no call {other}"),
        }
    }

    fn everything(&mut self) -> Json {
        json!([self.snapshot(), self.probabilities()])
    }
}

impl Subject for ConditionallyMarkovSequence {
    fn call(&mut self, name: &str, with: &Json) -> Result<()> {
        let step = || with["step"].as_u64().unwrap() as usize;
        match name {
            "measure" => self.measure(step(), &full(&with["position"])),
            "state" => self.state(step()).map(drop),
            "model" => self.model(step()).map(drop),
            "sample" => self.sample(with["seed"].as_u64().unwrap(), with["count"].as_u64().unwrap() as usize).map(drop),
            "isMarkov" => self.is_markov(with["tolerance"].as_f64().unwrap()).map(drop),
            "isReciprocal" => self.is_reciprocal(with["tolerance"].as_f64().unwrap()).map(drop),
            other => panic!("no call {other}"),
        }
    }

    fn everything(&mut self) -> Json {
        let states = (0..=self.steps()).map(|step| self.state(step).unwrap());
        states.map(|state| json!([state.mean.as_slice(), state.covariance.as_slice()])).collect()
    }
}

/// A number, also one that JSON has no number for; none for null.
fn number(json: &Json) -> Option<f64> {
    match value(json) {
        Value::Number(x) => Some(x),
        Value::Null => None,
        other => panic!("no number but {other:?}"),
    }
}

fn list(json: &Json) -> Vec<Option<f64>> {
    json.as_array().unwrap().iter().map(number).collect()
}

fn full(json: &Json) -> Vec<f64> {
    list(json).into_iter().map(Option::unwrap).collect()
}

fn build(base: &str, from: &Json) -> Result<Box<dyn Subject>> {
    let given = value(from);
    Ok(match base {
        "scenario" | "pointing" => Box::new(Predictor::new(&whither::internals::scenario(&given)?)),
        "snapshot" => Box::new(Predictor::restore(&whither::internals::snapshot(given))?),
        "sequence" => Box::new(whither::internals::sequence(&given)?),
        "parameters" => Box::new(whither::internals::given_sequence(&given)?),
        "pointer" => {
            let target = |target: &Json| PointerTarget {
                id: target["id"].as_str().unwrap().to_owned(),
                x: target["x"].as_f64().unwrap(),
                y: target["y"].as_f64().unwrap(),
                width: target["width"].as_f64().unwrap(),
                height: target["height"].as_f64().unwrap(),
            };
            let targets: Vec<PointerTarget> = from["targets"].as_array().unwrap().iter().map(target).collect();
            let options =
                PointerOptions { none: from["options"]["none"].as_f64().unwrap(), ..PointerOptions::default() };
            Box::new(Predictor::new(&pointer_scenario(&targets, options)?))
        }
        "ray" => {
            let target = |target: &Json| RayTarget {
                id: target["id"].as_str().unwrap().to_owned(),
                azimuth: target["azimuth"].as_f64().unwrap(),
                elevation: target["elevation"].as_f64().unwrap(),
                width: target["width"].as_f64().unwrap(),
                height: target["height"].as_f64().unwrap(),
            };
            let targets: Vec<RayTarget> = from["targets"].as_array().unwrap().iter().map(target).collect();
            let none = from["options"]["none"].as_f64().unwrap();
            Box::new(Predictor::new(&ray_scenario(&targets, RayOptions { none, ..RayOptions::default() })?))
        }
        "hand" => {
            let target = |target: &Json| HandTarget {
                id: target["id"].as_str().unwrap().to_owned(),
                x: target["x"].as_f64().unwrap(),
                y: target["y"].as_f64().unwrap(),
                z: target["z"].as_f64().unwrap(),
                width: target["width"].as_f64().unwrap(),
                height: target["height"].as_f64().unwrap(),
                depth: target["depth"].as_f64().unwrap(),
            };
            let targets: Vec<HandTarget> = from["targets"].as_array().unwrap().iter().map(target).collect();
            let none = from["options"]["none"].as_f64().unwrap();
            Box::new(Predictor::new(&hand_scenario(&targets, HandOptions { none, ..HandOptions::default() })?))
        }
        other => panic!("no base {other}"),
    })
}

/// The subject of a base after the calls that it begins with.
fn begun(bases: &Json, base: &str, from: &Json) -> Box<dyn Subject> {
    let mut subject = build(base, from).unwrap_or_else(|error| panic!("{base}: {error}"));
    for call in bases[base]["before"].as_array().into_iter().flatten() {
        subject.call(call["call"].as_str().unwrap(), &call["with"]).unwrap();
    }
    subject
}

fn shown(error: &Error) -> String {
    format!("{} | {} | {}", error.code().as_str(), error.path(), error.message())
}

#[test]
fn everything_wrong_is_refused_by_name_and_changes_nothing() {
    let mut table = read("errors.json");
    let (mut bases, rows) = (table["bases"].take(), table["rows"].take());
    bases["snapshot"]["from"] = begun(&bases, "scenario", &bases["scenario"]["from"]).everything()[0].take();
    for base in bases.as_object().unwrap().keys() {
        begun(&bases, base, &bases[base]["from"]);
    }
    let mut wrong = Vec::new();
    let mut run = 0;
    for row in rows.as_array().unwrap() {
        if row["boundary"] == true {
            continue;
        }
        let base = row["base"].as_str().unwrap();
        let expected = ["code", "path", "message"].map(|key| row[key].as_str().unwrap()).join(" | ");
        let mut check = |found: Result<()>, what: &str| {
            let found = found.map_or_else(|error| shown(&error), |()| "nothing wrong".to_owned());
            if found != expected {
                wrong.push(format!("{row} {what}\n  found {found}"));
            }
            run += 1;
        };
        let from = change(&bases[base]["from"], row.get("change").unwrap_or(&json!({})));
        let Some(name) = row["call"].as_str() else {
            check(build(base, &from).map(drop), "");
            continue;
        };
        // what no row changes is the same with every method
        let methods: &[&str] = if base == "scenario" && row["change"].is_null() { &METHODS } else { &[""] };
        for method in methods {
            let from = match *method {
                "" => from.clone(),
                method => change(&from, &json!({ "/method": method, "/none": 0 })),
            };
            let (mut with, mut without) = (begun(&bases, base, &from), begun(&bases, base, &from));
            check(with.call(name, &row["with"]), method);
            assert_eq!(with.everything(), without.everything(), "{row} {method}");
            let after = &bases[base]["after"];
            for subject in [&mut with, &mut without] {
                subject.call(after["call"].as_str().unwrap(), &after["with"]).unwrap();
            }
            assert_eq!(with.everything(), without.everything(), "{row} {method}");
        }
    }
    assert!(wrong.is_empty(), "{} rows:\n{}", wrong.len(), wrong.join("\n"));
    assert!(run > 450, "only {run} errors");
}

#[test]
fn a_duplicate_key_is_refused() {
    let twice = r#"{ "motion": { "type": "brownian", "noise": 1, "dimensions": 1, "noise": 2 } }"#;
    let error = serde_json::from_str::<Scenario>(twice).unwrap_err().to_string();
    assert_eq!(error, "motion.noise: duplicate key \"noise\"");
}

#[test]
fn an_unknown_id_has_no_index() {
    let error = predictor(&read("errors.json")["bases"]["scenario"]["from"]).index_of("c").unwrap_err();
    assert_eq!(shown(&error), "unknown-id | id | no destination \"c\", there are \"a\", \"b\"");
}

/// Limits that no input can pass, whatever it costs to state them.
#[test]
fn what_would_exhaust_the_memory_is_too_large() {
    let base = &read("errors.json")["bases"]["scenario"]["from"];
    let one = value(&json!({ "id": "?", "center": [1, 2], "size": 3 }));
    let with = |count: usize, changes: &Json| {
        let Value::Map(mut entries) = value(&change(base, changes)) else { unreachable!() };
        let each = |i: usize| {
            let Value::Map(mut destination) = one.clone() else { unreachable!() };
            destination.retain(|(key, _)| **key != *"id");
            destination.push(("id".into(), Value::text(&i.to_string())));
            Value::Map(destination)
        };
        entries.retain(|(key, _)| **key != *"destinations");
        entries.push(("destinations".into(), Value::List((0..count).map(each).collect())));
        whither::internals::scenario(&Value::Map(entries)).map_err(|error| shown(&error))
    };
    let refused = |count, changes: Json| with(count, &changes).unwrap_err();
    assert_eq!(
        refused(1_000_001, json!({})),
        "too-large | destinations | must have at most 1000000 destinations, has 1000001"
    );
    assert_eq!(
        refused(140_000, json!({ "/quadrature/points": 1001 })),
        "too-large | destinations | 140000 destinations with 140140000 arrival times together, under 1 noise candidates, \
         need 140140000 numbers with \"pseudoObservation\", the most is 134217728"
    );
    assert_eq!(
        refused(20_000, json!({ "/quadrature/points": 1001, "/method": "bridging" })),
        "too-large | destinations | 20000 destinations with 20020000 arrival times together, under 1 noise candidates, \
         need 180180000 numbers with \"bridging\", the most is 134217728"
    );
    assert!(with(1_000_000, &json!({})).is_ok());
}
