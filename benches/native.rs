//! The native part of `npm run bench`, which writes the cases for it: what is measured in JavaScript is measured here too.

use criterion::Criterion;
use serde_json::Value as Json;
use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use whither::{Predictor, Scenario};

/// A predictor that is fed with positions over and over.
struct Movement {
    predictor: Predictor,
    positions: Vec<Vec<f64>>,
    /// Seconds between observations.
    interval: f64,
    /// After so many observations a new movement begins.
    length: u64,
    observations: u64,
}

impl Movement {
    fn new(case: &Json, positions: &[Vec<f64>], interval: f64) -> Self {
        let scenario: Scenario = serde_json::from_value(case["scenario"].clone()).expect("the scenarios are good");
        let predictor = Predictor::new(&scenario);
        let dimensions = predictor.dimensions();
        let positions = positions.iter().map(|position| position[..dimensions].to_vec()).collect();
        let length = case["length"].as_u64().unwrap_or(u64::MAX);
        let mut movement = Self { predictor, positions, interval, length, observations: 0 };
        for _ in 0..case["before"].as_u64().unwrap_or(20) {
            movement.step();
        }
        movement
    }

    /// One `observe` and `probabilities`.
    fn step(&mut self) {
        if self.observations.is_multiple_of(self.length) {
            self.predictor.reset();
        }
        let position = &self.positions[self.observations as usize % self.positions.len()];
        let time = self.interval * self.observations as f64;
        self.predictor.observe(time, position).expect("the positions are good");
        black_box(self.predictor.probabilities());
        self.observations += 1;
    }
}

/// The sum of the exponentials, one after another.
fn plain(numbers: &[f64]) -> f64 {
    numbers.iter().map(|x| x.exp()).sum()
}

/// The same in `N` sums at a time, so that no call waits for the addition before it.
fn unrolled<const N: usize>(numbers: &[f64]) -> f64 {
    let (blocks, rest) = numbers.as_chunks::<N>();
    let mut sums = [0.0; N];
    for block in blocks {
        for (sum, x) in sums.iter_mut().zip(block) {
            *sum += x.exp();
        }
    }
    sums.iter().sum::<f64>() + plain(rest)
}

fn main() -> Result<(), Box<dyn Error>> {
    // cargo starts it in the package's folder
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/bench/native.json");
    let text = std::fs::read_to_string(&file)
        .map_err(|_| format!("{} is missing: npm run bench writes it", file.display()))?;
    let given: Json = serde_json::from_str(&text)?;
    drop(text);
    let positions: Vec<Vec<f64>> = serde_json::from_value(given["positions"].clone())?;
    let interval = given["interval"].as_f64().ok_or("interval is missing")?;
    let cases = given["cases"].as_array().ok_or("cases are missing")?;

    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("native");
    let exponents: Vec<f64> = serde_json::from_value(given["exponents"].clone())?;
    // more than once, as the machine's pace may change
    for round in ["first", "second", "third"] {
        for (name, way) in
            [("plain", plain as fn(&[f64]) -> f64), ("unrolled", unrolled::<4>), ("check", unrolled::<8>)]
        {
            group.bench_function(format!("exp {name} {round}"), |bencher| bencher.iter(|| way(black_box(&exponents))));
        }
        let third = cases.len().div_ceil(3);
        let from = match round {
            "first" => 0,
            "second" => third,
            _ => 2 * third,
        };
        for case in cases.iter().skip(from).take(third) {
            let name = case["name"].as_str().unwrap_or_default();
            // nothing is prepared for cases that the command line excludes
            let mut movement = None;
            group.bench_function(name, |bencher| {
                let movement = movement.get_or_insert_with(|| Movement::new(case, &positions, interval));
                bencher.iter(|| movement.step());
            });
        }
    }
    group.finish();
    criterion.final_summary();
    Ok(())
}
