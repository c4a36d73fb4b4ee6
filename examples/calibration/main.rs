//! Of all moments when a destination has the probability 0.3, is it the one in three of ten? On tracks that are drawn from
//! the model itself it has to be.
//!
//! `cargo run --release --example calibration` prints a reliability table for each method.

#[allow(clippy::expect_used, reason = "what is drawn from a right scenario is right")]
mod simulation;

use simulation::{Family, reliability};

const TRACKS: usize = 5000;

fn main() {
    for (method, family) in [
        ("pseudoObservation", Family::PseudoObservation),
        ("singleFilter", Family::Independent),
        ("singleFilterApproximate", Family::Independent),
        ("pseudoObservation", Family::Independent),
    ] {
        println!("\n{method}, {TRACKS} tracks, endpoint: {family:?}, after 3 and after 10 observations");
        println!("| said | how often | right | deviations | how often | right | deviations |");
        println!("|---|---|---|---|---|---|---|");
        let [early, late] = [3, 10].map(|count| reliability(method, family, TRACKS, count, 1));
        for (bin, (early, late)) in early.iter().zip(&late).enumerate() {
            let low = bin as f64 / 10.0;
            print!("| {low:.1} to {:.1} ", low + 0.1);
            for bin in [early, late] {
                let right = if bin.count > 0.0 { bin.right / bin.count } else { 0.0 };
                print!("| {} | {right:.3} | {:+.1} ", bin.count, bin.deviations());
            }
            println!("|");
        }
    }
}
