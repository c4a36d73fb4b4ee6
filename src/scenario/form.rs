//! A scenario as data, `{ motion, observation, .. }`: read from and written to any serde format.

use super::builder::ScenarioBuilder;
use super::{Scenario, Setup};
use crate::error::Result;
use crate::likelihood::Method;
use crate::math::quadrature::Quadrature;
use crate::model::arrival::Arrival;
use crate::model::destination::{Destination, Destinations};
use crate::model::habits::Learning;
use crate::model::initial::Initial;
use crate::model::motion::Motion;
use crate::model::observation::Observation;
use crate::pointing::parameters::PointingConstants;
use crate::value::{Node, Value};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

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

/// The pointing model as `method` spells it.
const POINTING: &str = "pointing";

impl Scenario {
    /// Reads and checks a scenario.
    pub(crate) fn from_value(value: &Value) -> Result<Self> {
        ScenarioBuilder::read(&Node::root(value, ""))?.build()
    }

    /// The scenario as it is written, with these destinations in place of its own.
    pub(crate) fn to_value_with(&self, destinations: &Destinations) -> Value {
        let mut entries = vec![
            ("motion".into(), self.motion.to_value()),
            ("observation".into(), self.observation.to_value()),
            ("none".into(), Value::Number(self.none)),
            ("destinations".into(), destinations.to_value()),
        ];
        let mut put = |key: &str, value: Value| entries.push((key.into(), value));
        match &self.setup {
            Setup::Papers { method, arrival, quadrature, .. } => {
                put("arrival", arrival.to_value());
                put("quadrature", quadrature.to_value());
                put("method", Value::text(method.name()));
            }
            Setup::Pointing(parameters) => {
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
    pub(crate) fn to_value(&self) -> Value {
        self.to_value_with(&self.destinations)
    }
}

impl ScenarioBuilder {
    fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&KEYS)?;
        let motion = Motion::read(&fields.required("motion")?)?;
        let dimensions = motion.dimensions();
        let mut builder = Self::new(motion, Observation::read(&fields.required("observation")?, dimensions)?);
        if let Some(initial) = fields.optional("initial") {
            builder.initial = Initial::read(&initial, dimensions)?;
        }
        if let Some(method) = fields.optional("method") {
            let mut words = Method::NAMES.map(|(name, method)| (name, Some(method))).to_vec();
            words.push((POINTING, None));
            builder.method = method.word(&words)?;
        }
        // what the method does not take is refused, whatever it is
        let papers = builder.method.is_some();
        if let Some(arrival) = fields.optional("arrival") {
            builder.arrival = Some(if papers { Arrival::read(&arrival)? } else { Arrival::uniform(1.0, 2.0) });
        }
        if let Some(rule) = fields.optional("quadrature") {
            builder.quadrature = Some(if papers { Quadrature::read(&rule)? } else { Quadrature::default() });
        }
        if let Some(pointing) = fields.optional("pointing") {
            builder.pointing =
                Some(if papers { PointingConstants::default() } else { PointingConstants::read(&pointing)? });
        }
        if let Some(none) = fields.optional("none") {
            builder.none = none.float()?;
        }
        builder.learning = fields.optional("learning").map(|learning| Learning::read(&learning)).transpose()?;
        let destinations = fields.required("destinations")?;
        builder.destinations = Destination::read_all(&destinations, dimensions)?;
        Ok(builder)
    }
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
