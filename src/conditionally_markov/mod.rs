//! Conditionally Markov sequences, Rezaie and Li: movements from an origin to a destination whose densities are known, by
//! way of waypoints if there are any.
//!
//! | equation | where |
//! |---|---|
//! | (2), (3), (10), (11) the model | [`StepModel`], [`ConditionallyMarkovSequence::model`] |
//! | (7)-(9) induced by a Markov model | [`crate::model::bridge`] |
//! | (12) filtering and prediction | [`ConditionallyMarkovSequence::measure`], [`ConditionallyMarkovSequence::state`] |
//! | Theorem 3.2 | [`ConditionallyMarkovSequence::is_reciprocal`], [`ConditionallyMarkovSequence::is_markov`] |
//!
//! The printed (12) has `x_k` on its right-hand side where `x_{k-1}` is meant.

use crate::error::{Code, Error, Result};
use crate::math::gaussian::Gaussian;
use crate::math::kalman::Measurement;
use std::sync::Arc;

mod description;
mod filter;
mod model;
mod properties;
mod sampling;
#[cfg(test)]
mod tests;

pub use description::{Boundary, GivenSequence, SequenceParameters, TimeStep};
use filter::Filter;
use model::Model;
pub use model::{MAX_STEPS, StepModel};

/// How far both sides of Theorem 3.2 may differ, relative to the larger one, unless given.
pub const DEFAULT_TOLERANCE: f64 = 1e-6;

/// A Gaussian sequence `x_0 .. x_N` that moves like a Markov sequence towards its destination `x_N`, and what is known of one
/// realisation of it after some measurements.
///
/// ```
/// use whither::{ConditionallyMarkovSequence, Motion, Observation, SequenceParameters};
/// // from about 0 to about 10 in 20 steps of a second, on one axis
/// let variances = [1.0, 0.1, 4.0, 0.1];
/// let mut sequence = ConditionallyMarkovSequence::new(&SequenceParameters {
///     motion: Motion::constant_velocity(1, 0.1),
///     time_step: 1.0.into(),
///     steps: 20,
///     pins: None,
///     pinned_mean: vec![0.0, 0.5, 10.0, 0.5],
///     pinned_covariance: std::array::from_fn::<_, 4, _>(|i| {
///         std::array::from_fn::<_, 4, _>(|j| if i == j { variances[i] } else { 0.0 })
///     })
///     .into(),
///     observation: Observation::deviation(0.2),
/// })?;
/// let before = sequence.destination();
/// sequence.measure(3, &[1.8])?;
/// sequence.measure(4, &[2.5])?;
/// let after = sequence.destination();
/// assert!(after.mean[0] > before.mean[0]); // it goes faster than expected, so farther
/// assert!(after.covariance[(0, 0)] < before.covariance[(0, 0)]);
/// let half_way = sequence.state(10)?; // a prediction
/// assert!(half_way.mean[0] > 4.0 && half_way.mean[0] < 7.0);
/// # Ok::<(), whither::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct ConditionallyMarkovSequence {
    model: Arc<Model>,
    filter: Filter,
    measurements: Vec<(usize, Measurement)>,
}

impl ConditionallyMarkovSequence {
    /// A sequence induced by a Markov model, (10)-(11) with (7)-(9).
    ///
    /// # Errors
    /// `wrong-length`, `not-finite`, `out-of-range`, `not-positive-definite`, `too-large`, `unknown-key` (`motion.speedNoise`),
    /// each with the path of the field.
    pub fn new(parameters: &SequenceParameters) -> Result<Self> {
        Ok(Self::of(Model::induced(parameters)?))
    }

    /// A sequence given matrix by matrix, (2)-(3).
    ///
    /// # Errors
    /// `wrong-length`, `not-finite`, `out-of-range`, `not-positive-definite`, `too-large`, each with the path of the field.
    pub fn from_parameters(sequence: &GivenSequence) -> Result<Self> {
        Ok(Self::of(Model::given(sequence)?))
    }

    fn of(model: Model) -> Self {
        Self { filter: Filter::new(&model), measurements: Vec::new(), model: Arc::new(model) }
    }

