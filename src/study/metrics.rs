//! How good predictions are along a recorded movement, on its approach to the target.

use super::track::Track;
use crate::error::Result;
use crate::math::random::Random;
use crate::predictor::Predictor;
use crate::scenario::Scenario;

/// Shares of the approach's time at which accuracy is reported.
pub const MOMENTS: [f64; 4] = [0.25, 0.5, 0.75, 0.9];

/// Bins of the top probability, for calibration.
pub const BINS: usize = 10;

/// Points of the course of the movement, from its start to the entry into the target.
pub const COURSE: usize = 21;

/// Probabilities below this count as this in the log loss.
pub const FLOOR: f64 = 1e-4;

/// What was predicted after one sample.
///
/// ```
/// use whither::study::{metrics::{Prediction, Score}, track::Track};
/// let track: Track = serde_json::from_str(r#"{
///     "target": 1, "targets": [[0, 0, 40, 40], [100, 0, 40, 40]],
///     "samples": [[0, 50, 0], [1, 60, 0], [2, 90, 0], [3, 95, 0]]
/// }"#).unwrap();
/// let predictions = [0, 1, 1, 1].map(|top| Prediction { top: Some(top), chances: None });
/// assert_eq!(Score::of(&track, &predictions).lead, 2.0); // right for the last two of three seconds
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// The most probable target; none where the predictor names none.
    pub top: Option<usize>,
    /// Where the predictor gives probabilities: that of the top target, and that of the true one.
    pub chances: Option<[f64; 2]>,
}

/// One bin of a calibration curve.
///
/// ```
/// use whither::study::metrics::{Bin, calibration_error};
/// // four predictions of 0.7 to 0.8 that sum to 3, of which two came true
/// let bin = Bin { count: 4.0, predicted: 3.0, happened: 2.0 };
/// assert_eq!(calibration_error(&[bin]), 0.25);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bin {
    /// How many predictions.
    pub count: f64,
    /// Sum of their probabilities.
    pub predicted: f64,
    /// How many came true.
    pub happened: f64,
}

/// The score of one predictor on one track, or the sum of many.
///
/// ```
/// use whither::study::{metrics::{Prediction, Score}, track::Track};
/// let track: Track = serde_json::from_str(r#"{
///     "target": 1, "targets": [[0, 0, 40, 40], [100, 0, 40, 40]],
///     "samples": [[0, 50, 0], [1, 60, 0], [2, 90, 0], [3, 95, 0]]
/// }"#).unwrap();
/// let half = Prediction { top: Some(1), chances: Some([0.5, 0.5]) };
/// let wrong = Prediction { top: Some(0), chances: Some([0.5, 0.5]) };
/// let score = Score::of(&track, &[wrong, wrong, half, half]);
/// assert_eq!(score.time, 0.5); // the last two of four samples, each with half of its neighbours' interval
/// assert!((score.loss - 4.0 * 2f64.ln()).abs() < 1e-14);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Score {
    /// Tracks.
    pub tracks: f64,
    /// Share of the time with the true target on top, each sample weighted by half of its neighbours' interval.
    pub time: f64,
    /// Whether the true target is on top at each of [`MOMENTS`].
    pub at: [f64; MOMENTS.len()],
    /// The same along the movement, at [`COURSE`] evenly spaced moments.
    pub course: [f64; COURSE],
    /// Seconds from the moment since which the top stays right until the end.
    pub lead: f64,
    /// Samples for which there were probabilities.
    pub samples: f64,
    /// Sum over them of `-ln p(true target)`.
    pub loss: f64,
    /// Calibration of the top probability.
    pub bins: [Bin; BINS],
}

/// The figures of a [`Score`], over its tracks.
///
/// ```
/// use whither::study::metrics::Score;
/// let mut sum = Score { tracks: 1.0, time: 0.5, lead: 0.25, ..Score::default() };
/// sum.add(&Score { tracks: 1.0, time: 1.0, lead: 0.75, ..Score::default() });
/// let figures = sum.figures();
/// assert_eq!((figures.time, figures.lead), (75.0, 500.0)); // percent and milliseconds, of a mean track
/// assert_eq!(figures.loss, None); // without probabilities there is none
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Share of the time with the true target on top, in percent.
    pub time: f64,
    /// Mean log loss over samples, in nats.
    pub loss: Option<f64>,
    /// Expected calibration error.
    pub calibration: Option<f64>,
    /// Accuracy at each of [`MOMENTS`], in percent.
    pub at: [f64; MOMENTS.len()],
    /// Lead time, in milliseconds.
    pub lead: f64,
}

