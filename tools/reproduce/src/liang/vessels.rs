//! Figures 1 and 2: six harbours, vessels that move by constant velocity and end at one of them.

use super::prediction_error::distances;
use crate::movement::{METHODS, Movement, mean, median, percent, posteriors, scenario, share_on_top};
use crate::report::{Exhibit, Figure, Table};
use crate::{Effort, random};
use presentation::{COLOURS, Corner, Panel, ProgressBar, RGBColor, Series, Stroke};
use serde_json::json;
use whither::Scenario;
use whither::internals::Value;

/// The harbours' centres in metres, around a bay; not in the paper.
pub const HARBOURS: [[f64; 2]; 6] = [
    [-32_000.0, 14_000.0],
    [-24_000.0, 30_000.0],
    [-8_000.0, 38_000.0],
    [10_000.0, 37_000.0],
    [26_000.0, 28_000.0],
    [34_000.0, 12_000.0],
];
/// The time between observations, in seconds; not in the paper.
const STEP: f64 = 60.0;
const MINUTE: f64 = 60.0;

/// The deviation of the velocity that a report states, in m/s; not in the paper.
const REPORTED: f64 = 0.5;
/// The diagonal of `Sigma_i`.
const EXTENT: [f64; 4] = [5.0, 5.0, 0.1, 0.1];

/// What is known of a vessel before its first observation.
#[derive(Clone, Copy, Debug)]
pub enum Start {
    /// The rendezvous, and the velocity that its first report states.
    Reported([f64; 2]),
    /// Any place, about the speed of a vessel.
    Unknown,
}

/// The paper's predictor.
pub fn predictor_of(method: &str, start: Start) -> Scenario {
    let initial = match start {
        Start::Reported([east, north]) => {
            let variances = [1e6, 1e6, REPORTED * REPORTED, REPORTED * REPORTED];
            json!({ "mean": [0, 0, east, north], "covariance": diagonal(&variances) })
        }
        Start::Unknown => json!({ "velocity": 5 }),
    };
    scenario(json!({
        "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 0.1 },
        "observation": { "noise": 10 },
        "initial": initial,
        "arrival": { "type": "uniform", "from": 80.0 * MINUTE, "to": 150.0 * MINUTE },
        "quadrature": { "rule": "simpson", "points": 15 },
        "method": method,
        "destinations": HARBOURS.iter().enumerate().map(|(i, harbour)| json!({
            "id": format!("D{}", i + 1), "mean": [harbour[0], harbour[1], 0, 0], "covariance": diagonal(&EXTENT),
        })).collect::<Vec<_>>(),
    }))
}

fn diagonal(variances: &[f64]) -> Vec<Vec<f64>> {
    let size = variances.len();
    (0..size).map(|i| (0..size).map(|j| if i == j { variances[i] } else { 0.0 }).collect()).collect()
}

/// A vessel on its way.
pub struct Vessel {
    pub movement: Movement,
    /// The velocity that its first report states.
    pub reported: [f64; 2],
}

/// A vessel that goes to harbour `truth`: constant velocity given both endpoints.
pub fn vessel(truth: usize, random: &mut random::Normals) -> Vessel {
    let steps = (random.between(80.0 * MINUTE, 150.0 * MINUTE) / STEP).round();
    let harbour = HARBOURS[truth];
    // it starts from the rendezvous at about the speed that it needs
    let velocity = harbour.map(|x| x / (steps * STEP));
    let covariance = diagonal(&[&[1e6, 1e6, 1.0, 1.0], EXTENT.as_slice()].concat());
    let configuration: Value = serde_json::from_value(json!({
        "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 0.1 }, "timeStep": STEP, "steps": steps,
        "pinnedMean": [0, 0, velocity[0], velocity[1], harbour[0], harbour[1], 0, 0], "pinnedCovariance": covariance,
        "observation": { "noise": 10 },
    }))
    .expect("plain data");
    let sequence = whither::internals::sequence(&configuration).expect("it is legal");
    let seed = random.between(0.0, 1e9) as u64;
    let states = sequence.sample(seed, 1).expect("one is not too many").concat();
    let reported = [states[2] + REPORTED * random.draw(), states[3] + REPORTED * random.draw()];
    let observed = |(k, state): (usize, &[f64])| {
        (k as f64 * STEP, vec![state[0] + 10.0 * random.draw(), state[1] + 10.0 * random.draw()])
    };
    let observations = states.chunks(4).enumerate().map(observed).collect();
    Vessel { movement: Movement { observations, truth }, reported }
}

/// So many vessels, to one harbour after the other.
pub fn drawn(count: usize) -> Vec<Vessel> {
    let mut random = random::Normals::new(6);
    (0..count).map(|i| vessel(i % HARBOURS.len(), &mut random)).collect()
}

