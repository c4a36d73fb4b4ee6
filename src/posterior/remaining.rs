//! The time to go, with an interval.

use super::arrival_time::ArrivalTime;

/// The time that is left, in seconds, with an interval.
///
/// With the papers' methods it lies between the tenth and the ninetieth percentile of the posterior of the arrival time. With
/// `pointing` it was fitted to hold four fifths of the samples of recorded mouse movements, and holds 83, 77 and 83% on three
/// sets, but does not leave a tenth on each side: 1, 3 and 9% enter before `low`, 15, 20 and 8% after `high`. On other devices
/// it holds less, until it is learnt ([`Learnt`](crate::Learnt)).
///
/// ```
/// use whither::{Predictor, Scenario};
/// let scenario: Scenario = serde_json::from_str(r#"{
///     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
///     "arrival": { "type": "discrete", "times": [4], "weights": [1] },
///     "destinations": [{ "id": "there", "center": [9], "size": 1 }]
/// }"#).unwrap();
/// let mut predictor = Predictor::new(&scenario);
/// predictor.observe(10.0, &[0.0]).unwrap();
/// predictor.observe(11.0, &[2.0]).unwrap();
/// assert!((predictor.remaining().unwrap().mean - 3.0).abs() < 1e-12); // 4 seconds from the first observation
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Remaining {
    /// The expected time to go; of the pointing model the median, which is off by the least.
    pub mean: f64,
    /// The lower end of the interval.
    pub low: f64,
    /// The upper end of the interval.
    pub high: f64,
}

impl Remaining {
    /// The time from `elapsed` to the arrival, the interval being that between the tenth and the ninetieth percentile.
    pub(crate) fn until(arrival: &ArrivalTime, elapsed: f64) -> Self {
        Self {
            mean: arrival.mean - elapsed,
            low: arrival.quantile(0.1) - elapsed,
            high: arrival.quantile(0.9) - elapsed,
        }
    }
}
