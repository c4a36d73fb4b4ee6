//! `constantVelocity`: the velocity is driven by white noise.
//!
//! ```text
//! dx = v dt        F = | 1  h |      M = 0      Q = noise^2 | h^3/3  h^2/2 |
//! dv = dw              | 0  1 |                             | h^2/2  h     |
//! ```
//!
//! Source: Liang et al., after (1); Bar-Shalom, Li and Kirubarajan, "Estimation with Applications to Tracking and
//! Navigation", 6.2.2 (the continuous white-noise acceleration model). `noise` is in units of length per second^1.5.

use super::{AxisTransition, MotionModel};

/// Nearly constant velocity; `s = 2d`.
#[derive(Clone, Debug)]
pub struct ConstantVelocity {
    noise: Vec<f64>,
}

impl ConstantVelocity {
    pub const fn new(noise: Vec<f64>) -> Self {
        Self { noise }
    }
}

impl MotionModel for ConstantVelocity {
    fn dimensions(&self) -> usize {
        self.noise.len()
    }

    fn states(&self) -> usize {
        2 * self.noise.len()
    }

    fn axis(&self, axis: usize, step: f64) -> Option<AxisTransition> {
        let noise = self.noise.get(axis)?;
        let (h, q) = (step, noise * noise);
        Some(AxisTransition {
            states: 2,
            transition: [[1.0, h, 0.0], [0.0, 1.0, 0.0], [0.0; 3]],
            noise: [[q * h * h * h / 3.0, q * h * h / 2.0, 0.0], [q * h * h / 2.0, q * h, 0.0], [0.0; 3]],
            ..AxisTransition::default()
        })
    }
}
