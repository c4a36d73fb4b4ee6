//! The filter of the pointing model: constant velocity whose noise grows with the speed, each axis a 2 by 2 covariance.

use super::parameters::Parameters;
use super::{Vector, dot, vector};
use crate::error::Result;
use crate::value::{Node, Value};

/// The shortest step that the filter takes, in seconds: repeated times must not make the velocity certain.
const SHORTEST_STEP: f64 = 1e-4;

/// One axis of the state: position and velocity now, and at the start given all observations, with what ties them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Position now.
    pub position: f64,
    /// Velocity now.
    pub velocity: f64,
    /// Variance of the position, covariance with the velocity, variance of the velocity.
    pub covariance: [f64; 3],
    /// Position and velocity at the first observation, smoothed.
    pub first: [f64; 2],
    /// Their covariance, in the same order as `covariance`.
    pub first_covariance: [f64; 3],
    /// Covariance of the first state (rows) with the state now (columns), row by row.
    pub tie: [f64; 4],
}

impl Axis {
    fn begin(position: f64, variance: f64, speed_variance: f64) -> Self {
        let covariance = [variance, 0.0, speed_variance];
        Self {
            position,
            velocity: 0.0,
            covariance,
            first: [position, 0.0],
            first_covariance: covariance,
            tie: [variance, 0.0, 0.0, speed_variance],
        }
    }

    fn predict(&mut self, step: f64, noise: f64) {
        let [pp, pv, vv] = self.covariance;
        self.position += step * self.velocity;
        self.covariance = [
            pp + 2.0 * step * pv + step * step * vv + noise * step.powi(3) / 3.0,
            pv + step * vv + noise * step * step / 2.0,
            vv + noise * step,
        ];
        self.tie[0] += step * self.tie[1];
        self.tie[2] += step * self.tie[3];
    }

    fn correct(&mut self, observed: f64, variance: f64) {
        let [pp, pv, vv] = self.covariance;
        let total = pp + variance;
        let (k0, k1) = (pp / total, pv / total);
        let error = observed - self.position;
        self.position += k0 * error;
        self.velocity += k1 * error;
        self.covariance = [pp * (1.0 - k0), pv * (1.0 - k0), vv - k1 * pv];
        let gain = [self.tie[0] / total, self.tie[2] / total];
        self.first[0] += gain[0] * error;
        self.first[1] += gain[1] * error;
        self.first_covariance[0] -= gain[0] * self.tie[0];
        self.first_covariance[1] -= gain[0] * self.tie[2];
        self.first_covariance[2] -= gain[1] * self.tie[2];
        for row in [0, 2] {
            let with_position = self.tie[row];
            self.tie[row] -= k0 * with_position;
            self.tie[row + 1] -= k1 * with_position;
        }
    }
}

/// The movement so far, without regard to the destinations.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    dimensions: usize,
    /// The first observed position `y_1`.
    pub start: Vector,
    /// `t_k - t_1`.
    pub elapsed: f64,
    /// How many observations there were.
    pub observations: u64,
    /// The axes; those beyond the dimensions stay at zero.
    pub axes: [Axis; 3],
}

impl Course {
    /// Begins at the first observation, of variance `variances` in each axis.
    #[must_use]
    pub fn begin(parameters: &Parameters, position: &[f64], variances: &[f64]) -> Self {
        let mut start = Vector::default();
        let mut axes = [Axis::begin(0.0, 0.0, 0.0); 3];
        for (j, (&y, &variance)) in position.iter().zip(variances).enumerate().take(3) {
            start[j] = y;
            axes[j] = Axis::begin(y, variance, parameters.first_speed[j].powi(2));
        }
        Self { dimensions: position.len().min(3), start, elapsed: 0.0, observations: 1, axes }
    }

    /// Takes in one more observation, `elapsed` seconds after the first one; none marks an axis that was not observed.
    pub fn advance(&mut self, parameters: &Parameters, elapsed: f64, position: &[Option<f64>], variances: &[f64]) {
        let step = elapsed - self.elapsed;
        let velocity = self.velocity();
        let noise = parameters.filter_noise.powi(2) + parameters.speed_noise.powi(2) * dot(&velocity, &velocity);
        for (axis, (observed, &variance)) in self.axes.iter_mut().zip(position.iter().zip(variances)) {
            axis.predict(step.max(SHORTEST_STEP), noise);
            if let Some(observed) = observed {
                axis.correct(*observed, variance);
            }
        }
        self.elapsed = elapsed;
        self.observations += 1;
    }

    /// Spatial dimensions.
    #[must_use]
    pub const fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// The position now.
    #[must_use]
    pub fn position(&self) -> Vector {
        self.axes.map(|axis| axis.position)
    }

    /// The velocity now.
    #[must_use]
    pub fn velocity(&self) -> Vector {
        self.axes.map(|axis| axis.velocity)
    }

    /// The speed now.
    #[must_use]
    pub fn speed(&self) -> f64 {
        let velocity = self.velocity();
        dot(&velocity, &velocity).sqrt()
    }

    /// What a snapshot keeps.
    #[must_use]
    pub fn save(&self) -> Value {
        let mut numbers = self.start[..self.dimensions].to_vec();
        for axis in &self.axes[..self.dimensions] {
            numbers.extend([axis.position, axis.velocity]);
            numbers.extend(axis.covariance);
            numbers.extend(axis.first);
            numbers.extend(axis.first_covariance);
            numbers.extend(axis.tie);
        }
        Value::map([
            ("elapsed", Value::exact(self.elapsed)),
            ("observations", Value::Number(self.observations as f64)),
            ("axes", Value::exact_numbers(&numbers)),
        ])
    }

    /// The course that [`Course::save`] wrote.
    ///
    /// # Errors
    /// Those of reading a value.
    pub fn load(node: &Node<'_>, dimensions: usize) -> Result<Self> {
        const EACH: usize = 14;
        let fields = node.fields(&["elapsed", "observations", "axes"])?;
        let numbers = fields.required("axes")?.exact_numbers(dimensions * (1 + EACH))?;
        let (start, rest) = numbers.split_at(dimensions);
        let mut axes = [Axis::begin(0.0, 0.0, 0.0); 3];
        for (axis, n) in axes.iter_mut().zip(rest.chunks_exact(EACH)) {
            *axis = Axis {
                position: n[0],
                velocity: n[1],
                covariance: [n[2], n[3], n[4]],
                first: [n[5], n[6]],
                first_covariance: [n[7], n[8], n[9]],
                tie: [n[10], n[11], n[12], n[13]],
            };
        }
        Ok(Self {
            dimensions,
            start: vector(start),
            elapsed: fields.required("elapsed")?.exact()?,
            observations: fields.required("observations")?.positive()? as u64,
            axes,
        })
    }
}
