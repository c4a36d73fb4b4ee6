//! Gaussian densities and conditioning, by roots of covariances.
//!
//! One conditioning on a linear observation serves everything here: the Kalman correction, Liang's pseudo-observation
//! (10) and (12), and the fixed-point smoother are all `x | z = H x + n + v`, `v ~ N(0, R)`.
//!
//! It works on a root `L` of `P = L L'` (Kailath, Sayed and Hassibi, "Linear Estimation", 12.3: the array form). Joseph's form
//! keeps a covariance positive only as long as its components span less than the sixteen digits of a double: a wide start
//! and tiny noise lose it. What is a root times its transpose is positive whatever the rounding.

use nalgebra::{DMatrix, DVector};
use whither_kernel::dense;

pub use whither_kernel::dense::filter::LN_2_PI;

/// A Gaussian over a vector: mean and covariance.
///
/// ```
/// use whither::{Arrival, Destination, Gaussian, Motion, Observation, Predictor, Scenario};
/// let scenario = Scenario::builder(Motion::brownian(1, 1.0), Observation::deviation(0.5))
///     .arrival(Arrival::uniform(1.0, 5.0))
///     .destination(Destination::new("there", [9.0]).size(1.0))
///     .build()?;
/// let mut predictor = Predictor::new(&scenario);
/// predictor.observe(0.0, &[0.0])?;
/// let Some(Gaussian { mean, covariance }) = predictor.forecast(1.0)? else { panic!("it was observed") };
/// assert!(mean[0] > 1.0 && mean[0] < 9.0); // on its way
/// assert!(covariance[(0, 0)] > 0.5 * 0.5);
/// # Ok::<(), whither::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Gaussian {
    /// The mean, of length `n`.
    pub mean: DVector<f64>,
    /// The covariance, `n` by `n`.
    pub covariance: DMatrix<f64>,
}

/// A Gaussian state given a linear observation: gain, corrected covariance, and the density of predicted
/// observations. It depends on no value, only on covariances, so one of it serves every mean.
#[derive(Clone, Debug)]
pub struct Conditioning {
    /// The gain `K = P H' S^-1`.
    pub gain: DMatrix<f64>,
    /// A root of the covariance after the observation, `P+ = L L'`, lower triangular.
    pub root: DMatrix<f64>,
    /// The prediction error's covariance `S = H P H' + R`, factored.
    pub prediction_error: Factor,
}

/// A covariance factored by Cholesky.
#[derive(Clone, Debug)]
pub struct Factor {
    /// The lower triangular root `L`, `S = L L'`.
    root: DMatrix<f64>,
    log_normaliser: f64,
}

impl Conditioning {
    /// The covariance after the observation.
    #[must_use]
    pub fn covariance(&self) -> DMatrix<f64> {
        square(&self.root)
    }
}

impl Factor {
    /// Factors a covariance; none if it is not positive definite.
    #[must_use]
    #[inline(never)]
    pub fn new(mut covariance: DMatrix<f64>) -> Option<Self> {
        let size = covariance.nrows();
        dense::cholesky(covariance.as_mut_slice(), size).then(|| Self::of_root(covariance))?
    }

    /// The factor of `L L'` for a lower triangular root; none if it is singular.
    #[must_use]
    fn of_root(root: DMatrix<f64>) -> Option<Self> {
        let n = root.nrows();
        let log_root: f64 = (0..n).map(|i| root[(i, i)].ln()).sum();
        log_root.is_finite().then(|| Self { root, log_normaliser: -log_root - 0.5 * n as f64 * LN_2_PI })
    }

    /// The log density of `N(0, S)` at `error`.
    #[must_use]
    #[inline(never)]
    pub fn log_density(&self, mut error: DVector<f64>) -> f64 {
        let square = dense::squared_distance(self.root.as_slice(), self.root.nrows(), error.as_mut_slice());
        self.log_normaliser - 0.5 * square
    }

    /// `ln` of the density's factor before the exponential: `-ln sqrt(det(2 pi S))`.
    #[must_use]
    pub const fn log_normaliser(&self) -> f64 {
        self.log_normaliser
    }

    /// `S^-1 B`.
    #[must_use]
    #[inline(never)]
    pub fn solve(&self, b: &DMatrix<f64>) -> DMatrix<f64> {
        let (root, size, mut solved) = (self.root.as_slice(), b.nrows(), b.clone());
        dense::solve_lower(root, size, size, solved.as_mut_slice());
        dense::solve_upper(root, size, solved.as_mut_slice());
        solved
    }

    /// The lower triangular root `L`, `S = L L'`.
    #[must_use]
    pub fn into_root(self) -> DMatrix<f64> {
        self.root
    }
}

/// Conditions a covariance `P` on a linear observation `z = H x + v`, `v ~ N(0, R)`; none if `S` is singular.
#[must_use]
pub fn condition(p: &DMatrix<f64>, h: &DMatrix<f64>, r: &DMatrix<f64>) -> Option<Conditioning> {
    condition_root(&root(p), h, r)
}

