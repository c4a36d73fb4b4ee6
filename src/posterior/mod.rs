//! Liang (3): the posterior over destinations, and "none of them"; and the forms that other results have.

pub mod arrival_time;
pub(crate) mod moments;
pub mod remaining;
mod serial;
pub(crate) mod shares;

/// Destinations, each with its share; the shares need not sum to one.
pub(crate) type Shares<'a> = &'a [(usize, f64)];

/// The most probable destination.
///
/// ```
/// use whither::{Predictor, Scenario};
/// let scenario: Scenario = serde_json::from_str(r#"{
///     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
///     "arrival": { "type": "uniform", "from": 1, "to": 5 },
///     "destinations": [{ "id": "a", "center": [0], "size": 1 }, { "id": "b", "center": [9], "size": 1, "prior": 3 }]
/// }"#).unwrap();
/// let mut predictor = Predictor::new(&scenario);
/// assert_eq!(predictor.best(), None);
/// predictor.observe(0.0, &[4.5]).unwrap(); // its start alone is no evidence: the priors
/// let best = predictor.best().unwrap();
/// assert_eq!((best.index, best.id.as_str()), (1, "b"));
/// assert!((best.probability - 0.75).abs() < 1e-14);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Best {
    /// Its place in the order of the destinations.
    pub index: usize,
    /// Its id.
    pub id: String,
    /// Its probability.
    pub probability: f64,
}

/// The probabilities after an observation.
#[derive(Clone, Debug, Default)]
pub(crate) struct Posterior {
    /// `p(D_i | y_1:k)`; they sum to `1 - none`.
    pub probabilities: Vec<f64>,
    /// `p(none of them | y_1:k)`.
    pub none: f64,
}

impl Posterior {
    /// The priors, with `none` for none of them: before the first observation, and where every likelihood is zero.
    pub fn set_to_prior(&mut self, priors: &[f64], none: f64) {
        shares::prior(priors, none, &mut self.probabilities);
        self.none = none;
    }

    /// Liang (3): the priors, `none` being that of none of them, times the likelihoods. Where every likelihood is zero, the
    /// probabilities are the priors.
    pub fn update(&mut self, priors: &[f64], none: f64, log_likelihoods: &[f64], log_evidence_of_none: f64) {
        let total: f64 = priors.iter().sum();
        let log_none = if none > 0.0 { log_evidence_of_none + none.ln() } else { f64::NEG_INFINITY };
        let joint = |(l, prior): (&f64, &f64)| l + ((1.0 - none) * prior / total).ln();
        self.probabilities.clear();
        self.probabilities.extend(log_likelihoods.iter().zip(priors).map(joint));
        let top = self.probabilities.iter().copied().fold(log_none, f64::max);
        if !top.is_finite() {
            self.set_to_prior(priors, none);
            return;
        }
        self.probabilities.iter_mut().for_each(|p| *p = (*p - top).exp());
        self.none = (log_none - top).exp();
        let sum = self.probabilities.iter().sum::<f64>() + self.none;
        self.probabilities.iter_mut().for_each(|p| *p /= sum);
        self.none /= sum;
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
}
