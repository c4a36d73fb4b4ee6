//! Liang (3): the posterior over destinations, and "none of them".

pub mod arrival_time;
pub(crate) mod shares;
pub mod state;

use crate::likelihood::candidates::Movement;
use crate::math::log_sum_exp::{log_sum_exp, share};
use crate::model::destination::Destinations;

/// Destinations that are asked about, each with its share; the shares need not sum to one.
///
/// ```
/// use whither::posterior::Shares;
/// fn total(shares: Shares<'_>) -> f64 {
///     shares.iter().map(|(_, share)| share).sum()
/// }
/// assert_eq!(total(&[(0, 0.125), (4, 0.375)]), 0.5);
/// ```
pub type Shares<'a> = &'a [(usize, f64)];

/// What is believed after an observation.
///
/// ```
/// use whither::{Value, model::destination::Destinations, posterior::Posterior, value::Node};
/// let value: Value = serde_json::from_str(r#"[
///     { "id": "near", "center": [10], "size": 12 }, { "id": "far", "center": [90], "size": 12, "prior": 3 }
/// ]"#).unwrap();
/// let destinations = Destinations::read(&Node::root(&value, "destinations"), 1, 1).unwrap();
/// let mut posterior = Posterior::default();
/// posterior.set_to_prior(&destinations, 0.5);
/// assert_eq!(posterior.probabilities, [0.125, 0.375]); // 1 to 3, of the half that is left
/// assert_eq!(posterior.best(), 1);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Posterior {
    /// For each noise candidate `ln w_c + log p(y_2:k, T_n | y_1, D_i, c)`, laid out as the plan's rows.
    pub joint: Vec<Vec<f64>>,
    /// `log p(y_2:k | y_1, D_i)`, marginalised over arrival time and noise.
    pub log_likelihoods: Vec<f64>,
    /// `p(D_i | y_1:k)`; they sum to `1 - none`.
    pub probabilities: Vec<f64>,
    /// `p(none of them | y_1:k)`.
    pub none: f64,
}

impl Posterior {
    /// Before the first observation: the priors, with `none` for none of them.
    pub fn set_to_prior(&mut self, destinations: &Destinations, none: f64) {
        self.joint.clear();
        self.log_likelihoods.clear();
        self.believe_prior(destinations, none);
    }

    /// What is believed where no destination can be reached, so that every likelihood is zero.
    pub fn believe_prior(&mut self, destinations: &Destinations, none: f64) {
        shares::prior(destinations.priors(), none, &mut self.probabilities);
        self.none = none;
    }

    /// Liang (3) and (6) for a movement so far. Where no destination can be reached, so that every likelihood is zero, the
    /// probabilities are the priors.
    pub fn update(&mut self, movement: &Movement, destinations: &Destinations, none: f64) {
        self.weigh_nodes(movement, destinations);
        let priors = destinations.priors();
        let total: f64 = priors.iter().sum();
        let weigh = |(l, prior): (&f64, &f64)| l + ((1.0 - none) * prior / total).ln();
        let weighed: Vec<f64> = self.log_likelihoods.iter().zip(priors).map(weigh).collect();
        let log_none = if none > 0.0 { movement.log_evidence_of_none(priors) + none.ln() } else { f64::NEG_INFINITY };
        let top = weighed.iter().copied().fold(log_none, f64::max);
        if !top.is_finite() {
            self.believe_prior(destinations, none);
            return;
        }
        self.probabilities.clear();
        self.probabilities.extend(weighed.iter().map(|l| (l - top).exp()));
        self.none = (log_none - top).exp();
        let sum = self.probabilities.iter().sum::<f64>() + self.none;
        self.probabilities.iter_mut().for_each(|p| *p /= sum);
        self.none /= sum;
    }

    /// The likelihoods of all nodes, and of the destinations.
    pub fn weigh_nodes(&mut self, movement: &Movement, destinations: &Destinations) {
        movement.joint(destinations, &mut self.joint);
        let plan = &movement.plan;
        let mut terms = Vec::new();
        self.log_likelihoods.clear();
        for i in 0..destinations.len() {
            terms.clear();
            for table in &self.joint {
                terms.extend_from_slice(&table[plan.rows[i]..plan.rows[i + 1]]);
            }
            self.log_likelihoods.push(log_sum_exp(&terms));
        }
    }

    /// The index of the most probable destination, the first of equals.
    #[must_use]
    pub fn best(&self) -> usize {
        let mut best = 0;
        for (i, &p) in self.probabilities.iter().enumerate() {
            if p > self.probabilities[best] {
                best = i;
            }
        }
        best
    }

    /// `p(T_n, c | D_i, y_1:k)` for each noise candidate and node of destination `i`, candidates after one another; all
    /// zero where the destination cannot be reached any more.
    #[must_use]
    pub fn nodes_of(&self, movement: &Movement, i: usize) -> Vec<f64> {
        let (from, to) = (movement.plan.rows[i], movement.plan.rows[i + 1]);
        let mut terms: Vec<f64> = self.joint.iter().flat_map(|table| table[from..to].iter().copied()).collect();
        if share(&mut terms).is_none() {
            terms.fill(0.0);
        }
        terms
    }

    /// The destinations with their shares of what is not none, or one of them alone.
    #[must_use]
    pub fn shares(&self, destinations: &Destinations, only: Option<usize>) -> Vec<(usize, f64)> {
        let log_likelihoods = || self.log_likelihoods.clone();
        shares::beside_none(&self.probabilities, destinations.priors(), only, log_likelihoods)
    }
}
