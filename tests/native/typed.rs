//! What is wrong with a scenario or a sequence that is built from types is reported as of the same one in JSON: the rows of
//! `tests/errors.json` whose values types can hold.

use crate::support::read;
use serde_json::{Value as Json, json};
use whither::{
    Arrival, Boundary, ConditionallyMarkovSequence, Destination, Error, GivenSequence, Initial, Learning, Matrix,
    Method, Motion, MotionNoise, Observation, Predictor, Quadrature, Result, Scenario, ScenarioBuilder,
    SequenceParameters,
};

/// The parts of the table's base `scenario`, each of which a row changes.
#[derive(Clone)]
struct Parts {
    motion: Motion,
    observation: Observation,
    initial: Initial,
    arrival: Arrival,
    quadrature: Quadrature,
    method: Method,
    none: f64,
    destinations: Vec<Destination>,
}

fn wide(id: &str) -> Destination {
    Destination::gaussian(id, [10.0, 0.0], [[1.0, 0.1], [0.1, 1.0]])
}

fn boxed(id: &str) -> Destination {
    Destination::new(id, [-10.0, 5.0]).size([2.0, 3.0]).end_velocity(4.0)
}

impl Default for Parts {
    fn default() -> Self {
        Self {
            motion: Motion::constant_velocity(2, 3.0),
            observation: Observation::deviation(1.5),
            initial: Initial::velocity(5.0),
            arrival: Arrival::uniform(1.0, 4.0),
            quadrature: Quadrature::simpson(5),
            method: Method::PseudoObservation,
            none: 0.1,
            destinations: vec![wide("a").prior(2.0), boxed("b")],
        }
    }
}

impl Parts {
    fn builder(self) -> ScenarioBuilder {
        Scenario::builder(self.motion, self.observation)
            .initial(self.initial)
            .arrival(self.arrival)
            .quadrature(self.quadrature)
            .method(self.method)
            .none(self.none)
            .destinations(self.destinations)
    }

    fn destination(self, i: usize, destination: Destination) -> Self {
        let mut destinations = self.destinations;
        destinations[i] = destination;
        Self { destinations, ..self }
    }
}

/// The error of the row with this base and change.
fn row(rows: &Json, base: &str, change: &Json) -> String {
    let found = rows.as_array().unwrap().iter().find(|row| row["base"] == base && row["change"] == *change);
    let row = found.unwrap_or_else(|| panic!("no row of {base} changes {change}"));
    ["code", "path", "message"].map(|key| row[key].as_str().unwrap()).join(" | ")
}

fn shown(error: &Error) -> String {
    format!("{} | {} | {}", error.code().as_str(), error.path(), error.message())
}

fn check<T>(base: &str, cases: Vec<(Json, Result<T>)>) {
    let rows = &read("errors.json")["rows"];
    for (change, built) in cases {
        let found = built.map_or_else(|error| shown(&error), |_| "nothing wrong".to_owned());
        assert_eq!(found, row(rows, base, &change), "{base} {change}");
    }
}

/// The base by types is the table's, so that each case differs from it by its change alone.
#[test]
fn the_base_is_that_of_the_table() {
    let from: Scenario = serde_json::from_value(read("errors.json")["bases"]["scenario"]["from"].take()).unwrap();
    let json = |scenario: &Scenario| serde_json::to_value(scenario).unwrap();
    assert_eq!(json(&Parts::default().builder().build().unwrap()), json(&from));
}

