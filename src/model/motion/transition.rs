//! One step of a motion model, of the state and of one axis.

use nalgebra::{DMatrix, DVector};
use std::fmt;
pub use whither_kernel::axes::AxisTransition;

/// One step of a motion model, `x_k = F x_{k-1} + M + B c + e`, `e ~ N(0, Q)`, with `c` the destination's centre.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// `F`, `s` by `s`.
    pub transition: DMatrix<f64>,
    /// `M`, of length `s`.
    pub offset: DVector<f64>,
    /// `B`, `s` by `d`; none where the model does not know the destination.
    pub destination_gain: Option<DMatrix<f64>>,
    /// `Q`, `s` by `s`, symmetric.
    pub noise: DMatrix<f64>,
}

/// A motion model: what it is over any step.
pub trait MotionModel: Send + Sync {
    /// Spatial dimensions `d`, 1 to 3.
    fn dimensions(&self) -> usize;

    /// State components `s`.
    fn states(&self) -> usize;

    /// Whether `B` is not zero: the movement knows where it is going.
    fn depends_on_destination(&self) -> bool {
        false
    }

    /// One step of one axis, `step >= 0` seconds; none where axes mix, or there is no such axis.
    fn axis(&self, axis: usize, step: f64) -> Option<AxisTransition>;

    /// One step of the state, `step >= 0` seconds. Zero gives the identity and no noise.
    fn transition(&self, step: f64) -> Transition {
        assemble(self.dimensions(), self.states(), self.depends_on_destination(), |axis| self.axis(axis, step))
    }
}

impl fmt::Debug for dyn MotionModel + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("MotionModel")
    }
}

/// The state's step from those of the axes: component `i` of axis `k` is at `i d + k`.
#[inline(never)]
fn assemble(
    dimensions: usize,
    states: usize,
    depends_on_destination: bool,
    axis: impl Fn(usize) -> Option<AxisTransition>,
) -> Transition {
    let mut joint = Transition {
        transition: DMatrix::zeros(states, states),
        offset: DVector::zeros(states),
        destination_gain: depends_on_destination.then(|| DMatrix::zeros(states, dimensions)),
        noise: DMatrix::zeros(states, states),
    };
    for k in 0..dimensions {
        let Some(one) = axis(k) else { continue };
        for i in 0..one.states {
            let row = i * dimensions + k;
            for j in 0..one.states {
                joint.transition[(row, j * dimensions + k)] = one.transition[i][j];
                joint.noise[(row, j * dimensions + k)] = one.noise[i][j];
            }
            joint.offset[row] = one.offset[i];
            if let Some(gain) = &mut joint.destination_gain {
                gain[(row, k)] = one.destination_gain[i];
            }
        }
    }
    joint
}
