//! State, forecast and paths of the pointing model, from the pairs of noise scale and time to go.
//!
//! For each destination and pair the filter's state is predicted to the time wanted, at most to the arrival, conditioned on
//! the endpoint (Liang (10)), and mixed with the weights `p(D_i, c, R_n | y_1:k)`; mean and covariance by moment matching.

use super::Shares;
use crate::likelihood::pointing::endpoint::{Pair, inverse, spread, times};
use crate::likelihood::pointing::{Pointing, Symmetric, Vector, minus, vector};
use crate::math::gaussian::Gaussian;
use crate::model::destination::Destinations;
use crate::posterior::state::Moments;
use nalgebra::{DMatrix, DVector};

impl Pointing {
    /// The state `later` seconds after the latest observation, given that the movement ends at one of the destinations.
    #[must_use]
    pub fn state(&self, destinations: &Destinations, shares: Shares<'_>, later: f64) -> Option<Gaussian> {
        self.mix(destinations, shares, |pair| self.ahead(pair, later.min(pair.time)))
    }

    /// The state at the first observation, given all of them and that the movement ends at one of the destinations.
    #[must_use]
    pub fn initial_state(&self, destinations: &Destinations, shares: Shares<'_>) -> Option<Gaussian> {
        self.mix(destinations, shares, |pair| self.at_start(pair))
    }

    fn mix(&self, destinations: &Destinations, shares: Shares<'_>, view: impl Fn(&Pair) -> View) -> Option<Gaussian> {
        let d = self.course().dimensions();
        let nodes = self.nodes();
        let views: Vec<View> = nodes.pairs.iter().map(view).collect();
        let mut moments = Moments::default();
        for &(i, share) in shares {
            let covariance = &destinations.kind(i).covariance;
            let weights = nodes.weights(destinations.center(i), covariance);
            let offset = minus(&vector(destinations.center(i)), &self.course().position());
            for ((pair, view), weight) in nodes.pairs.iter().zip(&views).zip(weights) {
                let weight = share * weight;
                if weight <= 0.0 {
                    continue;
                }
                let (precision, _) = inverse(&nodes.covariance(pair, covariance), d);
                let error = minus(&offset, &self.course().velocity().map(|v| v * pair.time));
                let shift = &view.mean + view.pull(&times(&precision, &error));
                moments.add(weight, shift, &(&view.covariance - view.gained(&precision, d)));
            }
        }
        let mut mixture = moments.mixture?;
        for (j, x) in self.course().position().iter().enumerate().take(d) {
            mixture.mean[j] += x;
        }
        Some(mixture)
    }

    /// The state `later` seconds on, which is not beyond the pair's time to go.
    fn ahead(&self, pair: &Pair, later: f64) -> View {
        let d = self.course().dimensions();
        let rest = pair.time - later;
        let velocity = self.course().velocity();
        let noise = |factor: f64| matrix(&spread(&pair.noise, &velocity, factor), d);
        let diagonal = |entry: fn(&[f64; 3], f64) -> f64| {
            DMatrix::from_diagonal(&DVector::from_fn(d, |j, _| entry(&self.course().axes[j].covariance, later)))
        };
        let pp = diagonal(|[pp, pv, vv], h| pp + 2.0 * h * pv + h * h * vv) + noise(later.powi(3) / 3.0);
        let pv = diagonal(|[_, pv, vv], h| pv + h * vv) + noise(later * later / 2.0);
        let vv = diagonal(|[_, _, vv], _| *vv) + noise(later);
        let mean = DVector::from_fn(2 * d, |j, _| if j < d { velocity[j] * later } else { velocity[j - d] });
        View::new(mean, &pp, &pv, &vv, &(&pp + &pv * rest), &(&pv + &vv * rest))
    }

    /// The smoothed state at the first observation.
    fn at_start(&self, pair: &Pair) -> View {
        let d = self.course().dimensions();
        let axes = &self.course().axes;
        let diagonal = |entry: &dyn Fn(usize) -> f64| DMatrix::from_diagonal(&DVector::from_fn(d, |j, _| entry(j)));
        let covariance = |k: usize| diagonal(&|j| axes[j].first_covariance[k]);
        let tie = |row: usize| diagonal(&|j| axes[j].tie[row] + pair.time * axes[j].tie[row + 1]);
        let mean =
            DVector::from_fn(
                2 * d,
                |j, _| {
                    if j < d { axes[j].first[0] - axes[j].position } else { axes[j - d].first[1] }
                },
            );
        View::new(mean, &covariance(0), &covariance(1), &covariance(2), &tie(0), &tie(2))
    }
}

/// A state, about the position now, and its covariance with the endpoint.
struct View {
    mean: DVector<f64>,
    covariance: DMatrix<f64>,
    with_endpoint: DMatrix<f64>,
}

impl View {
    fn new(
        mean: DVector<f64>,
        pp: &DMatrix<f64>,
        pv: &DMatrix<f64>,
        vv: &DMatrix<f64>,
        position_with_endpoint: &DMatrix<f64>,
        velocity_with_endpoint: &DMatrix<f64>,
    ) -> Self {
        let d = pp.nrows();
        let mut covariance = DMatrix::zeros(2 * d, 2 * d);
        covariance.view_mut((0, 0), (d, d)).copy_from(pp);
        covariance.view_mut((0, d), (d, d)).copy_from(pv);
        covariance.view_mut((d, 0), (d, d)).copy_from(&pv.transpose());
        covariance.view_mut((d, d), (d, d)).copy_from(vv);
        let mut with_endpoint = DMatrix::zeros(2 * d, d);
        with_endpoint.view_mut((0, 0), (d, d)).copy_from(position_with_endpoint);
        with_endpoint.view_mut((d, 0), (d, d)).copy_from(velocity_with_endpoint);
        Self { mean, covariance, with_endpoint }
    }

    fn pull(&self, by: &Vector) -> DVector<f64> {
        &self.with_endpoint * DVector::from_column_slice(&by[..self.with_endpoint.ncols()])
    }

    fn gained(&self, precision: &Symmetric, dimensions: usize) -> DMatrix<f64> {
        &self.with_endpoint * matrix(precision, dimensions) * self.with_endpoint.transpose()
    }
}

fn matrix(symmetric: &Symmetric, dimensions: usize) -> DMatrix<f64> {
    let place = [[0, 1, 3], [1, 2, 4], [3, 4, 5]];
    DMatrix::from_fn(dimensions, dimensions, |r, c| symmetric[place[r][c]])
}
