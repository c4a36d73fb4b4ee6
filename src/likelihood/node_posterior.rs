//! What the papers' methods have beyond likelihoods of destinations: the posterior of the arrival nodes, and through it the
//! arrival time and the state now, later and at the start, given that the object is going somewhere.
//!
//! For each destination and node the method gives the state by its own family ([`super::states`]): Liang (10) with the
//! pseudo-observation, the bridged posterior with an endpoint that is independent of the start. They are mixed with the weights
//! `p(D_i, T_n | y_1:k)`; mean and covariance by moment matching. Past `T_n` the state stays as at arrival.

use super::expiring::Expiring;
use super::filter_bank::FilterBank;
use crate::math::gaussian::Gaussian;
use crate::math::log_sum_exp::{log_sum_exp, share};
use crate::model::destination::Destinations;
use crate::posterior::Shares;
use crate::posterior::arrival_time::ArrivalTime;
use crate::posterior::moments::Moments;

/// For each noise candidate `ln w_c + log p(y_2:k, T_n | y_1, D_i, c)`, laid out as [`Plan::rows`](super::plan::Plan::rows) is.
/// The filters that it was computed from go with it: `bank` is always theirs.
#[derive(Clone, Debug)]
pub(crate) struct NodePosterior {
    joint: Vec<Vec<f64>>,
}

impl NodePosterior {
    pub fn new(bank: &FilterBank, destinations: &Destinations) -> Self {
        Self { joint: bank.joint(destinations) }
    }

    /// Liang (6): `log p(y_2:k | y_1, D_i)`, marginalised over arrival time and noise.
    pub fn log_likelihoods(&self, bank: &FilterBank, into: &mut Vec<f64>) {
        let mut terms = Vec::new();
        into.clear();
        into.extend(bank.plan.rows.windows(2).map(|row| {
            terms.clear();
            for table in &self.joint {
                terms.extend_from_slice(&table[row[0]..row[1]]);
            }
            log_sum_exp(&terms)
        }));
    }

    /// `p(T_n, c | D_i, y_1:k)` for each noise candidate and node of destination `i`, candidates after one another; all
    /// zero where the destination cannot be reached any more.
    fn weights(&self, bank: &FilterBank, i: usize) -> Vec<f64> {
        let (from, to) = (bank.plan.rows[i], bank.plan.rows[i + 1]);
        let mut terms: Vec<f64> = self.joint.iter().flat_map(|table| table[from..to].iter().copied()).collect();
        if share(&mut terms).is_none() {
            terms.fill(0.0);
        }
        terms
    }

    /// `p(T_n | y_1:k)`, mixed over destinations by their shares; none where they cannot be reached any more.
    pub fn arrival(&self, bank: &FilterBank, shares: Shares<'_>) -> Option<ArrivalTime> {
        let mut nodes = Vec::new();
        for &(i, share) in shares {
            let grid = bank.plan.grid_of[i] as usize;
            let times = &bank.plan.grids[grid].times;
            for (n, weight) in self.weights(bank, i).into_iter().enumerate() {
                nodes.push((bank.plan.since_first(grid, times[n % times.len()], bank.elapsed), share * weight));
            }
        }
        nodes.iter().any(|(_, weight)| *weight > 0.0).then(|| ArrivalTime::from_nodes(&nodes))
    }

    /// The state `later` seconds after the latest observation. None where no destination can be reached.
    pub fn state(
        &self,
        filters: &Expiring<FilterBank>,
        destinations: &Destinations,
        shares: Shares<'_>,
        later: f64,
    ) -> Option<Gaussian> {
        let bank = filters.evidence();
        let mut moments = Moments::default();
        let mut node_weights = vec![Vec::new(); destinations.len()];
        for &(i, share) in shares {
            node_weights[i] = self.weights(bank, i);
            node_weights[i].iter_mut().for_each(|weight| *weight *= share);
        }
        for c in 0..bank.candidates.len() {
            bank.each_node(destinations, |node| {
                let place = c * bank.plan.grids[node.group.grid].times.len() + node.index;
                let weight = |i: usize| node_weights[i].get(place).copied().unwrap_or(0.0);
                let members: Vec<usize> =
                    node.members.iter().map(|&i| i as usize).filter(|&i| weight(i) != 0.0).collect();
                if members.is_empty() {
                    return;
                }
                let Some(states) = bank.states(&filters.now, destinations, c, node, &members, later) else { return };
                for (i, mean) in members.into_iter().zip(states.means) {
                    moments.add(weight(i), mean, &states.covariance);
                }
            });
        }
        moments.mixture
    }

    /// `p(x_1 | y_1:k)`, Ardeshiri's fixed-point smoother. It takes no endpoint into account; noise candidates, and motion
    /// models that depend on the destination, are mixed by their posterior.
    pub fn initial_state(&self, bank: &FilterBank, shares: Shares<'_>) -> Option<Gaussian> {
        let mut moments = Moments::default();
        for &(i, share) in shares {
            let nodes = self.weights(bank, i);
            let count = nodes.len() / bank.candidates.len().max(1);
            for (candidate, weights) in bank.candidates.iter().zip(nodes.chunks(count.max(1))) {
                let start = candidate.filter.smoothed_start(i);
                let weight = share * weights.iter().sum::<f64>();
                if weight > 0.0 {
                    moments.add(weight, start.mean, &start.covariance);
                }
            }
        }
        moments.mixture
    }
}
