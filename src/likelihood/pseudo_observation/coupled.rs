//! Models, observations or endpoints that mix axes: one filter over the complete state, and the endpoint's position as one
//! Gaussian with correlations. What the endpoint names beyond the position is conditioned on, as in [`super::separable`].

use super::classes::ClassEndpoint;
use crate::math::gaussian::{Gaussian, propagate};
use crate::math::kalman::Filter;
use crate::model::motion::{MotionModel, Transition};
use whither_kernel::mixture::{AXES, Ellipsoid, HALF_LOG2_E};
use whither_kernel::small_gaussian::{Matrix, eliminate};

/// The Kalman posterior now, and that of the first observation.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupled {
    /// `p(x_1 | y_1)`.
    pub first: Gaussian,
    /// Over the pair (first observation, now).
    pub filter: Filter,
}

impl Coupled {
    /// The state now.
    pub fn now(&self) -> Gaussian {
        Gaussian { mean: self.filter.mean(0), covariance: self.filter.current_covariance() }
    }

    /// The first state, predicted `elapsed` ahead.
    pub fn predict_first(&self, model: &dyn MotionModel, elapsed: f64) -> Gaussian {
        let step = model.transition(elapsed);
        let covariance = propagate(&step.transition, &self.first.covariance, &step.noise);
        Gaussian { mean: &step.transition * &self.first.mean + step.offset, covariance }
    }
}

/// The endpoint of one node, as far as the position is concerned: a Gaussian, and the density of the rest.
#[derive(Clone, Copy, Debug)]
struct EndpointPosition {
    mean: [f64; AXES],
    covariance: Matrix<AXES>,
    /// The rest's density is the root of this ...
    density: f64,
    /// ... times two to this, and a constant.
    exponent: f64,
}

/// Room for what one node is computed with, kept from node to node.
#[derive(Clone, Debug, Default)]
pub struct Room {
    mean: Vec<f64>,
    product: Vec<f64>,
    /// Column by column.
    covariance: Vec<f64>,
}

impl EndpointPosition {
    /// From a state, `step` before the endpoint.
    // over slices: at the level for size each index of a matrix, and each step of an iterator, would be a call
    #[inline(never)]
    fn new(from: &Gaussian, step: &Transition, endpoint: &ClassEndpoint, d: usize, room: &mut Room) -> Self {
        let (s, length) = (from.mean.len(), endpoint.covariance.nrows());
        let (transition, offset, noise) = (step.transition.as_slice(), step.offset.as_slice(), step.noise.as_slice());
        let (start, before) = (from.mean.as_slice(), from.covariance.as_slice());
        let Room { mean, product, covariance } = room;
        mean.clear();
        product.resize(s, 0.0);
        covariance.clear();
        covariance.extend_from_slice(endpoint.covariance.as_slice());
        for i in 0..length {
            let mut sum = offset[i];
            for m in 0..s {
                sum += transition[i + m * s] * start[m];
                let mut entry = 0.0;
                for j in 0..s {
                    entry += transition[i + j * s] * before[j + m * s];
                }
                product[m] = entry;
            }
            mean.push(sum);
            for j in 0..i + 1 {
                let mut entry = noise[i + j * s];
                for m in 0..s {
                    entry += product[m] * transition[j + m * s];
                }
                covariance[i + j * length] += entry;
            }
        }
        let (mut density, mut exponent) = (1.0, 0.0);
        for r in (d..length).rev() {
            let inverse = 1.0 / covariance[r + r * length];
            let error = endpoint.rest[r - d] - mean[r];
            density *= inverse;
            exponent -= HALF_LOG2_E * (error * error * inverse);
            for i in 0..r {
                let gain = covariance[r + i * length] * inverse;
                mean[i] += gain * error;
                for j in 0..i + 1 {
                    covariance[i + j * length] -= gain * covariance[r + j * length];
                }
            }
        }
        let mut position = Self { mean: [0.0; AXES], covariance: [[0.0; AXES]; AXES], density, exponent };
        for i in 0..d {
            position.mean[i] = mean[i];
            for j in 0..i + 1 {
                position.covariance[i][j] = covariance[i + j * length];
                position.covariance[j][i] = covariance[i + j * length];
            }
        }
        position
    }
}

/// The term of a node: the ratio of the endpoint's density given all observations to that given the first, about its mean given all,
/// `factor` times two to `lead` in front. None where a covariance is singular.
pub fn ellipsoid(
    now: (&Gaussian, &Transition),
    start: (&Gaussian, &Transition),
    endpoint: &ClassEndpoint,
    (factor, lead): (f64, f64),
    d: usize,
    room: &mut Room,
) -> Option<Ellipsoid> {
    let here = EndpointPosition::new(now.0, now.1, endpoint, d, room);
    let there = EndpointPosition::new(start.0, start.1, endpoint, d, room);
    let (precision, determinant) = eliminate(here.covariance, d)?;
    let (start_precision, start_determinant) = eliminate(there.covariance, d)?;
    let mut term = Ellipsoid {
        center: here.mean,
        factor: factor * (start_determinant / determinant * (here.density / there.density)).sqrt(),
        constant: lead + here.exponent - there.exponent,
        ..Ellipsoid::default()
    };
    for i in 0..d {
        let apart = |j: usize| here.mean[j] - there.mean[j];
        let mut lean = 0.0;
        for j in 0..d {
            lean += HALF_LOG2_E * start_precision[i][j] * apart(j);
        }
        term.slope[i] = 2.0 * lean;
        term.constant += lean * apart(i);
        for j in i..d {
            let twice = if i == j { 1.0 } else { 2.0 };
            term.curvature[i][j] = twice * HALF_LOG2_E * (start_precision[i][j] - precision[i][j]);
        }
    }
    Some(term)
}
