//! `--shake`: recorded and simulated movements of which every observation is shaken, as a finger or a mouse in a moving car is.

use crate::habits::icons;
use crate::methods::Template;
use crate::reading;
use presentation::table;
use rayon::prelude::*;
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::Path;
use whither::internals::{Value, track_scenario};
use whither::study::metrics::{Prediction, Score};
use whither::study::simulate::{Hand, Random};
use whither::study::track::{Sample, Target, Track};
use whither::{Destination, Predictor};

/// In the unit of length of the movements: a sinusoid of that amplitude has the same variance.
const AMPLITUDES: [f64; 4] = [2.0, 5.0, 10.0, 20.0];

/// In Hz.
const FREQUENCIES: [f64; 3] = [2.0, 4.0, 8.0];

/// Waves that a shake is the sum of, on each axis, their frequencies drawn from this share below its frequency to this share above.
const WAVES: usize = 8;
const BAND: f64 = 0.2;

/// What the columns of a scenario that follows the shake are called.
const FOLLOWED: &str = "followed: ";

/// The probability that is crossed.
const THRESHOLD: f64 = 0.6;

/// Simulated users, and the movements of each.
const USERS: u64 = 20;
const MOVEMENTS: usize = 60;

/// One row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shake {
    amplitude: f64,
    frequency: f64,
}

/// Nothing, and then all amplitudes at all frequencies.
fn all() -> Vec<Shake> {
    let shakes = AMPLITUDES.iter().flat_map(|&amplitude| FREQUENCIES.map(|frequency| Shake { amplitude, frequency }));
    std::iter::once(Shake { amplitude: 0.0, frequency: 0.0 }).chain(shakes).collect()
}

impl Shake {
    fn name(self) -> String {
        match self.amplitude {
            0.0 => "none".to_owned(),
            amplitude => format!("{amplitude} at {} Hz", self.frequency),
        }
    }

    /// Adds narrow-band noise to each axis.
    fn add(self, samples: &mut [Sample], random: &mut Random) {
        let axes = samples.first().map_or(0, |sample| sample.position.len());
        for axis in 0..axes {
            let waves: [[f64; 2]; WAVES] = std::array::from_fn(|_| {
                let frequency = self.frequency * (1.0 + BAND * (2.0 * random.uniform() - 1.0));
                [TAU * frequency, TAU * random.uniform()]
            });
            for sample in &mut *samples {
                let sum: f64 = waves.iter().map(|[rate, phase]| (rate * sample.time + phase).sin()).sum();
                sample.position[axis] += self.amplitude * sum / (WAVES as f64).sqrt();
            }
        }
    }
}

/// What was measured of one predictor.
#[derive(Clone, Debug, Default)]
struct Sum {
    score: Score,
    /// Movements in which a probability came to the threshold, and those in which the first one was the true target's.
    crossed: f64,
    right: f64,
}

impl Sum {
    fn add(&mut self, other: &Self) {
        self.score.add(&other.score);
        self.crossed += other.crossed;
        self.right += other.right;
    }

    /// Time%, log loss, calibration error, percent of the movements that cross, percent of these that are right.
    fn figures(&self) -> [f64; 5] {
        let figures = self.score.figures();
        let crossed = 100.0 * self.crossed / self.score.tracks.max(1.0);
        let right = 100.0 * self.right / self.crossed.max(1.0);
        [figures.time, figures.loss.unwrap_or(0.0), figures.calibration.unwrap_or(0.0), crossed, right]
    }
}

/// The movements of each user in their order.
type Users = BTreeMap<String, Vec<Track>>;

/// Measures the sets of a file; returns how many broken lines were skipped.
pub fn run(template: &Template, file: &Path, into: &mut Vec<Json>) -> Result<usize, String> {
    let mut sets: BTreeMap<String, Users> = BTreeMap::new();
    let name = reading::name(file);
    let skipped = reading::each(
        file,
        |line| line.track(template.margin).map(|track| track.approach().map(|_| track)),
        |track| {
            let set = sets.entry(format!("{name}{}", reading::part(&track))).or_default();
            set.entry(track.user.clone()).or_default().push(track);
        },
    )?;
    for (set, users) in &sets {
        table_of(template, set, users, into)?;
    }
    Ok(skipped)
}

