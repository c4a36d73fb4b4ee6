//! Rezaie and Li, "Destination-Directed Trajectory Modeling and Prediction Using Conditionally Markov Sequences", section IV.

use crate::report::{Chapter, Exhibit, Figure};
use crate::{Effort, random};
use presentation::{COLOURS, Corner, Panel, ProgressBar, Series, Stroke};
use serde_json::json;
use whither::ConditionallyMarkovSequence;
use whither::internals::Value;

pub const STEPS: usize = 100;
/// Measurements are used up to this step.
const LAST_MEASURED: usize = 9;
const PAPERS_RATIO: f64 = 368.13;
/// Runs are quick compared with the other experiments.
const RUNS_A_TICK: usize = 50;

/// The airliner with the given joint density of origin and destination. State order here: positions, then velocities.
fn airliner(mean: Vec<f64>, covariance: Vec<Vec<f64>>) -> ConditionallyMarkovSequence {
    let configuration: Value = serde_json::from_value(json!({
        "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 0.1 },
        "timeStep": 15, "steps": STEPS, "pinnedMean": mean, "pinnedCovariance": covariance,
        "observation": { "noise": 10 },
    }))
    .expect("plain data");
    whither::internals::sequence(&configuration).expect("the paper's numbers are legal")
}

const ORIGIN: [f64; 4] = [2000.0, 5000.0, 70.0, 0.0];
const DESTINATION: [f64; 4] = [130_000.0, 10_000.0, 70.0, 0.0];
const VARIANCE: [f64; 4] = [1000.0, 1000.0, 10.0, 10.0];

/// The CM_L sequence: independent endpoints.
fn directed() -> ConditionallyMarkovSequence {
    let covariance = (0..8).map(|i| (0..8).map(|j| if i == j { VARIANCE[i % 4] } else { 0.0 }).collect()).collect();
    airliner([ORIGIN, DESTINATION].concat(), covariance)
}

/// The Markov sequence (1) is the CM_L sequence whose endpoints have the joint density of (1):
/// `x_N = F x_0 + e` over all steps.
fn markov() -> ConditionallyMarkovSequence {
    let h = 15.0 * STEPS as f64;
    let f = |i: usize, j: usize| match j {
        _ if i == j => 1.0,
        _ if i + 2 == j => h,
        _ => 0.0,
    };
    let q = |i: usize, j: usize| match (i / 2, j / 2) {
        _ if i % 2 != j % 2 => 0.0,
        (0, 0) => 0.01 * h.powi(3) / 3.0,
        (1, 1) => 0.01 * h,
        _ => 0.01 * h * h / 2.0,
    };
    let cross = |end: usize, start: usize| f(end, start) * VARIANCE[start];
    let covariance = |i: usize, j: usize| match (i / 4, j / 4) {
        (0, 0) if i == j => VARIANCE[i],
        (0, 0) => 0.0,
        (1, 0) => cross(i - 4, j),
        (0, _) => cross(j - 4, i),
        _ => (0..4).map(|k| cross(i - 4, k) * f(j - 4, k)).sum::<f64>() + q(i - 4, j - 4),
    };
    let end = [ORIGIN[0] + h * ORIGIN[2], ORIGIN[1], ORIGIN[2], ORIGIN[3]];
    airliner([ORIGIN, end].concat(), (0..8).map(|i| (0..8).map(|j| covariance(i, j)).collect()).collect())
}

pub fn work(effort: Effort) -> u64 {
    (runs(effort) / RUNS_A_TICK) as u64
}

pub const fn runs(effort: Effort) -> usize {
    match effort {
        Effort::Full => 1000,
        Effort::Quick => 200,
    }
}

pub fn chapter(effort: Effort, progress: &ProgressBar) -> Chapter {
    progress.set_message("Rezaie and Li: the airliner");
    Chapter {
        citation: "R. Rezaie and X. R. Li, Destination-Directed Trajectory Modeling and Prediction Using Conditionally Markov Sequences, 2018",
        exhibits: vec![figure1(), figure2(runs(effort), progress)],
    }
}

