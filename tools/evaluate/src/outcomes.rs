//! `--learning`: what is gained by learning from the outcomes of each user's movements, in their order: the score of a scenario of ours
//! without and with what the movements before have taught, the first twenty of each user apart.

use crate::extras::{self, Sums};
use crate::methods::Template;
use crate::reading;
use crate::variants::Variant;
use presentation::table;
use rayon::prelude::*;
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use std::path::Path;
use whither::internals::{Value, track_scenario};
use whither::study::metrics::Score;
use whither::study::track::Track;
use whither::{Learnt, Predictor};

/// A user's first movements, which are scored apart.
const FIRST: usize = 20;

/// A scenario's priors that no choice changes: targets of different recordings are different things.
const FIXED_PRIORS: f64 = 1e50;

/// Without learning and with it.
type Pair<T> = [T; 2];

/// The results of one set.
#[derive(Debug, Default)]
pub struct Gain {
    users: usize,
    all: Pair<Score>,
    first: Pair<Score>,
    more: Pair<Sums>,
}

/// What was measured, by set.
pub type Gains = BTreeMap<String, Gain>;

/// Measures the sets of a file. Broken lines are skipped.
pub fn run(
    template: &Template,
    file: &Path,
    (margin, every): (f64, usize),
    more: bool,
    gains: &mut Gains,
) -> Result<(), String> {
    let mut users: BTreeMap<(String, String), Vec<(usize, Track)>> = BTreeMap::new();
    let name = reading::name(file);
    reading::each(
        file,
        |line| line.track(margin).map(|track| Some((line.number, track))),
        |(number, track)| {
            let set = format!("{name}{}", reading::part(&track));
            users.entry((set, track.user.clone())).or_default().push((number, track));
        },
    )?;
    let of_user =
        |((set, _), tracks): (&(String, String), &Vec<_>)| (set.clone(), of_user(template, tracks, every, more));
    for (set, gain) in users.par_iter().map(of_user).collect::<Vec<_>>() {
        let gain = gain?;
        let sum = gains.entry(set).or_default();
        sum.users += 1;
        for k in 0..2 {
            sum.all[k].add(&gain.all[k]);
            sum.first[k].add(&gain.first[k]);
            sum.more[k].merge(&gain.more[k]);
        }
    }
    Ok(())
}

/// One user's movements, one after the other.
fn of_user(template: &Template, tracks: &[(usize, Track)], every: usize, more: bool) -> Result<Gain, String> {
    let message = |error: whither::Error| error.to_string();
    let mut scenario = template.scenario.clone();
    if let Value::Map(entries) = &mut scenario {
        entries.push(("learning".into(), Value::map([("strength", Value::Number(FIXED_PRIORS))])));
    }
    let mut learnt = Learnt::default();
    let mut gain = Gain::default();
    for (number, track) in tracks {
        let to_the_end = template.to_the_end && track.approach().is_none();
        let variant = if to_the_end { Variant::Complete(every) } else { Variant::Every(every) };
        let Some((recorded, approach)) = variant.of(track, 0) else { continue };
        let coordinates = template.coordinates(&recorded)?;
        let track = coordinates.as_ref();
        let scenario = track_scenario(track, &scenario, &template.extra).map_err(message)?;
        for (k, known) in [Learnt::default(), learnt].into_iter().enumerate() {
            let mut predictor = Predictor::new(&scenario);
            predictor.set_learnt(known).map_err(message)?;
            let score = Score::of_predictor(track, approach, &mut predictor).map_err(message)?;
            gain.all[k].add(&score);
            if gain.all[k].tracks <= FIRST as f64 {
                gain.first[k].add(&score);
            }
            if more {
                gain.more[k].add(&extras::run(template, &recorded, approach, *number, &known)?);
            }
            // what follows the entry, up to the press
            for sample in &track.samples[approach..] {
                sample.observe(&mut predictor).map_err(message)?;
            }
            predictor.chosen(&track.target.to_string()).map_err(message)?;
            learnt = predictor.learnt();
        }
    }
    Ok(gain)
}

/// Prints a table, and returns the same as JSON.
pub fn report(gains: &Gains, more: bool) -> Json {
    let figures = ["time %", "log loss", "calibration error"];
    let mut header = vec!["set".to_owned(), "users".to_owned()];
    for part in ["", &format!(", first {FIRST}")] {
        header.extend(figures.map(|figure| format!("{figure}{part}")));
    }
    let mut table = table(header, 1);
    let mut all = serde_json::Map::new();
    for (set, gain) in gains {
        let mut cells = vec![set.clone(), gain.users.to_string()];
        for pair in [&gain.all, &gain.first] {
            let [before, after] = pair.each_ref().map(|score| {
                let figures = score.figures();
                [figures.time, figures.loss.unwrap_or_default(), figures.calibration.unwrap_or_default()]
            });
            let digits = [1, 3, 3];
            cells.extend((0..3).map(|k| format!("{:.2$}, {:.2$}", before[k], after[k], digits[k])));
        }
        table.add_row(cells);
        let json = |score: &Score| {
            let figures = score.figures();
            json!({ "tracks": score.tracks, "time": figures.time, "loss": figures.loss, "calibration": figures.calibration })
        };
        all.insert(
            set.clone(),
            json!({ "users": gain.users, "all": gain.all.each_ref().map(json), "first": gain.first.each_ref().map(json) }),
        );
    }
    println!("\nlearning from the outcomes of each user's movements: without, with\n{table}");
    if more {
        let rows = gains
            .iter()
            .flat_map(|(set, gain)| [(set.clone(), &gain.more[0]), (format!("{set}, learnt"), &gain.more[1])]);
        all.insert("more".to_owned(), extras::report(rows));
    }
    Json::Object(all)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use whither::study::simulate::{Hand, Random};
    use whither::study::track::Target;

    #[test]
    fn a_user_is_scored_with_what_the_movements_before_have_taught() {
        let icon = |i: usize| Target { center: vec![150.0 * i as f64, 300.0], size: vec![60.0; 2] };
        let icons: Vec<Target> = (0..9).map(icon).collect();
        let mut random = Random::new(3);
        let mut reach = |k: usize| Hand::default().reach(&mut random, [600.0, 800.0], &icons, k % icons.len());
        let tracks: Vec<(usize, Track)> = (0..30).map(|k| (k, reach(k))).collect();
        let template = Template::pointer().unwrap();
        let [one, all] = [1, 30].map(|count| of_user(&template, &tracks[..count], 1, true).unwrap());
        assert_eq!(one.all[0], one.all[1], "nothing is known before the first");
        assert_eq!((all.all[1].tracks, all.first[1].tracks), (30.0, FIRST as f64));
        assert_ne!(all.all[0].loss, all.all[1].loss);
        assert_eq!(all.all[0].time, all.all[1].time, "the order of targets stays");
    }
}