#[test]
fn motions_from_types_are_refused_as_from_json() {
    let with = |motion: Motion| Parts { motion, ..Parts::default() }.builder().build();
    let custom = |drift: Matrix, diffusion: Matrix| with(Motion::custom(1, drift, diffusion));
    let weighted = |weights: Vec<f64>| {
        let noises = vec![1.0.into(), 2.0.into()];
        with(Motion::constant_velocity(2, MotionNoise::Candidates { noises, weights: Some(weights) }))
    };
    let none = MotionNoise::candidates::<f64>([]);
    let rates = json!({ "type": "meanReverting", "dimensions": 2, "noise": 1, "rate": 0 });
    let spring =
        json!({ "type": "equilibriumRevertingVelocity", "dimensions": 2, "noise": 1, "stiffness": -1, "damping": 1 });
    let damped = json!({ "type": "integratedOrnsteinUhlenbeck", "dimensions": 2, "noise": 1, "damping": -1 });
    check(
        "scenario",
        vec![
            (json!({ "/motion/dimensions": 4 }), with(Motion::constant_velocity(4, 3.0))),
            (json!({ "/motion/noise": "NaN" }), with(Motion::constant_velocity(2, f64::NAN))),
            (json!({ "/motion/noise": -3 }), with(Motion::constant_velocity(2, -3.0))),
            (json!({ "/motion/noise": [3] }), with(Motion::constant_velocity(2, [3.0]))),
            (json!({ "/motion/noise": [3, 0] }), with(Motion::constant_velocity(2, [3.0, 0.0]))),
            (json!({ "/motion/noise": { "candidates": [] } }), with(Motion::constant_velocity(2, none))),
            (json!({ "/motion/noise": { "candidates": [1, 2], "weights": [1] } }), weighted(vec![1.0])),
            (json!({ "/motion/noise": { "candidates": [1, 2], "weights": [1, 0] } }), weighted(vec![1.0, 0.0])),
            (json!({ "/motion": rates }), with(Motion::mean_reverting(2, 1.0, 0.0))),
            (json!({ "/motion": spring }), with(Motion::equilibrium_reverting_velocity(2, 1.0, -1.0, 1.0))),
            (json!({ "/motion": damped }), with(Motion::integrated_ornstein_uhlenbeck(2, 1.0, -1.0))),
            (
                json!({ "/motion": { "type": "custom", "dimensions": 1, "drift": [[0]], "diffusion": [[-1]] } }),
                custom([[0.0]].into(), [[-1.0]].into()),
            ),
            (
                json!({ "/motion": { "type": "custom", "dimensions": 1, "drift": [[0, 1], [0]], "diffusion": [[1]] } }),
                custom(vec![vec![0.0, 1.0], vec![0.0]].into(), [[1.0]].into()),
            ),
        ],
    );
}

#[test]
fn observations_and_starts_from_types_are_refused_as_from_json() {
    let observed = |observation: Observation| Parts { observation, ..Parts::default() }.builder().build();
    let begun = |initial: Initial| Parts { initial, ..Parts::default() }.builder().build();
    let unit = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0; 4]];
    check(
        "scenario",
        vec![
            (json!({ "/observation/noise": 0 }), observed(Observation::deviation(0.0))),
            (json!({ "/observation/noise": [1, 2, 3] }), observed(Observation::deviation([1.0, 2.0, 3.0]))),
            (json!({ "/observation/noise": [[1]] }), observed(Observation::covariance([[1.0]]))),
            (
                json!({ "/observation/noise": [[1, 2], [2, 1]] }),
                observed(Observation::covariance([[1.0, 2.0], [2.0, 1.0]])),
            ),
            (json!({ "/observation/matrix": [[1, 0]] }), observed(Observation::deviation(1.5).matrix([[1.0, 0.0]]))),
            (json!({ "/initial/velocity": 0 }), begun(Initial::velocity(0.0))),
            (json!({ "/initial/velocity": ["NaN", 1] }), begun(Initial::velocity([f64::NAN, 1.0]))),
            (
                json!({ "/initial/acceleration": 1 }),
                begun(Initial::Flat { velocity: Some(5.0.into()), acceleration: Some(1.0.into()) }),
            ),
            (
                json!({ "/initial": { "mean": [0, 0], "covariance": [[1]] } }),
                begun(Initial::gaussian([0.0, 0.0], [[1.0]])),
            ),
            (
                json!({ "/initial": {
                    "mean": [0, 0, 0, 0],
                    "covariance": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 0]],
                } }),
                begun(Initial::gaussian([0.0; 4], unit)),
            ),
        ],
    );
}

