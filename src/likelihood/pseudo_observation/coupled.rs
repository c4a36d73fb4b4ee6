//! Models, observations or endpoints that mix axes: one filter over the complete state, and the endpoint's position as one
//! Gaussian with correlations. What the endpoint names beyond the position is conditioned on, as in [`super::separable`].

use crate::math::gaussian::Gaussian;
use crate::math::kalman::Filter;
use crate::model::motion::MotionModel;
use whither_kernel::coupled;
use whither_kernel::dense;

/// The Kalman posterior now, and that of the first observation.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupled {
    /// `p(x_1 | y_1)`.
    pub first: Gaussian,
    /// Over the pair (first observation, now).
    pub filter: Filter,
}

/// Room for what the terms are computed with, kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Room {
    /// The state now: its mean, and the columns of its covariance.
    pub now: Vec<f64>,
    /// The first state, predicted: the same.
    pub start: Vec<f64>,
    product: Vec<f64>,
    /// That of the kernel.
    pub nodes: coupled::Room,
}

impl Coupled {
    /// Writes the state now, and the first state, predicted `elapsed` ahead if at all.
    pub fn predict(&self, model: &dyn MotionModel, elapsed: Option<f64>, room: &mut Room) {
        let (s, Room { now, start, product, .. }) = (self.filter.states, room);
        now.clear();
        now.extend_from_slice(&self.filter.means.as_slice()[s..2 * s]);
        dense::resize(now, s + s * s);
        dense::square(self.filter.root.as_slice(), 2 * s, s, s, &mut now[s..]);
        dense::resize(start, s + s * s);
        let (mean, covariance) = start.split_at_mut(s);
        let (first_mean, first_covariance) = (self.first.mean.as_slice(), self.first.covariance.as_slice());
        if let Some(elapsed) = elapsed {
            let step = model.transition(elapsed);
            let (transition, noise) = (step.transition.as_slice(), step.noise.as_slice());
            dense::multiply(transition, s, first_mean, s, mean);
            mean.iter_mut().zip(&step.offset).for_each(|(mean, offset)| *mean += offset);
            dense::propagate(transition, s, first_covariance, noise, product, covariance);
        } else {
            mean.copy_from_slice(first_mean);
            covariance.copy_from_slice(first_covariance);
        }
    }
}
