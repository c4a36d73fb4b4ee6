//! Every bad input: its code, its path, its message; and that nothing has changed after it.

use crate::support::{change, predictor, value};
use serde_json::{Value as Json, json};
use whither::{Code, Error, Predictor, Result, Scenario, Value};

/// A scenario that is right.
fn scenario() -> Json {
    json!({
        "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 3 },
        "observation": { "noise": 1.5 },
        "initial": { "velocity": 5 },
        "arrival": { "type": "uniform", "from": 1, "to": 4 },
        "quadrature": { "rule": "simpson", "points": 5 },
        "method": "pseudoObservation",
        "none": 0.1,
        "destinations": [
            { "id": "a", "mean": [10, 0], "covariance": [[1, 0.1], [0.1, 1]], "prior": 2 },
            { "id": "b", "center": [-10, 5], "size": [2, 3], "endVelocity": 4 }
        ]
    })
}

fn shown(error: &Error) -> String {
    format!("{} | {} | {}", error.code().as_str(), error.path(), error.message())
}

/// `tests/errors.json`: what is changed in the scenario, and the error that this makes.
#[test]
fn every_scenario_that_is_wrong_is_refused_by_name() {
    let rows: Vec<Json> = serde_json::from_str(include_str!("../errors.json")).unwrap();
    assert!(rows.len() > 180);
    assert!(Scenario::from_value(&value(&scenario())).is_ok());
    let mut wrong = Vec::new();
    for row in rows {
        let expected = ["code", "path", "message"].map(|key| row[key].as_str().unwrap()).join(" | ");
        match Scenario::from_value(&value(&change(&scenario(), &row["change"]))) {
            Err(error) if shown(&error) == expected => {}
            Err(error) => wrong.push(format!("{}\n  expected {expected}\n  found    {}", row["change"], shown(&error))),
            Ok(_) => wrong.push(format!("{}\n  expected {expected}\n  found    nothing wrong", row["change"])),
        }
    }
    assert!(wrong.is_empty(), "{} rows:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn a_key_that_is_there_twice_is_refused() {
    let twice = r#"{ "motion": { "type": "brownian", "noise": 1, "dimensions": 1, "noise": 2 } }"#;
    let error = serde_json::from_str::<Scenario>(twice).unwrap_err().to_string();
    assert_eq!(error, "motion.noise: the key \"noise\" is there twice");
}

/// Limits that no input can pass, whatever it costs to state them.
#[test]
fn what_would_exhaust_the_memory_is_too_large() {
    let one = value(&json!({ "id": "?", "center": [1, 2], "size": 3 }));
    let with = |count: usize, changes: &Json| {
        let Value::Map(mut entries) = value(&change(&scenario(), changes)) else { unreachable!() };
        let each = |i: usize| {
            let Value::Map(mut destination) = one.clone() else { unreachable!() };
            destination.retain(|(key, _)| key != "id");
            destination.push(("id".to_owned(), Value::text(&i.to_string())));
            Value::Map(destination)
        };
        entries.retain(|(key, _)| key != "destinations");
        entries.push(("destinations".to_owned(), Value::List((0..count).map(each).collect())));
        Scenario::from_value(&Value::Map(entries)).map_err(|error| shown(&error))
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

type Act = fn(&mut Predictor) -> Result<()>;

/// Calls on a predictor in mid-movement at time 1 and the errors that they make.
const CALLS: [(&str, Act, Code, &str, &str); 34] = [
    (
        "a time that is no number",
        |p| p.observe(f64::NAN, &[0.0; 2]),
        Code::NotFinite,
        "time",
        "must be a finite number, got NaN",
    ),
    (
        "an infinite time",
        |p| p.observe(f64::NEG_INFINITY, &[0.0; 2]),
        Code::NotFinite,
        "time",
        "must be a finite number, got -Infinity",
    ),
    (
        "a time before the last",
        |p| p.observe(0.99, &[0.0; 2]),
        Code::TimeNotIncreasing,
        "time",
        "must be at least the last observation's, 1, got 0.99",
    ),
    (
        "a time beyond the limit",
        |p| p.observe(2e12, &[0.0; 2]),
        Code::OutOfRange,
        "time",
        "must be at most 1e12 seconds after the first observation's, 0.5, got 2000000000000",
    ),
    ("too few axes", |p| p.observe(1.1, &[0.0]), Code::WrongLength, "position", "must have 2 numbers, has 1"),
    ("too many axes", |p| p.observe(1.1, &[0.0; 3]), Code::WrongLength, "position", "must have 2 numbers, has 3"),
    ("no axes", |p| p.observe(1.1, &[]), Code::WrongLength, "position", "must have 2 numbers, has 0"),
    (
        "a position that is no number",
        |p| p.observe(1.1, &[0.0, f64::NAN]),
        Code::NotFinite,
        "position[1]",
        "must be a finite number, got NaN",
    ),
    (
        "an infinite position",
        |p| p.observe(1.1, &[f64::INFINITY, 0.0]),
        Code::NotFinite,
        "position[0]",
        "must be a finite number, got Infinity",
    ),
    (
        "a position beyond the limit",
        |p| p.observe(1.1, &[1e51, 0.0]),
        Code::OutOfRange,
        "position[0]",
        "must be from -1e50 to 1e50, got 1e51",
    ),
    (
        "a noise that is no number",
        |p| p.observe_with(1.1, &[Some(0.0); 2], Some(&Value::Number(f64::NAN))),
        Code::NotFinite,
        "noise",
        "must be a finite number, got NaN",
    ),
    (
        "no noise",
        |p| p.observe_with(1.1, &[Some(0.0); 2], Some(&Value::Number(0.0))),
        Code::OutOfRange,
        "noise",
        "must be greater than 0, got 0",
    ),
    (
        "noise for another number of axes",
        |p| p.observe_with(1.1, &[Some(0.0); 2], Some(&value(&json!([1, 2, 3])))),
        Code::WrongLength,
        "noise",
        "must have 2 numbers, has 3, got [1, 2, 3]",
    ),
    (
        "an indefinite noise",
        |p| p.observe_with(1.1, &[Some(0.0); 2], Some(&value(&json!([[1, 2], [2, 1]])))),
        Code::NotPositiveDefinite,
        "noise",
        "must be symmetric and positive definite, got [[1, 2], [2, 1]]",
    ),
    (
        "a missing axis with NaN beside it",
        |p| p.observe_with(1.1, &[None, Some(f64::NAN)], None),
        Code::NotFinite,
        "position[1]",
        "must be a finite number, got NaN",
    ),
    (
        "an unknown id asked for",
        |p| p.index_of("c").map(drop),
        Code::UnknownId,
        "id",
        "no destination \"c\", there are \"a\", \"b\"",
    ),
    (
        "the arrival at an unknown id",
        |p| p.arrival(Some("c")).map(drop),
        Code::UnknownId,
        "id",
        "no destination \"c\", there are \"a\", \"b\"",
    ),
    (
        "the path to an unknown id",
        |p| p.path("c", &[2.0]).map(drop),
        Code::UnknownId,
        "id",
        "no destination \"c\", there are \"a\", \"b\"",
    ),
    (
        "a path into the past",
        |p| p.path("a", &[2.0, 0.5]).map(drop),
        Code::OutOfRange,
        "times[1]",
        "must be at least the last observation's time, 1, got 0.5",
    ),
    (
        "a path to no time",
        |p| p.path("a", &[2.0, f64::NAN]).map(drop),
        Code::NotFinite,
        "times[1]",
        "must be a finite number, got NaN",
    ),
    (
        "a forecast of the past",
        |p| p.forecast(0.9).map(drop),
        Code::OutOfRange,
        "time",
        "must be at least the last observation's time, 1, got 0.9",
    ),
    (
        "a forecast for no time",
        |p| p.forecast(f64::INFINITY).map(drop),
        Code::NotFinite,
        "time",
        "must be a finite number, got Infinity",
    ),
    (
        "a forecast beyond the limit",
        |p| p.forecast(1e13).map(drop),
        Code::OutOfRange,
        "time",
        "must be at most 1e12 seconds after the last observation, got 10000000000000",
    ),
    (
        "an unknown id taken out",
        |p| p.remove_destination("c"),
        Code::UnknownId,
        "id",
        "no destination \"c\", there are \"a\", \"b\"",
    ),
    (
        "an unknown id moved",
        |p| p.update_destination("c", &value(&json!({ "center": [0, 0], "size": 1 }))),
        Code::UnknownId,
        "id",
        "no destination \"c\", there are \"a\", \"b\"",
    ),
    (
        "another id given",
        |p| p.update_destination("a", &value(&json!({ "id": "c", "center": [0, 0], "size": 1 }))),
        Code::OutOfRange,
        "destination.id",
        "must stay \"a\", got \"c\"",
    ),
    (
        "a destination without a place",
        |p| p.update_destination("a", &value(&json!({ "size": 1 }))),
        Code::UnknownKey,
        "destination.size",
        "belongs to center; beside mean there is covariance, got 1",
    ),
    (
        "a destination that is none",
        |p| p.add_destination(&Value::Number(3.0)),
        Code::WrongType,
        "destination",
        "must be an object, got 3",
    ),
    (
        "an id that is taken",
        |p| p.add_destination(&value(&json!({ "id": "b", "center": [0, 0], "size": 1 }))),
        Code::DuplicateId,
        "id",
        "the id \"b\" is taken by destinations[1]",
    ),
    (
        "an unknown key in a destination",
        |p| p.add_destination(&value(&json!({ "id": "c", "center": [0, 0], "size": 1, "colour": 1 }))),
        Code::UnknownKey,
        "destination.colour",
        "unknown key \"colour\", expected one of \"id\", \"mean\", \"covariance\", \"center\", \"size\", \"endVelocity\", \"prior\", \"arrival\"",
    ),
    (
        "an empty list of destinations",
        |p| p.set_destinations(&Value::List(Vec::new())),
        Code::NoDestinations,
        "destinations",
        "must have at least one destination, has none",
    ),
    (
        "no list of destinations",
        |p| p.set_destinations(&Value::Null),
        Code::WrongType,
        "destinations",
        "must be a list, got nothing",
    ),
    (
        "one id twice",
        |p| {
            p.set_destinations(&value(
                &json!([{ "id": "c", "center": [0, 0], "size": 1 }, { "id": "c", "center": [0, 0], "size": 1 }]),
            ))
        },
        Code::DuplicateId,
        "destinations[1].id",
        "the id \"c\" is taken by destinations[0]",
    ),
    (
        "no prior left",
        |p| p.set_destinations(&value(&json!([{ "id": "c", "center": [0, 0], "size": 1, "prior": 0 }]))),
        Code::OutOfRange,
        "destinations",
        "the priors must have a finite sum above 0, it is 0",
    ),
];

/// For each method that takes the call, the same sequence with and without it.
#[test]
fn after_every_error_the_predictor_is_as_before() {
    let methods =
        ["pseudoObservation", "algorithm1", "algorithm2", "bridging", "singleFilter", "singleFilterApproximate"];
    let mut wrong = Vec::new();
    for method in methods {
        let start = || {
            let mut predictor = predictor(&change(&scenario(), &json!({ "/method": method, "/none": 0 })));
            predictor.observe(0.5, &[0.0, 1.0]).unwrap();
            predictor.observe(1.0, &[2.0, 1.0]).unwrap();
            predictor
        };
        let mut without = start();
        let before = without.snapshot();
        without.observe(1.25, &[3.0, 0.5]).unwrap();
        for (name, act, code, path, message) in CALLS {
            let mut with = start();
            let error = act(&mut with).expect_err(name);
            let found = (error.code(), error.path(), error.message());
            if found != (code, path, message) {
                wrong.push(format!("{method} {name}: Code::{:?}, {:?}, {:?}", found.0, found.1, found.2));
            }
            assert_eq!(with.snapshot(), before, "{method} {name}");
            with.observe(1.25, &[3.0, 0.5]).unwrap();
            assert_eq!(with.snapshot(), without.snapshot(), "{method} {name}");
            assert_eq!(with.probabilities(), without.probabilities(), "{method} {name}");
        }
    }
    assert!(wrong.is_empty(), "{} calls:\n{}", wrong.len(), wrong.join("\n"));
}
