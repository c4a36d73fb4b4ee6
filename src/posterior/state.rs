//! The state now, later and at the start, given that the object is going somewhere.
//!
//! For each destination and node the engine gives the state by its own family (`likelihood::states`): Liang (10) with the
//! pseudo-observation, the bridged posterior with an endpoint that is independent of the start. They are mixed with the weights
//! `p(D_i, T_n | y_1:k)`; mean and covariance by moment matching. Past `T_n` the state stays as at arrival.

use super::{Posterior, Shares};
use crate::likelihood::candidates::Movement;
use crate::math::gaussian::{Gaussian, symmetrise};
use crate::model::destination::Destinations;
use nalgebra::{DMatrix, DVector};

/// A mixture of Gaussians in the making: each part moves the mean and widens the covariance by its distance from it, so
/// nothing is subtracted and the covariance stays positive.
#[derive(Default)]
pub(crate) struct Moments {
    total: f64,
    pub mixture: Option<Gaussian>,
}

impl Moments {
    pub fn add(&mut self, weight: f64, mean: DVector<f64>, covariance: &DMatrix<f64>) {
        let before = self.total;
        self.total += weight;
        let Some(mixture) = &mut self.mixture else {
            self.mixture = Some(Gaussian { mean, covariance: covariance.clone() });
            return;
        };
        let (share, offset) = (weight / self.total, mean - &mixture.mean);
        mixture.covariance *= before / self.total;
        mixture.covariance += covariance * share;
        mixture.covariance.ger(share * (before / self.total), &offset, &offset, 1.0);
        symmetrise(&mut mixture.covariance);
        mixture.mean.axpy(share, &offset, 1.0);
    }
}

impl Posterior {
    /// The destination-aware state `later` seconds after the latest observation of `movement`. The weights are those of
    /// `believed`, which is the same movement unless every node has passed. None where no destination can be reached.
    #[must_use]
    pub fn state(
        &self,
        believed: &Movement,
        movement: &Movement,
        destinations: &Destinations,
        shares: Shares<'_>,
        later: f64,
    ) -> Option<Gaussian> {
        let plan = &believed.plan;
        let mut moments = Moments::default();
        let mut node_weights = vec![Vec::new(); destinations.len()];
        for &(i, share) in shares {
            node_weights[i] = self.nodes_of(believed, i);
            node_weights[i].iter_mut().for_each(|weight| *weight *= share);
        }
        for c in 0..believed.worlds.len() {
            believed.each_node(destinations, |node| {
                let place = c * plan.grids[node.group.grid].times.len() + node.index;
                let weight = |i: usize| node_weights[i].get(place).copied().unwrap_or(0.0);
                let members: Vec<usize> =
                    node.group.members.iter().map(|&i| i as usize).filter(|&i| weight(i) != 0.0).collect();
                if members.is_empty() {
                    return;
                }
                let Some(states) = believed.states(movement, destinations, c, node, &members, later) else { return };
                for (i, mean) in members.into_iter().zip(states.means) {
                    moments.add(weight(i), mean, &states.covariance);
                }
            });
        }
        moments.mixture
    }

    /// `p(x_1 | y_1:k)`, Ardeshiri's fixed-point smoother. It takes no endpoint into account; noise candidates, and motion
    /// models that know the destination, are mixed by their posterior.
    #[must_use]
    pub fn initial_state(&self, movement: &Movement, shares: Shares<'_>) -> Option<Gaussian> {
        let mut moments = Moments::default();
        for &(i, share) in shares {
            let nodes = self.nodes_of(movement, i);
            let count = nodes.len() / movement.worlds.len().max(1);
            for (world, weights) in movement.worlds.iter().zip(nodes.chunks(count.max(1))) {
                let start = world.filter.smoothed_start(i);
                let weight = share * weights.iter().sum::<f64>();
                if weight > 0.0 {
                    moments.add(weight, start.mean, &start.covariance);
                }
            }
        }
        moments.mixture
    }
}
