//! `--steps`: what each scenario of ours predicts after every sample that is scored, as a table for other programs.

use crate::recorded::Recorded;
use std::fs::File;
use std::path::Path;
use whither::study::metrics::{Prediction, Score};
use whither::{Predictor, Scenario};

/// The columns before those of the targets.
const COLUMNS: [&str; 21] = [
    "file",
    "line",
    "id",
    "user",
    "method",
    "step",
    "time",
    "target",
    "top",
    "none",
    "log_likelihood",
    "log_evidence",
    "arrival",
    "arrival_deviation",
    "remaining",
    "x",
    "y",
    "z",
    "vx",
    "vy",
    "vz",
];

/// What is predicted after one sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    time: f64,
    top: Option<usize>,
    probabilities: Vec<f64>,
    none: f64,
    /// `log p(y_2:k | y_1, D)` of the true target, and `log p(y_2:k | y_1)`.
    evidence: [Option<f64>; 2],
    /// Mean and deviation.
    arrival: Option<[f64; 2]>,
    remaining: Option<f64>,
    /// Positions, then velocities.
    state: [Option<f64>; 6],
}

/// The steps of the approach, and their score, which is that of [`Score::of_scenario`].
pub fn run(
    track: &Recorded,
    approach: usize,
    scenario: &Scenario,
    compares: bool,
) -> whither::Result<(Score, Vec<Step>)> {
    let mut predictor = Predictor::new(scenario);
    let priors = predictor.probabilities().to_vec();
    let mut steps = Vec::with_capacity(approach);
    for sample in &track.samples[..approach.min(track.samples.len())] {
        sample.observe(&mut predictor)?;
        steps.push(Step::of(&mut predictor, track, sample.time, compares.then_some(&priors))?);
    }
    let predictions: Vec<Prediction> = steps
        .iter()
        .map(|step| {
            let chances = step.top.map(|top| [step.probabilities[top], step.probabilities[track.target]]);
            Prediction { top: step.top, chances }
        })
        .collect();
    Ok((Score::of(track, &predictions), steps))
}

impl Step {
    /// With priors where the method has a likelihood and not only something in proportion to it.
    fn of(predictor: &mut Predictor, track: &Recorded, time: f64, priors: Option<&Vec<f64>>) -> whither::Result<Self> {
        let top = predictor.best().map(|best| best.index);
        let probabilities = predictor.probabilities().to_vec();
        let none = predictor.none();
        let evidence = match (priors, top) {
            (Some(priors), Some(top)) if !predictor.expired() => {
                let likelihoods = predictor.log_likelihoods();
                [Some(likelihoods[track.target]), Some(likelihoods[top] + priors[top].ln() - probabilities[top].ln())]
            }
            _ => [None, None],
        };
        let arrival = predictor.arrival(None)?.map(|arrival| [arrival.mean, arrival.deviation]);
        let remaining = predictor.remaining().map(|remaining| remaining.mean);
        let dimensions = track.dimensions();
        let mut state = [None; 6];
        if let Some(now) = predictor.state() {
            for axis in 0..dimensions {
                state[axis] = now.mean.get(axis).copied();
                state[3 + axis] = now.mean.get(dimensions + axis).copied();
            }
        }
        Ok(Self { time, top, probabilities, none, evidence, arrival, remaining, state })
    }
}

/// The file that they are written to.
pub struct Table {
    writer: csv::Writer<File>,
    path: String,
    targets: usize,
}

impl Table {
    /// Begins a file with columns for so many targets.
    pub fn create(path: &Path, targets: usize) -> Result<Self, String> {
        let failed = |error: String| format!("--steps {}: {error}", path.display());
        std::fs::create_dir_all(path.parent().unwrap_or(Path::new(""))).map_err(|error| failed(error.to_string()))?;
        let writer = csv::Writer::from_path(path).map_err(|error| failed(error.to_string()))?;
        let mut table = Self { writer, path: path.display().to_string(), targets };
        let header = COLUMNS.iter().map(|&name| name.to_owned());
        table.record(header.chain((0..targets).map(|k| format!("p{k}"))))?;
        Ok(table)
    }

    /// Adds the steps of one method on one track.
    pub fn add(
        &mut self,
        file: &Path,
        line: usize,
        track: &Recorded,
        method: &str,
        steps: &[Step],
    ) -> Result<(), String> {
        let first = [file.display().to_string(), line.to_string(), track.id.clone(), track.user.clone()];
        for (k, step) in steps.iter().enumerate() {
            let [mean, deviation] = step.arrival.map_or([None; 2], |arrival| arrival.map(Some));
            let of_the_step = [
                method.to_owned(),
                k.to_string(),
                number(step.time),
                track.target.to_string(),
                step.top.map_or_else(String::new, |top| top.to_string()),
                number(step.none),
            ];
            let figures = step.evidence.into_iter().chain([mean, deviation, step.remaining]).chain(step.state);
            let probabilities = step.probabilities.iter().copied().map(Some);
            let figures = figures.chain(probabilities).map(|x| x.map_or_else(String::new, number));
            let missing = self.targets.saturating_sub(step.probabilities.len());
            let record = first.iter().cloned().chain(of_the_step).chain(figures);
            self.record(record.chain((0..missing).map(|_| String::new())))?;
        }
        Ok(())
    }

