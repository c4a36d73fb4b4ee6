//! Ardeshiri, Ahmad, Langdon and Godsill, "Efficient Bridging-Based Destination Inference in Object Tracking".

use crate::Effort;
use crate::gestures::{self, Gesture, gesture, predictor_of};
use crate::movement::{Movement, mean, percent, posteriors, share_on_top, top};
use crate::random::Normals;
use crate::report::{Chapter, Exhibit, Figure, Table};
use nalgebra::Vector3;
use presentation::{COLOURS, Corner, Panel, ProgressBar, Series, Stroke};

/// Exact, and with the denominator taken as constant.
const METHODS: [&str; 2] = ["singleFilter", "singleFilterApproximate"];
const SIGMA: f64 = 1.0;
/// A probability that is "significant (meaningful)", among 21.
const SURE: f64 = 0.3;

pub const fn gestures(effort: Effort) -> usize {
    match effort {
        Effort::Full => 50,
        Effort::Quick => 12,
    }
}

pub fn work(effort: Effort) -> u64 {
    2 * gestures(effort) as u64
}

pub fn chapter(effort: Effort, progress: &ProgressBar) -> Chapter {
    progress.set_message("Ardeshiri: exact and approximate");
    Chapter {
        citation: "T. Ardeshiri, B. I. Ahmad, P. M. Langdon and S. J. Godsill, Efficient Bridging-Based Destination Inference in Object Tracking, ICASSP 2017",
        exhibits: vec![figure1(effort, progress), in_line(effort, progress)],
    }
}

fn both(targets: &[[f64; 4]], movement: &Movement) -> [Vec<Vec<f64>>; 2] {
    METHODS.map(|method| posteriors(&predictor_of(targets, method, SIGMA), movement))
}

/// The share of the observations at which both methods have the same destination on top, of all and of those where the exact
/// one is fairly sure; and each method's shares of the time with the true one on top.
pub fn compare(gestures: &[Gesture], progress: &ProgressBar) -> ([f64; 2], [Vec<f64>; 2]) {
    let (mut same, mut observations) = ([0.0; 2], [0.0; 2]);
    let mut shares = [Vec::new(), Vec::new()];
    for Gesture { movement, targets } in gestures {
        let both = both(targets, movement);
        for (exact, approximate) in both[0].iter().zip(&both[1]) {
            let sure = exact[top(exact)] > SURE;
            for place in [Some(0), sure.then_some(1)].into_iter().flatten() {
                observations[place] += 1.0;
                same[place] += f64::from(u8::from(top(exact) == top(approximate)));
            }
        }
        for (shares, posteriors) in shares.iter_mut().zip(&both) {
            shares.push(share_on_top(posteriors, movement));
        }
        progress.inc(1);
    }
    ([0, 1].map(|place| same[place] / observations[place]), shares)
}

fn figure1(effort: Effort, progress: &ProgressBar) -> Exhibit {
    let gestures = gestures::simulated(gestures(effort), 50);
    let (agreements, shares) = compare(&gestures, progress);
    let selected = &gestures[0];
    let posteriors = both(&selected.targets, &selected.movement);
    let largest = posteriors[0]
        .iter()
        .flatten()
        .zip(posteriors[1].iter().flatten())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    let panel = |title: &str, posteriors: &[Vec<f64>]| {
        let line = |i: usize| {
            let points = selected
                .movement
                .observations
                .iter()
                .zip(posteriors)
                .map(move |((time, _), posterior)| (*time, posterior[i]));
            if i == selected.movement.truth {
                let mut truth = Series::new("the true destination", COLOURS[1], points);
                truth.width = 3.0;
                truth
            } else {
                Series::new("the others", COLOURS[0], points).thin(0.6)
            }
        };
        let last = selected.movement.observations.last().map_or(1.0, |(time, _)| *time);
        Panel {
            title: title.into(),
            x: ("time (s)", 0.0..last),
            y: ("p(D | y)", 0.0..1.02),
            legend: Some(Corner::UpperLeft),
            series: (0..selected.targets.len()).map(line).collect(),
        }
    };
    let panels = [panel("exact, (12)", &posteriors[0]), panel("denominator constant, Table 1", &posteriors[1])];
    let mut exhibit = Exhibit {
        title: "Figure 1: posteriors of 21 destinations over one gesture".into(),
        figures: vec![Figure::new(panels, 1, (760, 300))],
        caption: format!("Top: the exact formulation, bottom: the approximation. The numbers are over {} gestures, but for the largest difference.", gestures.len()),
        paper: "Over 50 recorded gestures both formulations gave identical classification results at every observation. In the figure the \
                distributions at each time differ marginally."
            .into(),
        assumed: vec![
            "The recordings are not public, so the gestures here are simulated, as for Liang's experiment above.".into(),
            gestures::PREDICTOR.into(),
            "sigma = 1.".into(),
        ],
        ..Exhibit::default()
    };
    for (place, quantity) in [
        "observations at which both have the same destination on top",
        "the same where the exact one gives it more than 0.3",
    ]
    .into_iter()
    .enumerate()
    {
        let agreement = agreements[place];
        let difference = format!("{:+.1} points", 100.0 * (agreement - 1.0));
        exhibit.compare(quantity, "100%", percent(agreement), difference);
    }
    exhibit.compare("largest difference of a probability in the figure", "\"marginal\"", format!("{largest:.3}"), "");
    for (shares, name) in shares.iter().zip(["exact", "approximate"]) {
        exhibit.compare(&format!("success, {name}"), "not stated", percent(mean(shares)), "");
    }
    exhibit
}

