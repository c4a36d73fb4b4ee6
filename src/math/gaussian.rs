//! Gaussian densities and conditioning, by Cholesky.
//!
//! One conditioning on a linear observation serves everything here: the Kalman correction, Liang's pseudo-observation
//! (10) and (12), and the fixed-point smoother are all `x | z = H x + n + v`, `v ~ N(0, R)`.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// `ln(2 pi)`.
pub const LN_2_PI: f64 = 1.837_877_066_409_345_6;

/// A Gaussian over a vector: mean and covariance.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use whither::math::gaussian::{Gaussian, condition};
/// let prior = Gaussian { mean: dvector![0.0], covariance: dmatrix![4.0] };
/// // 5 is observed, with the variance 1
/// let seen = condition(&prior.covariance, &dmatrix![1.0], &dmatrix![1.0]).unwrap();
/// let posterior = Gaussian { mean: seen.gain * dvector![5.0], covariance: seen.covariance };
/// assert!((posterior.mean[0] - 4.0).abs() < 1e-14 && (posterior.covariance[(0, 0)] - 0.8).abs() < 1e-14);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Gaussian {
    /// The mean, of length `n`.
    pub mean: DVector<f64>,
    /// The covariance, `n` by `n`.
    pub covariance: DMatrix<f64>,
}

/// What a linear observation says of a Gaussian state: gain, corrected covariance, and the density of predicted
/// observations. It depends on no value, only on covariances, so one of it serves every mean.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use whither::math::gaussian::condition;
/// // position and velocity, uncorrelated: seeing the position says nothing of the velocity
/// let seen = condition(&dmatrix![3.0, 0.0; 0.0, 7.0], &dmatrix![1.0, 0.0], &dmatrix![1.0]).unwrap();
/// assert!((seen.gain - dmatrix![0.75; 0.0]).amax() < 1e-14);
/// assert!((seen.covariance - dmatrix![0.75, 0.0; 0.0, 7.0]).amax() < 1e-14);
/// assert_eq!(seen.prediction_error.root()[(0, 0)], 2.0); // 3 + 1
/// ```
#[derive(Clone, Debug)]
pub struct Conditioning {
    /// The gain `K = P H' S^-1`.
    pub gain: DMatrix<f64>,
    /// The covariance after the observation, in Joseph's form: symmetric and positive by construction.
    pub covariance: DMatrix<f64>,
    /// The prediction error's covariance `S = H P H' + R`, factored.
    pub prediction_error: Factor,
}

/// A covariance factored by Cholesky.
///
/// ```
/// use nalgebra::dmatrix;
/// use whither::math::gaussian::Factor;
/// let factor = Factor::new(dmatrix![4.0, 2.0; 2.0, 2.0]).unwrap();
/// assert_eq!(factor.root(), dmatrix![2.0, 0.0; 1.0, 1.0]);
/// assert!(Factor::new(dmatrix![1.0, 2.0; 2.0, 1.0]).is_none()); // its determinant is -3
/// ```
#[derive(Clone, Debug)]
pub struct Factor {
    cholesky: Cholesky<f64, Dyn>,
    log_normaliser: f64,
}

impl Factor {
    /// Factors a covariance; none if it is not positive definite.
    #[must_use]
    #[inline(never)]
    pub fn new(covariance: DMatrix<f64>) -> Option<Self> {
        let n = covariance.nrows();
        let cholesky = Cholesky::new(covariance)?;
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
///
/// ```
/// use nalgebra::dmatrix;
/// let c = whither::math::gaussian::condition(&dmatrix![4.0], &dmatrix![1.0], &dmatrix![1.0]).unwrap();
/// assert!((c.gain[(0, 0)] - 0.8).abs() < 1e-15);
/// ```
#[must_use]
#[inline(never)]
pub fn condition(p: &DMatrix<f64>, h: &DMatrix<f64>, r: &DMatrix<f64>) -> Option<Conditioning> {
    let hp = h * p;
    let mut s = &hp * h.transpose() + r;
    symmetrise(&mut s);
    let prediction_error = Factor::new(s)?;
    let gain = prediction_error.solve(&hp).transpose();
    let mut left = -(&gain * h);
    for i in 0..left.nrows() {
        left[(i, i)] += 1.0;
    }
    let mut covariance = &left * p * left.transpose() + &gain * r * gain.transpose();
    symmetrise(&mut covariance);
    Some(Conditioning { gain, covariance, prediction_error })
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
    fn two_observations_one_after_the_other_are_one_of_both() {
        let p = dmatrix![3.0, 0.5, 0.2; 0.5, 2.0, 0.1; 0.2, 0.1, 1.0];
        let h = dmatrix![1.0, 0.0, 0.5; 0.0, 1.0, 0.0];
        let r = dmatrix![0.3, 0.0; 0.0, 0.7];
        let both = condition(&p, &h, &r).unwrap();
        let row = |i: usize| h.rows(i, 1).into_owned();
        let first = condition(&p, &row(0), &dmatrix![0.3]).unwrap();
        let second = condition(&first.covariance, &row(1), &dmatrix![0.7]).unwrap();
        assert!((both.covariance - second.covariance).amax() < 1e-14);
    }
}