/// The same of simulated movements among 21 icons.
pub fn simulated(template: &Template) -> Result<Vec<Json>, String> {
    let mut rows = Vec::new();
    table_of(template, "simulated", &simulated_users(), &mut rows)?;
    Ok(rows)
}

fn simulated_users() -> Users {
    let icons = icons();
    let mut users = Users::new();
    for user in 0..USERS {
        let mut random = Random::new(user);
        let mut below = |count: usize| (random.uniform() * count as f64) as usize;
        let ways: Vec<[usize; 2]> = (0..MOVEMENTS)
            .map(|_| {
                let (from, other) = (below(icons.len()), below(icons.len() - 1));
                [from, other + usize::from(other >= from)]
            })
            .collect();
        let reach = |[from, to]: [usize; 2]| {
            let start = [icons[from].center[0], icons[from].center[1]];
            Hand::default().reach(&mut random, start, &icons, to)
        };
        let tracks = ways.into_iter().map(reach).filter(|track| track.approach().is_some());
        users.insert(format!("{user:02}"), tracks.collect());
    }
    users
}

fn table_of(template: &Template, set: &str, users: &Users, into: &mut Vec<Json>) -> Result<(), String> {
    let columns = ["time %", "log loss", "calibration error", "first crossing of .6 %", "right %"];
    let mut header = vec!["shake".to_owned()];
    header.extend(["", FOLLOWED].iter().flat_map(|kind| columns.map(|column| format!("{kind}{column}"))));
    let mut table = table(header, 1);
    let templates = [template.scenario.clone(), following(&template.scenario)];
    for (k, shake) in all().into_iter().enumerate() {
        let mut cells = vec![shake.name()];
        for (scenario, followed) in templates.iter().zip([false, true]) {
            let sum = measure(scenario, users, shake, k)?;
            let [time, loss, calibration, crossed, right] = sum.figures();
            cells.extend([format!("{time:.1}"), format!("{loss:.3}"), format!("{calibration:.3}")]);
            cells.extend([crossed, right].map(|percent| format!("{percent:.1}")));
            into.push(json!({
                "set": set, "followed": followed, "amplitude": shake.amplitude, "frequency": shake.frequency,
                "tracks": sum.score.tracks, "time": time, "loss": loss, "calibration": calibration,
                "crossed": crossed, "right": right,
            }));
        }
        table.add_row(cells);
    }
    println!("\n{set}\n{table}");
    Ok(())
}

/// The scenario that follows shake of up to the largest amplitude.
fn following(scenario: &Value) -> Value {
    let mut scenario = scenario.clone();
    if let Value::Map(entries) = &mut scenario {
        for (key, constants) in entries.iter_mut() {
            if let (true, Value::Map(constants)) = (**key == *"pointing", constants) {
                constants.retain(|(key, _)| **key != *"shake");
                constants.push(("shake".into(), Value::Number(AMPLITUDES[AMPLITUDES.len() - 1])));
            }
        }
    }
    scenario
}

/// All movements with one shake: the predictor of a user goes from movement to movement.
fn measure(scenario: &Value, users: &Users, shake: Shake, row: usize) -> Result<Sum, String> {
    let of_user = |(number, tracks): (usize, &Vec<Track>)| {
        let mut random = Random::new((1000 * row + number) as u64);
        let mut sum = Sum::default();
        let mut predictor = None;
        for track in tracks {
            let Some(approach) = track.approach() else { continue };
            let mut shaken = track.clone();
            if shake.amplitude > 0.0 {
                shake.add(&mut shaken.samples, &mut random);
            }
            let predictor = next(&mut predictor, scenario, track)?;
            sum.add(&score(&shaken, approach, predictor).map_err(|error| error.to_string())?);
        }
        Ok(sum)
    };
    let users: Vec<&Vec<Track>> = users.values().collect();
    let sums = users.into_par_iter().enumerate().map(of_user).collect::<Result<Vec<Sum>, String>>()?;
    let mut total = Sum::default();
    sums.iter().for_each(|sum| total.add(sum));
    Ok(total)
}

