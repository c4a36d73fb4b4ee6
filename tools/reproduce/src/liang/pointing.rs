//! The in-car pointing experiment: success of the methods, and how it depends on the noise.

use crate::Effort;
use crate::gestures::{self, Gesture, predictor_of};
use crate::movement::{METHODS, mean, percent, posteriors, share_on_top};
use crate::report::{Exhibit, Figure, Table};
use presentation::{COLOURS, Corner, Panel, ProgressBar, Series, Stroke};

const SIGMAS: [f64; 10] = [0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 2.5, 3.0];
/// The families: within each the methods are the same to rounding.
const FAMILIES: [(&str, &str); 3] = [
    ("pseudoObservation", "pseudo-observation (Algorithms 1 and 2)"),
    ("singleFilter", "original bridging"),
    ("singleFilterApproximate", "Ardeshiri, Table 1"),
];

pub const fn simulated(effort: Effort) -> usize {
    match effort {
        Effort::Full => 95,
        Effort::Quick => 20,
    }
}

/// One in so many recorded gestures.
const fn every(effort: Effort) -> usize {
    match effort {
        Effort::Full => 10,
        Effort::Quick => 60,
    }
}

pub fn work(_effort: Effort) -> u64 {
    2 * (METHODS.len() + SIGMAS.len()) as u64
}

pub fn exhibits(effort: Effort, progress: &ProgressBar) -> Vec<Exhibit> {
    progress.set_message("Liang: pointing gestures");
    let mut exhibits = vec![exhibit(
        "Freehand pointing gestures in a car, 21 icons: simulated",
        &gestures::simulated(simulated(effort), 95),
        vec![
            "The recordings are not public, so the gestures here are simulated.".into(),
            gestures::SIMULATION.into(),
            gestures::PREDICTOR.into(),
        ],
        progress,
    )];
    match gestures::recorded(every(effort)) {
        Some(recorded) => exhibits.push(exhibit(
            "Recorded mid-air gestures, 9 targets on a ring",
            &recorded,
            vec![
                "The 3DFitts recordings (one person, Leap Motion and VIVE) in place of the paper's.".into(),
                gestures::PREDICTOR.into(),
            ],
            progress,
        )),
        None => {
            println!("  (no recorded gestures: RECORDINGS names no folder that has fitts3d_midair.jsonl)\n");
            progress.inc((METHODS.len() + SIGMAS.len()) as u64);
        }
    }
    exhibits
}

pub fn success(gestures: &[Gesture], method: &str, noise: f64) -> f64 {
    let share = |gesture: &Gesture| {
        let posteriors = posteriors(&predictor_of(&gesture.targets, method, noise), &gesture.movement);
        share_on_top(&posteriors, &gesture.movement)
    };
    mean(&gestures.iter().map(share).collect::<Vec<_>>())
}

fn exhibit(title: &str, gestures: &[Gesture], assumed: Vec<String>, progress: &ProgressBar) -> Exhibit {
    let mut methods = Table::new(&["method at sigma = 1", "", "success"]);
    let mut at_one = Vec::new();
    for (method, source) in METHODS {
        let share = success(gestures, method, 1.0);
        methods.row([method.to_owned(), source.to_owned(), percent(share)]);
        at_one.push(share);
        progress.inc(1);
    }
    let mut curves = vec![Vec::new(); FAMILIES.len()];
    for sigma in SIGMAS {
        for (curve, (method, _)) in curves.iter_mut().zip(FAMILIES) {
            curve.push(success(gestures, method, sigma));
        }
        progress.inc(1);
    }
    let mut table = Table::new(&["sigma", "pseudo-observation", "bridging", "approximate"]);
    for (k, sigma) in SIGMAS.iter().enumerate() {
        table.row([sigma.to_string(), percent(curves[0][k]), percent(curves[1][k]), percent(curves[2][k])]);
    }
    let series = FAMILIES.iter().zip(&curves).enumerate().map(|(i, ((_, label), curve))| {
        let points = SIGMAS.iter().zip(curve).map(|(sigma, share)| (*sigma, 100.0 * share));
        let stroke = if i == 2 { Stroke::Dashed } else { Stroke::Solid };
        Series::new(*label, COLOURS[i], points).stroke(stroke)
    });
    let series: Vec<Series> = series.collect();
    let mut exhibit = Exhibit {
        title: format!("{title} ({} gestures)", gestures.len()),
        figures: vec![Figure::new(
            [Panel { title: String::new(), x: ("sigma (m/s^1.5)", 0.0..3.0), y: ("success (% of the time)", 0.0..100.0), legend: Some(Corner::LowerRight), series }],
            1,
            (760, 380),
        )],
        caption: "Share of the time with the true target on top, as the model's noise changes.".into(),
        paper: "All three methods have a success of about 63% with sigma = 1. For sigma from 0.3 to 1.5 it stays within 60 to 65% for all \
                bridging approaches; values outside that range degrade it."
            .into(),
        tables: vec![methods, table],
        assumed,
        ..Exhibit::default()
    };
    for (i, name) in [(0, "original bridging"), (1, "Algorithm 1"), (2, "Algorithm 2")] {
        let points = 100.0 * at_one[i] - 63.0;
        exhibit.compare(
            &format!("success at sigma = 1, {name}"),
            "63%",
            percent(at_one[i]),
            format!("{points:+.1} points"),
        );
    }
    let within = |curve: &[f64]| {
        let middle =
            SIGMAS.iter().zip(curve).filter(|(sigma, _)| (0.3..=1.5).contains(*sigma)).map(|(_, share)| *share);
        (middle.clone().fold(1.0, f64::min), middle.fold(0.0, f64::max))
    };
    for (name, curve) in [("Algorithm 1", &curves[0]), ("original", &curves[1])] {
        let (low, high) = within(curve);
        exhibit.compare(
            &format!("range for sigma from 0.3 to 1.5, {name}"),
            "60 to 65%",
            format!("{} to {}", percent(low), percent(high)),
            format!("{:.1} points wide, paper 5", 100.0 * (high - low)),
        );
        exhibit.compare(
            &format!("at sigma = 0.1, {name}"),
            "degraded",
            percent(curve[0]),
            format!("{:+.1} points to the best", 100.0 * (curve[0] - high)),
        );
        exhibit.compare(
            &format!("at sigma = 3, {name}"),
            "degraded",
            percent(curve[SIGMAS.len() - 1]),
            format!("{:+.1} points to the best", 100.0 * (curve[SIGMAS.len() - 1] - high)),
        );
    }
    exhibit
}
