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

use crate::error::{Code, Error, Result};
use crate::likelihood::Method;
use crate::math::quadrature::Quadrature;
use crate::model::arrival::Arrival;
use crate::model::destination::Destinations;
use crate::model::initial::Initial;
use crate::model::motion::Motion;
use crate::model::observation::ObservationModel;
use crate::value::{Node, Value};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

const KEYS: [&str; 8] = ["motion", "observation", "initial", "arrival", "quadrature", "method", "none", "destinations"];

/// Everything that a predictor is made from.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// How the object moves.
    pub motion: Motion,
    /// How it is observed.
    pub observation: ObservationModel,
    /// What is known of it before the first observation.
    pub initial: Initial,
    /// The arrival prior of the destinations that have none of their own.
    pub arrival: Arrival,
    /// How the arrival time is summed over.
    pub quadrature: Quadrature,
    /// Which predictor.
    pub method: Method,
    /// The prior probability that the object goes to none of the destinations, at least 0 and less than 1.
    pub none: f64,
    /// Where it may be going.
    pub destinations: Destinations,
}

impl Scenario {
    /// Reads and checks a scenario.
    ///
    /// # Errors
    /// An [`Error`] that names the field, for anything that is not as design and documentation say.
    pub fn from_value(value: &Value) -> Result<Self> {
        let node = Node::root(value, "");
        let fields = node.fields(&KEYS)?;
        let motion = Motion::read(&fields.required("motion")?)?;
        let (d, s) = (motion.dimensions(), motion.states());
        let observation = ObservationModel::read(&fields.required("observation")?, d, s)?;
        let initial = Initial::read(fields.optional("initial"), d, s, &deviations_after_a_second(&motion))?;
        let arrival = Arrival::read(&fields.required("arrival")?)?;
        let quadrature =
            fields.optional("quadrature").map_or_else(|| Ok(Quadrature::default()), |q| Quadrature::read(&q))?;
        let method = fields.optional("method").map_or(Ok(Method::PseudoObservation), |m| m.word(&Method::NAMES))?;
        let none = fields.optional("none").map_or(Ok(0.0), |none| none.number())?;
        let destinations = Destinations::read(&fields.required("destinations")?, d, s)?;
        let scenario = Self { motion, observation, initial, arrival, quadrature, method, none, destinations };
        scenario.check()?;
        scenario.check_arrivals(&scenario.destinations)?;
        Ok(scenario)
    }

    /// What no part can see for itself.
    fn check(&self) -> Result<()> {
        if !(0.0..1.0).contains(&self.none) {
            let none = Value::Number(self.none);
            let message = format!("must be at least 0 and less than 1, got {}", none.quoted());
            return Err(Error::new(Code::OutOfRange, "none", message));
        }
        if self.none > 0.0 && self.method == Method::SingleFilterApproximate {
            let message = "must be 0 with \"singleFilterApproximate\", whose likelihoods are known up to a factor only";
            return Err(Error::new(Code::OutOfRange, "none", message));
        }
        if self.motion.speed_noise.is_some() {
            let message = "is for the method \"pointing\" only";
            return Err(Error::new(Code::OutOfRange, "motion.speedNoise", message));
        }
        if self.initial.is_flat() && !self.observation.is_position() {
            let message = "missing mean and covariance: with observation.matrix, initial cannot be flat in position";
            return Err(Error::new(Code::MissingKey, "initial", message));
        }
        if self.arrival.is_horizon() {
            self.refuse_accumulating("arrival", "a horizon moves with every observation")?;
        }
        Ok(())
    }

    /// Whether the arrival priors of these destinations go with the method.
    ///
    /// # Errors
    /// `method-accumulates`.
    pub(crate) fn check_arrivals(&self, destinations: &Destinations) -> Result<()> {
        let own = |i: &usize| destinations.kind(*i).arrival.as_ref().is_some_and(Arrival::is_horizon);
        match (0..destinations.len()).find(own) {
            Some(i) => self
                .refuse_accumulating(&format!("destinations[{i}].arrival"), "a horizon moves with every observation"),
            None => Ok(()),
        }
    }

    /// An error where the method accumulates evidence for each destination and node.
    ///
    /// # Errors
    /// `method-accumulates`.
    pub(crate) fn refuse_accumulating(&self, path: &str, why: &str) -> Result<()> {
        if !self.method.accumulates() {
            return Ok(());
        }
        let message = format!(
            "{why}, but \"{}\" accumulates evidence for each destination and arrival time; \"pseudoObservation\", \
             \"singleFilter\" and \"singleFilterApproximate\" do not",
            self.method.name()
        );
        Err(Error::new(Code::MethodAccumulates, path, message))
    }

    /// The scenario as it is written, with these destinations in place of its own.
    pub(crate) fn to_value_with(&self, destinations: &Destinations) -> Value {
        let mut entries = vec![
            ("motion".to_owned(), self.motion.to_value()),
            ("observation".to_owned(), self.observation.to_value().clone()),
            ("arrival".to_owned(), self.arrival.to_value()),
            ("quadrature".to_owned(), self.quadrature.to_value()),
            ("method".to_owned(), Value::text(self.method.name())),
            ("none".to_owned(), Value::Number(self.none)),
            ("destinations".to_owned(), destinations.to_value()),
        ];
        if *self.initial.to_value() != Value::Null {
            entries.push(("initial".to_owned(), self.initial.to_value().clone()));
        }
        Value::Map(entries)
    }

    /// The scenario as it is written.
    #[must_use]
    pub fn to_value(&self) -> Value {
        self.to_value_with(&self.destinations)
    }
}

/// The deviation that a second of the noisiest candidate gives each component after the position: the default of `initial`.
fn deviations_after_a_second(motion: &Motion) -> Vec<f64> {
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
