//! Models whose axes do not mix: each axis is a small filter of its own. Axes that are alike (one noise, one history of
//! observation noise) share all that does not depend on a mean.

use crate::math::small_root::{condition, triangularise};
use crate::model::motion::{AxisTransition, MotionModel};

/// The most components of one axis: position, velocity, acceleration.
pub const MOST: usize = 3;

const PAIR: usize = 2 * MOST;

/// The Kalman posterior of one axis over the pair (now, first observation), Liang (8) and the usual correction. The first
/// state rides along, and what is kept is a root of the covariance, as in [`crate::math::kalman`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisFilter {
    states: usize,
    /// The state now; the first one from `MOST` on.
    pub mean: [f64; PAIR],
    /// Lower triangular `L`, first the rows of the first state, then those of the state now: the covariance is `L L'`.
    pub root: [[f64; PAIR]; PAIR],
    /// The covariance of the state now.
    pub covariance: [[f64; MOST]; MOST],
}

/// What one observation of one axis does: the gain, and the prediction error's variance.
#[derive(Clone, Copy, Debug)]
struct Correction {
    gain: [f64; PAIR],
    spread: f64,
}

impl AxisFilter {
    /// A filter of an axis with so many components, all zero.
    pub fn new(states: usize) -> Self {
        let covariance = [[0.0; MOST]; MOST];
        Self { states: states.min(MOST), mean: [0.0; PAIR], root: [[0.0; PAIR]; PAIR], covariance }
    }

    /// How many components the axis has.
    pub const fn states(&self) -> usize {
        self.states
    }

    fn predict_mean(&mut self, step: &AxisTransition) {
        let before = self.mean;
        for i in 0..self.states {
            let mut moved = 0.0;
            for j in 0..self.states {
                moved += step.transition[i][j] * before[j];
            }
            self.mean[i] = step.offset[i] + moved;
        }
    }

    fn predict_covariance(&mut self, step: &AxisTransition) {
        let (s, before) = (self.states, self.root);
        let noise = root(&step.noise, s);
        // what the state now has of its own, and the noise beside it
        let mut own = [[0.0; PAIR]; MOST];
        for i in 0..s {
            for q in 0..s {
                let [mut first, mut now] = [0.0; 2];
                for m in 0..s {
                    first += step.transition[i][m] * before[s + m][q];
                    now += step.transition[i][m] * before[s + m][s + q];
                }
                self.root[s + i][q] = first;
                own[i][q] = now;
                own[i][s + q] = noise[i][q];
            }
        }
        triangularise(&mut own, s, 2 * s);
        for i in 0..s {
            for q in 0..s {
                self.root[s + i][s + q] = own[i][q];
            }
        }
        self.square();
    }

    /// The step, and the correction of the covariance where something is observed with this variance.
    fn advance(&mut self, step: &AxisTransition, variance: Option<f64>) -> Option<Correction> {
        self.predict_mean(step);
        self.predict_covariance(step);
        variance.map(|variance| self.correct_covariance(variance))
    }

    fn correct_covariance(&mut self, variance: f64) -> Correction {
        let s = self.states;
        let (by_row, spread) = condition(&mut self.root, 2 * s, s, variance);
        self.square();
        let mut gain = [0.0; PAIR];
        gain[..s].copy_from_slice(&by_row[s..2 * s]);
        gain[MOST..MOST + s].copy_from_slice(&by_row[..s]);
        Correction { gain, spread }
    }

    /// The covariance of the state now, from the root.
    pub fn square(&mut self) {
        let s = self.states;
        for i in 0..s {
            for j in 0..i + 1 {
                let mut entry = 0.0;
                for q in 0..s + j + 1 {
                    entry += self.root[s + i][q] * self.root[s + j][q];
                }
                self.covariance[i][j] = entry;
                self.covariance[j][i] = entry;
            }
        }
    }

    /// The prediction of mean and covariance alone, for what is not observed any more; the root stays.
    fn foresee(&mut self, step: &AxisTransition) {
        self.predict_mean(step);
        let (s, before) = (self.states, self.covariance);
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
                self.covariance[i][j] = entry;
            }
        }
    }

    fn correct_mean(&mut self, correction: &Correction, position: f64) -> f64 {
        let error = position - self.mean[0];
        for i in 0..self.states {
            self.mean[i] += correction.gain[i] * error;
            self.mean[MOST + i] += correction.gain[MOST + i] * error;
        }
        error
    }
}

