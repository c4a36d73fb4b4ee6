//! `constantAcceleration`: the acceleration is driven by white noise.
//!
//! ```text
//! dx = v dt        F = | 1  h  h^2/2 |      M = 0      Q = noise^2 | h^5/20  h^4/8  h^3/6 |
//! dv = a dt            | 0  1  h     |                             | h^4/8   h^3/3  h^2/2 |
//! da = dw              | 0  0  1     |                             | h^3/6   h^2/2  h     |
//! ```
//!
//! Source: Bar-Shalom, Li and Kirubarajan, "Estimation with Applications to Tracking and Navigation", 6.2.3 (the
//! continuous Wiener process acceleration model). `noise` is in units of length per second^2.5.

use super::{AxisTransition, MotionModel};

/// Nearly constant acceleration; `s = 3d`.
#[derive(Clone, Debug)]
pub struct ConstantAcceleration {
    noise: Vec<f64>,
}

impl ConstantAcceleration {
    pub const fn new(noise: Vec<f64>) -> Self {
        Self { noise }
    }
}

impl MotionModel for ConstantAcceleration {
    fn dimensions(&self) -> usize {
        self.noise.len()
    }

    fn states(&self) -> usize {
        3 * self.noise.len()
    }

    fn axis(&self, axis: usize, step: f64) -> Option<AxisTransition> {
        let noise = self.noise.get(axis)?;
        let h = step;
        let h2 = h * h;
        let q = noise * noise * h;
        Some(AxisTransition {
            states: 3,
            transition: [[1.0, h, h2 / 2.0], [0.0, 1.0, h], [0.0, 0.0, 1.0]],
            noise: [
                [q * h2 * h2 / 20.0, q * h2 * h / 8.0, q * h2 / 6.0],
                [q * h2 * h / 8.0, q * h2 / 3.0, q * h / 2.0],
                [q * h2 / 6.0, q * h / 2.0, q],
            ],
            ..AxisTransition::default()
        })
    }
}
