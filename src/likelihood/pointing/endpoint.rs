//! The endpoint density `N_i`: where the movement ends if it goes on, mixed over noise scales and times to go.
//!
//! With velocity `v`, speed `s`, unit vector `u = v / s`, scale `c` and time to go `R`, the endpoint of destination `i` is
//! Gaussian about `x + v R` with the covariance
//! ```text
//! P_pp + 2 R P_pv + R^2 P_vv + (c^2 + (across s)^2) R^3/3 I + (along^2 - across^2) R^3/3 v v' + S_i
//! ```
//! which is, in the frame of `u`, noise `c^2 + (along s)^2` along the way and `c^2 + (across s)^2` across it. For one
//! covariance `S_i` its logarithm is a quadratic in `a_i - x`.

use super::course::Course;
use super::parameters::Parameters;
use super::{Symmetric, Vector, minus, vector};
use crate::math::gaussian::LN_2_PI;
use crate::model::destination::Destinations;
use nalgebra::DMatrix;

/// One (scale, time to go).
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// The time to go `R`.
    pub time: f64,
    /// Spectral density of the noise across the way, and what is added to it along `v v'`.
    pub noise: [f64; 2],
    log_weight: f64,
    mean: Vector,
    covariance: Symmetric,
}

/// All pairs as they stand after an observation.
#[derive(Clone, Debug)]
pub struct Nodes {
    dimensions: usize,
    position: Vector,
    /// The pairs, scale by scale.
    pub pairs: Vec<Pair>,
}

/// `quadratic . (xx, xy, yy, xz, yz, zz) + linear . (x, y, z) + constant`: the log density of a pair, weight included.
#[derive(Clone, Copy, Debug)]
struct Quadratic {
    quadratic: Symmetric,
    linear: Vector,
    constant: f64,
}

impl Nodes {
    /// The pairs after the latest observation.
    #[must_use]
    pub fn new(parameters: &Parameters, course: &Course) -> Self {
        let (velocity, speed) = (course.velocity(), course.speed());
        let nodes = parameters.time_to_go.nodes();
        let mut log_weights = Vec::with_capacity(nodes.len());
        parameters.time_to_go.log_weights(&nodes, speed, &mut log_weights);
        let log_scales = (parameters.scales.len() as f64).ln();
        let (along, across) = (parameters.along_noise.powi(2), parameters.across_noise.powi(2));
        let mut pairs = Vec::with_capacity(parameters.scales.len() * nodes.len());
        for scale in &parameters.scales {
            let noise = [scale * scale + across * speed * speed, along - across];
            pairs.extend(nodes.iter().zip(&log_weights).map(|(&time, log_weight)| {
                let mut covariance = spread(&noise, &velocity, time.powi(3) / 3.0);
                for (axis, place) in course.axes.iter().zip([0, 2, 5]) {
                    let [pp, pv, vv] = axis.covariance;
                    covariance[place] += pp + 2.0 * time * pv + time * time * vv;
                }
                let mean = velocity.map(|v| v * time);
                Pair { time, noise, log_weight: log_weight - log_scales, mean, covariance }
            }));
        }
        Self { dimensions: course.dimensions(), position: course.position(), pairs }
    }

    /// `ln N_i` for every destination.
    pub fn log_densities(&self, destinations: &Destinations, into: &mut Vec<f64>) {
        into.clear();
        let mut kind = u32::MAX;
        let mut quadratics = Vec::new();
        let mut terms = Vec::with_capacity(self.pairs.len());
        for (i, &its_kind) in destinations.kind_of().iter().enumerate() {
            if its_kind != kind {
                kind = its_kind;
                self.quadratics(&destinations.kind(i).covariance, &mut quadratics);
            }
            let offset = minus(&vector(destinations.center(i)), &self.position);
            terms.clear();
            terms.extend(quadratics.iter().map(|quadratic| quadratic.at(&offset)));
            into.push(crate::math::log_sum_exp::log_sum_exp(&terms));
        }
    }

