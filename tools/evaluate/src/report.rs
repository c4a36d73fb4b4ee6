//! What was measured, as tables and as JSON.

use crate::methods::Method;
use presentation::{table, write};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use std::path::Path;
use whither::study::metrics::{Figures, MOMENTS, Score, bootstrap};

/// How often users are drawn for an interval.
const DRAWS: usize = 1000;

/// Everything that was measured.
#[derive(Debug, Default)]
pub struct Results {
    pub sets: Vec<Set>,
}

/// One set of tracks.
#[derive(Debug)]
pub struct Set {
    pub name: String,
    pub rows: Vec<Row>,
}

/// One method on one set.
#[derive(Debug)]
pub struct Row {
    pub name: String,
    of_grid: bool,
    users: BTreeMap<String, Score>,
}

/// Adds the scores of one track, one for each method.
pub fn add(sets: &mut Vec<Set>, file: &str, part: &str, methods: &[Method], user: &str, scores: &[Option<Score>]) {
    let name = format!("{file}{part}");
    let place = sets.iter().position(|set| set.name == name).unwrap_or_else(|| {
        let rows = methods.iter().map(|method| Row {
            name: method.name.clone(),
            of_grid: method.is_of_grid(),
            users: BTreeMap::new(),
        });
        sets.push(Set { name, rows: rows.collect() });
        sets.len() - 1
    });
    for (row, score) in sets[place].rows.iter_mut().zip(scores) {
        if let Some(score) = score {
            row.users.entry(user.to_owned()).or_default().add(score);
        }
    }
}

impl Row {
    /// The sum over users.
    pub fn total(&self) -> Score {
        let mut total = Score::default();
        self.users.values().for_each(|score| total.add(score));
        total
    }

    fn cells(&self) -> Vec<String> {
        let figures = self.total().figures();
        let [time, loss] = bootstrap(self.users.values(), DRAWS);
        let mut cells = figure_cells(&figures);
        if let Some([low, high]) = time {
            cells[0] += &format!(" [{low:.1}, {high:.1}]");
        }
        if let Some([low, high]) = loss {
            cells[1] += &format!(" [{low:.3}, {high:.3}]");
        }
        cells
    }

    fn json(&self) -> Json {
        let total = self.total();
        let [time, loss] = bootstrap(self.users.values(), DRAWS);
        let users: serde_json::Map<String, Json> =
            self.users.iter().map(|(user, score)| (user.clone(), figures_json(score))).collect();
        let bins =
            total.bins.map(|bin| json!({ "count": bin.count, "predicted": bin.predicted, "happened": bin.happened }));
        let course = total.course.map(|right| right / total.tracks.max(1.0));
        json!({
            "method": self.name, "figures": figures_json(&total),
            "interval": { "time": time, "loss": loss },
            "course": course, "calibration": bins, "users": users,
        })
    }
}

fn figure_cells(figures: &Figures) -> Vec<String> {
    let or_none = |figure: Option<f64>| figure.map_or_else(|| "-".to_owned(), |x| format!("{x:.3}"));
    vec![
        format!("{:.1}", figures.time),
        or_none(figures.loss),
        or_none(figures.calibration),
        figures.at.map(|right| format!("{right:.0}")).join(" / "),
        format!("{:.0}", figures.lead),
    ]
}

fn figures_json(score: &Score) -> Json {
    let figures = score.figures();
    json!({
        "tracks": score.tracks, "samples": score.samples, "time": figures.time, "loss": figures.loss,
        "calibration": figures.calibration, "at": figures.at, "lead": figures.lead,
    })
}

impl Set {
    /// The rows to show: of a grid the best one alone, under a name that shows it.
    pub fn shown(&self) -> Vec<(String, &Row)> {
        let best = self
            .rows
            .iter()
            .filter(|row| row.of_grid && !row.users.is_empty())
            .max_by(|a, b| a.total().figures().time.total_cmp(&b.total().figures().time));
        let mut shown: Vec<(String, &Row)> = self
            .rows
            .iter()
            .filter(|row| !row.of_grid && !row.users.is_empty())
            .map(|row| (row.name.clone(), row))
            .collect();
        shown.extend(best.map(|row| (format!("best {}", row.name), row)));
        shown
    }
}

impl Results {
    /// Prints a table for each set.
    pub fn print(&self, by_user: bool) {
        let moments = MOMENTS.map(|share| format!("{:.0}", 100.0 * share)).join(" / ");
        let at = format!("right at {moments}%");
        for set in &self.sets {
            let Some(first) = set.rows.iter().find(|row| !row.users.is_empty()) else { continue };
            println!("\n{}: {} tracks of {} users", set.name, first.total().tracks, first.users.len());
            let mut table = table(["method", "time %", "log loss", "calibration error", &at, "lead, ms"], 1);
            for (name, row) in set.shown() {
                table.add_row([vec![name], row.cells()].concat());
            }
            println!("{table}");
            if by_user {
                print_users(first, &at);
            }
        }
    }

    /// Writes everything as JSON.
    pub fn write(&self, path: &Path, [more, learning, thresholds]: [Option<Json>; 3]) -> Result<(), String> {
        let sets: Vec<Json> = self
            .sets
            .iter()
            .map(|set| json!({ "set": set.name, "methods": set.rows.iter().map(Row::json).collect::<Vec<_>>() }))
            .collect();
        write_json(path, &json!({ "sets": sets, "more": more, "learning": learning, "thresholds": thresholds }))
    }
}

/// Writes JSON.
pub fn write_json(path: &Path, report: &Json) -> Result<(), String> {
    write(path, &serde_json::to_string_pretty(report).map_err(|error| error.to_string())?)
}

fn print_users(row: &Row, at: &str) {
    let mut table = table(["user", "tracks", "time %", "log loss", "calibration error", at, "lead, ms"], 1);
    for (user, score) in &row.users {
        let tracks = vec![user.clone(), format!("{}", score.tracks)];
        table.add_row([tracks, figure_cells(&score.figures())].concat());
    }
    println!("{} by user\n{table}", row.name);
}
