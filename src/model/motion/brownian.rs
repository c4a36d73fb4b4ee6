//! `brownian`: position alone, driven by white noise.
//!
//! ```text
//! dx = dw          F = 1          M = 0          Q = noise^2 h
//! ```
//!
//! Source: Liang (1) with `F` the identity; tied at both ends it is the Brownian bridge. `noise` is in units of length per
//! second^0.5.

use super::{AxisTransition, MotionModel};

/// Brownian motion; `s = d`.
#[derive(Clone, Debug)]
pub struct Brownian {
    noise: Vec<f64>,
}

impl Brownian {
    pub const fn new(noise: Vec<f64>) -> Self {
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
}
