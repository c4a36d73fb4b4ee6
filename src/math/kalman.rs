//! The Kalman filter over the pair (state at the first observation, state now).
//!
//! Liang (8) and the usual correction, in the array form: what is kept is a root of the covariance. The first state is kept beside
//! the present one, so that the filter is also the fixed-point smoother of Ardeshiri, section 3. Covariances and gains depend on no value: one of each serves every column of means. There is
//! one column where the motion model does not know the destination, and one for each destination where it does.

use super::gaussian::{Factor, Gaussian, root, square_rows, triangularise};
use nalgebra::{DMatrix, DVector};
use whither_kernel::dense;
use whither_kernel::dense::filter::{Pair, Room};

/// A linear observation `y = G x + v`, `v ~ N(0, V)`, as it was made: missing axes have no row.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// `y`, of length `m`; zero where nothing was measured at all.
    pub value: DVector<f64>,
    /// `G`, `m` by `s`.
    pub matrix: DMatrix<f64>,
    /// `V`, `m` by `m`.
    pub noise: DMatrix<f64>,
}

impl Measurement {
    /// The prediction error of a predicted state, `y - G x`.
    #[must_use]
    pub fn error(&self, state: &DVector<f64>) -> DVector<f64> {
        let mut error = self.value.clone();
        error.gemv(-1.0, &self.matrix, state, 1.0);
        error
    }
}

/// Mean columns and a root of one covariance of `[x_1; x_k]`, and the log evidence `log p(y_2:k | y_1)` of each column.
#[derive(Clone, Debug, PartialEq)]
pub struct Filter {
    /// Number of components `s` of one state.
    pub states: usize,
    /// `2 s` rows; one column, or one for each destination.
    pub means: DMatrix<f64>,
    /// `L`, `2 s` by `2 s` and lower triangular: the covariance is `L L'`.
    pub root: DMatrix<f64>,
    /// `log p(y_2:k | y_1)`, one for each column.
    pub log_evidence: Vec<f64>,
    room: Room,
}

/// The time update of a filter: `x_k = F x_{k-1} + M + e`, `e ~ N(0, Q)`, with `M` one column or one for each destination.
#[derive(Clone, Debug)]
pub struct TimeUpdate<'a> {
    /// `F`.
    pub transition: &'a DMatrix<f64>,
    /// `M`, with as many columns as the filter has, or one for all.
    pub offsets: &'a DMatrix<f64>,
    /// `Q`.
    pub noise: &'a DMatrix<f64>,
}

impl Filter {
    /// A filter at the first observation, whose posterior is `first`, with `columns` equal columns.
    #[must_use]
    pub fn new(first: &Gaussian, columns: usize) -> Self {
        let s = first.mean.len();
        let pair = DVector::from_fn(2 * s, |i, _| first.mean[i % s]);
        // Cholesky's own order keeps what is uncorrelated uncorrelated to the bit
        let one = Factor::new(first.covariance.clone())
            .map_or_else(|| triangularise(root(&first.covariance)), Factor::into_root);
        Self {
            states: s,
            means: DMatrix::from_fn(2 * s, columns, |i, _| pair[i]),
            root: DMatrix::from_fn(2 * s, 2 * s, |i, j| if j < s { one[(i % s, j)] } else { 0.0 }),
            log_evidence: vec![0.0; columns],
            room: Room::default(),
        }
    }

    /// The column that serves destination `i`.
    #[must_use]
    pub fn column(&self, i: usize) -> usize {
        if self.means.ncols() == 1 { 0 } else { i }
    }

    /// The mean of the state now, for destination `i`.
    #[must_use]
    pub fn mean(&self, i: usize) -> DVector<f64> {
        self.means.column(self.column(i)).rows(self.states, self.states).into_owned()
    }

    /// The covariance of the state now.
    #[must_use]
    pub fn current_covariance(&self) -> DMatrix<f64> {
        square_rows(&self.root, self.states, self.states)
    }

    /// The mean of [`Filter::smoothed_start`].
    #[must_use]
    pub fn start_mean(&self, i: usize) -> DVector<f64> {
        self.means.column(self.column(i)).rows(0, self.states).into_owned()
    }

    /// The smoothed state at the first observation, `p(x_1 | y_1:k)`, for destination `i`.
    #[must_use]
    pub fn smoothed_start(&self, i: usize) -> Gaussian {
        Gaussian { mean: self.start_mean(i), covariance: square_rows(&self.root, 0, self.states) }
    }

    /// `log p(y_2:k | y_1)` under destination `i`'s motion.
    #[must_use]
    pub fn evidence(&self, i: usize) -> f64 {
        self.log_evidence[self.column(i)]
    }

    /// Whether every number is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        [self.means.as_slice(), self.root.as_slice(), &self.log_evidence].into_iter().all(dense::is_finite)
    }

    fn parts(&mut self) -> (Pair<'_>, &mut Room) {
        let Self { states, means, root, log_evidence, room } = self;
        (Pair { states: *states, root: root.as_mut_slice(), means: means.as_mut_slice(), log_evidence }, room)
    }

    /// Liang (8): the prediction of the next state.
    pub fn predict(&mut self, step: &TimeUpdate<'_>) {
        let (mut pair, room) = self.parts();
        pair.predict(step.transition.as_slice(), step.offsets.as_slice(), step.noise.as_slice(), room);
    }

    /// The Kalman correction with a measurement. Where its prediction error has no density (a singular covariance, which a
    /// positive definite `V` excludes) the state stays and the answer is false.
    pub fn correct(&mut self, measurement: &Measurement) -> bool {
        let Measurement { value, matrix, noise } = measurement;
        let (mut pair, room) = self.parts();
        value.is_empty() || pair.correct(value.as_slice(), matrix.as_slice(), noise.as_slice(), room)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::gaussian::Factor;
    use nalgebra::{dmatrix, dvector};

    /// A random walk observed three times, against the joint density of the observations written out by hand.
    #[test]
    fn evidence_is_the_batch_density_of_the_observations() {
        let first = Gaussian { mean: dvector![0.5], covariance: dmatrix![2.0] };
        let (q, v) = (0.7, 0.3);
        let mut filter = Filter::new(&first, 1);
        let (f, zero, noise) = (dmatrix![1.0], dmatrix![0.0], dmatrix![q]);
        for y in [1.0, -0.4] {
            filter.predict(&TimeUpdate { transition: &f, offsets: &zero, noise: &noise });
            let value = dvector![y];
            assert!(filter.correct(&Measurement { value, matrix: dmatrix![1.0], noise: dmatrix![v] }));
        }
        let joint = dmatrix![2.0 + q + v, 2.0 + q; 2.0 + q, 2.0 + 2.0 * q + v];
        let expected = Factor::new(joint.clone()).unwrap().log_density(dvector![0.5, -0.9]);
        assert!((filter.log_evidence[0] - expected).abs() < 1e-14);
        // the start given both: cov(x_1, y) = 2 for each
        let weights = joint.try_inverse().unwrap() * dvector![2.0, 2.0];
        let start = filter.smoothed_start(0);
        assert!((start.mean[0] - (0.5 + weights.dot(&dvector![0.5, -0.9]))).abs() < 1e-14);
        assert!((start.covariance[(0, 0)] - (2.0 - weights.dot(&dvector![2.0, 2.0]))).abs() < 1e-14);
    }
}
