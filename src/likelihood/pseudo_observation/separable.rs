//! Models whose axes do not mix: each axis is a small filter of its own. Axes that are alike (one noise, one history of
//! observation noise) share all that does not depend on a mean.

use crate::model::motion::{AxisTransition, MotionModel};
use whither_kernel::mixture::AXES;
use whither_kernel::small_gaussian::axis_filter::{self, AxisFilters, Step};
use whither_kernel::small_gaussian::{Matrix, root};

/// The most components of one axis: position, velocity, acceleration.
pub const MOST: usize = 3;

/// The components of the first state and the state now.
pub const PAIR: usize = 2 * MOST;

/// The filter of one axis.
pub type AxisFilter = axis_filter::AxisFilter<MOST, PAIR>;

/// The filters of all axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// The filter of each axis.
    pub filters: AxisFilters<MOST, PAIR>,
    /// Whether an axis moves as the first one does, offset included.
    pub alike: [bool; AXES],
    /// `ln p(y_2:k | y_1)`.
    pub log_evidence: f64,
}

/// How many components each axis of a model has, and which move as the first one does; none where its axes mix.
pub fn axes_of_model(model: &dyn MotionModel) -> Option<([usize; AXES], [bool; AXES])> {
    let (mut states, mut alike) = ([0; AXES], [true; AXES]);
    for axis in 0..model.dimensions() {
        *states.get_mut(axis)? = model.axis(axis, 0.0)?.states.min(MOST);
        // a linear, time-invariant model that is the same over two steps is the same over all
        alike[axis] = [0.37, 1.0].iter().all(|&step| model.axis(axis, step) == model.axis(0, step));
    }
    Some((states, alike))
}

impl Step<MOST, PAIR> for AxisTransition {
    fn states(&self) -> usize {
        self.states
    }

    fn mean(&self, x: &mut [f64; MOST]) {
        let before = *x;
        for i in 0..self.states {
            let mut moved = 0.0;
            for j in 0..self.states {
                moved += self.transition[i][j] * before[j];
            }
            x[i] = self.offset[i] + moved;
        }
    }

    fn root(&self, x: &mut [[f64; PAIR]; MOST]) {
        let before = *x;
        for i in 0..self.states {
            for q in 0..2 * self.states {
                let mut moved = 0.0;
                for j in 0..self.states {
                    moved += self.transition[i][j] * before[j][q];
                }
                x[i][q] = moved;
            }
        }
    }

    fn noise_root(&self) -> Matrix<MOST> {
        root(&self.noise, self.states)
    }
}

impl Axes {
    /// One observation, `step` seconds after the last: positions where observed, and their variances.
    pub fn advance(&mut self, model: &dyn MotionModel, step: f64, position: &[Option<f64>], variance: &[f64; AXES]) {
        let (mut squares, mut variances) = (0.0, 1.0);
        self.filters.advance(
            |axis| model.axis(axis, step),
            position,
            variance,
            |error, variance| {
                squares += error * error / variance;
                variances *= std::f64::consts::TAU * variance;
            },
        );
        self.log_evidence -= 0.5 * (squares + variances.ln());
    }

    /// Turns the posterior of the first observation into the prediction of the state `elapsed` after it: means and covariances.
    /// It is not observed any more, so the roots stay.
    pub fn propagate(&mut self, model: &dyn MotionModel, elapsed: f64) {
        let Some(shared) = model.axis(0, elapsed) else { return };
        propagate(&mut self.filters[0], &shared);
        for axis in 1..self.filters.dimensions() {
            if self.filters.is_twin(axis) {
                self.filters[axis].predict_mean(&shared);
                self.filters[axis].covariance = self.filters[0].covariance;
            } else if let Some(own) = model.axis(axis, elapsed) {
                propagate(&mut self.filters[axis], &own);
            }
        }
    }
}

/// The mean of the state now, and its covariance `F P F' + Q`.
fn propagate(filter: &mut AxisFilter, step: &AxisTransition) {
    filter.predict_mean(step);
    let (s, before) = (filter.states(), filter.covariance);
    for i in 0..s {
        let mut moved = [0.0; MOST];
        for j in 0..s {
            for m in 0..s {
                moved[j] += step.transition[i][m] * before[m][j];
            }
        }
        for j in 0..s {
            let mut entry = step.noise[i][j];
            for m in 0..s {
                entry += moved[m] * step.transition[j][m];
            }
            filter.covariance[i][j] = entry;
        }
    }
}
