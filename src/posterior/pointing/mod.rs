//! The posterior of the pointing model: destinations, none of them, the time to go.

pub mod state;

use super::arrival_time::Arrival;
use super::{Posterior, Shares};
use crate::likelihood::pointing::Pointing;
use crate::model::destination::Destinations;

impl Posterior {
    /// Multiplies likelihoods, priors and the factor `near`, normalises together with none of them, whose prior is `none`,
    /// and spreads the even share over the destinations that are possible at all.
    pub(crate) fn update_pointing(&mut self, pointing: &mut Pointing, destinations: &Destinations, none: f64) {
        pointing.log_likelihoods(destinations, &mut self.log_likelihoods);
        let priors = destinations.priors();
        let total: f64 = priors.iter().sum();
        let scale = (1.0 - none) / total;
        let log_none = if none > 0.0 { none.ln() + pointing.log_likelihood_of_none() } else { f64::NEG_INFINITY };
        let each = self.log_likelihoods.iter().zip(pointing.log_near()).zip(priors);
        self.probabilities.clear();
        self.probabilities.extend(each.map(|((likelihood, near), prior)| likelihood + near + (scale * prior).ln()));
        let largest = self.probabilities.iter().copied().fold(log_none, f64::max);
        self.none = (log_none - largest).exp();
        let mut sum = self.none;
        for value in &mut self.probabilities {
            *value = (*value - largest).exp();
            sum += *value;
        }
        let scale = if self.none < sum { 1.0 / (sum - self.none) } else { 0.0 };
        let kept = pointing.parameters().none_share;
        self.none = (1.0 - kept) * self.none / sum + kept * none;
        let uniform = pointing.parameters().uniform;
        let possible = priors.iter().filter(|prior| **prior > 0.0).count().max(1);
        let share = uniform * (1.0 - self.none) / possible as f64;
        for (value, prior) in self.probabilities.iter_mut().zip(priors) {
            *value = (1.0 - uniform) * (1.0 - self.none) * *value * scale + if *prior > 0.0 { share } else { 0.0 };
        }
    }
}

impl Pointing {
    /// The median of the time to the entry into the target and its 80% interval, where the scenario has constants for it.
    #[must_use]
    pub fn entry_time(&self, destinations: &Destinations, shares: Shares<'_>) -> Option<[f64; 3]> {
        let entry = self.parameters().remaining.as_ref()?;
        let pairs = self.nodes();
        let (mut mean, mut total) = (0.0, 0.0);
        for &(i, share) in shares {
            let weights = pairs.weights(destinations.center(i), &destinations.kind(i).covariance);
            mean += share * pairs.pairs.iter().zip(&weights).map(|(pair, weight)| weight * pair.time.ln()).sum::<f64>();
            total += share;
        }
        Some(entry.at(mean / total, self.course().speed()))
    }

    /// The posterior of the arrival time, in seconds since the first observation.
    #[must_use]
    pub fn arrival(&self, destinations: &Destinations, shares: Shares<'_>) -> Arrival {
        let pairs = self.nodes();
        let mut nodes = Vec::with_capacity(pairs.pairs.len());
        nodes.extend(pairs.pairs.iter().map(|pair| (self.course().elapsed + pair.time, 0.0)));
        for &(i, share) in shares {
            let weights = pairs.weights(destinations.center(i), &destinations.kind(i).covariance);
            nodes.iter_mut().zip(weights).for_each(|(node, weight)| node.1 += share * weight);
        }
        Arrival::from_nodes(nodes)
    }
}
