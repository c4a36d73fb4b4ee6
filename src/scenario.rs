//! A scenario: the whole configuration, read from and written to any serde format, and the one validation.
//!
//! ```
//! let scenario: whither::Scenario = serde_json::from_str(r#"{
//!     "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 3000 },
//!     "observation": { "noise": 1.5 },
//!     "initial": { "velocity": 200 },
//!     "arrival": { "type": "horizon", "from": 0.05, "to": 0.5 },
//!     "destinations": [
//!         { "id": "radio", "center": [100, 100], "size": [80, 80] },
//!         { "id": "map", "center": [500, 300], "size": [80, 80], "endVelocity": 200 }
//!     ]
//! }"#).unwrap();
//! assert_eq!(scenario.destinations.len(), 2);
//! ```

mod begin;

use crate::error::{Code, Error, Result};
use crate::likelihood::Method;
use crate::math::quadrature::Quadrature;
use crate::model::arrival::Arrival;
use crate::model::destination::Destinations;
use crate::model::endpoint::Endpoint;
use crate::model::habits::Learning;
use crate::model::initial::{Initial, InitialDensity};
use crate::model::motion::{Motion, MotionModels};
use crate::model::observation::{Observation, ObservationModel};
use crate::pointing::parameters::Parameters;
use crate::value::{Fields, Node, Value};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::sync::Arc;

const KEYS: [&str; 10] = [
    "motion",
    "observation",
    "initial",
    "arrival",
    "quadrature",
    "method",
    "pointing",
    "none",
    "learning",
    "destinations",
];

/// The most numbers that are kept for the pairs of destination and arrival time, a gigabyte of them.
const MOST_NUMBERS: u64 = 1 << 27;

/// Everything that a predictor is made from.
///
/// ```
/// use whither::Scenario;
/// let value = serde_json::from_str(r#"{
///     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
///     "arrival": { "type": "uniform", "from": 1, "to": 5 },
///     "destinations": [{ "id": "there", "center": [9], "size": 1 }]
/// }"#).unwrap();
/// let scenario = Scenario::from_value(&value).unwrap();
/// assert_eq!((scenario.none, scenario.destinations.id(0)), (0.0, "there")); // it goes nowhere else unless told
/// let again = Scenario::from_value(&scenario.to_value()).unwrap();
/// assert_eq!(again.to_value(), scenario.to_value());
/// ```
#[derive(Clone, Debug)]
pub struct Scenario {
    /// How the object moves.
    pub motion: MotionModels,
    /// How it is observed.
    pub observation: ObservationModel,
    /// What is known of it before the first observation.
    pub initial: InitialDensity,
    /// Which predictor.
    pub engine: Engine,
    /// The prior probability that the object goes to none of the destinations, at least 0 and less than 1.
    pub none: f64,
    /// How the destinations' priors are learnt from what is chosen, where they are.
    pub learning: Option<Learning>,
    /// Where it may be going.
    pub destinations: Arc<Destinations>,
}

/// Which predictor, and what only it needs.
///
/// ```
/// use whither::{Scenario, likelihood::Method, scenario::Engine};
/// let scenario: Scenario = serde_json::from_str(r#"{
///     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
///     "arrival": { "type": "uniform", "from": 1, "to": 5 },
///     "destinations": [{ "id": "there", "center": [9], "size": 1 }]
/// }"#).unwrap();
/// let Engine::Papers { method, quadrature, .. } = scenario.engine else { panic!() };
/// assert_eq!((method, quadrature.points()), (Method::PseudoObservation, 15)); // unless others are asked for
/// ```
#[derive(Clone, Debug)]
pub enum Engine {
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
    Pointing(Arc<Parameters>),
}

impl Scenario {
    /// Reads and checks a scenario.
    ///
    /// # Errors
    /// An [`Error`] that names the field, for anything that is not as design and documentation say.
    pub fn from_value(value: &Value) -> Result<Self> {
        let node = Node::root(value, "");
        let fields = node.fields(&KEYS)?;
        let at = node.place();
        let motion = Motion::read(&fields.required("motion")?)?.models(&at.key("motion"))?;
        let (d, s) = (motion.dimensions(), motion.states());
        let observation =
            Observation::read(&fields.required("observation")?, d)?.model(&at.key("observation"), d, s)?;
        let initial =
            fields.optional("initial").map_or_else(|| Ok(Initial::default()), |node| Initial::read(&node, d))?;
        let initial = initial.density(&at.key("initial"), d, s, &deviations_after_a_second(&motion))?;
        let engine = Engine::read(&fields, &motion, &observation, &initial)?;
        let none = fields.optional("none").map_or(Ok(0.0), |none| none.number())?;
        let learning = fields.optional("learning").map(|learning| Learning::read(&learning)).transpose()?;
        let destinations = Arc::new(Destinations::read(&fields.required("destinations")?, d, s)?);
        let scenario = Self { motion, observation, initial, engine, none, learning, destinations };
        scenario.check()?;
        scenario.check_destinations(&scenario.destinations)?;
        Ok(scenario)
    }

