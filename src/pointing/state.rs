//! State, forecast and paths of the pointing model, from the pairs of noise scale and time to go.
//!
//! For each target and pair the filter's state is predicted to the time wanted, at most to the arrival, conditioned on
//! the endpoint (Liang (10)), and mixed with the weights `p(D_i, c, R_n | y_1:k)`; mean and covariance by moment matching.
//! Roots of covariances all the way, so that no variance is a difference.

use super::endpoint::Pair;
use super::targets::Extent;
use super::{Pointing, Space, Vector, dot, minus};
use crate::math::gaussian::Gaussian;
use crate::posterior::Shares;
use nalgebra::{DMatrix, DVector};
use whither_kernel::mixture::AXES;
use whither_kernel::small_gaussian;

/// The most components of a state: positions and velocities.
const STATES: usize = 2 * AXES;

/// The most independent sources of uncertainty: for each axis four of the filter, and two of the noise until the time wanted.
const SOURCES: usize = 6 * AXES;

/// Linear functions of the sources, each of deviation one.
type Rows = [[f64; SOURCES]; STATES + AXES];

/// The lower triangle with the same square; a function of its own, as speed does not matter here.
#[inline(never)]
fn triangularise(a: &mut Rows, rows: usize, columns: usize) {
    small_gaussian::triangularise(a, rows, columns);
}

/// The mean and the covariance of the state: positions, then velocities; components beyond twice the dimensions are zero.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct State {
    /// How many components there are.
    size: usize,
    mean: [f64; STATES],
    covariance: [[f64; STATES]; STATES],
}

impl State {
    /// The mean.
    #[must_use]
    pub fn mean(&self) -> &[f64] {
        &self.mean[..self.size]
    }

    /// The rows of the covariance.
    pub fn covariance(&self) -> impl Iterator<Item = &[f64]> {
        self.covariance[..self.size].iter().map(|row| &row[..self.size])
    }

    /// Adds a part of the mixture: `share` is its weight over all that has been added, itself included.
    fn add(&mut self, share: f64, mean: &[f64; STATES], covariance: &[[f64; STATES]; STATES]) {
        let mut offset = [0.0; STATES];
        for r in 0..self.size {
            offset[r] = mean[r] - self.mean[r];
            self.mean[r] += share * offset[r];
        }
        for r in 0..self.size {
            for c in 0..self.size {
                // each part widens the covariance by its distance from the mean, so nothing is subtracted
                let apart = offset[r] * offset[c] * (share * (1.0 - share));
                self.covariance[r][c] = (1.0 - share) * self.covariance[r][c] + share * covariance[r][c] + apart;
            }
        }
    }
}

impl From<State> for Gaussian {
    fn from(state: State) -> Self {
        let rows = state.covariance().flatten().copied();
        let covariance = DMatrix::from_row_iterator(state.size, state.size, rows);
        Self { mean: DVector::from_column_slice(state.mean()), covariance }
    }
}

impl<S: Space> Pointing<S> {
    /// The state `later` seconds after the latest observation, given that the movement ends at one of the targets.
    #[must_use]
    pub fn state(&self, shares: Shares<'_>, later: f64) -> Option<State> {
        self.mix(shares, |pair| self.ahead(pair, later.min(pair.time)))
    }

    /// The state at the first observation, given all of them and that the movement ends at one of the targets.
    #[must_use]
    pub fn initial_state(&self, shares: Shares<'_>) -> Option<State> {
        self.mix(shares, |pair| self.at_start(pair))
    }

    fn mix(&self, shares: Shares<'_>, joint: impl Fn(&Pair) -> Joint) -> Option<State> {
        let d = self.course().dimensions();
        let (position, velocity) = (self.course().position(), self.course().velocity());
        let pairs = self.nodes().pairs();
        let joints: Vec<Joint> = pairs.list.iter().map(joint).collect();
        let (mut mixture, mut total) = (None, 0.0);
        let (mut number, mut conditioned) = (None, Vec::new());
        for &(i, share) in shares {
            let extent = self.targets().extent(i);
            if number != Some(self.targets().extent_number(i)) {
                number = Some(self.targets().extent_number(i));
                conditioned.clear();
                conditioned.extend(joints.iter().map(|joint| joint.conditioned(extent, d)));
            }
            let center = self.targets().center(i);
            let offset = minus(&center, &position);
            for ((pair, known), weight) in pairs.list.iter().zip(&conditioned).zip(pairs.weights(&center, extent)) {
                let (weight, Some(known)) = (share * weight, known) else { continue };
                if weight <= 0.0 {
                    continue;
                }
                total += weight;
                let [x, y, z] = velocity;
                let mean = known.mean(&minus(&offset, &[x * pair.time, y * pair.time, z * pair.time]), d);
                let empty = State { size: 2 * d, mean, covariance: known.covariance };
                mixture.get_or_insert(empty).add(weight / total, &mean, &known.covariance);
            }
        }
        let mut mixture = mixture?;
        for (component, x) in mixture.mean.iter_mut().zip(position).take(d) {
            *component += x;
        }
        Some(mixture)
    }