/// The probabilities over each track by the original bridging distributions and by Algorithm 1.
pub fn families(vessels: &[Vessel], start: fn(&Vessel) -> Start) -> [Vec<Vec<Vec<f64>>>; 2] {
    ["bridging", "algorithm1"].map(|method| {
        let posterior = |vessel: &Vessel| posteriors(&predictor_of(method, start(vessel)), &vessel.movement);
        vessels.iter().map(posterior).collect()
    })
}

pub fn reported(vessel: &Vessel) -> Start {
    Start::Reported(vessel.reported)
}

/// The mean share of the time during which the true harbour is on top.
pub fn success(vessels: &[Vessel], method: &str) -> f64 {
    let share = |vessel: &Vessel| {
        share_on_top(&posteriors(&predictor_of(method, reported(vessel)), &vessel.movement), &vessel.movement)
    };
    mean(&vessels.iter().map(share).collect::<Vec<f64>>())
}

pub const fn tracks(effort: Effort) -> usize {
    match effort {
        Effort::Full => 100,
        Effort::Quick => 12,
    }
}

pub fn work(effort: Effort) -> u64 {
    2 * tracks(effort) as u64
}

pub fn exhibits(effort: Effort, progress: &ProgressBar) -> Vec<Exhibit> {
    progress.set_message("Liang: vessels");
    let vessels = drawn(tracks(effort));
    vec![figure1(&vessels, progress), figure2(&vessels, progress)]
}

fn assumptions() -> Vec<String> {
    [
        "The harbours' places: 34 to 39 km from the rendezvous, around a bay (map above); the paper gives none.",
        "Metres and seconds; sigma = 0.1 in m/s^1.5, Sigma_i in m^2 and (m/s)^2, so that a vessel comes to rest at its harbour.",
        "A track: constant velocity with sigma = 0.1, given both endpoints; it starts within about 1 km of the rendezvous with about the velocity it needs, and arrives after U(80 min, 150 min).",
        "One observation a minute, with a deviation of 10 m for each axis. Before the first observation the vessel is within about 1 km of the rendezvous, and the velocity is known to 0.5 m/s (AIS reports state speed and course).",
    ]
    .map(String::from)
    .to_vec()
}

fn figure1(vessels: &[Vessel], progress: &ProgressBar) -> Exhibit {
    let shown = &vessels[..HARBOURS.len()];
    let [original, proposed] = families(shown, reported);
    let unknown = families(shown, |_| Start::Unknown);
    let mut map = Vec::new();
    for (vessel, posteriors) in shown.iter().zip(&proposed) {
        for (pair, posterior) in vessel.movement.observations.windows(2).zip(posteriors) {
            let points = pair.iter().map(|(_, position)| (position[0] / 1000.0, position[1] / 1000.0));
            let mut segment = Series::new("", heat(posterior[vessel.movement.truth]), points);
            segment.width = 3.0;
            map.push(segment);
        }
    }
    map.push(Series::new("harbour", COLOURS[6], HARBOURS.map(|[x, y]| (x / 1000.0, y / 1000.0))).stroke(Stroke::Dots));
    let map = Panel {
        title: "(a) coloured by the probability of the true harbour: blue 0, red 1".into(),
        x: ("x (km)", -40.0..40.0),
        y: ("y (km)", -5.0..42.0),
        legend: Some(Corner::UpperLeft),
        series: map,
    };
    let panels: Vec<Panel> = shown
        .iter()
        .enumerate()
        .map(|(i, vessel)| {
            let line = |posteriors: &[Vec<f64>]| {
                let times = vessel.movement.observations.iter().map(|(time, _)| time / MINUTE);
                times.zip(posteriors.iter().map(|posterior| posterior[i])).collect::<Vec<_>>()
            };
            Panel {
                title: format!("(b) p(D = D{} | y)", i + 1),
                x: ("time (min)", 0.0..150.0),
                y: ("", 0.0..1.02),
                legend: (i == 0).then_some(Corner::LowerRight),
                series: vec![
                    Series::new("original", COLOURS[1], line(&original[i])),
                    Series::new("Algorithm 1", COLOURS[0], line(&proposed[i])).stroke(Stroke::Dashed),
                ],
            }
        })
        .collect();
    let mut success_table = Table::new(&["method", "", "time on top"]);
    let mut shares = Vec::new();
    for (method, source) in METHODS {
        let share = success(vessels, method);
        success_table.row([method.to_owned(), source.to_owned(), percent(share)]);
        shares.push(share);
    }
    progress.inc(vessels.len() as u64);
    let mut exhibit = Exhibit {
        title: format!("Figure 1: six synthetic vessel tracks; the true harbour on top over {} tracks", vessels.len()),
        figures: vec![Figure::new([map], 1, (760, 460)), Figure::new(panels, 3, (300, 230))],
        caption: "Orange: the original bridging distributions; blue, dashed: Algorithm 1. Both agree to rounding if x_1 is known; the less is known of the velocity at the start, the more they differ, for the original takes start and end as independent and Algorithm 1 knows that a start towards the harbour is likelier.".into(),
        paper: "Bridging is effective: uncertainty diminishes as the vessel moves towards its endpoint. The proposed algorithms give \
                very similar results to the original."
            .into(),
        tables: vec![success_table],
        assumed: assumptions(),
        ..Exhibit::default()
    };
    for (quantity, difference) in [
        (
            "largest difference of a probability in (b), original and Algorithm 1",
            largest_difference(&original, &proposed),
        ),
        ("the same where the velocity at the start is not known", largest_difference(&unknown[0], &unknown[1])),
    ] {
        exhibit.compare(quantity, "\"very similar\"", format!("{difference:.3}"), "");
    }
    exhibit.compare(
        "time on top, Algorithm 1 less original",
        "not stated",
        format!("{:+.1} points", 100.0 * (shares[1] - shares[0])),
        "",
    );
    exhibit
}

