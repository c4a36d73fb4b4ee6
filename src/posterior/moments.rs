//! A mixture of Gaussians as one: mean and covariance by moment matching.

use crate::math::gaussian::{Gaussian, symmetrise};
use nalgebra::{DMatrix, DVector};

/// A mixture in the making: each part moves the mean and widens the covariance by its distance from it, so nothing is
/// subtracted and the covariance stays positive.
#[derive(Default)]
pub(crate) struct Moments {
    total: f64,
    /// The mean and the covariance of the parts so far; none before the first.
    pub mixture: Option<Gaussian>,
}

impl Moments {
    /// One more part.
    pub fn add(&mut self, weight: f64, mean: DVector<f64>, covariance: &DMatrix<f64>) {
        let before = self.total;
        self.total += weight;
        let Some(mixture) = &mut self.mixture else {
            self.mixture = Some(Gaussian { mean, covariance: covariance.clone() });
            return;
        };
        let (share, offset) = (weight / self.total, mean - &mixture.mean);
        mixture.covariance *= before / self.total;
        mixture.covariance += covariance * share;
        mixture.covariance.ger(share * (before / self.total), &offset, &offset, 1.0);
        symmetrise(&mut mixture.covariance);
        mixture.mean.axpy(share, &offset, 1.0);
    }
}
