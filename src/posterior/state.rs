//! The state now, later and at the start, given that the object is going somewhere: Liang (10), mixed.
//!
//! For each destination and node the Kalman posterior is predicted to the time wanted, at most to `T_n` (past it the state
//! stays as at arrival), conditioned on the pseudo-observation, and mixed with the weights `p(D_i, T_n | y_1:k)`; mean and
//! covariance by moment matching.

use super::Posterior;
use crate::likelihood::candidates::Movement;
use crate::math::gaussian::{Gaussian, condition, propagate, symmetrise};
use crate::model::destination::Destinations;
use crate::model::endpoint::Endpoint;
use nalgebra::{DMatrix, DVector};

/// A mixture of Gaussians in the making, about a reference so that far-off coordinates cost no digits.
struct Moments {
    reference: DVector<f64>,
    total: f64,
    mean: DVector<f64>,
    second: DMatrix<f64>,
}

impl Moments {
    fn about(reference: DVector<f64>) -> Self {
        let n = reference.len();
        Self { reference, total: 0.0, mean: DVector::zeros(n), second: DMatrix::zeros(n, n) }
    }

    fn add(&mut self, weight: f64, mean: &DVector<f64>, covariance: &DMatrix<f64>) {
        let offset = mean - &self.reference;
        self.total += weight;
        self.mean.axpy(weight, &offset, 1.0);
        self.second += covariance * weight;
        self.second.ger(weight, &offset, &offset, 1.0);
    }

    fn finish(self) -> Option<Gaussian> {
        if self.total <= 0.0 {
            return None;
        }
        let mean = self.mean / self.total;
        let mut covariance = self.second / self.total;
        covariance.ger(-1.0, &mean, &mean, 1.0);
        symmetrise(&mut covariance);
        Some(Gaussian { mean: mean + self.reference, covariance })
    }
}

impl Posterior {
    /// The destination-aware state `later` seconds after the latest observation of `movement`. The weights are those of
    /// `believed`, which is the same movement unless every node has passed.
    #[must_use]
    pub fn state(
        &self,
        believed: &Movement,
        movement: &Movement,
        destinations: &Destinations,
        later: f64,
        only: Option<usize>,
    ) -> Option<Gaussian> {
        let plan = &believed.plan;
        let mut moments = Moments::about(movement.worlds.first()?.filter.mean(only.unwrap_or(0)));
        let shares: Vec<f64> = (0..destinations.len())
            .map(|i| only.map_or_else(|| self.share(i), |one| f64::from(u8::from(one == i))))
            .collect();
        let node_weights: Vec<Vec<f64>> = shares
            .iter()
            .enumerate()
            .map(|(i, &share)| if share > 0.0 { self.nodes_of(believed, i) } else { Vec::new() })
            .collect();
        for (c, world) in movement.worlds.iter().enumerate() {
            let covariance = world.filter.current_covariance();
            let motion = world.model.as_ref();
            for group in &plan.groups {
                let nodes = &plan.grids[group.grid].times;
                let endpoint_noise = &destinations.kinds()[group.kind].covariance;
                for (n, &time) in nodes.iter().enumerate() {
                    let place = c * nodes.len() + n;
                    let weight = |i: usize| node_weights[i].get(place).map_or(0.0, |w| w * shares[i]);
                    if group.members.iter().all(|&i| weight(i as usize) == 0.0) {
                        continue;
                    }
                    let ahead = (plan.since_first(group.grid, time, believed.elapsed) - movement.elapsed).max(0.0);
                    let onward = motion.transition(later.min(ahead));
                    let rest = Endpoint::after(motion, ahead - later.min(ahead), endpoint_noise.nrows());
                    let predicted = propagate(&onward.transition, &covariance, &onward.noise);
                    let noise = &rest.noise + endpoint_noise;
                    let Some(conditioned) = condition(&predicted, &rest.matrix, &noise) else { continue };
                    for &i in &group.members {
                        let i = i as usize;
                        let weight = weight(i);
                        if weight == 0.0 {
                            continue;
                        }
                        let center = destinations.center(i);
                        let mean = &onward.transition * world.filter.mean(i) + onward.constant(center);
                        let error = rest.error(destinations.mean(i), &mean, center);
                        moments.add(weight, &(mean + &conditioned.gain * error), &conditioned.covariance);
                    }
                }
            }
        }
        moments.finish()
    }

    /// `p(x_1 | y_1:k)`, Ardeshiri's fixed-point smoother. It takes no endpoint into account; noise candidates, and motion
    /// models that know the destination, are mixed by their posterior.
    #[must_use]
    pub fn initial_state(&self, movement: &Movement, destinations: &Destinations) -> Option<Gaussian> {
        let mut moments = Moments::about(movement.first.mean.clone());
        for i in 0..destinations.len() {
            let share = self.share(i);
            if share == 0.0 {
                continue;
            }
            let nodes = self.nodes_of(movement, i);
            let count = nodes.len() / movement.worlds.len().max(1);
            for (world, weights) in movement.worlds.iter().zip(nodes.chunks(count.max(1))) {
                let start = world.filter.smoothed_start(i);
                moments.add(share * weights.iter().sum::<f64>(), &start.mean, &start.covariance);
            }
        }
        moments.finish()
    }
}