/// The predictor before the next movement, among its targets.
fn next<'a>(
    predictor: &'a mut Option<Predictor>,
    scenario: &Value,
    track: &Track,
) -> Result<&'a mut Predictor, String> {
    let message = |error: whither::Error| error.to_string();
    if let Some(before) = predictor {
        before.reset();
        let targets = track.targets.iter().enumerate();
        let destination = |(i, target): (usize, &Target)| {
            Destination::new(i.to_string(), target.center.clone()).size(target.size.clone())
        };
        before.set_destinations(targets.map(destination)).map_err(message)?;
    }
    let among = || track_scenario(track, scenario, &Value::Null).map_err(message);
    match predictor {
        Some(before) => Ok(before),
        None => Ok(predictor.insert(Predictor::new(&among()?))),
    }
}

fn score(track: &Track, approach: usize, predictor: &mut Predictor) -> whither::Result<Sum> {
    let mut sum = Sum::default();
    let mut predictions = Vec::with_capacity(approach);
    for sample in &track.samples[..approach] {
        sample.observe(predictor)?;
        let Some(best) = predictor.best() else { continue };
        let of_target = predictor.probabilities()[track.target];
        predictions.push(Prediction { top: Some(best.index), chances: Some([best.probability, of_target]) });
        if sum.crossed == 0.0 && best.probability >= THRESHOLD {
            sum.crossed = 1.0;
            sum.right = f64::from(u8::from(best.index == track.target));
        }
    }
    sum.score = Score::of(track, &predictions);
    Ok(sum)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_shake_has_its_amplitude_and_its_frequency() {
        let still = |k: u32| Sample { time: 0.001 * f64::from(k), position: vec![7.0, -3.0], missing: vec![] };
        let mut samples: Vec<Sample> = (0..60_000).map(still).collect();
        Shake { amplitude: 20.0, frequency: 4.0 }.add(&mut samples, &mut Random::new(1));
        for (axis, center) in [(0, 7.0), (1, -3.0)] {
            let at: Vec<f64> = samples.iter().map(|sample| sample.position[axis] - center).collect();
            let variance = at.iter().map(|x| x * x).sum::<f64>() / 60_000.0;
            assert!((variance / 200.0 - 1.0).abs() < 0.1, "as a sinusoid of that amplitude, got {variance}");
            let crossings = at.windows(2).filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count();
            assert!((3.2..4.8).contains(&(crossings as f64 / 60.0)), "{crossings} in a minute");
        }
        assert_ne!(samples[9].position[0] - 7.0, samples[9].position[1] + 3.0);
    }

    #[test]
    fn the_first_crossing_counts_and_no_other() {
        let track: Track = serde_json::from_str(
            r#"{"targets": [[0, 0, 20, 20], [400, 0, 20, 20]], "target": 0, "samples": [
                [0, 200, 0], [0.016, 215, 0], [0.032, 235, 0], [0.048, 260, 0], [0.064, 290, 0], [0.2, 200, 0],
                [0.25, 120, 0], [0.3, 60, 0], [0.35, 20, 0], [0.4, 2, 0]]}"#,
        )
        .unwrap();
        let scenario = track_scenario(&track, &Template::pointer().unwrap().scenario, &Value::Null).unwrap();
        let sum = score(&track, 10, &mut Predictor::new(&scenario)).unwrap();
        assert_eq!((sum.crossed, sum.right, sum.score.at[3]), (1.0, 0.0, 1.0));
    }

    #[test]
    fn what_follows_the_shake_is_right_more_often() {
        let template = Template::pointer().unwrap().scenario;
        let users = simulated_users();
        let few = users.into_iter().take(3).collect();
        let right = |scenario: &Value, amplitude: f64| {
            let [.., right] = measure(scenario, &few, Shake { amplitude, frequency: 8.0 }, 1).unwrap().figures();
            right
        };
        let [still, shaken] = [0.0, 20.0].map(|amplitude| right(&template, amplitude));
        let followed = right(&following(&template), 20.0);
        assert!(
            shaken < still - 20.0 && followed > shaken + 20.0,
            "{still} without, {shaken} with, {followed} followed"
        );
    }
}
