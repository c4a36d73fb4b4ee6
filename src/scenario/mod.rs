//! A scenario: everything that a predictor is made from, and the validation of what no part can check by itself.

mod begin;
mod builder;
mod form;

use crate::error::{Code, Error, Result};
use crate::likelihood::Method;
use crate::math::quadrature::Quadrature;
use crate::model::arrival::Arrival;
use crate::model::destination::Destinations;
use crate::model::endpoint::Endpoint;
use crate::model::habits::Learning;
use crate::model::initial::InitialDensity;
use crate::model::motion::{Motion, MotionModels};
use crate::model::observation::{Observation, ObservationModel};
use crate::pointing::parameters::PointingConstants;
use crate::value::Path;
pub use builder::ScenarioBuilder;
use std::sync::Arc;

/// The most numbers that are kept for the pairs of destination and arrival time, a gigabyte of them.
const MOST_NUMBERS: u64 = 1 << 27;

/// Everything that a predictor is made from, validated: how the object moves, how it is observed, where it may go and when it may
/// arrive. [`Scenario::builder`] makes it from types, serde from any format; what serde writes reads as the same scenario.
///
/// ```
/// use whither::{Arrival, Destination, Motion, Observation, Scenario};
/// let scenario = Scenario::builder(Motion::brownian(1, 1.0), Observation::deviation(1.0))
///     .arrival(Arrival::uniform(1.0, 5.0))
///     .destination(Destination::new("there", [9.0]).size(1.0))
///     .build()?;
/// let json = serde_json::to_value(&scenario)?;
/// assert_eq!(json["method"], "pseudoObservation"); // the default
/// let again: Scenario = serde_json::from_value(json.clone())?;
/// assert_eq!(serde_json::to_value(&again)?, json);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Scenario {
    /// How the object moves.
    pub(crate) motion: MotionModels,
    /// How it is observed.
    pub(crate) observation: ObservationModel,
    /// What is known of it before the first observation.
    pub(crate) initial: InitialDensity,
    /// Which predictor, and what only it needs.
    pub(crate) setup: Setup,
    /// The prior probability that the object goes to none of the destinations, at least 0 and less than 1.
    pub(crate) none: f64,
    /// How is learnt from what is chosen, where something is.
    pub(crate) learning: Option<Learning>,
    /// Where it may be going.
    pub(crate) destinations: Arc<Destinations>,
}

/// Which predictor, and what only it needs.
#[derive(Clone, Debug)]
pub enum Setup {
    /// A method of the papers.
    Papers {
        /// Which one.
        method: Method,
        /// The arrival prior of the destinations that have none of their own.
        arrival: Arrival,
        /// How the arrival time is summed over.
        quadrature: Quadrature,
    },
    /// The pointing model.
    Pointing(Arc<PointingConstants>),
}

impl Scenario {
    /// Begins a scenario with how the object moves and how it is observed.
    #[must_use]
    pub fn builder(motion: Motion, observation: Observation) -> ScenarioBuilder {
        ScenarioBuilder::new(motion, observation)
    }

    /// What no part can check by itself.
    fn check(&self) -> Result<()> {
        let at = Path::root("none");
        if !(0.0..1.0).contains(&at.number(self.none)?) {
            return Err(at.error(Code::OutOfRange, "must be at least 0 and less than 1", self.none));
        }
        let Setup::Papers { method, arrival, .. } = &self.setup else { return Ok(()) };
        if self.none > 0.0 && *method == Method::SingleFilterApproximate {
            let message = "must be 0 with \"singleFilterApproximate\", whose likelihoods are known up to a factor only";
            return Err(Error::new(Code::OutOfRange, "none", message));
        }
        if self.initial.is_flat() && !self.observation.is_position() {
            let message = "missing mean and covariance: with observation.matrix, initial cannot be flat in position";
            return Err(Error::new(Code::MissingKey, "initial", message));
        }
        if arrival.is_horizon() {
            self.refuse_accumulating("arrival", "a horizon moves with every observation")?;
        }
        Ok(())
    }

