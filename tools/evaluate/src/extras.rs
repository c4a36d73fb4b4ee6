//! Two more scores of a scenario of ours: of "none of them", with the true target taken out of half of the tracks, and of
//! the time to the entry into the target.

use crate::methods::Template;
use presentation::table;
use serde_json::{Value as Json, json};
use whither::internals::{Value, track_scenario};
use whither::study::metrics::{BINS, Bin, calibration_error};
use whither::study::track::Track;
use whither::{Learnt, Predictor};

/// The priors of "none" that are tried.
pub const PRIORS: [f64; 2] = [0.2, 0.5];

/// The results of one track.
#[derive(Debug, Default)]
pub struct Extras {
    /// Samples, sum of absolute errors in seconds, samples that enter before the 80% interval, samples that enter after it.
    when: [f64; 4],
    none: [NoneResults; PRIORS.len()],
}

#[derive(Debug, Default)]
struct NoneResults {
    bins: [Bin; BINS],
    /// At 90% of the approach: the probability of none, and whether the target was absent.
    late: Option<(f64, bool)>,
}

/// The results of a set of tracks.
#[derive(Debug, Default)]
pub struct Sums {
    when: [f64; 4],
    /// Movements, and the sum of their mean absolute errors.
    movements: [f64; 2],
    bins: [[Bin; BINS]; PRIORS.len()],
    late: [Vec<(f64, bool)>; PRIORS.len()],
}

/// Runs one track of a user of whom this is known; its number decides whether its target is taken out for the score of "none".
pub fn run(
    template: &Template,
    track: &Track,
    approach: usize,
    number: usize,
    learnt: &Learnt,
) -> Result<Extras, String> {
    let message = |error: whither::Error| error.to_string();
    let mut results = Extras::default();
    let coordinates = template.coordinates(track)?;
    let track = coordinates.as_ref();
    let samples = &track.samples[..approach];
    let end = samples[approach - 1].time;
    let scenario = track_scenario(track, &template.scenario, &template.extra).map_err(message)?;
    let mut predictor = Predictor::new(&scenario);
    predictor.set_learnt(*learnt).map_err(message)?;
    let until_the_entry = if track.approach().is_some() { approach - 1 } else { 0 };
    for sample in &samples[..until_the_entry] {
        sample.observe(&mut predictor).map_err(message)?;
        let Some(remaining) = predictor.remaining() else { continue };
        let true_time = end - sample.time;
        let one_if = |yes: bool| f64::from(u8::from(yes));
        let (before, after) = (one_if(true_time < remaining.low), one_if(true_time > remaining.high));
        let found = [1.0, (remaining.mean - true_time).abs(), before, after];
        results.when.iter_mut().zip(found).for_each(|(to, from)| *to += from);
    }
    let absent = (number.wrapping_mul(2_654_435_761) >> 7).is_multiple_of(2) && track.targets.len() > 1;
    let mut shown = track.clone();
    if absent {
        shown.targets.remove(track.target);
    }
    for (result, prior) in results.none.iter_mut().zip(PRIORS) {
        let mut with_none = template.scenario.clone();
        if let Value::Map(entries) = &mut with_none {
            entries.retain(|(key, _)| **key != *"none");
            entries.push(("none".into(), Value::Number(prior)));
        }
        let scenario = track_scenario(&shown, &with_none, &template.extra).map_err(message)?;
        let mut predictor = Predictor::new(&scenario);
        predictor.set_learnt(*learnt).map_err(message)?;
        let weight = 2.0 * if absent { prior } else { 1.0 - prior };
        for sample in samples {
            sample.observe(&mut predictor).map_err(message)?;
            let none = predictor.none();
            let bin = &mut result.bins[((none * BINS as f64) as usize).min(BINS - 1)];
            bin.count += weight;
            bin.predicted += weight * none;
            bin.happened += if absent { weight } else { 0.0 };
            if sample.time - samples[0].time <= 0.9 * (end - samples[0].time) + 1e-9 {
                result.late = Some((none, absent));
            }
        }
    }
    Ok(results)
}

impl Sums {
    /// Adds one track's results.
    pub fn add(&mut self, results: &Extras) {
        self.when.iter_mut().zip(results.when).for_each(|(to, from)| *to += from);
        let [samples, error, ..] = results.when;
        if samples > 0.0 {
            self.movements[0] += 1.0;
            self.movements[1] += error / samples;
        }
        for (k, result) in results.none.iter().enumerate() {
            for (to, from) in self.bins[k].iter_mut().zip(result.bins) {
                to.count += from.count;
                to.predicted += from.predicted;
                to.happened += from.happened;
            }
            self.late[k].extend(result.late);
        }
    }

