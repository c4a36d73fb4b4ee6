//! Movements, and the posteriors of predictors.

use whither::{Predictor, Scenario};

/// The six methods, as a scenario spells them, with their source.
pub const METHODS: [(&str, &str); 6] = [
    ("bridging", "original bridging"),
    ("algorithm1", "Liang, Algorithm 1"),
    ("algorithm2", "Liang, Algorithm 2"),
    ("pseudoObservation", "ours: both in closed form"),
    ("singleFilter", "Ardeshiri (12): bridging in closed form"),
    ("singleFilterApproximate", "Ardeshiri, Table 1"),
];

/// One observed movement.
pub struct Movement {
    /// Time and position.
    pub observations: Vec<(f64, Vec<f64>)>,
    /// The destination where it ended.
    pub truth: usize,
}

/// A scenario from JSON.
pub fn scenario(json: serde_json::Value) -> Scenario {
    serde_json::from_value(json).expect("the experiments' scenarios are legal")
}

/// The probabilities of all destinations after each observation.
pub fn posteriors(scenario: &Scenario, movement: &Movement) -> Vec<Vec<f64>> {
    let mut predictor = Predictor::new(scenario);
    let posterior = |(time, position): &(f64, Vec<f64>)| {
        predictor.observe(*time, position).expect("times ascend and numbers are finite");
        predictor.probabilities().to_vec()
    };
    movement.observations.iter().map(posterior).collect()
}

/// The share of the time during which the true destination has the highest probability, each observation weighted by half
/// the time to its neighbours.
pub fn share_on_top(posteriors: &[Vec<f64>], movement: &Movement) -> f64 {
    let right = |k: usize| top(&posteriors[k]) == movement.truth;
    let (mut on_top, mut total) = (0.0, 0.0);
    for (k, weight) in weights(movement).into_iter().enumerate() {
        total += weight;
        on_top += if right(k) { weight } else { 0.0 };
    }
    on_top / total
}

/// Half the time to both neighbours of each observation.
fn weights(movement: &Movement) -> Vec<f64> {
    let times: Vec<f64> = movement.observations.iter().map(|(time, _)| *time).collect();
    let last = times.len() - 1;
    (0..times.len()).map(|k| (times[(k + 1).min(last)] - times[k.saturating_sub(1)]) / 2.0).collect()
}

/// The most probable destination.
pub fn top(probabilities: &[f64]) -> usize {
    (0..probabilities.len()).fold(0, |best, i| if probabilities[i] > probabilities[best] { i } else { best })
}

/// A share as a percentage.
pub fn percent(share: f64) -> String {
    format!("{:.1}%", 100.0 * share)
}

/// The middle of a list.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The mean of a list.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}