    /// Whether these destinations go with the method, and fit into memory.
    ///
    /// # Errors
    /// `method-accumulates`, `too-large`, `not-positive-definite`; `unknown-key` with the pointing model, which has nodes of
    /// its own.
    pub(crate) fn check_destinations(&self, destinations: &Destinations) -> Result<()> {
        let Setup::Papers { method, arrival, quadrature, .. } = &self.setup else {
            return check_for_pointing(destinations);
        };
        self.check_size(destinations, *method, arrival, quadrature)?;
        self.check_noise(destinations, *method)?;
        let own = |i: &usize| destinations.class(*i).arrival().is_some_and(Arrival::is_horizon);
        match (0..destinations.len()).find(own) {
            Some(i) => self
                .refuse_accumulating(&format!("destinations[{i}].arrival"), "a horizon moves with every observation"),
            None => Ok(()),
        }
    }

    /// What grows with the product of destinations, arrival times and noise candidates must fit into the memory of a wasm
    /// module.
    fn check_size(
        &self,
        destinations: &Destinations,
        method: Method,
        arrival: &Arrival,
        quadrature: &Quadrature,
    ) -> Result<()> {
        let count = destinations.len();
        let points = |i: usize| destinations.class(i).arrival().unwrap_or(arrival).points(quadrature);
        let nodes: u64 = (0..count).map(|i| points(i) as u64).sum();
        let states = self.motion.states() as u64;
        let each = nodes * if method == Method::Bridging { 2 * states + 1 } else { 1 };
        let columns = if self.motion.depends_on_destination() { 2 * states * count as u64 } else { 0 };
        let needed = self.motion.candidates.len() as u64 * (each + columns);
        if needed <= MOST_NUMBERS {
            return Ok(());
        }
        let message = format!(
            "{count} destinations with {nodes} arrival times together, under {} noise candidates, need {needed} numbers \
             with \"{}\", the most is {MOST_NUMBERS}",
            self.motion.candidates.len(),
            method.name()
        );
        Err(Error::new(Code::TooLarge, "destinations", message))
    }

    /// Where the endpoint is independent of the start, as these methods have it, some noise must lead to all of it: the
    /// state alone would determine the rest, whatever the destination is. Only `custom` can be without.
    fn check_noise(&self, destinations: &Destinations, method: Method) -> Result<()> {
        if !matches!(method, Method::Bridging | Method::SingleFilter) {
            return Ok(());
        }
        let length = (0..destinations.len()).map(|i| destinations.class(i).length()).max().unwrap_or(0);
        // the rank is the same after any time
        if !self.motion.candidates.iter().any(|c| Endpoint::after(c.model.as_ref(), 1.0, length).is_singular()) {
            return Ok(());
        }
        let message = format!(
            "must reach each of the endpoint's {length} components: with \"{}\" the endpoint does not depend on the start, \
             so noise must lead to it; \"pseudoObservation\", \"algorithm1\" and \"algorithm2\" can do without",
            method.name()
        );
        Err(Error::new(Code::NotPositiveDefinite, "motion.diffusion", message))
    }

    /// An error where the method accumulates evidence for each destination and node.
    ///
    /// # Errors
    /// `method-accumulates`.
    pub(crate) fn refuse_accumulating(&self, path: &str, why: &str) -> Result<()> {
        let Setup::Papers { method, .. } = &self.setup else { return Ok(()) };
        if !method.accumulates() {
            return Ok(());
        }
        let message = format!(
            "{why}, but \"{}\" accumulates evidence for each destination and arrival time; \"pseudoObservation\", \
             \"singleFilter\" and \"singleFilterApproximate\" do not",
            method.name()
        );
        Err(Error::new(Code::MethodAccumulates, path, message))
    }
}

/// What the pointing model has no use for in a destination.
fn check_for_pointing(destinations: &Destinations) -> Result<()> {
    for i in 0..destinations.len() {
        let class = destinations.class(i);
        let extra = [
            ("arrival", class.arrival().is_some()),
            ("endVelocity", class.end_velocity().is_some()),
            ("mean", class.length() > destinations.dimensions()),
        ];
        for (key, found) in extra {
            if found {
                let message =
                    "the method \"pointing\" knows positions alone as endpoints, and arrival nodes of its own";
                return Err(Error::new(Code::UnknownKey, format!("destinations[{i}].{key}"), message));
            }
        }
    }
    Ok(())
}
