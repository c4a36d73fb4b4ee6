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
use super::parameters::{PointingConstants, TimeToGo};
use super::targets::Extent;
use super::{Space, Symmetric, Vector, dot, minus};
use crate::math::gaussian::LN_2_PI;
use crate::math::log_sum_exp::{log_sum_exp, share};
use whither_kernel::mixture::Densities;
use whither_kernel::pairs::{Motion, TimesToGo};
use whither_kernel::small_gaussian::{inverse, times};

/// One (scale, time to go).
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// The time to go `R`.
    pub time: f64,
    /// Spectral density of the noise across the way, and what is added to it along `v v'`.
    pub noise: [f64; 2],
    weight: f64,
    mean: Vector,
    covariance: Symmetric,
}

/// The pairs one at a time, for what is not computed for every destination after every observation.
#[derive(Clone, Debug)]
pub(crate) struct Pairs<S> {
    space: S,
    position: Vector,
    /// Scale by scale.
    pub list: Vec<Pair>,
}

/// All pairs after an observation.
#[derive(Clone, Debug)]
pub(crate) struct Nodes<S> {
    space: S,
    motion: Motion,
    times: TimesToGo,
    /// That of each scale, as in [`Pair::noise`].
    noises: Vec<[f64; 2]>,
}

impl<S: Space> Nodes<S> {
    /// The pairs after the latest observation.
    #[must_use]
    pub fn new(parameters: &PointingConstants, course: &Course<S>) -> Self {
        let TimeToGo { median, .. } = parameters.time_to_go;
        let mut nodes = Self {
            space: course.space(),
            motion: course.motion(),
            times: TimesToGo::new(&parameters.time_to_go.nodes(), median),
            noises: vec![[0.0; 2]; parameters.scales.len()],
        };
        nodes.refresh(parameters, course);
        nodes
    }

    /// The pairs after one more observation.
    pub fn refresh(&mut self, parameters: &PointingConstants, course: &Course<S>) {
        self.motion = course.motion();
        let speed = course.speed();
        let TimeToGo { spread, speed_exponent, .. } = parameters.time_to_go;
        let unit = parameters.unit;
        self.times.set_weights((speed + 50.0 * unit) / (1000.0 * unit), speed_exponent, spread);
        let (along, across) = (parameters.along_noise.powi(2), parameters.across_noise.powi(2));
        for (noise, scale) in self.noises.iter_mut().zip(&parameters.scales) {
            *noise = [scale * scale + across * speed * speed, along - across];
        }
    }

    /// Dimensions.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.space.dimensions()
    }

    /// The pairs, scale by scale.
    #[must_use]
    pub fn pairs(&self) -> Pairs<S> {
        let ([x, y, z], each) = (self.motion.velocity, 1.0 / self.noises.len() as f64);
        let mut list = Vec::with_capacity(self.noises.len() * self.times.times().len());
        for noise in &self.noises {
            for (&time, weight) in self.times.times().iter().zip(self.times.weights()) {
                let (mean, covariance) = ([x * time, y * time, z * time], self.motion.covariance(noise, time));
                list.push(Pair { time, noise: *noise, weight: weight * each, mean, covariance });
            }
        }
        Pairs { space: self.space, position: self.motion.position, list }
    }

    /// The pairs as densities, for destinations whose endpoints have this covariance, or each its own variances; returns whether they
    /// have all digits.
    pub fn densities(&self, own: Option<&Symmetric>, into: &mut Vec<Densities>) -> bool {
        into.resize(self.times.times().len() * self.noises.len().div_ceil(2), Densities::default());
        self.times.densities(self.dimensions(), &self.motion, &self.noises, own, into)
    }
}

impl<S: Space> Pairs<S> {
    /// `ln N_i` of a destination at `center` whose endpoint has this covariance.
    #[must_use]
    pub fn log_density(&self, center: &Vector, extent: &Extent) -> f64 {
        log_sum_exp(&self.log_terms(center, extent))
    }

    /// `p(c, R_n | D_i)`, in the order of the pairs; their priors where `N_i` is zero or no number.
    #[must_use]
    pub fn weights(&self, center: &Vector, extent: &Extent) -> Vec<f64> {
        let mut terms = self.log_terms(center, extent);
        if share(&mut terms).is_none() {
            terms.iter_mut().zip(&self.list).for_each(|(term, pair)| *term = pair.weight);
        }
        terms
    }

    /// The logarithms of the pairs' densities, weights included.
    fn log_terms(&self, center: &Vector, extent: &Extent) -> Vec<f64> {
        let d = self.space.dimensions();
        let offset = minus(center, &self.position);
        let each = self.list.iter().map(|pair| {
            let (precision, determinant) = inverse(&sum(&pair.covariance, &extent.covariance), d);
            let error = minus(&offset, &pair.mean);
            let square = dot(&error, &times(&precision, &error));
            pair.weight.ln() - 0.5 * (square + determinant.ln() + d as f64 * LN_2_PI)
        });
        each.collect()
    }
}

fn sum(a: &Symmetric, b: &Symmetric) -> Symmetric {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]]
}