/// Two targets one behind the other from the start: there the denominator is not constant.
fn in_line(effort: Effort, progress: &ProgressBar) -> Exhibit {
    let targets = [[0.0, 0.0, 0.0, 0.024], [0.0, 0.0, -0.2, 0.024]];
    let start = Vector3::new(0.0, 0.0, 0.2);
    let mut random = Normals::new(12);
    let mut table = Table::new(&[
        "going to",
        "exact, time on top",
        "approximate, time on top",
        "mean probability, exact",
        "approximate",
    ]);
    let mut panels = Vec::new();
    let mut success = [[0.0; 2]; 2];
    for (truth, name) in ["the near target", "the far target"].into_iter().enumerate() {
        let mut shares = [Vec::new(), Vec::new()];
        let mut probabilities = [Vec::new(), Vec::new()];
        for i in 0..gestures(effort) / 2 {
            let movement = gesture(start, &targets, truth, &mut random);
            let both = both(&targets, &movement);
            for (place, posteriors) in both.iter().enumerate() {
                shares[place].push(share_on_top(posteriors, &movement));
                probabilities[place].extend(posteriors.iter().map(|posterior| posterior[truth]));
            }
            if i == 0 {
                let last = movement.observations.last().map_or(1.0, |(time, _)| *time);
                let line = |posteriors: &[Vec<f64>]| {
                    movement
                        .observations
                        .iter()
                        .zip(posteriors)
                        .map(|((time, _), b)| (*time, b[truth]))
                        .collect::<Vec<_>>()
                };
                panels.push(Panel {
                    title: format!("p of {name}, going there"),
                    x: ("time (s)", 0.0..last),
                    y: ("", 0.0..1.02),
                    legend: Some(Corner::LowerRight),
                    series: vec![
                        Series::new("exact", COLOURS[0], line(&both[0])),
                        Series::new("approximate", COLOURS[1], line(&both[1])).stroke(Stroke::Dashed),
                    ],
                });
            }
            progress.inc(1);
        }
        let [exact, approximate] = shares.map(|shares| mean(&shares));
        success[truth] = [exact, approximate];
        let [p_exact, p_approximate] = probabilities.map(|p| format!("{:.3}", mean(&p)));
        table.row([name.to_owned(), percent(exact), percent(approximate), p_exact, p_approximate]);
    }
    let mut exhibit = Exhibit {
        title: "Where dropping the denominator changes the answer: two targets in line".into(),
        figures: vec![Figure::new(panels, 2, (420, 300))],
        caption: "Targets 0.2 m and 0.4 m from the start in the same direction. f(x_T given x_1) is larger for the near one, and by (12) each is \
                  measured against its density given the start alone; without that the near one is the most probable before anything has moved."
            .into(),
        paper: "The denominator is approximately constant when the time to go is long (Q_T1 much larger than Q_Tt and Sigma_D), so the paper \
                replaces it by a constant factor."
            .into(),
        tables: vec![table],
        assumed: vec!["The paper has no such example; gestures and predictor are as above.".into()],
        ..Exhibit::default()
    };
    for (truth, name) in ["near", "far"].into_iter().enumerate() {
        let [exact, approximate] = success[truth];
        exhibit.compare(
            &format!("time on top, {name} target, approximate less exact"),
            "0 (identical)",
            format!("{:+.1} points", 100.0 * (approximate - exact)),
            "",
        );
    }
    exhibit
}