impl Score {
    /// The score of what was predicted after each of the first `predictions.len()` samples.
    #[must_use]
    pub fn of(track: &Track, predictions: &[Prediction]) -> Self {
        let samples = &track.samples[..predictions.len().min(track.samples.len())];
        let Some((first, last)) = samples.first().zip(samples.last()) else { return Self::default() };
        let right = |k: usize| f64::from(u8::from(predictions[k].top == Some(track.target)));
        let mut score = Self { tracks: 1.0, ..Self::default() };
        let mut total = 0.0;
        for (k, sample) in samples.iter().enumerate() {
            let before = samples[k.saturating_sub(1)].time;
            let after = samples[(k + 1).min(samples.len() - 1)].time;
            total += (after - before) / 2.0;
            score.time += (after - before) / 2.0 * right(k);
            if let Some([top, of_target]) = predictions[k].chances {
                score.samples += 1.0;
                score.loss -= of_target.max(FLOOR).ln();
                let bin = &mut score.bins[((top * BINS as f64) as usize).min(BINS - 1)];
                bin.count += 1.0;
                bin.predicted += top;
                bin.happened += right(k);
            }
            if right(k) == 0.0 {
                score.lead = 0.0;
            } else if score.lead == 0.0 {
                score.lead = (last.time - sample.time).max(f64::MIN_POSITIVE);
            }
        }
        score.time /= total.max(1e-12);
        let at = |share: f64| {
            let moment = first.time + (last.time - first.time) * share + 1e-9;
            right(samples.partition_point(|sample| sample.time <= moment).saturating_sub(1))
        };
        score.at = MOMENTS.map(at);
        score.course = std::array::from_fn(|k| at(k as f64 / (COURSE - 1) as f64));
        score
    }

    /// The score of a predictor of ours on the first `approach` samples.
    ///
    /// # Errors
    /// Those of the predictor.
    pub fn of_scenario(track: &Track, approach: usize, scenario: &Scenario) -> Result<Self> {
        Self::of_predictor(track, approach, &mut Predictor::new(scenario))
    }

    /// The same for a predictor that is at the beginning of a movement, among the track's targets: one that has learnt from
    /// what was chosen before.
    ///
    /// # Errors
    /// Those of the predictor.
    pub fn of_predictor(track: &Track, approach: usize, predictor: &mut Predictor) -> Result<Self> {
        let mut predictions = Vec::with_capacity(approach);
        for sample in &track.samples[..approach.min(track.samples.len())] {
            sample.observe(predictor)?;
            let top = predictor.best().map(|best| best.index);
            let probabilities = predictor.probabilities();
            let chances = top.map(|top| [probabilities[top], probabilities[track.target]]);
            predictions.push(Prediction { top, chances });
        }
        Ok(Self::of(track, &predictions))
    }

    /// Adds another score to this one.
    pub fn add(&mut self, other: &Self) {
        self.tracks += other.tracks;
        self.time += other.time;
        self.lead += other.lead;
        self.samples += other.samples;
        self.loss += other.loss;
        self.at.iter_mut().zip(other.at).for_each(|(to, from)| *to += from);
        self.course.iter_mut().zip(other.course).for_each(|(to, from)| *to += from);
        for (to, from) in self.bins.iter_mut().zip(other.bins) {
            to.count += from.count;
            to.predicted += from.predicted;
            to.happened += from.happened;
        }
    }

    /// The figures, over all tracks and samples that were added.
    #[must_use]
    pub fn figures(&self) -> Figures {
        let tracks = self.tracks.max(1.0);
        let any = self.samples > 0.0;
        Figures {
            time: 100.0 * self.time / tracks,
            loss: any.then(|| self.loss / self.samples),
            calibration: any.then(|| calibration_error(&self.bins)),
            at: self.at.map(|right| 100.0 * right / tracks),
            lead: 1000.0 * self.lead / tracks,
        }
    }
}

/// The expected calibration error: `|predicted - happened|` of each bin, weighted by its count.
#[must_use]
pub fn calibration_error(bins: &[Bin]) -> f64 {
    let count: f64 = bins.iter().map(|bin| bin.count).sum();
    bins.iter().map(|bin| (bin.predicted - bin.happened).abs()).sum::<f64>() / count.max(1.0)
}

