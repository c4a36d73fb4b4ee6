//! The posterior of the pointing model: targets, none of them, the time to go.

use super::kernel::Total;
use super::{Pointing, Space, minus};
use crate::posterior::arrival_time::ArrivalTime;
use crate::posterior::{Shares, shares};
use whither_kernel::vectors::mix;

impl<S: Space> Pointing<S> {
    /// Writes the probabilities of the targets against none of them, whose prior is `none`, with the even share distributed over
    /// the targets that are possible at all, and returns the probability of none.
    pub fn posterior(&mut self, none: f64, into: &mut Vec<f64>) -> f64 {
        let Some(Total { total, log_scale }) = self.weights(into) else {
            shares::prior(self.targets().priors(), none, into);
            return none;
        };
        let (kept, uniform) = (self.parameters().none_share, self.parameters().uniform);
        let none = match none {
            0.0 => 0.0,
            none => {
                let log_odds = self.confidence() * ((none / (1.0 - none)).ln() + self.log_likelihood_of_none())
                    - (total.ln() + log_scale);
                (1.0 - kept) / (1.0 + (-log_odds).exp()) + kept * none
            }
        };
        let even = (1.0 - none) * (uniform / self.from_start.possible as f64);
        mix(into, (1.0 - none) * (1.0 - uniform) / total, self.targets().priors(), even);
        none
    }

    /// The median of the time to the entry into the target and its interval, where the scenario has constants for it.
    #[must_use]
    pub fn entry_time(&self, shares: Shares<'_>) -> Option<[f64; 3]> {
        let entry = self.parameters().remaining.as_ref()?;
        let (pairs, course) = (self.nodes().pairs(), self.course());
        let position = course.position();
        let (mut mean, mut near, mut total) = (0.0, 0.0, 0.0);
        for &(i, share) in shares {
            let (center, extent) = (self.targets().center(i), self.targets().extent(i));
            let weights = pairs.weights(&center, extent);
            mean += share * pairs.list.iter().zip(&weights).map(|(pair, weight)| weight * pair.time.ln()).sum::<f64>();
            near += share * entry.nearness(&minus(&center, &position), extent, course.dimensions());
            total += share;
        }
        Some(entry.at(mean / total, near / total, course.elapsed, &self.learnt))
    }

    /// The posterior of the arrival time, in seconds since the first observation.
    #[must_use]
    pub fn arrival(&self, shares: Shares<'_>) -> ArrivalTime {
        let pairs = self.nodes().pairs();
        let mut nodes: Vec<_> = pairs.list.iter().map(|pair| (self.course().elapsed + pair.time, 0.0)).collect();
        for &(i, share) in shares {
            let weights = pairs.weights(&self.targets().center(i), self.targets().extent(i));
            nodes.iter_mut().zip(weights).for_each(|(node, weight)| node.1 += share * weight);
        }
        ArrivalTime::from_nodes(&nodes)
    }
}
