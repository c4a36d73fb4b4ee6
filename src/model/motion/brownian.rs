//! `brownian`: position alone, driven by white noise.
//!
//! ```text
//! dx = dw          F = 1          M = 0          Q = noise^2 h
//! ```
//!
//! Source: Liang (1) with `F` the identity; tied at both ends it is the Brownian bridge. `noise` is in units of length per
//! second^0.5.

use super::{AxisTransition, Kind, MotionModel, axis_value};
use crate::value::Value;
use std::sync::Arc;

pub(super) const KIND: (&str, Kind) = (
    "brownian",
    Kind { keys: &["type", "dimensions", "noise"], build: |_, noise, _| Ok(Arc::new(Brownian::new(noise))) },
);

/// Brownian motion; `s = d`.
///
/// ```
/// use whither::{Value, model::motion::Motion, value::Node};
/// let value: Value = serde_json::from_str(r#"{ "type": "brownian", "dimensions": 1, "noise": 3 }"#).unwrap();
/// let motion = Motion::read(&Node::root(&value, "motion")).unwrap();
/// let step = motion.candidates[0].model.transition(2.0);
/// assert_eq!((step.transition[(0, 0)], step.noise[(0, 0)]), (1.0, 18.0)); // 3^2 2
/// ```
#[derive(Clone, Debug)]
pub struct Brownian {
    noise: Vec<f64>,
}

impl Brownian {
    const fn new(noise: Vec<f64>) -> Self {
        Self { noise }
    }
}

impl MotionModel for Brownian {
    fn dimensions(&self) -> usize {
        self.noise.len()
    }

    fn states(&self) -> usize {
        self.noise.len()
    }

    fn axis(&self, axis: usize, step: f64) -> Option<AxisTransition> {
        let noise = self.noise.get(axis)?;
        let mut one = AxisTransition { states: 1, ..AxisTransition::default() };
        one.transition[0][0] = 1.0;
        one.noise[0][0] = noise * noise * step;
        Some(one)
    }

    fn to_value(&self) -> Value {
        Value::map([
            ("type", Value::text("brownian")),
            ("dimensions", Value::Number(self.noise.len() as f64)),
            ("noise", axis_value(&self.noise)),
        ])
    }
}