    fn record(&mut self, fields: impl Iterator<Item = String>) -> Result<(), String> {
        self.writer.write_record(fields).map_err(|error| format!("--steps {}: {error}", self.path))
    }

    /// Writes what is left, and returns the path.
    pub fn finish(mut self) -> Result<String, String> {
        self.writer.flush().map_err(|error| format!("--steps {}: {error}", self.path))?;
        Ok(self.path)
    }
}

/// The shortest text that is the same number, with an exponent where it is small or large.
fn number(x: f64) -> String {
    format!("{x:?}")
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const TRACK: &str = r#"{"id": "a \"7\", b", "user": "u", "targets": [[0, 0, 9, 9], [60, 0, 9, 9]], "target": 1,
        "samples": [[0, 30, 1], [1, 34, 1], [2, null, 0], [3, 50, 0], [4, 58, 0]]}"#;

    fn scenario(track: &Recorded, rest: &str) -> Scenario {
        let template = format!(
            r#"{{"motion": {{"type": "brownian", "dimensions": 2, "noise": 6}}, "observation": {{"noise": 1}}, {rest}}}"#
        );
        track.scenario(&serde_json::from_str(&template).unwrap(), &serde_json::from_str("null").unwrap()).unwrap()
    }

    #[test]
    fn a_score_is_the_same_with_steps_and_each_step_is_the_predictor_s() {
        let track = Recorded::read(&serde_json::from_str(TRACK).unwrap(), 0.0).unwrap();
        let scenario = scenario(&track, r#""none": 0.1, "arrival": {"type": "uniform", "from": 3, "to": 9}"#);
        let (score, steps) = run(&track, 5, &scenario, true).unwrap();
        assert_eq!(score, Score::of_scenario(&track, 5, &scenario).unwrap());
        let mut predictor = Predictor::new(&scenario);
        for (step, sample) in steps.iter().zip(&track.samples) {
            sample.observe(&mut predictor).unwrap();
            assert_eq!(step.probabilities, predictor.probabilities());
            assert_eq!(step.none, predictor.none());
            // Bayes: each target's likelihood and prior give its probability
            let likelihoods = predictor.log_likelihoods().to_vec();
            let [of_target, evidence] = step.evidence.map(Option::unwrap);
            assert_eq!(of_target, likelihoods[1]);
            for (likelihood, probability) in likelihoods.iter().zip(&step.probabilities) {
                assert!((0.45 * (likelihood - evidence).exp() - probability).abs() < 1e-12);
            }
            assert_eq!(step.arrival.unwrap()[0], predictor.arrival(None).unwrap().unwrap().mean);
            assert_eq!(step.state[..2], [0, 1].map(|axis| predictor.state().unwrap().mean.get(axis).copied()));
            assert_eq!(step.state[2..], [None; 4], "Brownian motion has no velocity");
        }
    }

    #[test]
    fn the_table_has_a_field_for_each_column_empty_where_there_is_nothing() {
        let track = Recorded::read(&serde_json::from_str(TRACK).unwrap(), 0.0).unwrap();
        let scenario = scenario(&track, r#""arrival": {"type": "uniform", "from": 1, "to": 2.5}"#);
        let (_, steps) = run(&track, 5, &scenario, true).unwrap();
        let path = std::env::temp_dir().join(format!("whither-steps-{}/steps.csv", std::process::id()));
        let mut table = Table::create(&path, 3).unwrap();
        table.add(Path::new("a.jsonl"), 12, &track, "one", &steps).unwrap();
        table.finish().unwrap();
        let mut reader = csv::Reader::from_path(&path).unwrap();
        let header = reader.headers().unwrap().clone();
        assert_eq!(header.iter().skip(COLUMNS.len()).collect::<Vec<_>>(), ["p0", "p1", "p2"]);
        let rows = reader.records().collect::<Result<Vec<_>, _>>().unwrap();
        std::fs::remove_dir_all(path.parent().unwrap()).unwrap();
        assert_eq!(rows.len(), 5);
        let field =
            |row: usize, name: &str| rows[row][header.iter().position(|column| column == name).unwrap()].to_owned();
        let texts = ["file", "line", "id", "method", "step", "time", "target"].map(|name| field(3, name));
        assert_eq!(texts, ["a.jsonl", "12", "a \"7\", b", "one", "3", "3.0", "1"].map(str::to_owned));
        assert_eq!(field(3, "p1").parse(), Ok(steps[3].probabilities[1]));
        assert_eq!(field(1, "log_likelihood").parse(), Ok(steps[1].evidence[0].unwrap()));
        assert_eq!(field(4, "log_evidence"), "", "every arrival time has passed");
        assert_eq!((field(0, "p2"), field(0, "vx"), field(0, "z"), field(0, "remaining")), Default::default());
        let taken = Table::create(Path::new("/dev/null/steps.csv"), 1).err().unwrap();
        assert!(taken.starts_with("--steps /dev/null/steps.csv: "), "{taken}");
    }
}