#[test]
fn arrivals_and_quadratures_from_types_are_refused_as_from_json() {
    let with = |arrival: Arrival| Parts { arrival, ..Parts::default() }.builder().build();
    let summed = |quadrature: Quadrature| Parts { quadrature, ..Parts::default() }.builder().build();
    let discrete =
        |times: &[f64], weights: &[f64]| with(Arrival::Discrete { times: times.to_vec(), weights: weights.to_vec() });
    check(
        "scenario",
        vec![
            (json!({ "/arrival/from": 0 }), with(Arrival::uniform(0.0, 4.0))),
            (json!({ "/arrival/from": 4 }), with(Arrival::uniform(4.0, 4.0))),
            (json!({ "/arrival/to": "Infinity" }), with(Arrival::uniform(1.0, f64::INFINITY))),
            (json!({ "/arrival": { "type": "discrete", "times": [] } }), with(Arrival::discrete([]))),
            (json!({ "/arrival": { "type": "discrete", "times": [1, 0] } }), with(Arrival::discrete([1.0, 0.0]))),
            (
                json!({ "/arrival": { "type": "discrete", "times": [1, 2], "weights": [1] } }),
                discrete(&[1.0, 2.0], &[1.0]),
            ),
            (
                json!({ "/arrival": { "type": "discrete", "times": [1, 2], "weights": [0, 0] } }),
                discrete(&[1.0, 2.0], &[0.0, 0.0]),
            ),
            (
                json!({ "/arrival": { "type": "logNormal", "median": 1, "spread": 0 } }),
                with(Arrival::log_normal(1.0, 0.0)),
            ),
            (
                json!({ "/arrival": { "type": "fitts", "intercept": -1, "slope": 1, "spread": 1 } }),
                with(Arrival::fitts(-1.0, 1.0, 1.0)),
            ),
            (json!({ "/quadrature/points": 4 }), summed(Quadrature::simpson(4))),
            (json!({ "/quadrature": { "rule": "trapezoid", "points": 1002 } }), summed(Quadrature::trapezoid(1002))),
            (json!({ "/quadrature": { "rule": "gaussLegendre", "points": 0 } }), summed(Quadrature::gauss_legendre(0))),
            (
                json!({ "/arrival/type": "horizon", "/method": "algorithm1" }),
                Parts { method: Method::Algorithm1, arrival: Arrival::horizon(1.0, 4.0), ..Parts::default() }
                    .builder()
                    .build(),
            ),
        ],
    );
}

#[test]
fn destinations_from_types_are_refused_as_from_json() {
    let with = |i, destination| Parts::default().destination(i, destination).builder().build();
    let only = |destinations: Vec<Destination>| Parts { destinations, ..Parts::default() }.builder().build();
    let gaussian = |covariance: [[f64; 2]; 2]| Destination::gaussian("a", [10.0, 0.0], covariance).prior(2.0);
    check(
        "scenario",
        vec![
            (json!({ "/none": 1 }), Parts { none: 1.0, ..Parts::default() }.builder().build()),
            (json!({ "/destinations": [] }), only(vec![])),
            (json!({ "/destinations/1/id": "a" }), only(vec![wide("a"), boxed("a")])),
            (
                json!({ "/destinations/0/prior": 0, "/destinations/1/prior": 0 }),
                only(vec![wide("a").prior(0.0), boxed("b").prior(0.0)]),
            ),
            (json!({ "/destinations/1/prior": -1 }), with(1, boxed("b").prior(-1.0))),
            (json!({ "/destinations/1/size": null }), with(1, Destination::new("b", [-10.0, 5.0]).end_velocity(4.0))),
            (json!({ "/destinations/1/size": [2, -3] }), with(1, boxed("b").size([2.0, -3.0]))),
            (json!({ "/destinations/1/center": [1] }), with(1, Destination::new("b", [1.0]).size([2.0, 3.0]))),
            (json!({ "/destinations/1/endVelocity": 0 }), with(1, boxed("b").end_velocity(0.0))),
            (json!({ "/destinations/0/size": 1 }), with(0, wide("a").size(1.0))),
            (
                json!({ "/destinations/0/mean": [1] }),
                with(0, Destination::gaussian("a", [1.0], [[1.0, 0.1], [0.1, 1.0]])),
            ),
            (json!({ "/destinations/0/covariance": [[-1, 0], [0, 1]] }), with(0, gaussian([[-1.0, 0.0], [0.0, 1.0]]))),
            (
                json!({ "/method": "algorithm1", "/destinations/1/arrival": { "type": "horizon", "from": 1, "to": 2 } }),
                Parts { method: Method::Algorithm1, ..Parts::default() }
                    .destination(1, boxed("b").arrival(Arrival::horizon(1.0, 2.0)))
                    .builder()
                    .build(),
            ),
        ],
    );
}