/// A 95% interval by drawing users with replacement: of time% and, where there are probabilities, of the log loss.
#[must_use]
pub fn bootstrap<'a>(users: impl Iterator<Item = &'a Score>, draws: usize) -> [Option<[f64; 2]>; 2] {
    let users: Vec<&Score> = users.collect();
    if users.len() < 2 {
        return [None, None];
    }
    let mut random = Random::new(0);
    let (mut times, mut losses) = (Vec::with_capacity(draws), Vec::with_capacity(draws));
    for _ in 0..draws {
        let mut sum = [0.0; 4];
        for _ in 0..users.len() {
            let user = users[(random.uniform() * users.len() as f64) as usize];
            sum.iter_mut().zip([user.time, user.tracks, user.loss, user.samples]).for_each(|(to, from)| *to += from);
        }
        times.push(100.0 * sum[0] / sum[1]);
        if sum[3] > 0.0 {
            losses.push(sum[2] / sum[3]);
        }
    }
    let interval = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values[((values.len() - 1) as f64 * share).round() as usize];
        (!values.is_empty()).then(|| [at(0.025), at(0.975)])
    };
    [interval(times), interval(losses)]
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn track(times: &[f64]) -> Track {
        let samples: Vec<String> = times.iter().map(|t| format!("[{t}, {}, 0]", 10.0 * t)).collect();
        let text =
            format!(r#"{{"targets": [[0, 0, 1, 1], [40, 0, 1, 1]], "target": 1, "samples": [{}]}}"#, samples.join(","));
        serde_json::from_str(&text).unwrap()
    }

    fn predicted(top: usize, chances: [f64; 2]) -> Prediction {
        Prediction { top: Some(top), chances: Some(chances) }
    }

    #[test]
    fn a_track_scored_by_hand() {
        // times 0, 1, 2, 4: weights .5, 1, 1.5, 1 (sum 4); right at 1 and from 4 on
        let predictions = [
            predicted(0, [0.6, 0.4]),
            predicted(1, [0.7, 0.7]),
            predicted(0, [0.95, 0.00001]),
            predicted(1, [0.96, 0.96]),
        ];
        let score = Score::of(&track(&[0.0, 1.0, 2.0, 4.0]), &predictions);
        assert!((score.time - 2.0 / 4.0).abs() < 1e-12);
        // 25% is t = 1 (right), 50% t = 2 (wrong), 75% t = 3, so the sample at 2; 90% the same
        assert_eq!(score.at, [1.0, 0.0, 0.0, 0.0]);
        assert!(score.lead <= f64::MIN_POSITIVE, "right since the last sample only");
        let expected = -(0.4f64.ln() + 0.7f64.ln() + 1e-4f64.ln() + 0.96f64.ln());
        assert!((score.loss - expected).abs() < 1e-12);
        // bins: .6 wrong, .7 right, .95 wrong and .96 right together: |.6 - 0| + |.7 - 1| + |1.91 - 1| = 1.81 of 4
        assert!((score.figures().calibration.unwrap() - 1.81 / 4.0).abs() < 1e-12);
        assert_eq!(score.course[0], 0.0);
        assert_eq!(score.course[COURSE - 1], 1.0);
    }

    #[test]
    fn lead_time_runs_from_the_last_wrong_sample() {
        let wrong = Prediction { top: None, chances: None };
        let right = Prediction { top: Some(1), chances: None };
        let score = Score::of(&track(&[0.0, 1.0, 2.0, 4.0]), &[right, wrong, right, right]);
        assert_eq!(score.lead, 2.0);
        let figures = score.figures();
        assert_eq!((figures.loss, figures.calibration), (None, None));
        let score = Score::of(&track(&[0.0, 1.0, 2.0, 4.0]), &[right, right, right, wrong]);
        assert_eq!(score.lead, 0.0);
    }

    #[test]
    fn scores_add_up_to_means_over_tracks_and_samples() {
        let right = predicted(1, [0.5, 0.5]);
        let wrong = predicted(0, [0.9, 0.1]);
        let mut sum = Score::of(&track(&[0.0, 1.0, 2.0]), &[right; 3]);
        sum.add(&Score::of(&track(&[0.0, 1.0]), &[wrong; 2]));
        let figures = sum.figures();
        assert_eq!(figures.time, 50.0);
        assert!((figures.loss.unwrap() + (3.0 * 0.5f64.ln() + 2.0 * 0.1f64.ln()) / 5.0).abs() < 1e-12);
        assert_eq!(figures.lead, 1000.0);
    }

    #[test]
    fn users_who_agree_leave_no_uncertainty() {
        let one = Score { tracks: 4.0, time: 2.0, loss: 3.0, samples: 6.0, ..Score::default() };
        let same = [one.clone(), one.clone(), one.clone()];
        assert_eq!(bootstrap(same.iter(), 100), [Some([50.0, 50.0]), Some([0.5, 0.5])]);
        let other = Score { time: 4.0, ..one.clone() };
        let [time, _] = bootstrap([one.clone(), other].iter(), 1000);
        assert_eq!(time, Some([50.0, 100.0]));
        assert_eq!(bootstrap([one].iter(), 100), [None, None]);
    }
}
