//! The cost of a step: (14)-(16), Table I, the operations of our code, and run times.

use super::vessels::{Start, predictor_of, vessel};
use crate::movement::{METHODS, median};
use crate::random::Normals;
use crate::report::{Exhibit, Table};
use crate::{Effort, movement};
use presentation::ProgressBar;
use std::hint::black_box;
use std::time::Instant;
use whither::{Predictor, Scenario};

/// Observation, state, endpoint, arrival times, destinations, as in the paper.
const M: f64 = 2.0;
const S: f64 = 4.0;
const L: f64 = 4.0;
const Q: f64 = 15.0;
const N: f64 = 6.0;
/// The paper's mean run times in ms: original, Algorithm 1, Algorithm 2.
const PAPERS_TIMES: [f64; 3] = [7.42, 2.62, 5.36];

const fn rounds(effort: Effort) -> usize {
    match effort {
        Effort::Full => 21,
        Effort::Quick => 5,
    }
}

pub fn work(effort: Effort) -> u64 {
    rounds(effort) as u64
}

pub fn exhibits(effort: Effort, progress: &ProgressBar) -> Vec<Exhibit> {
    progress.set_message("Liang: run times");
    vec![flops(), run_times(rounds(effort), progress)]
}

fn kalman_filter(m: f64, s: f64) -> f64 {
    1.5 * (s.powi(3) + s * s) + m * s * (1.5 * (s + m) + 3.0) + 2.0 / 3.0 * (m.powi(3) - m)
}

/// The factors of (14), (15), (16).
fn gammas(m: f64, s: f64) -> [f64; 3] {
    let observed = m * s * (s + 0.5 * m + 1.5);
    [
        20.5 * s.powi(3) + 9.5 * s * s - 2.0 * s + 3.0 * m * s * (2.0 * s + m + 2.0) + 2.0 / 3.0 * (m.powi(3) - m),
        43.0 / 6.0 * s.powi(3) + 4.5 * s * s - 2.0 / 3.0 * s + observed,
        52.0 / 3.0 * s.powi(3) + 12.0 * s * s - 4.0 / 3.0 * s + observed,
    ]
}

/// (14)-(16): for models that know the destination, and for those that do not.
fn papers_costs() -> [[f64; 3]; 2] {
    let [original, one, two] = gammas(M, S);
    let filter = kalman_filter(M, S);
    let pairs = Q * N;
    [
        [pairs * original, pairs * (one + filter), pairs * (two + filter)],
        [pairs * original, pairs * one + filter, pairs * two + filter],
    ]
}

/// Conditioning `n` components on an observation of `o`, covariance in Joseph's form: `H P`, `H P H'`, its root, the gain,
/// `I - K H`, `(I - K H) P (I - K H)'`, `K R K'`.
fn conditioning(n: f64, o: f64) -> f64 {
    o * n * n + o * o * n + o.powi(3) / 6.0 + o * o * n + n * o * n + 2.0 * n.powi(3) + n * o * o + n * n * o
}

/// `A P A'` with `A` of `rows` by `n`.
fn propagation(rows: f64, n: f64) -> f64 {
    rows * n * n + rows * rows * n
}

fn root(n: f64) -> f64 {
    n.powi(3) / 6.0
}

/// Multiplications of our code for one step, (for each node and kind of destination, for each node and destination); each
/// method's own order in `METHODS`. The engines keep covariances once for all destinations whose extent is the same.
fn ours(method: usize) -> (f64, f64) {
    let density = M * M;
    let bridge = conditioning(S, L) + S * L * S + S.powi(3);
    let onward = L * S + S * L;
    match method {
        0 => (
            bridge + propagation(S + L, S + L) + conditioning(S + L, M),
            (S + L) * (S + L) + S * S + S * L + 2.0 * M * (S + L) + density,
        ),
        1 => (conditioning(S, L) + propagation(M, S) + root(M), onward + M * S + density),
        2 => (
            2.0 * conditioning(S, L) + L * S * S + S * L * S + propagation(S, S) + propagation(M, S) + root(M),
            2.0 * onward + S * S + M * S + density,
        ),
        // the root of q(x_1, z), two densities of z under it, and the integral's precision
        4 => {
            let n = S + L;
            let solved = L * L * n + n * n * L;
            (
                propagation(n, 2.0 * S) + 2.0 * root(n) + L * S * n + 2.0 * root(L) + 2.0 * solved,
                2.0 * (L * S + L * L + n * L) + n * n + n + 2.0 * L,
            )
        }
        _ => (propagation(L, S) + root(L), L * S + L * L),
    }
}