/// Over all tracks, times and harbours.
pub fn largest_difference(one: &[Vec<Vec<f64>>], other: &[Vec<Vec<f64>>]) -> f64 {
    let pairs = one.iter().flatten().flatten().zip(other.iter().flatten().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn figure2(vessels: &[Vessel], progress: &ProgressBar) -> Exhibit {
    let pairs = ["original and Algorithm 1", "original and Algorithm 2", "Algorithm 1 and Algorithm 2"];
    let mut sums = vec![[0.0; 3]; 160];
    let mut counts = vec![0.0; 160];
    for vessel in vessels {
        let scenario = predictor_of("bridging", reported(vessel));
        for (k, distances) in distances(&scenario, &vessel.movement).into_iter().enumerate() {
            counts[k] += 1.0;
            (0..3).for_each(|pair| sums[k][pair] += distances[pair]);
        }
        progress.inc(1);
    }
    let decibels = |x: f64| 10.0 * x.log10();
    let series = pairs.iter().enumerate().map(|(pair, label)| {
        let points = (0..sums.len())
            .filter(|&k| counts[k] >= 5.0 && sums[k][pair] > 0.0)
            .map(|k| ((k + 1) as f64 * STEP / MINUTE, decibels(sums[k][pair] / counts[k])));
        let stroke = if pair == 1 { Stroke::Dashed } else { Stroke::Solid };
        Series::new(*label, COLOURS[[1, 2, 0][pair]], points).stroke(stroke)
    });
    let series: Vec<Series> = series.collect();
    let typical = |pair: usize| {
        decibels(median((0..sums.len()).filter(|&k| counts[k] >= 5.0).map(|k| sums[k][pair] / counts[k]).collect()))
    };
    let mut exhibit = Exhibit {
        caption: "From 80 min on an arrival time passes every five minutes. Just before it passes, a prediction is drawn to an end that most \
                  tracks are not near, and there the formulations differ most."
            .into(),
        title: format!("Figure 2: Bhattacharyya distance between the prediction errors, {} tracks", vessels.len()),
        figures: vec![Figure::new(
            [Panel { title: String::new(), x: ("time (min)", 0.0..150.0), y: ("distance (dB)", -200.0..0.0), legend: Some(Corner::MiddleRight), series }],
            1,
            (760, 420),
        )],
        paper: "The difference between the proposed formulation and the original is negligibly small, the results of the two algorithms are \
                nearly identical. (The curves' values are in the figure only.)"
            .into(),
        assumed: vec![
            "A prediction error is Gaussian for one arrival time: the distance is averaged over the arrival times ahead with Simpson's weights, over the six harbours and over the tracks.".into(),
            "The printed distance has det(Sigma_1) det(Sigma_2) in the logarithm's denominator where the square root of it is meant; the corrected one is used.".into(),
        ],
        ..Exhibit::default()
    };
    for (pair, label) in pairs.iter().enumerate() {
        let paper = if pair == 2 { "\"nearly identical\"" } else { "\"negligibly small\"" };
        exhibit.compare(&format!("distance, {label}, median over time"), paper, format!("{:.0} dB", typical(pair)), "");
    }
    exhibit
}

/// From blue by way of grey to red.
fn heat(p: f64) -> RGBColor {
    let (low, middle, high) = ([0.0, 90.0, 190.0], [200.0, 195.0, 190.0], [200.0, 30.0, 20.0]);
    let (from, to, share) = if p < 0.5 { (low, middle, 2.0 * p) } else { (middle, high, 2.0 * p - 1.0) };
    let channel = |i: usize| (from[i] + (to[i] - from[i]) * share).round() as u8;
    RGBColor(channel(0), channel(1), channel(2))
}
