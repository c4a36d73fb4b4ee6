//! Probabilities are frequencies, on tracks drawn from the model.

mod simulation;

use simulation::{Family, reliability};

const TRACKS: usize = 2000;

fn worst(method: &str, family: Family, count: usize) -> f64 {
    let bins = reliability(method, family, TRACKS, count, 5);
    let total: f64 = bins.iter().map(|bin| bin.count).sum();
    assert_eq!(total, 4.0 * TRACKS as f64);
    bins.iter().filter(|bin| bin.count > 50.0).map(|bin| bin.deviations().abs()).fold(0.0, f64::max)
}

#[test]
fn probabilities_are_frequencies_on_tracks_from_the_model() {
    for count in [3, 10] {
        for (method, family) in
            [("pseudoObservation", Family::PseudoObservation), ("singleFilter", Family::Independent)]
        {
            let worst = worst(method, family, count);
            assert!(worst < 4.0, "{method} after {count}: {worst} standard deviations");
        }
    }
}

/// The approximation of (15), on the same tracks: the test above can fail.
#[test]
fn the_approximation_is_not_calibrated() {
    assert!(worst("singleFilterApproximate", Family::Independent, 3) > 6.0);
}
