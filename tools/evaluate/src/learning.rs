//! `--fit`: what is gained by learning constants from recorded movements, on users and movements that were left out.

use crate::methods::Template;
use crate::reading;
use presentation::{progress, table};
use rayon::prelude::*;
use serde_json::{Value as Json, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use whither::internals::{Node, fit, track_scenario};
use whither::study::fit::{Options, Progress, TRACKS_PER_CONSTANT};
use whither::study::metrics::{Score, bootstrap};
use whither::study::track::Track;

/// What is learnt from one user's own movements: two constants need no more than twenty of them.
const OWN: [&str; 2] = ["pointing.timeToGo.median", "pointing.power.to"];

/// One search: from these movements, for those.
struct Task<'a> {
    learnt_from: Vec<&'a Track>,
    scored_on: Vec<&'a Track>,
}

/// Scores with the old constants and with the new ones, by user.
type Gain = BTreeMap<String, [Score; 2]>;

/// Learns for each set of a file and prints what was gained; returns how many broken lines were skipped.
pub fn run(template: &Template, file: &Path, into: &mut Vec<Json>) -> Result<usize, String> {
    let mut sets: BTreeMap<String, Vec<Track>> = BTreeMap::new();
    let name = reading::name(file);
    let skipped = reading::each(
        file,
        |line| line.track(template.margin).map(|track| track.approach().map(|_| track)),
        |track| sets.entry(format!("{name}{}", reading::part(&track))).or_default().push(track),
    )?;
    let [time, loss] = ["time % before", "log loss before"];
    let header = ["learnt from", "users", "tracks scored", time, "after", loss, "after", "users who gain"];
    let mut table = table(header, 1);
    for (set, tracks) in &sets {
        let (others, halves) = halves(tracks);
        let mut rows = vec![(others, Vec::new(), halves)];
        if Node::root(&template.scenario, "").get("pointing").is_some() {
            let own = own(tracks);
            if !own.is_empty() {
                rows.push(("the user's own first 20", OWN.map(str::to_owned).to_vec(), own));
            }
        }
        for (from, constants, tasks) in rows {
            match learn(template, set, &constants, &tasks) {
                Ok(gain) => {
                    let row = Row::of(&gain);
                    table.add_row([vec![format!("{set}: {from}")], row.cells()].concat());
                    into.push(row.json(set, from));
                }
                Err(error) => eprintln!("{}: {set}, {from}: {error}; left out", file.display()),
            }
        }
    }
    if table.row_count() > 0 {
        println!("\nconstants learnt from recorded movements, scored on others\n{table}");
    }
    Ok(skipped)
}

/// Each half of the users (of the tracks, where there is one user) for the other half.
fn halves(tracks: &[Track]) -> (&'static str, Vec<Task<'_>>) {
    let users: BTreeSet<&str> = tracks.iter().map(|track| track.user.as_str()).collect();
    let places: BTreeMap<&str, usize> = users.iter().enumerate().map(|(k, user)| (*user, k)).collect();
    let (from, side): (_, Vec<usize>) = match users.len() {
        1 => ("every second track", (0..tracks.len()).map(|k| k % 2).collect()),
        _ => ("every second user", tracks.iter().map(|track| places[track.user.as_str()] % 2).collect()),
    };
    let half = |wanted: usize| tracks.iter().zip(&side).filter(|(_, side)| **side == wanted).map(|(t, _)| t).collect();
    (from, [0, 1].map(|learnt| Task { learnt_from: half(learnt), scored_on: half(1 - learnt) }).into())
}

/// Each user's first movements for the same user's later ones, where there are as many again.
fn own(tracks: &[Track]) -> Vec<Task<'_>> {
    let needed = OWN.len() * TRACKS_PER_CONSTANT;
    let mut users: BTreeMap<&str, Vec<&Track>> = BTreeMap::new();
    tracks.iter().for_each(|track| users.entry(&track.user).or_default().push(track));
    let long = users.into_values().filter(|tracks| tracks.len() >= 2 * needed);
    long.map(|mut tracks| Task { scored_on: tracks.split_off(needed), learnt_from: tracks }).collect()
}

