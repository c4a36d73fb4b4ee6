//! The posterior of the pointing model: destinations, none of them, the time to go.

use super::{Pointing, minus, vector};
use crate::model::destination::Destinations;
use crate::posterior::arrival_time::Arrival;
use crate::posterior::{Posterior, Shares};

impl Posterior {
    /// The probabilities among the destinations against none of them, whose prior is `none`, with the even share spread
    /// over the destinations that are possible at all.
    pub(crate) fn update_pointing(&mut self, pointing: &mut Pointing, destinations: &Destinations, none: f64) {
        let Some(log_sum) = pointing.probabilities(destinations, &mut self.probabilities) else {
            return self.believe_prior(destinations, none);
        };
        let (kept, uniform) = (pointing.parameters().none_share, pointing.parameters().uniform);
        self.none = match none {
            0.0 => 0.0,
            none => {
                let log_odds = (none / (1.0 - none)).ln() + pointing.log_likelihood_of_none() - log_sum;
                (1.0 - kept) / (1.0 + (-log_odds).exp()) + kept * none
            }
        };
        let priors = destinations.priors();
        let possible = priors.iter().filter(|prior| **prior > 0.0).count().max(1);
        let (kept, even) = ((1.0 - self.none) * (1.0 - uniform), (1.0 - self.none) * (uniform / possible as f64));
        for (value, prior) in self.probabilities.iter_mut().zip(priors) {
            *value = kept * *value + if *prior > 0.0 { even } else { 0.0 };
        }
    }
}

impl Pointing {
    /// The median of the time to the entry into the target and its interval, where the scenario has constants for it.
    #[must_use]
    pub fn entry_time(&self, destinations: &Destinations, shares: Shares<'_>) -> Option<[f64; 3]> {
        let entry = self.parameters().remaining.as_ref()?;
        let (pairs, course) = (self.nodes().pairs(), self.course());
        let position = course.position();
        let (mut mean, mut near, mut total) = (0.0, 0.0, 0.0);
        for &(i, share) in shares {
            let (center, kind) = (destinations.center(i), destinations.kind(i));
            let weights = pairs.weights(&center, kind);
            mean += share * pairs.list.iter().zip(&weights).map(|(pair, weight)| weight * pair.time.ln()).sum::<f64>();
            near += share * entry.nearness(&minus(&vector(&center), &position), kind, course.dimensions());
            total += share;
        }
        Some(entry.at(mean / total, near / total, course.elapsed))
    }

    /// The posterior of the arrival time, in seconds since the first observation.
    #[must_use]
    pub fn arrival(&self, destinations: &Destinations, shares: Shares<'_>) -> Arrival {
        let pairs = self.nodes().pairs();
        let mut nodes: Vec<_> = pairs.list.iter().map(|pair| (self.course().elapsed + pair.time, 0.0)).collect();
        for &(i, share) in shares {
            let weights = pairs.weights(&destinations.center(i), destinations.kind(i));
            nodes.iter_mut().zip(weights).for_each(|(node, weight)| node.1 += share * weight);
        }
        Arrival::from_nodes(&nodes)
    }
}
