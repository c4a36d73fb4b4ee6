//! Models whose axes do not mix: each axis is a small filter of its own. Axes that are alike (one noise, one history of
//! observation noise) share all that does not depend on a mean.

use crate::mixture::AXES;
use crate::small_gaussian::axis_filter::{self, AxisFilters, Step};
use crate::small_gaussian::{Matrix, root};

/// The most components of one axis: position, velocity, acceleration.
pub const MOST: usize = 3;

/// The components of the first state and the state now.
pub const PAIR: usize = 2 * MOST;

/// The filter of one axis.
pub type AxisFilter = axis_filter::AxisFilter<MOST, PAIR>;

/// One step of one axis of a model whose axes do not mix, `x_k = F x_{k-1} + M + B c + e`, `e ~ N(0, Q)`, with at most three
/// components (position, velocity, acceleration). What lies beyond `states` is zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisTransition {
    /// How many components the axis has: 1, 2 or 3.
    pub states: usize,
    /// `F`.
    pub transition: [[f64; MOST]; MOST],
    /// `M`.
    pub offset: [f64; MOST],
    /// `B`, for this axis of the destination's centre; zero where the model does not know the destination.
    pub destination_gain: [f64; MOST],
    /// `Q`, symmetric.
    pub noise: [[f64; MOST]; MOST],
}

/// A step of `N` components: a constant, so that no loop over them is left.
struct Of<const N: usize>(AxisTransition);

impl<const N: usize> Of<N> {
    /// `F P F' + Q`.
    #[inline(always)]
    fn covariance(&self, before: &Matrix<MOST>) -> Matrix<MOST> {
        let AxisTransition { transition, noise, .. } = &self.0;
        let mut covariance = [[0.0; MOST]; MOST];
        for i in 0..N {
            let mut moved = [0.0; N];
            for j in 0..N {
                for m in 0..N {
                    moved[j] += transition[i][m] * before[m][j];
                }
            }
            for j in 0..N {
                let mut entry = noise[i][j];
                for m in 0..N {
                    entry += moved[m] * transition[j][m];
                }
                covariance[i][j] = entry;
            }
        }
        covariance
    }
}

impl<const N: usize> Step<MOST, PAIR> for Of<N> {
    #[inline(always)]
    fn states(&self) -> usize {
        N
    }

    #[inline(always)]
    fn mean(&self, x: &mut [f64; MOST]) {
        let before = *x;
        for i in 0..N {
            let mut moved = 0.0;
            for j in 0..N {
                moved += self.0.transition[i][j] * before[j];
            }
            x[i] = self.0.offset[i] + moved;
        }
    }

    #[inline(always)]
    fn root(&self, x: &mut [[f64; PAIR]; MOST]) {
        let before = *x;
        for i in 0..N {
            for q in 0..2 * N {
                let mut moved = 0.0;
                for j in 0..N {
                    moved += self.0.transition[i][j] * before[j][q];
                }
                x[i][q] = moved;
            }
        }
    }

    #[inline(always)]
    fn noise_root(&self) -> Matrix<MOST> {
        root(&self.0.noise, N)
    }
}

/// The states of all axes at one time: what of them the endpoints depend on.
#[derive(Clone, Copy, Debug)]
pub struct States<'a> {
    /// How many axes there are.
    pub dimensions: usize,
    /// The mean of each.
    pub means: [&'a [f64; MOST]; AXES],
    /// The covariance of each.
    pub covariances: [&'a Matrix<MOST>; AXES],
    /// Whether an axis moves as the first one does and has its covariance.
    pub twins: [bool; AXES],
}

/// The posterior of the first observation, or what it predicts for later.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Start {
    /// How many axes there are.
    pub dimensions: usize,
    /// How many components each has.
    pub components: usize,
    /// The mean of each.
    pub means: [[f64; MOST]; AXES],
    /// The covariance of each.
    pub covariances: [Matrix<MOST>; AXES],
    /// Whether an axis moves as the first one does and has its covariance.
    pub twins: [bool; AXES],
}

impl Start {
    /// Predicts over the step that `step` gives for an axis, `F m + M` and `F P F' + Q`. Where there is no step, the axes stay as they
    /// are.
    #[inline(never)]
    pub fn predict(&self, step: &dyn Fn(usize) -> Option<AxisTransition>, into: &mut Self) {
        into.clone_from(self);
        match self.components {
            2 => into.move_by(|axis| step(axis).map(Of::<2>)),
            // where there are fewer, the others are zero
            _ => into.move_by(|axis| step(axis).map(Of::<3>)),
        }
    }

    #[inline(always)]
    fn move_by<const N: usize>(&mut self, step: impl Fn(usize) -> Option<Of<N>>) {
        let Some(shared) = step(0) else { return };
        for axis in 0..self.dimensions {
            if self.twins[axis] {
                shared.mean(&mut self.means[axis]);
                self.covariances[axis] =
                    if axis == 0 { shared.covariance(&self.covariances[0]) } else { self.covariances[0] };
            } else if let Some(own) = step(axis) {
                own.mean(&mut self.means[axis]);
                self.covariances[axis] = own.covariance(&self.covariances[axis]);
            }
        }
    }

    /// The states.
    #[inline(always)]
    #[must_use]
    pub const fn states(&self) -> States<'_> {
        let ([x, y, z], [xx, yy, zz]) = (&self.means, &self.covariances);
        States { dimensions: self.dimensions, means: [x, y, z], covariances: [xx, yy, zz], twins: self.twins }
    }
}

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

impl Axes {
    /// One observation after the step that `step` gives for an axis: positions where observed, and their variances. Where there is
    /// no step, the axes stay as they are.
    #[inline(never)]
    pub fn advance(
        &mut self,
        step: &dyn Fn(usize) -> Option<AxisTransition>,
        position: &[Option<f64>],
        variance: &[f64; AXES],
    ) {
        let (mut squares, mut variances) = (0.0, 1.0);
        let innovation = |error: f64, variance: f64| {
            squares += error * error / variance;
            variances *= std::f64::consts::TAU * variance;
        };
        let filters = &mut self.filters;
        match filters[0].states() {
            1 => filters.advance(|axis| step(axis).map(Of::<1>), position, variance, innovation),
            2 => filters.advance(|axis| step(axis).map(Of::<2>), position, variance, innovation),
            _ => filters.advance(|axis| step(axis).map(Of::<3>), position, variance, innovation),
        }
        self.log_evidence -= 0.5 * (squares + variances.ln());
    }

    /// The states now.
    #[inline(always)]
    pub fn states(&self) -> States<'_> {
        let [x, y, z] = [&self.filters[0], &self.filters[1], &self.filters[2]];
        let twins = [true, self.filters.is_twin(1), self.filters.is_twin(2)];
        States {
            dimensions: self.filters.dimensions(),
            means: [&x.now, &y.now, &z.now],
            covariances: [&x.covariance, &y.covariance, &z.covariance],
            twins,
        }
    }
}