    /// `N`: the states are `x_0 .. x_N`.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.model.steps()
    }

    /// The number of components `s` of one state.
    #[must_use]
    pub fn states(&self) -> usize {
        self.model.states
    }

    /// The number of spatial dimensions `d`: the first `d` components of a state are its position.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.model.dimensions
    }

    /// The steps whose states are pinned, ascending: 0, any waypoints, `N`.
    #[must_use]
    pub fn pins(&self) -> &[usize] {
        &self.model.pins
    }

    /// The step of the last measurement, 0 before the first.
    #[must_use]
    pub fn step(&self) -> usize {
        self.filter.step
    }

    /// The model of step `k`: `G_{k,k-1}`, `G_{k,N}` (towards the next waypoint where there is one), `G_k`; (7)-(9).
    ///
    /// # Errors
    /// `out-of-range` where there is no such step, or its state is pinned.
    pub fn model(&self, k: usize) -> Result<StepModel> {
        self.model.step(k)
    }

    /// Takes in a measurement of the state at `step`. Steps may be skipped and measured twice; the first may be 0.
    ///
    /// # Errors
    /// `out-of-range` where there is no such step, `time-not-increasing` where a later step was measured before,
    /// `wrong-length`, `not-finite`. The sequence is then what it was.
    pub fn measure(&mut self, step: usize, position: &[f64]) -> Result<()> {
        self.model.check_step(step)?;
        if step < self.filter.step {
            let message = format!("must be at least {}, the last measured step, got {step}", self.filter.step);
            return Err(Error::new(Code::TimeNotIncreasing, "step", message));
        }
        let position: Vec<Option<f64>> = position.iter().map(|&x| Some(x)).collect();
        let measurement = self.model.observation.measurement(&position, None)?;
        let mut filter = self.filter.clone();
        filter.advance(&self.model, step)?;
        filter.correct(&measurement);
        self.filter = filter;
        self.measurements.push((step, measurement));
        Ok(())
    }

    /// The state at any step given all measurements so far: filtered at the last measured step, predicted after it,
    /// smoothed before it.
    ///
    /// # Errors
    /// `out-of-range` where there is no such step.
    pub fn state(&self, step: usize) -> Result<Gaussian> {
        self.model.check_step(step)?;
        if step < self.filter.step {
            return filter::smoothed(&self.model, &self.measurements, step);
        }
        let mut filter = self.filter.clone();
        filter.advance(&self.model, step)?;
        Ok(filter.state(&self.model))
    }

    /// The state at the end, `x_N`, given all measurements so far.
    #[must_use]
    pub fn destination(&self) -> Gaussian {
        self.filter.destination(&self.model)
    }

    /// Forgets all measurements: another realisation of the same sequence.
    pub fn reset(&mut self) {
        self.filter = Filter::new(&self.model);
        self.measurements.clear();
    }

    /// Draws `count` sequences, of `(N + 1) s` numbers each, state by state. Measurements have no influence. The same
    /// seed gives the same numbers, on other processors to rounding.
    ///
    /// # Errors
    /// `too-large` where they would be more than 10 million numbers.
    pub fn sample(&self, seed: u64, count: usize) -> Result<Vec<Vec<f64>>> {
        sampling::sample(&self.model, seed, count)
    }

    /// Whether the sequence is reciprocal: given the states at any two steps, what lies between is independent of what
    /// lies outside. Theorem 3.2: `G_k^-1 G_{k,N} = G'_{k+1,k} G_{k+1}^-1 G_{k+1,N}` for `k = 1 .. N - 2`, both sides to `tolerance` of
    /// the larger one. A sequence induced by a Markov model is, unless waypoints depend on one another in some other way.
    ///
    /// # Errors
    /// `out-of-range` for a negative tolerance, `not-positive-definite` where some `G_k` is numerically singular.
    pub fn is_reciprocal(&self, tolerance: f64) -> Result<bool> {
        properties::holds(&self.model, false, tolerance)
    }

    /// Whether the sequence is Markov: Theorem 3.2 with `G_0^-1 G_{0,N} = G'_{1,0} G_1^-1 G_{1,N}` as well.
    ///
    /// # Errors
    /// As [`ConditionallyMarkovSequence::is_reciprocal`].
    pub fn is_markov(&self, tolerance: f64) -> Result<bool> {
        properties::holds(&self.model, true, tolerance)
    }
}