    /// `p(c, R_n | D_i)`, in the order of the pairs.
    #[must_use]
    pub fn weights(&self, center: &[f64], endpoint: &DMatrix<f64>) -> Vec<f64> {
        let mut quadratics = Vec::new();
        self.quadratics(endpoint, &mut quadratics);
        let offset = minus(&vector(center), &self.position);
        let terms: Vec<f64> = quadratics.iter().map(|quadratic| quadratic.at(&offset)).collect();
        let total = crate::math::log_sum_exp::log_sum_exp(&terms);
        terms.iter().map(|term| (term - total).exp()).collect()
    }

    fn quadratics(&self, endpoint: &DMatrix<f64>, into: &mut Vec<Quadratic>) {
        let own = symmetric(endpoint, self.dimensions);
        into.clear();
        into.extend(self.pairs.iter().map(|pair| {
            let mut covariance = pair.covariance;
            covariance.iter_mut().zip(own).for_each(|(to, add)| *to += add);
            let (precision, determinant) = inverse(&covariance, self.dimensions);
            let pull = times(&precision, &pair.mean);
            let constant = pair.log_weight
                - 0.5 * (super::dot(&pull, &pair.mean) + determinant.ln() + self.dimensions as f64 * LN_2_PI);
            let [xx, xy, yy, xz, yz, zz] = precision;
            Quadratic { quadratic: [-0.5 * xx, -xy, -0.5 * yy, -xz, -yz, -0.5 * zz], linear: pull, constant }
        }));
    }
}

impl Quadratic {
    fn at(&self, offset: &Vector) -> f64 {
        let [x, y, z] = *offset;
        let [xx, xy, yy, xz, yz, zz] = self.quadratic;
        self.constant
            + x * (xx * x + xy * y + xz * z + self.linear[0])
            + y * (yy * y + yz * z + self.linear[1])
            + z * (zz * z + self.linear[2])
    }
}

/// `(noise[0] I + noise[1] v v') factor`: the noise of a movement, wider along the velocity than across it.
#[must_use]
pub fn spread(noise: &[f64; 2], velocity: &Vector, factor: f64) -> Symmetric {
    let [x, y, z] = *velocity;
    let [even, along] = noise.map(|n| n * factor);
    [even + along * x * x, along * x * y, even + along * y * y, along * x * z, along * y * z, even + along * z * z]
}

/// The position block of an endpoint's covariance.
#[must_use]
pub fn symmetric(matrix: &DMatrix<f64>, dimensions: usize) -> Symmetric {
    let at = |r: usize, c: usize| if r < dimensions { matrix[(r, c)] } else { 0.0 };
    [at(0, 0), at(1, 0), at(1, 1), at(2, 0), at(2, 1), at(2, 2)]
}

/// The inverse and the determinant of a positive definite matrix; components beyond the dimensions stay zero.
#[must_use]
pub fn inverse(matrix: &Symmetric, dimensions: usize) -> (Symmetric, f64) {
    let [xx, xy, yy, xz, yz, zz] = *matrix;
    match dimensions {
        1 => ([1.0 / xx, 0.0, 0.0, 0.0, 0.0, 0.0], xx),
        2 => {
            let determinant = xx * yy - xy * xy;
            ([yy / determinant, -xy / determinant, xx / determinant, 0.0, 0.0, 0.0], determinant)
        }
        _ => {
            let minors = [
                yy * zz - yz * yz,
                xz * yz - xy * zz,
                xx * zz - xz * xz,
                xy * yz - xz * yy,
                xy * xz - xx * yz,
                xx * yy - xy * xy,
            ];
            let determinant = xx * minors[0] + xy * minors[1] + xz * minors[3];
            (minors.map(|minor| minor / determinant), determinant)
        }
    }
}

/// A symmetric matrix times a vector.
#[must_use]
pub fn times(matrix: &Symmetric, v: &Vector) -> Vector {
    let [xx, xy, yy, xz, yz, zz] = *matrix;
    let [x, y, z] = *v;
    [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z]
}
