//! The posterior of the arrival time, `p(T_n | y_1:k)`, mixed over the destinations or for one of them.

use crate::math::radix_sort::sort_numbers;

/// Arrival times and their probabilities.
///
/// ```
/// use whither::{Arrival, ArrivalTime, Destination, Motion, Observation, Predictor, Scenario};
/// let scenario = Scenario::builder(Motion::brownian(1, 1.0), Observation::deviation(1.0))
///     .arrival(Arrival::Discrete { times: vec![1.0, 5.0], weights: vec![1.0, 3.0] })
///     .destination(Destination::new("there", [9.0]).size(1.0))
///     .build()?;
/// let mut predictor = Predictor::new(&scenario);
/// predictor.observe(10.0, &[0.0])?; // the first observation alone is no evidence: the prior
/// let arrival: ArrivalTime = predictor.arrival(None)?.unwrap();
/// assert_eq!(arrival.times, [11.0, 15.0]);
/// assert!((arrival.mean - 14.0).abs() < 1e-12 && (arrival.deviation - 3f64.sqrt()).abs() < 1e-12);
/// # Ok::<(), whither::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ArrivalTime {
    /// The nodes, ascending.
    pub times: Vec<f64>,
    /// Their probabilities; they sum to one.
    pub probabilities: Vec<f64>,
    /// The mean arrival time.
    pub mean: f64,
    /// Its standard deviation.
    pub deviation: f64,
}

impl ArrivalTime {
    /// The posterior for nodes that may repeat and be in any order; `weights` need not sum to one.
    #[must_use]
    pub(crate) fn from_nodes(nodes: &[(f64, f64)]) -> Self {
        let mut times: Vec<f64> = nodes.iter().map(|(time, _)| *time).collect();
        sort_numbers(&mut times);
        times.dedup();
        let mut probabilities = vec![0.0; times.len()];
        for (time, weight) in nodes {
            probabilities[times.partition_point(|t| t < time)] += weight;
        }
        let total: f64 = probabilities.iter().sum();
        if total > 0.0 {
            probabilities.iter_mut().for_each(|p| *p /= total);
        }
        let mean: f64 = times.iter().zip(&probabilities).map(|(t, p)| t * p).sum();
        let variance: f64 = times.iter().zip(&probabilities).map(|(t, p)| (t - mean) * (t - mean) * p).sum();
        Self { times, probabilities, mean, deviation: variance.max(0.0).sqrt() }
    }

    /// The time below which the share `level` of the probability lies, between nodes linear in the middle of their shares.
    #[must_use]
    pub fn quantile(&self, level: f64) -> f64 {
        let (mut below, mut last) = (0.0, None);
        for (&time, &p) in self.times.iter().zip(&self.probabilities).filter(|(_, p)| **p > 0.0) {
            let middle = below + 0.5 * p;
            if level <= middle {
                return match last {
                    Some((from, start)) => start + (time - start) * (level - from) / (middle - from),
                    None => time,
                };
            }
            last = Some((middle, time));
            below += p;
        }
        last.map_or(self.mean, |(_, time)| time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_in_any_order_have_the_moments_of_their_weights() {
        let arrival = ArrivalTime::from_nodes(&[(5.0, 2.0), (1.0, 1.0), (5.0, 1.0)]);
        assert_eq!((&arrival.times[..], &arrival.probabilities[..]), (&[1.0, 5.0][..], &[0.25, 0.75][..]));
        assert_eq!(arrival.mean, 4.0);
        assert!((arrival.deviation - 3f64.sqrt()).abs() < 1e-14); // (9 + 3 * 1) / 4
    }

    #[test]
    fn nodes_at_one_time_are_one_node() {
        let arrival = ArrivalTime::from_nodes(&[(3.0, 1.0), (1.0, 1.0), (3.0, 2.0)]);
        assert_eq!(arrival.times, [1.0, 3.0]);
        assert_eq!(arrival.probabilities, [0.25, 0.75]);
        assert_eq!(arrival.mean, 2.5);
        assert!((arrival.deviation - 0.75f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn quantiles_run_from_node_to_node() {
        let arrival = ArrivalTime::from_nodes(&[(1.0, 1.0), (2.0, 1.0), (4.0, 2.0)]);
        assert_eq!(arrival.quantile(0.05), 1.0);
        assert_eq!(arrival.quantile(0.25), 1.5);
        assert_eq!(arrival.quantile(0.99), 4.0);
    }
}
