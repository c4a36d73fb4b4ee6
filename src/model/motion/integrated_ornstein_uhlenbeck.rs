//! `integratedOrnsteinUhlenbeck`: the velocity reverts to `drift` at the rate `damping` while noise drives it.
//!
//! ```text
//! dx = v dt                              F = | 1  (1 - e^-x) / damping |      M = drift | h - (1 - e^-x) / damping |
//! dv = damping (drift - v) dt + dw           | 0   e^-x                |                | 1 - e^-x                |
//!
//! x = damping h      Q = noise^2 | (h - 2 (1 - e^-x) / damping + (1 - e^-2x) / (2 damping)) / damping^2      . |
//!                                | (1 - e^-x)^2 / (2 damping^2)                      (1 - e^-2x) / (2 damping) |
//! ```
//!
//! Source: Liang's \[7\], Millefiori et al., "Modeling vessel kinematics using a stochastic mean-reverting process for
//! long-term prediction", IEEE Transactions on Aerospace and Electronic Systems 52 (2016). Without damping it is
//! `constantVelocity`. The quotients come from [`math::decay`](crate::math::decay), exact for small `x`.

use super::super::per_axis::PerAxis;
use super::{AxisTransition, MotionModel};
use crate::error::Result;
use crate::math::decay::{decay, decay_ramp, decay_square};
use crate::value::Path;

/// Integrated Ornstein-Uhlenbeck motion; `s = 2d`.
#[derive(Clone, Debug)]
pub struct IntegratedOrnsteinUhlenbeck {
    noise: Vec<f64>,
    damping: f64,
    drift: Vec<f64>,
}

impl IntegratedOrnsteinUhlenbeck {
    pub fn new(at: &Path<'_>, noise: Vec<f64>, damping: f64, drift: &PerAxis) -> Result<Self> {
        let damping = at.key("damping").not_negative(damping)?;
        let drift = drift.check(&at.key("drift"), noise.len(), |at, x| at.number(x))?;
        Ok(Self { noise, damping, drift })
    }
}

impl MotionModel for IntegratedOrnsteinUhlenbeck {
    fn dimensions(&self) -> usize {
        self.noise.len()
    }

    fn states(&self) -> usize {
        2 * self.noise.len()
    }

    fn axis(&self, axis: usize, step: f64) -> Option<AxisTransition> {
        let (noise, drift) = (self.noise.get(axis)?, self.drift.get(axis)?);
        let (h, q) = (step, noise * noise);
        let x = self.damping * h;
        let once = decay(x);
        let covariance = q * h * h * once * once / 2.0;
        Some(AxisTransition {
            states: 2,
            transition: [[1.0, h * once, 0.0], [0.0, (-x).exp(), 0.0], [0.0; 3]],
            offset: [drift * h * x * decay_ramp(x), -drift * (-x).exp_m1(), 0.0],
            noise: [
                [q * h * h * h * decay_square(x), covariance, 0.0],
                [covariance, q * h * decay(2.0 * x), 0.0],
                [0.0; 3],
            ],
            ..AxisTransition::default()
        })
    }
}