fn figure1() -> Exhibit {
    let mut series = Vec::new();
    let mut deviations = [0.0; 2];
    for (place, (label, sequence, stroke)) in
        [("Markov", markov(), Stroke::Dashed), ("CM_L", directed(), Stroke::Solid)].into_iter().enumerate()
    {
        let drawn = sequence.sample(1, 1000).expect("1000 sequences of 101 states are not too many");
        // both axes have the same variance
        let spread = |at: usize| -> f64 {
            let middle = mean(drawn.iter().map(|x| x[at]));
            drawn.iter().map(|x| (x[at] - middle).powi(2)).sum()
        };
        deviations[place] = ((spread(400) + spread(401)) / (2.0 * 999.0)).sqrt();
        for trajectory in &drawn[..50] {
            let points = trajectory.chunks(4).map(|x| (x[0] / 1000.0, x[1] / 1000.0));
            let colour = COLOURS[1 - place];
            series.push(Series::new(label, colour, points).stroke(stroke).thin(0.65));
        }
    }
    let mut exhibit = Exhibit {
        title: "Figure 1: 50 trajectories of the CM_L sequence and 50 of the Markov sequence".into(),
        figures: vec![Figure::new(
            [Panel { title: String::new(), x: ("x (km)", 0.0..140.0), y: ("y (km)", -15.0..25.0), legend: Some(Corner::UpperLeft), series }],
            1,
            (760, 460),
        )],
        paper: "Both sequences model the origin well, and near it they differ a little. Later the difference grows: only the CM_L \
                trajectories end up at the destination."
            .into(),
        ..Exhibit::default()
    };
    exhibit.compare(
        "deviation of a position at the end, CM_L",
        "31.6 m (C_N)",
        format!("{:.1} m", deviations[1]),
        format!("ratio {:.2}", deviations[1] / 1000f64.sqrt()),
    );
    exhibit.compare("deviation of a position at the end, Markov", "not stated", format!("{:.0} m", deviations[0]), "");
    exhibit
}

/// The average Euclidean errors of the predicted position at each step, by the CM_L sequence and by the Markov sequence.
pub fn average_errors(runs: usize, progress: &ProgressBar) -> [[f64; STEPS + 1]; 2] {
    let mut sequences = [directed(), markov()];
    let trajectories = sequences[0].sample(2018, runs).expect("not too many");
    let mut noise = random::Normals::new(40);
    let mut errors = [[0.0; STEPS + 1]; 2];
    for (run, trajectory) in trajectories.iter().enumerate() {
        let measured: Vec<[f64; 2]> = (1..=LAST_MEASURED)
            .map(|k| [trajectory[4 * k] + 10.0 * noise.draw(), trajectory[4 * k + 1] + 10.0 * noise.draw()])
            .collect();
        for (sequence, errors) in sequences.iter_mut().zip(&mut errors) {
            sequence.reset();
            for (k, position) in measured.iter().enumerate() {
                sequence.measure(k + 1, position).expect("steps ascend");
            }
            for (k, sum) in errors.iter_mut().enumerate().skip(LAST_MEASURED + 1) {
                let predicted = sequence.state(k).expect("it is a step").mean;
                let truth = &trajectory[4 * k..];
                *sum += (predicted[0] - truth[0]).hypot(predicted[1] - truth[1]) / runs as f64;
            }
        }
        progress.inc(u64::from(run % RUNS_A_TICK == 0));
    }
    errors
}

fn figure2(runs: usize, progress: &ProgressBar) -> Exhibit {
    let errors = average_errors(runs, progress);
    let points = |errors: &[f64]| {
        (LAST_MEASURED + 1..=STEPS).map(|k| ((k - LAST_MEASURED) as f64, errors[k].log10())).collect::<Vec<_>>()
    };
    let ratio = errors[1][STEPS] / errors[0][STEPS];
    let mut exhibit = Exhibit {
        title: format!("Figure 2: average Euclidean error of the predicted position, {runs} runs"),
        figures: vec![Figure::new(
            [Panel {
                title: String::new(),
                x: ("n", 0.0..92.0),
                y: ("log10 AEE of the position at 9 + n given 9 (m)", 1.0..5.0),
                legend: Some(Corner::UpperLeft),
                series: vec![
                    Series::new("Markov", COLOURS[1], points(&errors[1])).stroke(Stroke::Dashed),
                    Series::new("CM_L", COLOURS[0], points(&errors[0])),
                ],
            }],
            1,
            (760, 420),
        )],
        paper: "The ratio of the Markov model's error to the CM_L model's at step 100 is 368.13, from 1000 runs."
            .into(),
        assumed: vec![
            "Measurements begin at step 1 (the paper: k = 1 .. N), trajectories are drawn from the CM_L sequence."
                .into(),
        ],
        ..Exhibit::default()
    };
    exhibit.compare(
        "AEE ratio at step 100",
        "368.13",
        format!("{ratio:.2}"),
        format!("ratio {:.3}, difference {:+.2}", ratio / PAPERS_RATIO, ratio - PAPERS_RATIO),
    );
    for (label, errors) in [("AEE at step 100, CM_L", &errors[0]), ("AEE at step 100, Markov", &errors[1])] {
        exhibit.compare(label, "not stated", format!("{:.1} m", errors[STEPS]), "");
    }
    exhibit
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}
