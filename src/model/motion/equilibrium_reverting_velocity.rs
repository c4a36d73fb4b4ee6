//! `equilibriumRevertingVelocity`: a damped spring pulls towards the destination.
//!
//! ```text
//! dx = v dt                                        A = |  0           1       |      B = | 0         |      W = | 0  0       |
//! dv = (stiffness (c - x) - damping v) dt + dw         | -stiffness  -damping |          | stiffness |          | 0  noise^2 |
//!
//! F = exp(A h)      B(h) = int_0^h exp(A u) B du      Q(h) = int_0^h exp(A u) W exp(A' u) du
//! ```
//!
//! Source: a model of the Ornstein-Uhlenbeck type as in Liang's \[13\], Ahmad et al., "Bayesian intent prediction in object
//! tracking using bridging distributions", IEEE Transactions on Cybernetics 48 (2018).
//!
//! The closed forms differ between the underdamped, critical and overdamped spring, and each of them cancels somewhere
//! (short steps, near the critical damping, almost no damping). [`whither_kernel::van_loan`] is as accurate in all of them, so it is the
//! one form here; the tests compare it with the closed forms, computed with 150 digits.

use super::{AxisTransition, MotionModel};
use crate::error::Result;
use crate::math::van_loan::series;
use crate::value::Path;
use nalgebra::DMatrix;
use whither_kernel::van_loan::Series;

/// A damped spring towards the destination; `s = 2d`.
#[derive(Clone, Debug)]
pub struct EquilibriumRevertingVelocity {
    noise: Vec<f64>,
    stiffness: f64,
    /// One axis, driven by noise of unit density.
    equation: Series,
}

impl EquilibriumRevertingVelocity {
    pub fn new(at: &Path<'_>, noise: Vec<f64>, stiffness: f64, damping: f64) -> Result<Self> {
        let stiffness = at.key("stiffness").positive(stiffness)?;
        let damping = at.key("damping").not_negative(damping)?;
        let drift = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -stiffness, -damping]);
        let diffusion = DMatrix::from_row_slice(2, 2, &[0.0, 0.0, 0.0, 1.0]);
        Ok(Self { noise, stiffness, equation: series(&drift, &diffusion) })
    }
}

impl MotionModel for EquilibriumRevertingVelocity {
    fn dimensions(&self) -> usize {
        self.noise.len()
    }

    fn states(&self) -> usize {
        2 * self.noise.len()
    }

    fn depends_on_destination(&self) -> bool {
        true
    }

    fn axis(&self, axis: usize, step: f64) -> Option<AxisTransition> {
        let noise = self.noise.get(axis)?;
        let over = self.equation.step(step);
        let mut one = AxisTransition { states: 2, ..AxisTransition::default() };
        for i in 0..2 {
            for j in 0..2 {
                one.transition[i][j] = over.transition[i + 2 * j];
                one.noise[i][j] = noise * noise * over.noise[i + 2 * j];
            }
            one.destination_gain[i] = self.stiffness * over.integral[i + 2];
        }
        Some(one)
    }
}
