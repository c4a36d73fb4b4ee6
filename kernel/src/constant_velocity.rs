//! The filter step of the pointing model: constant velocity, axis by axis.

use crate::mixture::AXES;
use crate::small_gaussian::axis_filter::{AxisFilters, Step};

/// Constant velocity over so many seconds, with white noise of this spectral density.
#[derive(Clone, Copy, Debug)]
pub struct ConstantVelocity {
    /// How long.
    pub seconds: f64,
    /// The spectral density.
    pub noise: f64,
}

impl Step<2, 4> for ConstantVelocity {
    #[inline(always)]
    fn states(&self) -> usize {
        2
    }

    #[inline(always)]
    fn mean(&self, [position, velocity]: &mut [f64; 2]) {
        *position += self.seconds * *velocity;
    }

    #[inline(always)]
    fn root(&self, [position, velocity]: &mut [[f64; 4]; 2]) {
        for q in 0..4 {
            position[q] += self.seconds * velocity[q];
        }
    }

    #[inline(always)]
    fn noise_root(&self) -> [[f64; 2]; 2] {
        let scale = (self.noise * self.seconds).sqrt();
        [[scale * (self.seconds * (1.0 / 3.0f64).sqrt()), 0.0], [scale * 0.75f64.sqrt(), scale * 0.5]]
    }
}

impl ConstantVelocity {
    /// Takes in one observation after the step: positions where observed, and their variances.
    #[inline(never)]
    pub fn advance(&self, axes: &mut AxisFilters<2, 4>, position: &[Option<f64>; AXES], variances: &[f64; AXES]) {
        axes.advance(|_| Some(*self), position, variances, |_, _| {});
    }
}