#[test]
fn sequences_from_types_are_refused_as_from_json() {
    let base = SequenceParameters {
        motion: Motion::constant_velocity(1, 1.0),
        time_step: 1.0.into(),
        steps: 10,
        pins: Some(vec![0, 4, 10]),
        pinned_mean: vec![0.0; 6],
        pinned_covariance: (&nalgebra::DMatrix::identity(6, 6)).into(),
        observation: Observation::deviation(1.0),
    };
    let new = |parameters: SequenceParameters| ConditionallyMarkovSequence::new(&parameters);
    let candidates = Motion::constant_velocity(1, MotionNoise::candidates([1.0, 2.0]));
    assert!(new(base.clone()).is_ok());
    check(
        "sequence",
        vec![
            (
                json!({ "/motion/noise": { "candidates": [1, 2] } }),
                new(SequenceParameters { motion: candidates, ..base.clone() }),
            ),
            (json!({ "/timeStep": 0 }), new(SequenceParameters { time_step: 0.0.into(), ..base.clone() })),
            (json!({ "/timeStep": [1, 2] }), new(SequenceParameters { time_step: [1.0, 2.0].into(), ..base.clone() })),
            (json!({ "/steps": 0 }), new(SequenceParameters { steps: 0, ..base.clone() })),
            (json!({ "/pins": [0, 4] }), new(SequenceParameters { pins: Some(vec![0, 4]), ..base.clone() })),
            (
                json!({ "/pinnedMean": [0, 0, 0, 0] }),
                new(SequenceParameters { pinned_mean: vec![0.0; 4], ..base.clone() }),
            ),
            (
                json!({ "/observation/noise": 0 }),
                new(SequenceParameters { observation: Observation::deviation(0.0), ..base }),
            ),
        ],
    );
    let given = GivenSequence {
        previous: vec![[[1.0]].into(), [[1.0]].into()],
        destination: vec![[[0.0]].into(), [[0.0]].into()],
        offset: None,
        covariance: vec![[[1.0]].into(), [[1.0]].into()],
        boundary: Boundary {
            origin_mean: None,
            destination_mean: None,
            gain: None,
            origin_covariance: [[1.0]].into(),
            destination_covariance: [[1.0]].into(),
        },
        observation: Observation::deviation(1.0),
        dimensions: None,
    };
    let from = |sequence: GivenSequence| ConditionallyMarkovSequence::from_parameters(&sequence);
    assert!(from(given.clone()).is_ok());
    check(
        "parameters",
        vec![
            (
                json!({ "/destination": [[[0]]] }),
                from(GivenSequence { destination: vec![[[0.0]].into()], ..given.clone() }),
            ),
            (
                json!({ "/covariance/0": [[-1]] }),
                from(GivenSequence { covariance: vec![[[-1.0]].into(), [[1.0]].into()], ..given.clone() }),
            ),
            (json!({ "/dimensions": 2 }), from(GivenSequence { dimensions: Some(2), ..given })),
        ],
    );
}

/// What no row of the table has.
#[test]
fn learning_from_types_is_refused_as_from_json() {
    let json = serde_json::to_value(Parts::default().builder().build().unwrap()).unwrap();
    for (learning, put) in [
        (Learning::new(-1.0), json!({ "strength": -1 })),
        (Learning::new(1.0).forgetting(2.0), json!({ "strength": 1, "forgetting": 2 })),
        (Learning::new(1.0).after_last(0.0), json!({ "strength": 1, "afterLast": 0 })),
    ] {
        let mut json = json.clone();
        json["learning"] = put;
        let read = serde_json::from_value::<Scenario>(json).unwrap_err();
        let built = Parts::default().builder().learning(learning).build().unwrap_err();
        assert_eq!(built.to_string(), read.to_string());
    }
}

#[test]
fn a_wrong_destination_changes_no_predictor() {
    let mut predictor = Predictor::new(&Parts::default().builder().build().unwrap());
    let before = predictor.snapshot();
    let error = predictor.add_destination(Destination::new("c", [0.0, f64::NAN]).size(1.0)).unwrap_err();
    assert_eq!(shown(&error), "not-finite | destination.center[1] | must be a finite number, got NaN");
    assert_eq!(predictor.snapshot(), before);
}