/// Our filter carries the first state along, for the smoothed start.
fn our_filter() -> f64 {
    2.0 * (2.0 * S).powi(3) + conditioning(2.0 * S, M) + S * S + 2.0 * M * 2.0 * S
}

/// For one step: where all destinations have the same extent, and where each has its own.
fn our_costs(method: usize) -> [f64; 2] {
    if METHODS[method].0 == "pseudoObservation" {
        // two densities of each axis at every node, whoever goes there; at every destination and node a quadratic and a
        // power of two, with a root and a reciprocal where its extent is its own; a filter for each axis
        let (node, alike, own, filter) = (120.0, 17.0, 35.0, 100.0);
        return [alike, own].map(|each| Q * (node + N * each) + filter);
    }
    let (shared, each) = ours(method);
    [1.0, N].map(|kinds| Q * (kinds * shared + N * each) + our_filter())
}

fn flops() -> Exhibit {
    let [with, without] = papers_costs();
    let mut table = Table::new(&[
        "flops for a step",
        "paper, model knows D",
        "paper, it does not",
        "ours, one extent",
        "ours, each its own",
    ]);
    for (method, (name, _)) in METHODS.iter().enumerate() {
        let rounded = |x: f64| format!("{x:.0}");
        let [alike, own] = our_costs(method).map(rounded);
        let [knows, does_not] = match method {
            0..=2 => [rounded(with[method]), rounded(without[method])],
            _ => [String::new(), String::new()],
        };
        table.row([(*name).to_owned(), knows, does_not, alike, own]);
    }
    // the coefficients of s^3: Gamma, and 3/2 of the Kalman filter
    let cubes = [20.5, 43.0 / 6.0, 52.0 / 3.0];
    let mut exhibit = Exhibit {
        title: "(14)-(16) and Table I: flops of a step for {m, s, q, N} = {2, 4, 15, 6}".into(),
        paper: "Algorithm 1 reduces the computations by approximately 57.5%, and by 65% for motion models that do not depend on the \
                destination. Table I: O(8.7 qNs^3), O(18.8 qNs^3), O(20.5 qNs^3) with D_i; O(7.2 qNs^3 + c), O(17.3 qNs^3 + c), O(20.5 qNs^3) without, c = 1.5 s^3."
            .into(),
        caption: "A flop is a multiplication and the addition after it, as in the paper. Ours are counted from the matrix products of our code, \
                  with covariances kept once for destinations of the same extent, in Joseph's form, and a filter that also smooths the start. \
                  pseudoObservation has a form of its own: axis by axis, and one quadratic with its power of two at each destination and node. \
                  The methods in closed form have no counterpart in the paper's formulas."
            .into(),
        tables: vec![table],
        ..Exhibit::default()
    };
    let names = ["original", "Algorithm 1", "Algorithm 2"];
    for (i, papers) in [(1, "8.7"), (2, "18.8"), (0, "20.5")] {
        let filter = if i == 0 { 0.0 } else { 1.5 };
        let ours = cubes[i] + filter;
        let stated: f64 = papers.parse().expect("a number");
        exhibit.compare(
            &format!("Table I with D_i, {}", names[i]),
            papers,
            format!("{ours:.2}"),
            format!("{:+.2}", ours - stated),
        );
    }
    for (i, papers) in [(1, "7.2"), (2, "17.3"), (0, "20.5")] {
        let stated: f64 = papers.parse().expect("a number");
        exhibit.compare(
            &format!("Table I without D_i, {}", names[i]),
            papers,
            format!("{:.2}", cubes[i]),
            format!("{:+.2}", cubes[i] - stated),
        );
    }
    let saving = |costs: [f64; 3], i: usize| 100.0 * (1.0 - costs[i] / costs[0]);
    let leading = |filter: f64| 100.0 * (1.0 - (cubes[1] + filter) / cubes[0]);
    for (quantity, papers, ours) in [
        ("Algorithm 1 saves, with D_i, from the s^3 terms", 57.5, leading(1.5)),
        ("Algorithm 1 saves, without D_i, from the s^3 terms", 65.0, leading(0.0)),
        ("Algorithm 1 saves, with D_i, at m = 2, s = 4", 57.5, saving(with, 1)),
        ("Algorithm 1 saves, without D_i, at m = 2, s = 4", 65.0, saving(without, 1)),
    ] {
        exhibit.compare(
            quantity,
            &format!("{papers}%"),
            format!("{ours:.1}%"),
            format!("{:+.1} points", ours - papers),
        );
    }
    exhibit
}

