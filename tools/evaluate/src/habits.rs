//! `--habits`: what an application gains by learning which targets are likely, on simulated users with habits.

use crate::methods::Template;
use presentation::table;
use rayon::prelude::*;
use serde_json::{Value as Json, json};
use whither::internals::{Value, track_scenario};
use whither::study::metrics::Score;
use whither::study::simulate::{Hand, Random};
use whither::study::track::{Target, Track};
use whither::{Predictor, Scenario};

/// In how many cases of ten the next target follows from the last one; else it is any.
const HABITS: [usize; 4] = [0, 3, 6, 9];

const USERS: u64 = 20;
const MOVEMENTS: usize = 240;

/// Movements before those that are scored: what is learnt from.
const BEFORE: usize = 120;

/// What is learnt: nothing, from counts, and from counts after the same last choice.
const LEARNING: [(&str, &[(&str, f64)]); 3] = [
    ("nothing", &[]),
    ("counts", &[("strength", 10.0), ("forgetting", 0.01)]),
    ("counts after the last choice", &[("strength", 10.0), ("forgetting", 0.01), ("afterLast", 10.0)]),
];

/// Simulates, prints a table and returns it as JSON.
pub fn run(template: &Template) -> Result<Json, String> {
    let header = ["the next target follows from the last", "learnt from", "time %", "log loss", "calibration error"];
    let mut table = table(header, 2);
    let mut rows = Vec::new();
    for habit in HABITS {
        let users = (0..USERS).into_par_iter().map(|user| of_user(template, habit, user));
        let users = users.collect::<Result<Vec<_>, String>>()?;
        for (k, (name, _)) in LEARNING.iter().enumerate() {
            let mut sum = Score::default();
            users.iter().for_each(|scores| sum.add(&scores[k]));
            let figures = sum.figures();
            let (loss, calibration) = (figures.loss.unwrap_or(0.0), figures.calibration.unwrap_or(0.0));
            let numbers = [format!("{:.1}", figures.time), format!("{loss:.3}"), format!("{calibration:.3}")];
            table.add_row([vec![format!("{habit} of 10"), (*name).to_owned()], numbers.to_vec()].concat());
            rows.push(json!({ "habit": habit as f64 / 10.0, "learntFrom": name, "tracks": sum.tracks,
                "time": figures.time, "loss": loss, "calibration": calibration }));
        }
    }
    println!("\n{USERS} simulated users with habits, 21 targets, after {BEFORE} choices\n{table}");
    Ok(Json::Array(rows))
}

/// Three rows of seven icons.
pub fn icons() -> Vec<Target> {
    let center = |i: usize| vec![140.0 + 160.0 * (i % 7) as f64, 160.0 + 190.0 * (i / 7) as f64];
    (0..21).map(|i| Target { center: center(i), size: vec![96.0; 2] }).collect()
}

/// One user's movements, scored with each kind of learning.
fn of_user(template: &Template, habit: usize, user: u64) -> Result<Vec<Score>, String> {
    let message = |error: whither::Error| error.to_string();
    let targets = icons();
    let mut random = Random::new(100 * habit as u64 + user);
    // after each target one of the others, another one for each user
    let follows: Vec<usize> = (0..targets.len()).map(|last| other(&mut random, targets.len(), last)).collect();
    let mut last = 0;
    let tracks: Vec<Track> = (0..MOVEMENTS)
        .map(|_| {
            let habitual = random.uniform() < habit as f64 / 10.0;
            let next = if habitual { follows[last] } else { other(&mut random, targets.len(), last) };
            let start = [targets[last].center[0], targets[last].center[1]];
            last = next;
            Hand::default().reach(&mut random, start, &targets, next)
        })
        .collect();
    let mut scores = Vec::with_capacity(LEARNING.len());
    for (_, learning) in LEARNING {
        let mut predictor = Predictor::new(&learner(template, &tracks[0], learning)?);
        let mut sum = Score::default();
        for (k, track) in tracks.iter().enumerate() {
            if let Some(approach) = track.approach().filter(|_| k >= BEFORE) {
                predictor.reset();
                sum.add(&Score::of_predictor(track, approach, &mut predictor).map_err(message)?);
            }
            predictor.chosen(&track.target.to_string()).map_err(message)?;
        }
        scores.push(sum);
    }
    Ok(scores)
}

/// Any index below `count` but one.
fn other(random: &mut Random, count: usize, but: usize) -> usize {
    let any = (random.uniform() * (count - 1) as f64) as usize;
    any + usize::from(any >= but)
}

fn learner(template: &Template, track: &Track, learning: &[(&str, f64)]) -> Result<Scenario, String> {
    let mut scenario = template.scenario.clone();
    if let (Value::Map(entries), false) = (&mut scenario, learning.is_empty()) {
        let keys = learning.iter().map(|(key, number)| ((*key).into(), Value::Number(*number)));
        entries.push(("learning".into(), Value::Map(keys.collect())));
    }
    track_scenario(track, &scenario, &template.extra).map_err(|error| error.to_string())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_habit_is_worth_learning_and_no_habit_costs_little() {
        let template = Template::pointer().unwrap();
        let loss = |habit: usize| {
            let scores = of_user(&template, habit, 1).unwrap();
            scores.iter().map(|score| score.figures().loss.unwrap()).collect::<Vec<_>>()
        };
        let [plain, _, after_last] = loss(9)[..] else { panic!("three kinds of learning") };
        assert!(after_last < 0.6 * plain, "{after_last} for {plain}");
        let [plain, counts, _] = loss(0)[..] else { panic!("three kinds of learning") };
        assert!(counts < 1.1 * plain, "{counts} for {plain}");
    }
}