/// A root of a positive semi-definite matrix, lower triangular.
fn root(p: &[[f64; MOST]; MOST], s: usize) -> [[f64; MOST]; MOST] {
    let mut root = [[0.0; MOST]; MOST];
    for j in 0..s {
        let mut diagonal = 0.0;
        for i in j..s {
            let mut left = p[i][j];
            for q in 0..j {
                left -= root[i][q] * root[j][q];
            }
            if i > j {
                root[i][j] = left / diagonal;
            } else if left > 4.0 * f64::EPSILON * p[j][j] {
                diagonal = left.sqrt();
                root[j][j] = diagonal;
            } else {
                break;
            }
        }
    }
    root
}

/// The filters of all axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// How many axes there are.
    pub dimensions: usize,
    /// A filter for each axis, and unused ones up to `MOST`.
    pub filters: [AxisFilter; MOST],
    /// Whether an axis moves as the first one does, offset included.
    pub alike: [bool; MOST],
    /// Whether an axis has moreover been observed as the first one has, so that all but its mean is the same.
    pub twins: [bool; MOST],
    /// `ln p(y_2:k | y_1)`.
    pub log_evidence: f64,
}

impl Axes {
    /// Filters for a model, none where its axes mix. Means and covariances are zero.
    pub fn new(model: &dyn MotionModel) -> Option<Self> {
        let mut filters = [AxisFilter::new(0); MOST];
        let mut alike = [true; MOST];
        for axis in 0..model.dimensions() {
            *filters.get_mut(axis)? = AxisFilter::new(model.axis(axis, 0.0)?.states);
            // a linear, time-invariant model that is the same over two steps is the same over all
            alike[axis] = [0.37, 1.0].iter().all(|&step| model.axis(axis, step) == model.axis(0, step));
        }
        Some(Self { dimensions: model.dimensions(), filters, alike, twins: [false; MOST], log_evidence: 0.0 })
    }

    /// Finds the twins, once every filter has its root and its covariance.
    pub fn find_twins(&mut self) {
        let [first, ..] = self.filters;
        for (axis, one) in self.filters.iter().enumerate() {
            let same = one.root == first.root && one.covariance == first.covariance;
            self.twins[axis] = self.alike[axis] && one.states == first.states && same;
        }
    }

    /// One observation, `step` seconds after the last: positions where observed, and their variances.
    pub fn advance(&mut self, model: &dyn MotionModel, step: f64, position: &[Option<f64>], variance: &[f64; MOST]) {
        let Some(transition) = model.axis(0, step) else { return };
        let (mut squares, mut spreads) = (0.0, 1.0);
        let mut leading = None;
        for axis in 0..self.dimensions {
            let observed = position.get(axis).copied().flatten();
            let (first, others) = self.filters.split_at_mut(axis.max(1));
            let correction = if axis == 0 {
                first[0].advance(&transition, observed.map(|_| variance[0]))
            } else if self.twins[axis] && observed.is_some() == leading.is_some() && variance[axis] == variance[0] {
                // all but its mean is there already
                others[0].predict_mean(&transition);
                (others[0].root, others[0].covariance) = (first[0].root, first[0].covariance);
                leading
            } else {
                self.twins[axis] = false;
                let Some(own) = model.axis(axis, step) else { return };
                others[0].advance(&own, observed.map(|_| variance[axis]))
            };
            if let (Some(y), Some(correction)) = (observed, &correction) {
                let error = self.filters[axis].correct_mean(correction, y);
                squares += error * error / correction.spread;
                spreads *= std::f64::consts::TAU * correction.spread;
            }
            if axis == 0 {
                leading = correction;
            }
        }
        self.log_evidence -= 0.5 * (squares + spreads.ln());
    }

    /// Turns the posterior of the first observation into what it says of the state `elapsed` after it: means and covariances.
    pub fn foresee(&mut self, model: &dyn MotionModel, elapsed: f64) {
        let Some(transition) = model.axis(0, elapsed) else { return };
        self.filters[0].foresee(&transition);
        for axis in 1..self.dimensions {
            if self.twins[axis] {
                self.filters[axis].predict_mean(&transition);
                self.filters[axis].covariance = self.filters[0].covariance;
            } else if let Some(transition) = model.axis(axis, elapsed) {
                self.filters[axis].foresee(&transition);
            }
        }
    }
}
