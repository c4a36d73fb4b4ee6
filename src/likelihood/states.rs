//! The state given a destination and an arrival time, `p(x(t) | y_1:k, D_i, T_n)`: of every method, and Liang (10).
//!
//! Each family answers from its own construction of the endpoint. Where the endpoint is a pseudo-observation of `x_T` that is
//! Liang (10), here; where it is independent of the start it is the posterior of the augmented state, in
//! [`super::bridging`] and [`super::single_filter`]. After `T_n` the state stays as at arrival.

use super::{NodeOfGroup, Scene};
use crate::math::gaussian::{condition, propagate};
use crate::model::endpoint::Endpoint;
use nalgebra::{DMatrix, DVector};

/// The query for the state at one time given one arrival node, for destinations that share every matrix there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StateQuery<'a> {
    /// The movement now.
    pub now: Scene<'a>,
    /// The movement whose likelihoods hold: the same, unless every node has passed since then.
    pub evidence: Scene<'a>,
    /// The arrival time `T_n`, with what is left of it at `evidence`.
    pub node: &'a NodeOfGroup<'a>,
    /// The destinations, all of the node's group.
    pub members: &'a [usize],
    /// How long after `now` the state is wanted, in seconds.
    pub later: f64,
}

/// The states of several destinations: a mean for each, and the one covariance that they share.
#[derive(Clone, Debug)]
pub(crate) struct States {
    pub means: Vec<DVector<f64>>,
    pub covariance: DMatrix<f64>,
}

impl StateQuery<'_> {
    /// How far the state moves on from `from`, at most to the arrival, and what is left from there to the arrival.
    pub(crate) fn onward(&self, from: &Scene<'_>) -> (f64, f64) {
        let left = (self.node.since_first - from.elapsed).max(0.0);
        let onward = (self.later + (self.now.elapsed - from.elapsed)).min(left);
        (onward, left - onward)
    }

    /// Liang (10) for the state at the wanted time: the Kalman posterior, predicted to it, is conditioned on the
    /// pseudo-observation `a_i` of the endpoint. None where the endpoint's prediction error has no density.
    pub(crate) fn given_pseudo_observation(&self) -> Option<States> {
        let (onward, left) = self.onward(&self.now);
        let Scene { motion, destinations, filter, .. } = self.now;
        let step = motion.transition(onward);
        let rest = Endpoint::after(motion, left, self.node.covariance.nrows());
        let predicted = propagate(&step.transition, &filter.current_covariance(), &step.noise);
        let conditioned = condition(&predicted, &rest.matrix, &(&rest.noise + &self.node.covariance))?;
        let mean = |&i: &usize| {
            let mean = step.predict(&filter.mean(i), destinations.center(i));
            let error = self.now.endpoint_error(i, &rest, &mean);
            mean + &conditioned.gain * &error
        };
        Some(States { means: self.members.iter().map(mean).collect(), covariance: conditioned.covariance() })
    }
}