fn learn(template: &Template, set: &str, constants: &[String], tasks: &[Task<'_>]) -> Result<Gain, String> {
    let bar = progress(1000 * tasks.len() as u64, format!("{set}: learning"));
    let options = Options { constants: constants.to_vec(), ..Options::default() };
    let message = |error: whither::Error| error.to_string();
    let gains = tasks.par_iter().map(|task| {
        let tracks: Vec<Track> = task.learnt_from.iter().map(|track| (*track).clone()).collect();
        let mut done = 0;
        let mut progress = |state: Progress| {
            let now = (1000.0 * state.share) as u64;
            bar.inc(now.saturating_sub(done));
            done = done.max(now);
            true
        };
        let learnt = fit(&tracks, &template.scenario, &template.extra, &options, &mut progress);
        let (fitted, _) = learnt.map_err(message)?;
        bar.inc(1000u64.saturating_sub(done));
        let mut gain = Gain::new();
        for track in &task.scored_on {
            let Some(approach) = track.approach() else { continue };
            let sums = gain.entry(track.user.clone()).or_default();
            for (sum, scenario) in sums.iter_mut().zip([&template.scenario, &fitted]) {
                let scenario = track_scenario(track, scenario, &template.extra).map_err(message)?;
                sum.add(&Score::of_scenario(track, approach, &scenario).map_err(message)?);
            }
        }
        Ok(gain)
    });
    let gains = gains.collect::<Result<Vec<Gain>, String>>()?;
    bar.finish_and_clear();
    let mut all = Gain::new();
    for (user, scores) in gains.into_iter().flatten() {
        let sums = all.entry(user).or_default();
        sums.iter_mut().zip(&scores).for_each(|(sum, score)| sum.add(score));
    }
    Ok(all)
}

/// What the table shows of one search.
struct Row {
    users: usize,
    gaining: usize,
    tracks: f64,
    time: [f64; 2],
    loss: [f64; 2],
    /// The gain in log loss, with a 95% interval by drawing users.
    gain: Option<[f64; 2]>,
}

impl Row {
    fn of(gain: &Gain) -> Self {
        let total = |k: usize| {
            let mut sum = Score::default();
            gain.values().for_each(|scores| sum.add(&scores[k]));
            sum.figures()
        };
        let (before, after) = (total(0), total(1));
        let differences: Vec<Score> =
            gain.values().map(|[before, after]| Score { loss: before.loss - after.loss, ..before.clone() }).collect();
        let [_, interval] = bootstrap(differences.iter(), 1000);
        Self {
            users: gain.len(),
            gaining: gain.values().filter(|[before, after]| after.loss < before.loss).count(),
            tracks: gain.values().map(|scores| scores[0].tracks).sum(),
            time: [before.time, after.time],
            loss: [before.loss.unwrap_or(0.0), after.loss.unwrap_or(0.0)],
            gain: interval,
        }
    }

    fn cells(&self) -> Vec<String> {
        let [before, after] = self.loss;
        let interval =
            self.gain.map_or(String::new(), |[low, high]| format!(" [{:.3}, {:.3}]", before - high, before - low));
        vec![
            self.users.to_string(),
            self.tracks.to_string(),
            format!("{:.1}", self.time[0]),
            format!("{:.1}", self.time[1]),
            format!("{before:.3}"),
            format!("{after:.3}{interval}"),
            format!("{} of {}", self.gaining, self.users),
        ]
    }

    fn json(&self, set: &str, from: &str) -> Json {
        json!({
            "set": set, "learntFrom": from, "users": self.users, "tracks": self.tracks, "usersWhoGain": self.gaining,
            "time": self.time, "loss": self.loss, "gain": self.gain,
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn tracks(users: &[&str]) -> Vec<Track> {
        let track = |(k, user): (usize, &&str)| {
            let text = format!(
                r#"{{"id": "{k}", "user": "{user}", "targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, 9, 9], [1, 0, 0]]}}"#
            );
            serde_json::from_str(&text).unwrap()
        };
        users.iter().enumerate().map(track).collect()
    }

    fn ids(tracks: &[&Track]) -> Vec<String> {
        tracks.iter().map(|track| track.id.clone()).collect()
    }

    #[test]
    fn no_user_is_scored_with_what_was_learnt_from_that_user() {
        let tracks = tracks(&["b", "a", "c", "a", "b", "d"]);
        let (from, tasks) = halves(&tracks);
        assert_eq!((from, tasks.len()), ("every second user", 2));
        let found: Vec<_> = tasks.iter().map(|task| (ids(&task.learnt_from), ids(&task.scored_on))).collect();
        let (even, odd) = (["1", "2", "3"].map(str::to_owned).to_vec(), ["0", "4", "5"].map(str::to_owned).to_vec());
        assert_eq!(found, [(even.clone(), odd.clone()), (odd, even)]);
    }

    #[test]
    fn one_user_is_scored_on_other_tracks() {
        let tracks = tracks(&["a"; 5]);
        let (from, tasks) = halves(&tracks);
        assert_eq!((from, ids(&tasks[0].learnt_from).join(" ")), ("every second track", "0 2 4".to_owned()));
        assert_eq!(ids(&tasks[0].scored_on).join(" "), "1 3");
    }

    #[test]
    fn a_users_own_movements_are_learnt_from_where_there_are_enough() {
        let users: Vec<&str> = std::iter::repeat_n("long", 45).chain(std::iter::repeat_n("short", 39)).collect();
        let tracks = tracks(&users);
        let tasks = own(&tracks);
        assert_eq!(tasks.len(), 1);
        assert_eq!((ids(&tasks[0].learnt_from)[19].as_str(), ids(&tasks[0].scored_on)[0].as_str()), ("19", "20"));
        assert_eq!((tasks[0].learnt_from.len(), tasks[0].scored_on.len()), (20, 25));
    }

    #[test]
    fn what_was_gained_is_told_by_users_and_in_all() {
        let score = |loss: f64, time: f64| Score { tracks: 2.0, samples: 10.0, loss, time, ..Score::default() };
        let gain = Gain::from([
            ("a".to_owned(), [score(20.0, 1.0), score(10.0, 1.5)]),
            ("b".to_owned(), [score(10.0, 0.5), score(12.0, 0.5)]),
        ]);
        let row = Row::of(&gain);
        assert_eq!((row.users, row.gaining, row.tracks), (2, 1, 4.0));
        // 30 and 22 nats over 20 samples; 1.5 and 2 of 4 tracks' time
        assert_eq!((row.loss, row.time), ([1.5, 1.1], [37.5, 50.0]));
        // by users 1 and -.2 nats
        assert_eq!(row.gain, Some([-0.2, 1.0]));
    }
}
