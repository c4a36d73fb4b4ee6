//! Probabilities of destinations by their priors, and given that it is not "none".

use crate::math::log_sum_exp::share;
use whither_kernel::vectors::WIDTH;

/// Below this, probabilities have lost digits to that of none: their ratios are computed from the logarithms.
const SMALLEST_SUM: f64 = 1e-280;

/// Writes the prior probabilities, where `none` is that of none of them: before the first observation, and where no
/// destination can be reached, so that every likelihood is zero.
pub fn prior(priors: &[f64], none: f64, into: &mut Vec<f64>) {
    let total: f64 = priors.iter().sum();
    into.clear();
    // room for complete blocks, which a step fills before it cuts them to the count
    into.reserve_exact(priors.len().next_multiple_of(WIDTH));
    into.extend(priors.iter().map(|prior| (1.0 - none) * prior / total));
}

/// The destinations with their shares of the probability that is not none, or one of them alone. `log_likelihoods` is read only
/// where the probabilities are too small.
#[must_use]
pub fn beside_none(
    probabilities: &[f64],
    priors: &[f64],
    only: Option<usize>,
    log_likelihoods: impl FnOnce() -> Vec<f64>,
) -> Vec<(usize, f64)> {
    if let Some(one) = only {
        return vec![(one, 1.0)];
    }
    let positive = |weights: &[f64]| weights.iter().copied().enumerate().filter(|(_, share)| *share > 0.0).collect();
    if probabilities.iter().sum::<f64>() > SMALLEST_SUM {
        return positive(probabilities);
    }
    let mut weights = log_likelihoods();
    weights.iter_mut().zip(priors).for_each(|(weight, prior)| *weight += prior.ln());
    if share(&mut weights).is_none() {
        return Vec::new();
    }
    positive(&weights)
}
