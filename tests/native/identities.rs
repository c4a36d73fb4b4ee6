//! Identities between the methods, and invariances, over random models, steps and endpoints.

use crate::batch::Batch;
use crate::problem::{Choice, Draw, KINDS, apart, choices, random};
use crate::support::relative;
use proptest::prelude::*;
use serde_json::{Value as Json, json};

proptest! {
    #![proptest_config(random(300))]

    /// Within a family the log likelihoods are the same, after every observation.
    #[test]
    fn methods_of_a_family_are_the_same(choice in choices()) {
        let problem = choice.problem();
        for family in [&["pseudoObservation", "algorithm1", "algorithm2"][..], &["singleFilter", "bridging"]] {
            let apart = apart(&problem, family);
            prop_assert!(apart < 1e-9, "{family:?}: {apart:e}");
        }
    }

    /// The clock's zero and the order of the destinations mean nothing.
    #[test]
    fn time_may_be_shifted_and_destinations_permuted(choice in choices(), shift in -1000..1000i32) {
        let problem = choice.problem();
        let mut moved = problem.clone();
        moved.scenario["destinations"].as_array_mut().unwrap().rotate_left(1);
        for observed in &mut moved.observations {
            observed.time += f64::from(shift);
        }
        for method in ["pseudoObservation", "algorithm2", "bridging", "singleFilterApproximate"] {
            let mut found = moved.followed(method).probabilities().to_vec();
            found.rotate_right(1);
            let apart = relative(&found, problem.followed(method).probabilities());
            prop_assert!(apart < 1e-9, "{method}: {apart:e}");
        }
    }

    /// A destination may be given in two halves; two at the same place share equally.
    #[test]
    fn a_destination_may_be_split(choice in choices(), share in 0.05..0.95f64) {
        let problem = choice.problem();
        let mut split = problem.clone();
        let destinations = split.scenario["destinations"].as_array_mut().unwrap();
        let mut half = destinations[1].clone();
        let prior = half["prior"].as_f64().unwrap();
        half["id"] = json!("half");
        half["prior"] = json!(prior * share);
        destinations[1]["prior"] = json!(prior * (1.0 - share));
        destinations.push(half);
        for method in ["pseudoObservation", "algorithm1", "bridging", "singleFilter"] {
            let unsplit = problem.followed(method).probabilities().to_vec();
            let mut parts = split.followed(method).probabilities().to_vec();
            let half = parts.pop().unwrap();
            let expected = unsplit[1] * share;
            prop_assert!((half - expected).abs() <= 1e-12, "{method}");
            parts[1] += half;
            prop_assert!(relative(&parts, &unsplit) < 1e-12, "{method}");
        }
    }

    /// Everything moved by one vector: nothing changes, where the model has no fixed point of its own.
    #[test]
    fn space_may_be_shifted(mut choice in choices(), seed in any::<u64>()) {
        choice.matrix = false;
        prop_assume!(KINDS[choice.kind] != "custom");
        let problem = choice.problem();
        let d = choice.dimensions;
        let by = Draw(seed).list(d, -300.0, 300.0);
        let mut moved = problem.clone();
        let shift = |list: &mut Json| {
            for (x, by) in list.as_array_mut().unwrap().iter_mut().zip(&by) {
                *x = json!(x.as_f64().unwrap() + by);
            }
        };
        shift(&mut moved.scenario["initial"]["mean"]);
        for destination in moved.scenario["destinations"].as_array_mut().unwrap() {
            let key = if destination.get("mean").is_some() { "mean" } else { "center" };
            shift(&mut destination[key]);
        }
        for observed in &mut moved.observations {
            for (y, by) in observed.position.iter_mut().zip(&by) {
                *y = y.map(|y| y + by);
            }
        }
        for method in ["pseudoObservation", "algorithm2", "bridging", "singleFilter"] {
            let apart = relative(
                moved.followed(method).log_likelihoods(),
                problem.followed(method).log_likelihoods(),
            );
            prop_assert!(apart < 1e-9, "{method}: {apart:e}");
        }
    }

    /// `log p(y_2:k | y_1, D_i)` is that of the stacked joint Gaussian of all observations and the endpoint.
    #[test]
    fn the_evidence_is_the_batch_density(choice in choices()) {
        let problem = choice.problem();
        let batch = Batch::new(&problem, "pseudoObservation");
        let mut pseudo = problem.followed("pseudoObservation");
        prop_assume!(!pseudo.expired());
        let expected: Vec<f64> = (0..4).map(|i| batch.log_likelihood(i)).collect();
        let apart = relative(pseudo.log_likelihoods(), &expected);
        prop_assert!(apart < 1e-8, "{apart:e}: {:?} {expected:?}", pseudo.log_likelihoods());
    }
}

/// The two families answer different questions.
#[test]
fn the_families_differ() {
    let choice = Choice {
        kind: 1,
        dimensions: 2,
        candidates: false,
        matrix: false,
        own_arrivals: false,
        missing: false,
        own_noise: false,
        endpoints: 0,
        none: false,
        steps: 6,
        seed: 11,
    };
    let problem = choice.problem();
    let mut found = ["pseudoObservation", "bridging", "singleFilterApproximate"].map(|method| problem.followed(method));
    let [pseudo, bridging, approximate] = found.each_mut().map(|predictor| predictor.probabilities().to_vec());
    for (one, other) in [(&pseudo, &bridging), (&pseudo, &approximate), (&bridging, &approximate)] {
        assert!(relative(one, other) > 1e-3, "{one:?} {other:?}");
    }
}
