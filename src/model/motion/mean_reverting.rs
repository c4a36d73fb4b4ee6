//! `meanReverting`: the position reverts to the destination at the rate `rate`.
//!
//! ```text
//! dx = rate (c - x) dt + dw        F = e^-rh      B = 1 - e^-rh      Q = noise^2 (1 - e^-2rh) / (2 r),   r = rate
//! ```
//!
//! Source: Liang et al., after (1) (the Ornstein-Uhlenbeck process), and their \[13\], Ahmad et al., "Bayesian intent
//! prediction in object tracking using bridging distributions", IEEE Transactions on Cybernetics 48 (2018).

use super::{AxisTransition, Kind, MotionModel, axis_value};
use crate::error::Result;
use crate::math::decay::decay;
use crate::value::{Fields, Value};
use std::sync::Arc;

pub(super) const KIND: (&str, Kind) = (
    "meanReverting",
    Kind {
        keys: &["type", "dimensions", "noise", "rate"],
        build: |fields, noise, _| Ok(Arc::new(MeanReverting::read(fields, noise)?)),
    },
);

/// Motion that reverts to the destination; `s = d`.
///
/// ```
/// use whither::{model::motion::Motion, value::{Node, Value}};
/// let value = Value::map([
///     ("type", Value::text("meanReverting")),
///     ("dimensions", Value::Number(1.0)),
///     ("noise", Value::Number(1.0)),
///     ("rate", Value::Number(2.0)),
/// ]);
/// let motion = Motion::read(&Node::root(&value, "motion")).unwrap();
/// assert!(motion.depends_on_destination());
/// let step = motion.candidates[0].model.transition(100.0);
/// assert_eq!(step.destination_gain.unwrap()[(0, 0)], 1.0); // after a long time it is there
/// ```
#[derive(Clone, Debug)]
pub struct MeanReverting {
    noise: Vec<f64>,
    rate: f64,
}

impl MeanReverting {
    fn read(fields: &Fields<'_>, noise: Vec<f64>) -> Result<Self> {
        Ok(Self { noise, rate: fields.positive("rate")? })
    }
}

impl MotionModel for MeanReverting {
    fn dimensions(&self) -> usize {
        self.noise.len()
    }

    fn states(&self) -> usize {
        self.noise.len()
    }

    fn depends_on_destination(&self) -> bool {
        true
    }

    fn axis(&self, axis: usize, step: f64) -> Option<AxisTransition> {
        let noise = self.noise.get(axis)?;
        let x = self.rate * step;
        let mut one = AxisTransition { states: 1, ..AxisTransition::default() };
        one.transition[0][0] = (-x).exp();
        one.destination_gain[0] = -(-x).exp_m1();
        one.noise[0][0] = noise * noise * step * decay(2.0 * x);
        Some(one)
    }

    fn to_value(&self) -> Value {
        Value::map([
            ("type", Value::text("meanReverting")),
            ("dimensions", Value::Number(self.noise.len() as f64)),
            ("noise", axis_value(&self.noise)),
            ("rate", Value::Number(self.rate)),
        ])
    }
}
