//! `--sweep`: what it costs to have few targets or many, small or wide ones, other sample rates and pixels, no setting changed.

use crate::peers::Peer;
use crate::reading::{self, Line};
use crate::variants::{ALL, Variant};
use presentation::table;
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use std::path::Path;
use whither::internals::{Value, track_scenario};
use whither::study::metrics::{Prediction, Score};
use whither::study::track::Track;

/// Of one circumstance: our score, that of the nearest target, and those of extrapolation over its grid.
#[derive(Clone, Debug, Default)]
struct Row {
    ours: Score,
    nearest: Score,
    grid: Vec<Score>,
}

/// The rows of each set.
type Sets = BTreeMap<String, Vec<Row>>;

/// Runs all variants of a file's tracks; returns how many broken lines were skipped.
pub fn run(template: &Value, file: &Path, into: &mut Vec<Json>) -> Result<usize, String> {
    let mut sets = Sets::new();
    let name = reading::name(file);
    let skipped = reading::each(
        file,
        |line| score(template, line),
        |(part, rows)| {
            let sums = sets.entry(format!("{name}{part}")).or_insert_with(|| vec![Row::default(); ALL.len()]);
            sums.iter_mut()
                .zip(rows)
                .filter_map(|(sum, row)| row.map(|row| (sum, row)))
                .for_each(|(sum, row)| sum.add(&row));
        },
    )?;
    for (set, rows) in &sets {
        print(set, rows);
        let rows: Vec<Json> = ALL.iter().zip(rows).map(|(variant, row)| row.json(*variant)).collect();
        into.push(json!({ "set": set, "rows": rows }));
    }
    Ok(skipped)
}

type Scored = (&'static str, Vec<Option<Row>>);

fn score(template: &Value, line: &Line) -> Result<Option<Scored>, String> {
    let track = line.track(0.0)?;
    if track.dimensions() != 2 || track.approach().is_none() {
        return Ok(None);
    }
    let rows = ALL.iter().enumerate().map(|(k, variant)| {
        let seed = (line.number * ALL.len() + k) as u64;
        variant.of(&track, seed).map(|(track, approach)| Row::of(template, &track, approach)).transpose()
    });
    Ok(Some((reading::part(&track), rows.collect::<Result<_, _>>()?)))
}

impl Row {
    fn of(template: &Value, track: &Track, approach: usize) -> Result<Self, String> {
        let message = |error: whither::Error| error.to_string();
        let scenario = track_scenario(track, template, &Value::Null).map_err(message)?;
        let of_peer = |peer: Peer| {
            let tops = peer.tops(track, approach).into_iter();
            Score::of(track, &tops.map(|top| Prediction { top, chances: None }).collect::<Vec<_>>())
        };
        let grid =
            Peer::all().into_iter().filter(|peer| matches!(peer, Peer::Extrapolation { .. }) && peer.applies(track));
        Ok(Self {
            ours: Score::of_scenario(track, approach, &scenario).map_err(message)?,
            nearest: of_peer(Peer::Nearest),
            grid: grid.map(of_peer).collect(),
        })
    }

    fn add(&mut self, other: &Self) {
        self.ours.add(&other.ours);
        self.nearest.add(&other.nearest);
        self.grid.resize(other.grid.len(), Score::default());
        self.grid.iter_mut().zip(&other.grid).for_each(|(sum, score)| sum.add(score));
    }

    /// Ours: time%, log loss, calibration error; then time% of the best extrapolation and of the nearest target.
    fn figures(&self) -> [f64; 5] {
        let ours = self.ours.figures();
        let best = self.grid.iter().map(|score| score.figures().time).fold(0.0, f64::max);
        [ours.time, ours.loss.unwrap_or(0.0), ours.calibration.unwrap_or(0.0), best, self.nearest.figures().time]
    }

    fn json(&self, variant: Variant) -> Json {
        let [time, loss, calibration, extrapolation, nearest] = self.figures();
        json!({
            "variant": variant.name(), "tracks": self.ours.tracks, "time": time, "loss": loss,
            "calibration": calibration, "extrapolation": extrapolation, "nearest": nearest,
        })
    }
}

fn print(set: &str, rows: &[Row]) {
    let header = ["", "tracks", "time %", "log loss", "calibration error", "best extrapolation", "nearest"];
    let mut table = table(header, 1);
    for (variant, row) in ALL.iter().zip(rows) {
        let [time, loss, calibration, extrapolation, nearest] = row.figures();
        let cells = [
            variant.name(),
            row.ours.tracks.to_string(),
            format!("{time:.1}"),
            format!("{loss:.3}"),
            format!("{calibration:.3}"),
            format!("{extrapolation:.1}"),
            format!("{nearest:.1}"),
        ];
        table.add_row(cells);
    }
    println!("\n{set}: one setting, other circumstances\n{table}");
}
