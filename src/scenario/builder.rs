//! A scenario from its typed parts.

use super::{Scenario, Setup};
use crate::error::{Code, Error, Result};
use crate::likelihood::Method;
use crate::math::quadrature::Quadrature;
use crate::model::arrival::Arrival;
use crate::model::destination::{Destination, Destinations};
use crate::model::habits::Learning;
use crate::model::initial::Initial;
use crate::model::motion::{Motion, MotionModels};
use crate::model::observation::Observation;
use crate::pointing::parameters::PointingConstants;
use crate::value::{Path, quote};
use std::sync::Arc;

/// The parts of a [`Scenario`], not validated before [`ScenarioBuilder::build`]. [`Scenario::builder`] begins one.
///
/// ```
/// use whither::{Arrival, Code, Destination, Motion, Observation, Scenario};
/// let builder = Scenario::builder(Motion::brownian(1, 1.0), Observation::deviation(0.5))
///     .destination(Destination::new("there", [9.0]).size(1.0));
/// let error = builder.clone().build().unwrap_err();
/// assert_eq!((error.code(), error.path()), (Code::MissingKey, "arrival"));
/// let error = builder.arrival(Arrival::uniform(5.0, 1.0)).build().unwrap_err();
/// assert_eq!(error.to_string(), "arrival.to: must be greater than \"from\", which is 5, got 1");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioBuilder {
    pub(super) motion: Motion,
    pub(super) observation: Observation,
    pub(super) initial: Initial,
    pub(super) arrival: Option<Arrival>,
    pub(super) quadrature: Option<Quadrature>,
    /// None is the pointing model.
    pub(super) method: Option<Method>,
    pub(super) pointing: Option<PointingConstants>,
    pub(super) none: f64,
    pub(super) learning: Option<Learning>,
    pub(super) destinations: Vec<Destination>,
}

impl ScenarioBuilder {
    pub(super) fn new(motion: Motion, observation: Observation) -> Self {
        Self {
            motion,
            observation,
            initial: Initial::default(),
            arrival: None,
            quadrature: None,
            method: Some(Method::PseudoObservation),
            pointing: None,
            none: 0.0,
            learning: None,
            destinations: Vec::new(),
        }
    }

    /// What is known of the state before the first observation; by default nothing of the position.
    #[must_use]
    pub fn initial(self, initial: Initial) -> Self {
        Self { initial, ..self }
    }

    /// When it arrives: needed by every method of the papers.
    #[must_use]
    pub fn arrival(self, arrival: Arrival) -> Self {
        Self { arrival: Some(arrival), ..self }
    }

    /// How the arrival time is summed over; by default Simpson's rule with 15 nodes.
    #[must_use]
    pub fn quadrature(self, quadrature: Quadrature) -> Self {
        Self { quadrature: Some(quadrature), ..self }
    }

    /// Which method of the papers; by default [`Method::PseudoObservation`].
    #[must_use]
    pub fn method(self, method: Method) -> Self {
        Self { method: Some(method), ..self }
    }

    /// The pointing model in place of a method of the papers, for constant velocity and positions. It takes its filter's noise from
    /// `motion` and the deviation of the first velocity from `initial`, and neither arrival prior nor quadrature.
    #[must_use]
    pub fn pointing(self, constants: PointingConstants) -> Self {
        Self { method: None, pointing: Some(constants), ..self }
    }

    /// The prior probability that it goes to none of the destinations, at least 0 and less than 1; by default 0.
    #[must_use]
    pub fn none(self, none: f64) -> Self {
        Self { none, ..self }
    }

    /// How is learnt from what is chosen; by default nothing is.
    #[must_use]
    pub fn learning(self, learning: Learning) -> Self {
        Self { learning: Some(learning), ..self }
    }

    /// One more destination.
    #[must_use]
    pub fn destination(self, destination: Destination) -> Self {
        self.destinations([destination])
    }

    /// More destinations: 1 to 1 000 000 in all.
    #[must_use]
    pub fn destinations(mut self, destinations: impl IntoIterator<Item = Destination>) -> Self {
        self.destinations.extend(destinations);
        self
    }

    /// The scenario, if it can be built.
    ///
    /// # Errors
    /// An [`Error`] that names the field as JSON does (`destinations[3].size[1]`), for anything that is missing, beyond its limits
    /// or does not go together.
    pub fn build(self) -> Result<Scenario> {
        let root = Path::root("");
        let motion = self.motion.models(&root.key("motion"))?;
        let (d, s) = (motion.dimensions(), motion.states());
        let observation = self.observation.model(&root.key("observation"), d, s)?;
        let initial = self.initial.density(&root.key("initial"), d, s, &deviations_after_a_second(&motion))?;
        let setup = match self.method {
            None => Setup::Pointing(Arc::new(self.constants()?.with_filter(&motion, &observation, &initial)?)),
            Some(method) => self.papers(method, &motion)?,
        };
        if let Some(learning) = &self.learning {
            learning.check(&root.key("learning"))?;
        }
        let destinations = Arc::new(Destinations::new(&self.destinations, d, s)?);
        let scenario =
            Scenario { motion, observation, initial, setup, none: self.none, learning: self.learning, destinations };
        scenario.check()?;
        scenario.check_destinations(&scenario.destinations)?;
        Ok(scenario)
    }

    /// The constants of the pointing model, with which nothing of the papers' can be combined.
    fn constants(&self) -> Result<PointingConstants> {
        let extra = [
            ("arrival", self.arrival.as_ref().map(Arrival::to_value)),
            ("quadrature", self.quadrature.as_ref().map(Quadrature::to_value)),
        ];
        for (key, value) in extra {
            if let Some(value) = value {
                let must = "cannot be combined with the method \"pointing\"";
                return Err(Path::root(key).error(Code::UnknownKey, must, value));
            }
        }
        self.pointing.clone().ok_or_else(|| missing("pointing"))
    }

    fn papers(&self, method: Method, motion: &MotionModels) -> Result<Setup> {
        for (key, extra) in [("pointing", self.pointing.is_some()), ("motion.speedNoise", motion.speed_noise.is_some())]
        {
            if extra {
                return Err(Error::new(Code::UnknownKey, key, "is for the method \"pointing\" only"));
            }
        }
        let arrival = self.arrival.clone().ok_or_else(|| missing("arrival"))?;
        arrival.check(&Path::root("arrival"))?;
        let quadrature = self.quadrature.clone().unwrap_or_default();
        quadrature.check(&Path::root("quadrature"))?;
        Ok(Setup::Papers { method, arrival, quadrature })
    }
}

fn missing(key: &str) -> Error {
    Error::new(Code::MissingKey, key, format!("missing key {}", quote(key)))
}

/// The deviation that a second of the noisiest candidate gives each component after the position: the default of `initial`.
fn deviations_after_a_second(motion: &MotionModels) -> Vec<f64> {
    let mut deviations = vec![0.0; motion.states() - motion.dimensions()];
    for candidate in &motion.candidates {
        let noise = candidate.model.transition(1.0).noise;
        for (i, deviation) in deviations.iter_mut().enumerate() {
            let component = motion.dimensions() + i;
            *deviation = noise[(component, component)].sqrt().max(*deviation);
        }
    }
    deviations
}
