//! `meanReverting`: the position reverts to the destination at the rate `rate`.
//!
//! ```text
//! dx = rate (c - x) dt + dw        F = e^-rh      B = 1 - e^-rh      Q = noise^2 (1 - e^-2rh) / (2 r),   r = rate
//! ```
//!
//! Source: Liang et al., after (1) (the Ornstein-Uhlenbeck process), and their \[13\], Ahmad et al., "Bayesian intent
//! prediction in object tracking using bridging distributions", IEEE Transactions on Cybernetics 48 (2018).

use super::{AxisTransition, MotionModel};
use crate::error::Result;
use crate::math::decay::decay;
use crate::value::Path;

/// Motion that reverts to the destination; `s = d`.
#[derive(Clone, Debug)]
pub struct MeanReverting {
    noise: Vec<f64>,
    rate: f64,
}

impl MeanReverting {
    pub fn new(at: &Path<'_>, noise: Vec<f64>, rate: f64) -> Result<Self> {
        Ok(Self { noise, rate: at.key("rate").positive(rate)? })
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
}
