//! Gaussian densities and conditioning, by roots of covariances.
//!
//! One conditioning on a linear observation serves everything here: the Kalman correction, Liang's pseudo-observation
//! (10) and (12), and the fixed-point smoother are all `x | z = H x + n + v`, `v ~ N(0, R)`.
//!
//! It works on a root `L` of `P = L L'` (Kailath, Sayed and Hassibi, "Linear Estimation", 12.3: the array form). Joseph's form
//! keeps a covariance positive only as long as its components span less than the sixteen digits of a double: a wide start
//! and tiny noise lose it. What is a root times its transpose is positive whatever the rounding.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// `ln(2 pi)`.
pub const LN_2_PI: f64 = 1.837_877_066_409_345_6;

/// A deviation whose square is no number with all its digits.
pub use whither_kernel::small_gaussian::VANISHING;

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
    cholesky: Cholesky<f64, Dyn>,
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
    pub fn new(covariance: DMatrix<f64>) -> Option<Self> {
        Self::of(Cholesky::new(covariance)?)
    }

    /// The factor of `L L'` for a lower triangular root; none if it is singular.
    #[must_use]
    pub fn of_root(root: DMatrix<f64>) -> Option<Self> {
        Self::of(Cholesky::pack_dirty(root))
    }

    fn of(cholesky: Cholesky<f64, Dyn>) -> Option<Self> {
        let n = cholesky.l_dirty().nrows();
        let log_root: f64 = (0..n).map(|i| cholesky.l_dirty()[(i, i)].ln()).sum();
        log_root.is_finite().then(|| Self { cholesky, log_normaliser: -log_root - 0.5 * n as f64 * LN_2_PI })
    }

    /// The log density of `N(0, S)` at `error`.
    #[must_use]
    #[inline(never)]
    pub fn log_density(&self, error: &DVector<f64>) -> f64 {
        let l = self.cholesky.l_dirty();
        let n = error.len();
        let mut sum = 0.0;
        let mut z = [0.0; 16];
        if n > z.len() {
            let solved = self.cholesky.l().solve_lower_triangular(error);
            return self.log_normaliser - 0.5 * solved.map_or(f64::INFINITY, |z| z.norm_squared());
        }
        for i in 0..n {
            let dot: f64 = (0..i).map(|j| l[(i, j)] * z[j]).sum();
            z[i] = (error[i] - dot) / l[(i, i)];
            sum += z[i] * z[i];
        }
        self.log_normaliser - 0.5 * sum
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
        self.cholesky.solve(b)
    }

    /// The lower triangular root `L`, `S = L L'`.
    #[must_use]
    pub fn root(&self) -> DMatrix<f64> {
        self.cholesky.l()
    }
}

/// Conditions a covariance `P` on a linear observation `z = H x + v`, `v ~ N(0, R)`; none if `S` is singular.
#[must_use]
pub fn condition(p: &DMatrix<f64>, h: &DMatrix<f64>, r: &DMatrix<f64>) -> Option<Conditioning> {
    condition_root(&root(p), h, r)
}

/// As [`condition`], for a root `L` of `P = L L'`: an orthogonal transformation turns
/// ```text
/// | R^1/2  H L |          | S^1/2      0  |
/// |   0     L  |   into   | K S^1/2    L+ |
/// ```
#[must_use]
#[inline(never)]
pub fn condition_root(l: &DMatrix<f64>, h: &DMatrix<f64>, r: &DMatrix<f64>) -> Option<Conditioning> {
    let (m, n) = h.shape();
    let mut array = DMatrix::zeros(m + n, m + n);
    array.view_mut((0, 0), (m, m)).copy_from(&root(r));
    array.view_mut((0, m), (m, n)).copy_from(&(h * l));
    array.view_mut((m, m), (n, n)).copy_from(l);
    let array = triangularise(array);
    let innovation_root = array.view((0, 0), (m, m)).into_owned();
    // K from K S^1/2, the last column first
    let mut gain = array.view((m, 0), (n, m)).into_owned();
    for j in (0..m).rev() {
        for i in 0..n {
            let others: f64 = (j + 1..m).map(|k| gain[(i, k)] * innovation_root[(k, j)]).sum();
            gain[(i, j)] = (gain[(i, j)] - others) / innovation_root[(j, j)];
        }
    }
    Some(Conditioning {
        gain,
        root: array.view((m, m), (n, n)).into_owned(),
        prediction_error: Factor::of_root(innovation_root)?,
    })
}