/// As [`condition`], for a root `L` of `P = L L'`.
#[must_use]
#[inline(never)]
pub fn condition_root(l: &DMatrix<f64>, h: &DMatrix<f64>, r: &DMatrix<f64>) -> Option<Conditioning> {
    let (m, n) = h.shape();
    let mut array = dense::Conditioning::default();
    array.set(l.as_slice(), n, h.as_slice(), r.as_slice(), m).then(|| {
        Some(Conditioning {
            gain: DMatrix::from_iterator(n, m, array.gain()),
            root: DMatrix::from_iterator(n, n, array.root()),
            prediction_error: Factor::of_root(DMatrix::from_iterator(m, m, array.prediction_error()))?,
        })
    })?
}

/// `L L'`, symmetric to the bit.
#[must_use]
pub fn square(root: &DMatrix<f64>) -> DMatrix<f64> {
    square_rows(root, 0, root.nrows())
}

/// The same of so many rows, from this one on.
#[must_use]
pub fn square_rows(root: &DMatrix<f64>, from: usize, size: usize) -> DMatrix<f64> {
    let mut squared = DMatrix::zeros(size, size);
    dense::square(root.as_slice(), root.nrows(), from, size, squared.as_mut_slice());
    squared
}

/// A root of a positive semi-definite matrix, `P = A A'`: Cholesky's, with the largest pivot first and every component in
/// units of its own deviation, until what is left is rounding. Its columns are in the order of the pivots.
#[must_use]
pub fn root(p: &DMatrix<f64>) -> DMatrix<f64> {
    let mut root = DMatrix::zeros(p.nrows(), p.nrows());
    dense::root(p.as_slice(), p.nrows(), &mut Vec::new(), root.as_mut_slice());
    root
}

/// The lower triangular `L` with `L L' = A A'`, its diagonal not negative: reflections from the right, row by row.
#[must_use]
pub fn triangularise(mut a: DMatrix<f64>) -> DMatrix<f64> {
    let rows = a.nrows();
    dense::triangularise(a.as_mut_slice(), rows, &mut Vec::new());
    let mut numbers: Vec<f64> = a.data.into();
    numbers.resize(rows * rows, 0.0);
    DMatrix::from_vec(rows, rows, numbers)
}

/// `F P F' + Q`, symmetric to the bit.
#[must_use]
pub fn propagate(f: &DMatrix<f64>, p: &DMatrix<f64>, q: &DMatrix<f64>) -> DMatrix<f64> {
    let mut covariance = q.clone();
    let into = covariance.as_mut_slice();
    dense::propagate(f.as_slice(), f.nrows(), p.as_slice(), q.as_slice(), &mut Vec::new(), into);
    covariance
}

/// Replaces a matrix by its symmetric part.
pub fn symmetrise(matrix: &mut DMatrix<f64>) {
    let size = matrix.nrows();
    dense::symmetrise(matrix.as_mut_slice(), size);
}

/// Whether a matrix is symmetric to rounding.
#[must_use]
pub fn is_symmetric(m: &DMatrix<f64>) -> bool {
    let scale = m.amax();
    m.is_square() && (0..m.nrows()).all(|i| (0..i).all(|j| (m[(i, j)] - m[(j, i)]).abs() <= 1e-9 * scale))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn density_of_a_correlated_pair() {
        // by hand: S = [[2, 1], [1, 2]], det 3, S^-1 = [[2, -1], [-1, 2]] / 3, e = (1, 0): e'S^-1 e = 2/3
        let factor = Factor::new(dmatrix![2.0, 1.0; 1.0, 2.0]).unwrap();
        let expected = -LN_2_PI - 0.5 * 3f64.ln() - 1.0 / 3.0;
        assert!((factor.log_density(dvector![1.0, 0.0]) - expected).abs() < 1e-14);
    }

    #[test]
    fn an_indefinite_matrix_has_no_factor() {
        assert!(Factor::new(dmatrix![1.0, 2.0; 2.0, 1.0]).is_none());
        assert!(Factor::new(dmatrix![f64::NAN]).is_none());
    }

    #[test]
    fn roots_and_triangles_keep_the_square() {
        // the second component is twice the first, the third is free, the fourth nothing
        let covariance = dmatrix![4.0, 8.0, 1.0, 0.0; 8.0, 16.0, 2.0, 0.0; 1.0, 2.0, 3.0, 0.0; 0.0, 0.0, 0.0, 0.0];
        let root = root(&covariance);
        assert!((square(&root) - &covariance).amax() < 1e-14);
        let triangle = triangularise(root);
        assert!((square(&triangle) - &covariance).amax() < 1e-14);
        for i in 0..4 {
            assert!(triangle[(i, i)] >= 0.0 && (i + 1..4).all(|j| triangle[(i, j)] == 0.0), "{triangle}");
        }
    }

    #[test]
    fn two_observations_one_after_the_other_are_one_of_both() {
        let p = dmatrix![3.0, 0.5, 0.2; 0.5, 2.0, 0.1; 0.2, 0.1, 1.0];
        let h = dmatrix![1.0, 0.0, 0.5; 0.0, 1.0, 0.0];
        let r = dmatrix![0.3, 0.0; 0.0, 0.7];
        let both = condition(&p, &h, &r).unwrap();
        let row = |i: usize| h.rows(i, 1).into_owned();
        let first = condition(&p, &row(0), &dmatrix![0.3]).unwrap();
        let second = condition(&first.covariance(), &row(1), &dmatrix![0.7]).unwrap();
        assert!((both.covariance() - second.covariance()).amax() < 1e-14);
    }
}
