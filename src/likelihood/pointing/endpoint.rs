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
use super::{Symmetric, Vector, dot, minus, vector};
use crate::math::gaussian::LN_2_PI;
use crate::math::log_sum_exp::{log_sum_exp, share};
use crate::math::mixture::{Density, Ellipsoid, HALF_LOG2_E};
use nalgebra::DMatrix;

/// One (scale, time to go).
#[derive(Clone, Copy, Debug, Default)]
pub struct Pair {
    /// The time to go `R`.
    pub time: f64,
    /// Spectral density of the noise across the way, and what is added to it along `v v'`.
    pub noise: [f64; 2],
    weight: f64,
    mean: Vector,
    covariance: Symmetric,
}

/// All pairs as they stand after an observation.
#[derive(Clone, Debug)]
pub struct Nodes {
    dimensions: usize,
    position: Vector,
    times: Vec<f64>,
    log_times: Vec<f64>,
    weights: Vec<f64>,
    /// The pairs, scale by scale.
    pub pairs: Vec<Pair>,
}

impl Nodes {
    /// The pairs after the latest observation.
    #[must_use]
    pub fn new(parameters: &Parameters, course: &Course) -> Self {
        let times = parameters.time_to_go.nodes();
        let log_times = times.iter().map(|time| time.ln()).collect();
        let (weights, pairs) = (Vec::new(), vec![Pair::default(); parameters.scales.len() * times.len()]);
        let (dimensions, position) = (course.dimensions(), course.position());
        let mut nodes = Self { dimensions, position, times, log_times, weights, pairs };
        nodes.refresh(parameters, course);
        nodes
    }

    /// The pairs after one more observation.
    pub fn refresh(&mut self, parameters: &Parameters, course: &Course) {
        let (velocity, speed) = (course.velocity(), course.speed());
        self.position = course.position();
        parameters.time_to_go.weights(&self.log_times, speed, &mut self.weights);
        let each = 1.0 / parameters.scales.len() as f64;
        let (along, across) = (parameters.along_noise.powi(2), parameters.across_noise.powi(2));
        let mut pairs = self.pairs.iter_mut();
        for scale in &parameters.scales {
            let noise = [scale * scale + across * speed * speed, along - across];
            for ((&time, weight), pair) in self.times.iter().zip(&self.weights).zip(pairs.by_ref()) {
                let mut covariance = spread(&noise, &velocity, time * time * time / 3.0);
                for (axis, place) in course.axes.iter().zip(&[0, 2, 5]) {
                    let [pp, pv, vv] = axis.covariance;
                    covariance[*place] += pp + 2.0 * time * pv + time * time * vv;
                }
                let mean = [velocity[0] * time, velocity[1] * time, velocity[2] * time];
                *pair = Pair { time, noise, weight: weight * each, mean, covariance };
            }
        }
    }

    /// Dimensions.
    #[must_use]
    pub const fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// `ln N_i` of a destination at `center` whose endpoint has this covariance.
    #[must_use]
    pub fn log_density(&self, center: &[f64], endpoint: &DMatrix<f64>) -> f64 {
        log_sum_exp(&self.log_terms(center, endpoint))
    }

    /// `p(c, R_n | D_i)`, in the order of the pairs; their priors where `N_i` is zero or no number.
    #[must_use]
    pub fn weights(&self, center: &[f64], endpoint: &DMatrix<f64>) -> Vec<f64> {
        let mut terms = self.log_terms(center, endpoint);
        if share(&mut terms).is_none() {
            terms.iter_mut().zip(&self.pairs).for_each(|(term, pair)| *term = pair.weight);
        }
        terms
    }

    /// The logarithms of the pairs' densities, weights included.
    fn log_terms(&self, center: &[f64], endpoint: &DMatrix<f64>) -> Vec<f64> {
        let own = symmetric(endpoint, self.dimensions);
        let offset = minus(&vector(center), &self.position);
        let each = self.pairs.iter().map(|pair| {
            let (precision, determinant) = inverse(&sum(&pair.covariance, &own), self.dimensions);
            let error = minus(&offset, &pair.mean);
            let square = dot(&error, &times(&precision, &error));
            pair.weight.ln() - 0.5 * (square + determinant.ln() + self.dimensions as f64 * LN_2_PI)
        });
        each.collect()
    }

    /// The pairs as terms of a sum, for destinations whose endpoints have one covariance.
    pub fn ellipsoids(&self, own: &Symmetric, into: &mut Vec<Ellipsoid>) {
        let normaliser = normaliser(self.dimensions);
        into.resize(self.pairs.len(), Ellipsoid::default());
        for (term, pair) in into.iter_mut().zip(&self.pairs) {
            let (precision, determinant) = inverse(&sum(&pair.covariance, own), self.dimensions);
            let [xx, xy, yy, xz, yz, zz] = precision;
            let (half, whole) = (-HALF_LOG2_E, -2.0 * HALF_LOG2_E);
            *term = Ellipsoid {
                center: self.end(pair),
                curvature: [[half * xx, whole * xy, whole * xz], [0.0, half * yy, whole * yz], [0.0, 0.0, half * zz]],
                slope: [0.0; 3],
                constant: 0.0,
                factor: pair.weight * normaliser / determinant.sqrt(),
            };
        }
    }

    /// The pairs as terms of a sum, for destinations whose endpoints have each its own variances.
    pub fn densities(&self, into: &mut Vec<Density>) {
        let normaliser = normaliser(self.dimensions);
        into.resize(self.pairs.len(), Density::default());
        for (term, pair) in into.iter_mut().zip(&self.pairs) {
            let [xx, xy, yy, xz, yz, zz] = pair.covariance;
            *term = Density {
                mean: self.end(pair),
                variance: [xx, yy, zz],
                covariance: [xy, xz, yz],
                factor: pair.weight * normaliser,
            };
        }
    }

    /// Where the movement would end.
    fn end(&self, pair: &Pair) -> Vector {
        let ([x, y, z], [a, b, c]) = (&self.position, &pair.mean);
        [x + a, y + b, z + c]
    }
}

/// `(2 pi)^(-d/2)`.
fn normaliser(dimensions: usize) -> f64 {
    const ONE: f64 = 0.398_942_280_401_432_7;
    match dimensions {
        1 => ONE,
        2 => ONE * ONE,
        _ => ONE * ONE * ONE,
    }
}

fn sum(a: &Symmetric, b: &Symmetric) -> Symmetric {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]]
}

/// `(noise[0] I + noise[1] v v') factor`: the noise of a movement, wider along the velocity than across it.
#[must_use]
pub fn spread(noise: &[f64; 2], velocity: &Vector, factor: f64) -> Symmetric {
    let [x, y, z] = *velocity;
    let (even, along) = (noise[0] * factor, noise[1] * factor);
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
            let over = 1.0 / determinant;
            ([yy * over, -xy * over, xx * over, 0.0, 0.0, 0.0], determinant)
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
            let [a, b, c, d, e, f] = minors;
            let by = determinant;
            ([a / by, b / by, c / by, d / by, e / by, f / by], determinant)
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