/// `L L'`, symmetric to the bit.
#[must_use]
pub fn square(root: &DMatrix<f64>) -> DMatrix<f64> {
    let mut squared = root * root.transpose();
    symmetrise(&mut squared);
    squared
}

/// A root of a positive semi-definite matrix, `P = A A'`: Cholesky's, with the largest pivot first and every component in
/// units of its own deviation, until what is left is rounding. Its columns are in the order of the pivots.
#[must_use]
#[inline(never)]
pub fn root(p: &DMatrix<f64>) -> DMatrix<f64> {
    let n = p.nrows();
    let deviations: Vec<f64> = (0..n).map(|i| if p[(i, i)] > 0.0 { p[(i, i)].sqrt() } else { 0.0 }).collect();
    let unit = |i: usize, j: usize| match deviations[i] * deviations[j] {
        0.0 => 0.0,
        scale => p[(i, j)] / scale,
    };
    let mut left = DMatrix::from_fn(n, n, unit);
    let mut root = DMatrix::zeros(n, n);
    for column in 0..n {
        let pivot = left.diagonal().imax();
        if left[(pivot, pivot)] <= n as f64 * f64::EPSILON {
            break;
        }
        let part = left.column(pivot) / left[(pivot, pivot)].sqrt();
        left.ger(-1.0, &part, &part, 1.0);
        left.row_mut(pivot).fill(0.0);
        left.column_mut(pivot).fill(0.0);
        root.set_column(column, &part);
    }
    for (i, deviation) in deviations.iter().enumerate() {
        root.row_mut(i).scale_mut(*deviation);
    }
    root
}

/// The lower triangular `L` with `L L' = A A'`, its diagonal not negative: reflections from the right, row by row.
#[must_use]
#[inline(never)]
pub fn triangularise(mut a: DMatrix<f64>) -> DMatrix<f64> {
    let (n, m) = a.shape();
    let mut reflector = vec![0.0; m];
    for i in 0..n.min(m) {
        let norm = a.row(i).columns(i, m - i).norm();
        if norm < VANISHING {
            (i..m).for_each(|j| a[(i, j)] = 0.0);
            continue;
        }
        let pivot = a[(i, i)];
        let diagonal = if pivot > 0.0 { -norm } else { norm };
        for j in i..m {
            reflector[j] = a[(i, j)];
            a[(i, j)] = 0.0;
        }
        reflector[i] = pivot - diagonal;
        // the reflected row's sign is turned with the column's, so that the diagonal is not negative
        a[(i, i)] = norm;
        let (scale, sign) = (1.0 / (norm * (norm + pivot.abs())), diagonal.signum());
        for r in i + 1..n {
            let dot = (i..m).map(|j| a[(r, j)] * reflector[j]).sum::<f64>() * scale;
            for j in i..m {
                a[(r, j)] -= dot * reflector[j];
            }
            a[(r, i)] *= sign;
        }
    }
    DMatrix::from_fn(n, n, |i, j| if j < m { a[(i, j)] } else { 0.0 })
}

/// `F P F' + Q`, kept symmetric.
#[must_use]
#[inline(never)]
pub fn propagate(f: &DMatrix<f64>, p: &DMatrix<f64>, q: &DMatrix<f64>) -> DMatrix<f64> {
    let mut covariance = f * p * f.transpose() + q;
    symmetrise(&mut covariance);
    covariance
}

/// Replaces a matrix by its symmetric part.
pub fn symmetrise(m: &mut DMatrix<f64>) {
    for i in 0..m.nrows() {
        for j in 0..i {
            let mean = 0.5 * (m[(i, j)] + m[(j, i)]);
            m[(i, j)] = mean;
            m[(j, i)] = mean;
        }
    }
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
        assert!((factor.log_density(&dvector![1.0, 0.0]) - expected).abs() < 1e-14);
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