/// The paper's scenario, with one extent for all harbours or with one for each.
fn variants(method: &str) -> [Scenario; 2] {
    let alike = predictor_of(method, Start::Unknown);
    let mut json = serde_json::to_value(&alike).expect("a scenario is plain data");
    for (i, destination) in json["destinations"].as_array_mut().expect("a list").iter_mut().enumerate() {
        destination["covariance"][0][0] = (5.0 + 0.01 * i as f64).into();
    }
    [alike, movement::scenario(json)]
}

fn run_times(rounds: usize, progress: &ProgressBar) -> Exhibit {
    let track = vessel(2, &mut Normals::new(7)).movement;
    let scenarios: Vec<[Scenario; 2]> = METHODS.iter().map(|(method, _)| variants(method)).collect();
    let mut times = vec![[const { Vec::new() }; 2]; METHODS.len()];
    for _ in 0..rounds {
        // interleaved: what disturbs the machine disturbs all of them
        for (scenarios, times) in scenarios.iter().zip(&mut times) {
            for (scenario, times) in scenarios.iter().zip(times) {
                let mut predictor = Predictor::new(scenario);
                let start = Instant::now();
                for (time, position) in &track.observations {
                    predictor.observe(*time, position).expect("times ascend");
                    black_box(predictor.probabilities());
                }
                times.push(start.elapsed().as_secs_f64() / track.observations.len() as f64);
            }
        }
        progress.inc(1);
    }
    let times: Vec<[f64; 2]> = times.into_iter().map(|pair| pair.map(median)).collect();
    let mut table = Table::new(&[
        "time for a step",
        "paper (ms)",
        "one extent (us)",
        "to bridging",
        "counted",
        "each its own (us)",
        "to bridging",
        "counted",
    ]);
    for (method, (name, _)) in METHODS.iter().enumerate() {
        let ratio = |variant: usize| times[method][variant] / times[0][variant];
        let counted = |variant: usize| our_costs(method)[variant] / our_costs(0)[variant];
        table.row([
            (*name).to_owned(),
            PAPERS_TIMES.get(method).map_or(String::new(), |time| format!("{time:.2}")),
            format!("{:.1}", 1e6 * times[method][0]),
            format!("{:.3}", ratio(0)),
            format!("{:.3}", counted(0)),
            format!("{:.1}", 1e6 * times[method][1]),
            format!("{:.3}", ratio(1)),
            format!("{:.3}", counted(1)),
        ]);
    }
    let mut exhibit = Exhibit {
        title: format!("Run times for {{m, s, q, N}} = {{2, 4, 15, 6}}: medians of {rounds} interleaved rounds over one track"),
        paper: "MATLAB on a Core i7-4790: 2.62 ms for Algorithm 1, 5.36 ms for Algorithm 2, 7.42 ms for the original, at each observation."
            .into(),
        caption: "Ratios are to bridging in the same run. Our engines keep covariances once for all destinations of one extent, as here in the paper; \
                  with an extent for each harbour they do the work that the paper counts. Matrices of 4 by 4 are so small that their bookkeeping \
                  costs as much as their products, hence the distance to the counted ratios; pseudoObservation handles eight numbers at a time."
            .into(),
        tables: vec![table],
        assumed: vec!["A step is one observation and the probabilities of all harbours, on whatever machine this runs.".into()],
        ..Exhibit::default()
    };
    for (method, name) in [(1, "Algorithm 1"), (2, "Algorithm 2")] {
        let papers = PAPERS_TIMES[method] / PAPERS_TIMES[0];
        for (variant, what) in [(1, "each harbour its own extent"), (0, "one extent for all")] {
            let ours = times[method][variant] / times[0][variant];
            exhibit.compare(
                &format!("{name} to original, {what}"),
                &format!("{papers:.3}"),
                format!("{ours:.3}"),
                format!("ratio {:.2}", ours / papers),
            );
        }
    }
    let ours = times[3][0];
    exhibit.compare(
        "Algorithm 1 in the paper to our pseudoObservation, the same numbers",
        "2.62 ms",
        format!("{:.1} us", 1e6 * ours),
        format!("{:.0} times (another machine)", 2.62e-3 / ours),
    );
    exhibit
}
