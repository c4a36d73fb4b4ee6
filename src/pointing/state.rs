//! State, forecast and paths of the pointing model, from the pairs of noise scale and time to go.
//!
//! For each destination and pair the filter's state is predicted to the time wanted, at most to the arrival, conditioned on
//! the endpoint (Liang (10)), and mixed with the weights `p(D_i, c, R_n | y_1:k)`; mean and covariance by moment matching.
//! Roots of covariances all the way, so that no variance is a difference.

use super::endpoint::{Pair, spread};
use super::{Pointing, Symmetric, minus};
use crate::math::gaussian::{Conditioning, Gaussian, condition_root, root, square, triangularise};
use crate::posterior::Shares;
use crate::posterior::moments::Moments;
use nalgebra::{DMatrix, DVector};

impl Pointing {
    /// The state `later` seconds after the latest observation, given that the movement ends at one of the destinations.
    #[must_use]
    pub fn state(&self, shares: Shares<'_>, later: f64) -> Option<Gaussian> {
        self.mix(shares, |pair| self.ahead(pair, later.min(pair.time)))
    }

    /// The state at the first observation, given all of them and that the movement ends at one of the destinations.
    #[must_use]
    pub fn initial_state(&self, shares: Shares<'_>) -> Option<Gaussian> {
        self.mix(shares, |pair| self.at_start(pair))
    }

    fn mix(&self, shares: Shares<'_>, view: impl Fn(&Pair) -> View) -> Option<Gaussian> {
        let d = self.course().dimensions();
        let pairs = self.nodes().pairs();
        let views: Vec<View> = pairs.list.iter().map(view).collect();
        let mut moments = Moments::default();
        let mut kind = None;
        let mut conditioned = Vec::new();
        for &(i, share) in shares {
            if kind != Some(self.targets().extent_number(i)) {
                kind = Some(self.targets().extent_number(i));
                conditioned.clear();
                let covariance = matrix(&self.targets().extent(i).covariance, d);
                conditioned.extend(views.iter().map(|view| view.conditioned(&covariance)));
            }
            let weights = pairs.weights(&self.targets().center(i), self.targets().extent(i));
            let offset = minus(&self.targets().center(i), &self.course().position());
            for (((pair, view), known), weight) in pairs.list.iter().zip(&views).zip(&conditioned).zip(weights) {
                let (weight, Some((gain, covariance))) = (share * weight, known) else { continue };
                if weight <= 0.0 {
                    continue;
                }
                let error = minus(&offset, &self.course().velocity().map(|v| v * pair.time));
                let mean = &view.mean + gain * &DVector::from_column_slice(&error[..d]);
                moments.add(weight, mean, covariance);
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
        let (velocity, rest) = (self.course().velocity(), pair.time - later);
        let now = self.root();
        let (mut positions, speeds) = (now.rows(2 * d, d).into_owned(), now.rows(3 * d, d));
        positions += speeds * later;
        // beside the state now, the noise until then: the integral of white noise
        let noise = root(&self.spread(pair, later));
        let mut ahead = DMatrix::zeros(2 * d, 6 * d);
        ahead.view_mut((0, 0), (d, 4 * d)).copy_from(&positions);
        ahead.view_mut((d, 0), (d, 4 * d)).copy_from(&speeds);
        ahead.view_mut((0, 4 * d), (d, d)).copy_from(&(&noise * (later / 3f64.sqrt())));
        ahead.view_mut((d, 4 * d), (d, d)).copy_from(&(&noise * 0.75f64.sqrt()));
        ahead.view_mut((d, 5 * d), (d, d)).copy_from(&(noise * 0.5));
        View {
            mean: DVector::from_fn(2 * d, |j, _| if j < d { velocity[j] * later } else { velocity[j - d] }),
            root: triangularise(ahead),
            endpoint: onward(d, 2 * d, rest),
            noise: self.spread(pair, rest.powi(3) / 3.0),
        }
    }

    /// The smoothed state at the first observation, and below it the state now.
    fn at_start(&self, pair: &Pair) -> View {
        let d = self.course().dimensions();
        let axis = |j: usize| &self.course().axes[j];
        let first = |j: usize| if j < d { axis(j).first[0] - axis(j).now[0] } else { axis(j - d).first[1] };
        View {
            mean: DVector::from_fn(2 * d, |j, _| first(j)),
            root: self.root(),
            endpoint: onward(d, 4 * d, pair.time),
            noise: self.spread(pair, pair.time.powi(3) / 3.0),
        }
    }

    /// The filter's root: the rows are positions and velocities at the start and then now, axis by axis.
    fn root(&self) -> DMatrix<f64> {
        let d = self.course().dimensions();
        let entry = |row: usize, column: usize| match (row % d, column % d) {
            (axis, same) if axis == same => self.course().axes[axis].root()[row / d][column / d],
            _ => 0.0,
        };
        DMatrix::from_fn(4 * d, 4 * d, entry)
    }

    /// The noise of the movement, times a factor.
    fn spread(&self, pair: &Pair, factor: f64) -> DMatrix<f64> {
        matrix(&spread(&pair.noise, &self.course().velocity(), factor), self.course().dimensions())
    }
}

/// A state, about the position now, and what an endpoint of no extent observes of it.
struct View {
    /// The mean of the state that is asked for.
    mean: DVector<f64>,
    /// The root of its covariance, and of what the endpoint is an observation of.
    root: DMatrix<f64>,
    endpoint: DMatrix<f64>,
    noise: DMatrix<f64>,
}

impl View {
    /// The gain and the covariance given the endpoint, whose own covariance is this; none where it is singular.
    fn conditioned(&self, own: &DMatrix<f64>) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let size = self.mean.len();
        let noise = &self.noise + own;
        let Conditioning { gain, root, .. } = condition_root(&self.root, &self.endpoint, &noise)?;
        Some((gain.rows(0, size).into_owned(), square(&root.rows(0, size).into_owned())))
    }
}

/// `[0, I, rest I]`: the position after some more time, from a state whose last components are position and velocity.
fn onward(dimensions: usize, size: usize, rest: f64) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(dimensions, size);
    let start = size - 2 * dimensions;
    matrix.view_mut((0, start), (dimensions, dimensions)).fill_with_identity();
    matrix.view_mut((0, start + dimensions), (dimensions, dimensions)).fill_diagonal(rest);
    matrix
}

fn matrix(symmetric: &Symmetric, dimensions: usize) -> DMatrix<f64> {
    let place = [[0, 1, 3], [1, 2, 4], [3, 4, 5]];
    DMatrix::from_fn(dimensions, dimensions, |r, c| symmetric[place[r][c]])
}