    /// The state `later` seconds on, which is not beyond the pair's time to go.
    fn ahead(&self, pair: &Pair, later: f64) -> Joint {
        let (d, velocity) = (self.course().dimensions(), self.course().velocity());
        let (noise, rest) = (noise_root(&pair.noise, &velocity, later), pair.time - later);
        let mut mean = [0.0; STATES];
        let mut rows = [[0.0; SOURCES]; STATES + AXES];
        for j in 0..d {
            let [_, _, position, speed] = self.course().axes[j].root();
            for k in 0..4 {
                rows[j][k * d + j] = position[k] + later * speed[k];
                rows[d + j][k * d + j] = speed[k];
            }
            // the integral of white noise
            for i in 0..d {
                rows[j][4 * d + i] = noise[j][i] * (later / 3f64.sqrt());
                rows[d + j][4 * d + i] = noise[j][i] * 0.75f64.sqrt();
                rows[d + j][5 * d + i] = noise[j][i] * 0.5;
            }
            for source in 0..6 * d {
                rows[2 * d + j][source] = rows[j][source] + rest * rows[d + j][source];
            }
            (mean[j], mean[d + j]) = (velocity[j] * later, velocity[j]);
        }
        Joint::new(mean, rows, noise_root(&pair.noise, &velocity, rest.powi(3) / 3.0), d)
    }

    /// The smoothed state at the first observation.
    fn at_start(&self, pair: &Pair) -> Joint {
        let d = self.course().dimensions();
        let mut mean = [0.0; STATES];
        let mut rows = [[0.0; SOURCES]; STATES + AXES];
        for j in 0..d {
            let axis = &self.course().axes[j];
            let [first_position, first_speed, position, speed] = axis.root();
            for k in 0..4 {
                rows[j][k * d + j] = first_position[k];
                rows[d + j][k * d + j] = first_speed[k];
                rows[2 * d + j][k * d + j] = position[k] + pair.time * speed[k];
            }
            (mean[j], mean[d + j]) = (axis.first[0] - axis.now[0], axis.first[1]);
        }
        Joint::new(mean, rows, noise_root(&pair.noise, &self.course().velocity(), pair.time.powi(3) / 3.0), d)
    }
}

/// The state that is wanted, about the position now, and where the movement ends.
struct Joint {
    mean: [f64; STATES],
    /// A root of the covariance of the state and, below it, of the end without the noise; lower triangular.
    root: Rows,
    /// A root of the covariance of the noise from the time wanted to the end.
    noise: [Vector; AXES],
}

impl Joint {
    fn new(mean: [f64; STATES], mut root: Rows, noise: [Vector; AXES], d: usize) -> Self {
        triangularise(&mut root, 3 * d, 6 * d);
        Self { mean, root, noise }
    }

    /// The state given the endpoint, whose own covariance is that of `extent`; none where it is singular. An orthogonal
    /// transformation turns
    /// ```text
    /// | R^1/2  H L |          | S^1/2      0  |
    /// |   0     L  |   into   | K S^1/2    L+ |
    /// ```
    fn conditioned(&self, extent: &Extent, d: usize) -> Option<Conditioned> {
        let (own, mut noise) = (extent.root(), [[0.0; SOURCES]; STATES + AXES]);
        for j in 0..d {
            for i in 0..d {
                (noise[j][i], noise[j][d + i]) = (self.noise[j][i], own[j][i]);
            }
        }
        triangularise(&mut noise, d, 2 * d);
        let mut array = [[0.0; SOURCES]; STATES + AXES];
        for r in 0..3 * d {
            // the end is first here, and last in its own root
            let from = if r < d { 2 * d + r } else { r - d };
            for q in 0..3 * d {
                array[r][d + q] = self.root[from][q];
            }
            for q in 0..d {
                array[r][q] = if r < d { noise[r][q] } else { 0.0 };
            }
        }
        triangularise(&mut array, 3 * d, 4 * d);
        let mut given = Conditioned { mean: self.mean, ..Conditioned::default() };
        for j in 0..d {
            for i in 0..d {
                given.endpoint[j][i] = array[j][i];
            }
            if !(array[j][j] > 0.0 && array[j][j] < f64::INFINITY) {
                return None;
            }
        }
        for r in 0..2 * d {
            let row = &array[d + r];
            given.gain[r][..d].copy_from_slice(&row[..d]);
            for c in 0..=r {
                let covariance = (d..4 * d).map(|q| row[q] * array[d + c][q]).sum();
                (given.covariance[r][c], given.covariance[c][r]) = (covariance, covariance);
            }
        }
        Some(given)
    }
}

/// The state given the endpoint.
#[derive(Default)]
struct Conditioned {
    /// The mean before.
    mean: [f64; STATES],
    /// `S^1/2`, the root of the covariance of the endpoint's prediction.
    endpoint: [Vector; AXES],
    /// `K S^1/2`.
    gain: [Vector; STATES],
    covariance: [[f64; STATES]; STATES],
}

impl Conditioned {
    /// The mean, with the error of the endpoint's prediction.
    fn mean(&self, error: &Vector, d: usize) -> [f64; STATES] {
        let mut whitened = Vector::default();
        for j in 0..d {
            whitened[j] = (error[j] - dot(&self.endpoint[j], &whitened)) / self.endpoint[j][j];
        }
        let mut mean = self.mean;
        for (component, gain) in mean.iter_mut().zip(&self.gain) {
            *component += dot(gain, &whitened);
        }
        mean
    }
}

/// The symmetric root of `(noise[0] I + noise[1] v v') factor`, the noise of a movement.
fn noise_root(noise: &[f64; 2], velocity: &Vector, factor: f64) -> [Vector; AXES] {
    let [across, along] = *noise;
    let even = across.sqrt();
    // (sqrt(across + along v'v) - sqrt(across)) / v'v without the difference
    let slope = along / ((across + along * dot(velocity, velocity)).max(0.0).sqrt() + even);
    let scale = factor.sqrt();
    let mut root = [[0.0; AXES]; AXES];
    for j in 0..AXES {
        for i in 0..AXES {
            root[j][i] = scale * slope * velocity[j] * velocity[i];
        }
        root[j][j] += scale * even;
    }
    root
}