    /// What no part can see for itself.
    fn check(&self) -> Result<()> {
        if !(0.0..1.0).contains(&self.none) {
            let none = Value::Number(self.none);
            let message = format!("must be at least 0 and less than 1, got {}", none.quoted());
            return Err(Error::new(Code::OutOfRange, "none", message));
        }
        let Engine::Papers { method, arrival, .. } = &self.engine else { return Ok(()) };
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
        let Engine::Papers { method, arrival, quadrature, .. } = &self.engine else {
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
    /// state alone would settle the rest, against what the destination says. Only `custom` can be without.
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
        let Engine::Papers { method, .. } = &self.engine else { return Ok(()) };
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

    /// The scenario as it is written, with these destinations in place of its own.
    pub(crate) fn to_value_with(&self, destinations: &Destinations) -> Value {
        let mut entries = vec![
            ("motion".to_owned(), self.motion.to_value()),
            ("observation".to_owned(), self.observation.to_value()),
            ("none".to_owned(), Value::Number(self.none)),
            ("destinations".to_owned(), destinations.to_value()),
        ];
        let mut put = |key: &str, value: Value| entries.push((key.to_owned(), value));
        match &self.engine {
            Engine::Papers { method, arrival, quadrature, .. } => {
                put("arrival", arrival.to_value());
                put("quadrature", quadrature.to_value());
                put("method", Value::text(method.name()));
            }
            Engine::Pointing(parameters) => {
                put("method", Value::text(POINTING));
                put("pointing", parameters.to_value());
            }
        }
        if let Some(learning) = &self.learning {
            put("learning", learning.to_value());
        }
        match self.initial.to_value() {
            Value::Null => {}
            initial => put("initial", initial),
        }
        Value::Map(entries)
    }

    /// The scenario as it is written.
    #[must_use]
    pub fn to_value(&self) -> Value {
        self.to_value_with(&self.destinations)
    }
}

/// The pointing model as `method` spells it.
const POINTING: &str = "pointing";

impl Engine {
    fn read(
        fields: &Fields<'_>,
        motion: &MotionModels,
        observation: &ObservationModel,
        initial: &InitialDensity,
    ) -> Result<Self> {
        let mut words = Method::NAMES.map(|(name, method)| (name, Some(method))).to_vec();
        words.push((POINTING, None));
        let method = fields.optional("method");
        let method = method.map_or(Ok(Some(Method::PseudoObservation)), |method| method.word(&words))?;
        let Some(method) = method else {
            for key in ["arrival", "quadrature"] {
                if let Some(extra) = fields.optional(key) {
                    return Err(extra.error(Code::UnknownKey, "cannot be combined with the method \"pointing\""));
                }
            }
            let node = fields.required("pointing")?;
            return Parameters::read(&node)?
                .with_filter(motion, observation, initial)
                .map(|p| Self::Pointing(Arc::new(p)));
        };
        for (key, extra) in
            [("pointing", fields.optional("pointing").is_some()), ("motion.speedNoise", motion.speed_noise.is_some())]
        {
            if extra {
                return Err(Error::new(Code::UnknownKey, key, "is for the method \"pointing\" only"));
            }
        }
        let node = fields.required("arrival")?;
        let arrival = Arrival::read(&node)?;
        arrival.check(node.place())?;
        let quadrature = match fields.optional("quadrature") {
            None => Quadrature::default(),
            Some(node) => {
                let quadrature = Quadrature::read(&node)?;
                quadrature.check(node.place())?;
                quadrature
            }
        };
        Ok(Self::Papers { method, arrival, quadrature })
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

impl Serialize for Scenario {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        self.to_value().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Scenario {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        let value = Value::deserialize(deserializer)?;
        Self::from_value(&value).map_err(serde::de::Error::custom)
    }
}
