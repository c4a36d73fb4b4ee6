//! What an engine of the papers is configured with in one movement.

use super::Method;
use super::plan::Plan;
use crate::math::quadrature::Quadrature;
use crate::model::arrival::Arrival;
use crate::model::destination::Destinations;
use crate::model::motion::MotionModels;
use crate::value::{Node, Value};

/// The models, the method, and where the movement began.
#[derive(Debug)]
pub(crate) struct Configuration {
    /// How the object moves.
    pub motion: MotionModels,
    /// Which method.
    pub method: Method,
    /// The arrival prior of the destinations that have none of their own.
    pub arrival: Arrival,
    /// How the arrival time is summed over.
    pub quadrature: Quadrature,
    /// Whether positions are observed, each axis by itself.
    pub observes_position: bool,
    /// Whether the first observation's evidence counts: likelihoods are of `y_1:k`, not of `y_2:k` given `y_1`.
    pub first_counts: bool,
    /// The first position, or the prior's where it was not observed: arrival times under Fitts's law depend on it.
    pub start: Vec<f64>,
}

impl Configuration {
    /// The arrival nodes of destinations.
    pub fn plan(&self, destinations: &Destinations) -> Plan {
        Plan::new(destinations, &self.arrival, &self.quadrature, &self.start)
    }

    /// What a snapshot keeps.
    pub fn save(&self) -> Value {
        Value::exact_numbers(&self.start)
    }

    /// The start that [`Configuration::save`] wrote.
    pub fn load(self, node: &Node<'_>) -> crate::error::Result<Self> {
        Ok(Self { start: node.exact_numbers(self.motion.dimensions())?, ..self })
    }
}
