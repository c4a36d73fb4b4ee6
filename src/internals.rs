//! What the tools and tests of this repository use of the inside; it is not part of the interface and changes with any release.
//!
//! Data ([`Value`]) are what JavaScript's objects are read as; each function here reads them and calls the typed interface.

pub use crate::conditionally_markov::DEFAULT_TOLERANCE;
pub use crate::math::gaussian::{condition, propagate};
pub use crate::math::log_sum_exp::log_sum_exp;
pub use crate::model::bridge::Bridge;
pub use crate::model::destination::Destinations;
pub use crate::model::endpoint::Endpoint;
pub use crate::model::motion::{MotionModel, MotionModels};
pub use crate::model::observation::ObservationModel;
pub use crate::value::{Node, Value};

use crate::conditionally_markov::{ConditionallyMarkovSequence, GivenSequence, SequenceParameters};
use crate::error::Result;
use crate::math::quadrature::Quadrature;
use crate::model::arrival::{Arrival, Grid};
use crate::model::observation::ObservationNoise;
use crate::predictor::Predictor;
use crate::scenario::{Scenario, Setup};
use crate::snapshot::Snapshot;
#[cfg(feature = "fit")]
use crate::study::fit::{self, Fitted, Options, Progress};
use crate::study::track::{Target, Track};

/// A scenario from data.
///
/// # Errors
/// Those of reading and of [`ScenarioBuilder::build`](crate::ScenarioBuilder::build).
pub fn scenario(value: &Value) -> Result<Scenario> {
    Scenario::from_value(value)
}

/// A scenario as data.
#[must_use]
pub fn data(scenario: &Scenario) -> Value {
    scenario.to_value()
}

/// A snapshot from data, unchecked.
#[must_use]
pub const fn snapshot(value: Value) -> Snapshot {
    Snapshot(value)
}

/// [`Track::scenario`] of a template as data, each destination with the keys of `extra`, an object or nothing.
///
/// # Errors
/// Those of the scenario.
pub fn track_scenario(track: &Track, template: &Value, extra: &Value) -> Result<Scenario> {
    track.scenario_of(template, extra)
}

/// A track from data, of one dimension too, each of its targets read by `target` from the data and the number of dimensions.
///
/// # Errors
/// Those of reading and of `target`.
pub fn track(value: &Value, target: &mut dyn FnMut(&Node<'_>, usize) -> Result<Target>) -> Result<Track> {
    Track::read_with(&Node::root(value, ""), 1..=3, target)
}

/// A track's target from data: `[x, width]`, `[x, y, width, height]` or `[x, y, z, diameter]`.
///
/// # Errors
/// `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`.
pub fn track_target(node: &Node<'_>, dimensions: usize) -> Result<Target> {
    Target::read(node, dimensions)
}

/// [`Track::approach`] to a target that holds the positions for which `contains` is true.
#[must_use]
pub fn approach_to(track: &Track, contains: &dyn Fn(&[f64]) -> bool) -> Option<usize> {
    track.approach_to(contains)
}

/// [`fit`](fit::fit) with a template as data, each destination with the keys of `extra`, an object or nothing.
///
/// # Errors
/// Those of [`fit`](fit::fit).
#[cfg(feature = "fit")]
pub fn fit(
    tracks: &[Track],
    template: &Value,
    extra: &Value,
    options: &Options,
    progress: &mut dyn FnMut(Progress) -> bool,
) -> Result<(Value, Fitted)> {
    fit::fit_value(tracks, template, extra, options, progress)
}

/// The validated parts of a scenario.
#[derive(Clone, Copy, Debug)]
pub struct Parts<'a> {
    /// How the object moves.
    pub motion: &'a MotionModels,
    /// How it is observed.
    pub observation: &'a ObservationModel,
    /// Where it may be going.
    pub destinations: &'a Destinations,
    /// When it may arrive and how that is summed over, for the methods of the papers.
    pub arrival: Option<(&'a Arrival, &'a Quadrature)>,
}

/// The validated parts of a scenario.
#[must_use]
pub fn parts(scenario: &Scenario) -> Parts<'_> {
    Parts {
        motion: &scenario.motion,
        observation: &scenario.observation,
        destinations: &scenario.destinations,
        arrival: match &scenario.setup {
            Setup::Papers { arrival, quadrature, .. } => Some((arrival, quadrature)),
            Setup::Pointing(_) => None,
        },
    }
}

/// The nodes of an arrival prior and the logs of their probabilities, for a destination of this distance from the start and this
/// size.
#[must_use]
pub fn grid(arrival: &Arrival, quadrature: &Quadrature, distance: f64, size: f64) -> Grid {
    arrival.grid(quadrature, distance, size)
}

/// The noise of one observation of so many axes from data.
///
/// # Errors
/// `wrong-type`.
pub fn noise(value: &Value, axes: usize) -> Result<ObservationNoise> {
    ObservationNoise::read(&Node::root(value, "noise"), axes)
}

fn call(key: &str, id: Option<&str>, value: &Value, act: impl FnOnce(&Node<'_>) -> Result<()>) -> Result<()> {
    let entries = vec![("id", id.map(Value::text)), (key, Some(value.clone()))];
    act(&Node::root(&Value::some(entries), ""))
}

/// [`Predictor::add_destination`] with data.
///
/// # Errors
/// Those of reading and of the method.
pub fn add_destination(predictor: &mut Predictor, destination: &Value) -> Result<()> {
    call("destination", None, destination, |node| predictor.add_value(node))
}

/// [`Predictor::update_destination`] with data.
///
/// # Errors
/// Those of reading and of the method.
pub fn update_destination(predictor: &mut Predictor, id: &str, destination: &Value) -> Result<()> {
    call("destination", Some(id), destination, |node| predictor.update_value(node))
}

/// [`Predictor::set_destinations`] with data.
///
/// # Errors
/// Those of reading and of the method.
pub fn set_destinations(predictor: &mut Predictor, destinations: &Value) -> Result<()> {
    call("destinations", None, destinations, |node| predictor.set_value(node))
}

/// A sequence from the data that JavaScript's constructor takes.
///
/// # Errors
/// Those of reading and of [`ConditionallyMarkovSequence::new`].
pub fn sequence(value: &Value) -> Result<ConditionallyMarkovSequence> {
    ConditionallyMarkovSequence::new(&SequenceParameters::read(&Node::root(value, ""))?)
}

/// A sequence from the data that JavaScript's `fromParameters` takes.
///
/// # Errors
/// Those of reading and of [`ConditionallyMarkovSequence::from_parameters`].
pub fn given_sequence(value: &Value) -> Result<ConditionallyMarkovSequence> {
    ConditionallyMarkovSequence::from_parameters(&GivenSequence::read(&Node::root(value, ""))?)
}