    /// Adds others' results.
    pub fn merge(&mut self, other: &Self) {
        self.when.iter_mut().zip(other.when).for_each(|(to, from)| *to += from);
        self.movements.iter_mut().zip(other.movements).for_each(|(to, from)| *to += from);
        for k in 0..PRIORS.len() {
            for (to, from) in self.bins[k].iter_mut().zip(other.bins[k]) {
                to.count += from.count;
                to.predicted += from.predicted;
                to.happened += from.happened;
            }
            self.late[k].extend(&other.late[k]);
        }
    }

    fn row(&self) -> Vec<f64> {
        let [samples, error, before, after] = self.when;
        let [movements, errors] = self.movements;
        let share = |count: f64| count / samples.max(1.0);
        let mut row = vec![share(error), errors / movements.max(1.0)];
        row.extend([share(samples - before - after), share(before), share(after)]);
        for (bins, late) in self.bins.iter().zip(&self.late) {
            row.extend([calibration_error(bins), area_under_curve(late)]);
        }
        row
    }
}

/// The probability that a track without its target gets a larger "none" than one with it.
fn area_under_curve(results: &[(f64, bool)]) -> f64 {
    let mut sorted = results.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut present, mut pairs, mut absent, mut k) = (0.0, 0.0, 0.0, 0);
    while k < sorted.len() {
        let same = sorted[k..].iter().take_while(|result| result.0 == sorted[k].0).count();
        let here = sorted[k..k + same].iter().filter(|result| result.1).count() as f64;
        let others = same as f64 - here;
        pairs += here * (present + 0.5 * others);
        present += others;
        absent += here;
        k += same;
    }
    pairs / (present * absent).max(1.0)
}

/// Prints a table, and returns the same as JSON.
pub fn report<'a>(sets: impl IntoIterator<Item = (String, &'a Sums)>) -> Json {
    let when =
        ["time to the entry: error over samples, s", "over movements, s", "within the 80%", "before it", "after it"];
    let mut header = vec!["set".to_owned()];
    header.extend(when.map(str::to_owned));
    for prior in PRIORS {
        header.push(format!("none at {prior}: calibration error"));
        header.push("area under the curve at 90%".to_owned());
    }
    let mut table = table(header, 1);
    let mut all = serde_json::Map::new();
    for (name, sums) in sets {
        let row = sums.row();
        table.add_row([vec![name.clone()], row.iter().map(|x| format!("{x:.3}")).collect()].concat());
        all.insert(
            name.clone(),
            json!({
                "remaining": {
                    "error": row[0], "byMovement": row[1], "within": row[2], "before": row[3], "after": row[4],
                },
                "none": PRIORS.iter().zip(row[5..].chunks(2)).map(|(prior, pair)| {
                    json!({ "prior": prior, "calibration": pair[0], "area": pair[1] })
                }).collect::<Vec<_>>(),
            }),
        );
    }
    println!("\nwhen, and none of them (the true target taken out of half of the tracks)\n{table}");
    Json::Object(all)
}

#[cfg(test)]
mod tests {
    use super::{Extras, Sums, area_under_curve};

    #[test]
    fn what_is_not_before_or_after_the_interval_is_within_it() {
        let mut sums = Sums::default();
        // ten samples that are off by 3 s together, two of them before the interval and three after it; and none
        for when in [[4.0, 1.0, 2.0, 0.0], [6.0, 2.0, 0.0, 3.0], [0.0; 4]] {
            sums.add(&Extras { when, ..Extras::default() });
        }
        let row = sums.row();
        let expected = [0.3, (0.25 + 1.0 / 3.0) / 2.0, 0.5, 0.2, 0.3];
        assert!(row.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12), "{row:?}");
    }

    #[test]
    fn the_area_counts_pairs_in_the_right_order() {
        assert_eq!(area_under_curve(&[(0.1, false), (0.9, true), (0.2, false), (0.8, true)]), 1.0);
        assert_eq!(area_under_curve(&[(0.1, true), (0.9, false)]), 0.0);
        // (.5, .5) is a tie, (.9, .5) right: 1.5 of 2
        assert_eq!(area_under_curve(&[(0.5, false), (0.5, true), (0.9, true)]), 0.75);
    }
}
