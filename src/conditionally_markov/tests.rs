use super::*;
use crate::math::gaussian::{Factor, condition};
use crate::math::kalman;
use crate::value::Value;
use nalgebra::{DMatrix, DVector, dmatrix};

fn value(json: serde_json::Value) -> Value {
    serde_json::from_value(json).unwrap()
}

fn sequence(json: serde_json::Value) -> ConditionallyMarkovSequence {
    crate::internals::sequence(&value(json)).unwrap()
}

fn rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

/// Constant velocity on one axis over `h`.
fn constant_velocity(h: f64, q: f64) -> (DMatrix<f64>, DMatrix<f64>) {
    (dmatrix![1.0, h; 0.0, 1.0], dmatrix![h * h * h / 3.0, h * h / 2.0; h * h / 2.0, h] * q)
}

/// One axis, constant velocity with noise 0.5, 8 steps, correlated pins.
fn with_a_waypoint() -> ConditionallyMarkovSequence {
    let root = DMatrix::from_fn(6, 6, |i, j| if i == j { 0.9 } else { 0.1 * ((i * 5 + j * 3) % 7) as f64 - 0.3 });
    sequence(serde_json::json!({
        "motion": { "type": "constantVelocity", "dimensions": 1, "noise": 0.5 },
        "timeStep": [0.5, 1.0, 0.7, 0.4, 1.1, 0.2, 0.9, 0.6], "steps": 8, "pins": [0, 5, 8],
        "pinnedMean": [0, 1, 3, 0.5, 5, 0],
        "pinnedCovariance": rows(&(&root * root.transpose())),
        "observation": { "noise": 0.3 },
    }))
}

fn given(steps: usize) -> ConditionallyMarkovSequence {
    let matrix = |k: usize, a: f64, b: f64| {
        let wave = (k as f64 * 0.7).sin() * 0.1;
        vec![vec![a + wave, b], vec![-0.1 * b, a - wave]]
    };
    let each = |a: f64, b: f64| (1..steps).map(|k| matrix(k, a, b)).collect::<Vec<_>>();
    let parameters = serde_json::json!({
        "previous": each(0.8, 0.4), "destination": each(0.15, -0.05),
        "offset": (1..steps).map(|k| vec![0.1, 0.01 * k as f64]).collect::<Vec<_>>(),
        "covariance": (1..steps).map(|_| vec![vec![0.3, 0.1], vec![0.1, 0.2]]).collect::<Vec<_>>(),
        "boundary": {
            "originMean": [1, 0], "destinationMean": [4, -1], "gain": [[0.3, 0.1], [0, 0.2]],
            "originCovariance": [[0.5, 0.1], [0.1, 0.4]], "destinationCovariance": [[1, 0.2], [0.2, 0.6]],
        },
        "observation": { "noise": 0.4 },
    });
    crate::internals::given_sequence(&value(parameters)).unwrap()
}

/// The density of all states stacked, from the model as a linear map of independent deviations: no recursion is shared with
/// the filter.
fn stacked(sequence: &ConditionallyMarkovSequence) -> Gaussian {
    let (s, n) = (sequence.states(), sequence.steps());
    let pinned = &sequence.model.pinned;
    let size = (n + 1) * s;
    let noises = pinned.mean.len() + size;
    let root = Factor::new(pinned.covariance.clone()).unwrap().into_root();
    let (mut mean, mut map) = (DVector::zeros(size), DMatrix::zeros(size, noises));
    for (i, &pin) in sequence.pins().iter().enumerate() {
        mean.rows_mut(pin * s, s).copy_from(&pinned.mean.rows(i * s, s));
        map.view_mut((pin * s, 0), (s, root.ncols())).copy_from(&root.rows(i * s, s));
    }
    for pair in sequence.pins().windows(2) {
        for k in pair[0] + 1..pair[1] {
            let step = sequence.model(k).unwrap();
            let state = &step.previous * mean.rows((k - 1) * s, s)
                + &step.destination * mean.rows(pair[1] * s, s)
                + &step.offset;
            mean.rows_mut(k * s, s).copy_from(&state);
            let mut from = &step.previous * map.rows((k - 1) * s, s) + &step.destination * map.rows(pair[1] * s, s);
            let noise = Factor::new(step.covariance).unwrap().into_root();
            from.view_mut((0, pinned.mean.len() + k * s), (s, s)).copy_from(&noise);
            map.rows_mut(k * s, s).copy_from(&from);
        }
    }
    Gaussian { mean, covariance: &map * map.transpose() }
}

#[test]
fn every_state_is_that_of_the_stacked_density() {
    for mut sequence in [with_a_waypoint(), given(8)] {
        let mut joint = stacked(&sequence);
        let s = sequence.states();
        for (step, z) in [(0, 0.4), (2, 1.9), (2, 2.2), (5, 2.5), (6, 3.3), (8, 4.4)] {
            sequence.measure(step, &[z]).unwrap();
            let row = DMatrix::from_fn(1, joint.mean.len(), |_, j| f64::from(u8::from(j == step * s)));
            let noise = sequence.model.observation.noise().clone();
            let conditioned = condition(&joint.covariance, &row, &noise).unwrap();
            joint.mean += &conditioned.gain * (z - joint.mean[step * s]);
            joint.covariance = conditioned.covariance();
            for k in 0..=8 {
                let state = sequence.state(k).unwrap();
                assert!((&state.mean - joint.mean.rows(k * s, s)).amax() < 1e-12, "mean of {k} at {step}");
                let block = joint.covariance.view((k * s, k * s), (s, s));
                assert!((&state.covariance - block).amax() < 1e-12, "covariance of {k} at {step}");
            }
            assert_eq!(sequence.destination(), sequence.state(8).unwrap());
        }
    }
}

#[test]
fn a_sequence_given_by_the_matrices_of_an_induced_one_is_the_same() {
    // 300 steps: stable, and skipping steps is going step by step
    let steps = 300;
    let motion = serde_json::json!({
        "motion": { "type": "constantVelocity", "dimensions": 1, "noise": 0.1 }, "timeStep": 15, "steps": steps,
        "pinnedMean": [2000, 70, 130_000, 70],
        "pinnedCovariance": [[1000, 0, 100, 0], [0, 10, 0, 1], [100, 0, 1000, 0], [0, 1, 0, 10]],
        "observation": { "noise": 10 },
    });
    let mut induced = sequence(motion);
    let each = |part: fn(StepModel) -> DMatrix<f64>| {
        (1..steps).map(|k| rows(&part(induced.model(k).unwrap()))).collect::<Vec<_>>()
    };
    let mut given = crate::internals::given_sequence(&value(serde_json::json!({
        "previous": each(|step| step.previous), "destination": each(|step| step.destination),
        "covariance": each(|step| step.covariance),
        // C_{0,N} C_N^-1 and C_0 - C_{0,N} C_N^-1 C_{0,N}'
        "boundary": {
            "originMean": [2000, 70], "destinationMean": [130_000, 70], "gain": [[0.1, 0], [0, 0.1]],
            "originCovariance": [[990, 0], [0, 9.9]], "destinationCovariance": [[1000, 0], [0, 10]],
        },
        "observation": { "noise": 10 },
    })))
    .unwrap();
    for (step, z) in [(1, 3040.0), (40, 40_000.0), (41, 41_000.0), (250, 110_000.0), (299, 129_000.0)] {
        induced.measure(step, &[z]).unwrap();
        given.measure(step, &[z]).unwrap();
        for k in [step, step + 1, 150, 299, 300] {
            if k >= step && k <= steps {
                let (one, two) = (induced.state(k).unwrap(), given.state(k).unwrap());
                assert!((&one.mean - two.mean).amax() < 1e-8 * one.mean.amax(), "{k} at {step}");
                assert!((&one.covariance - two.covariance).amax() < 1e-8 * one.covariance.amax(), "{k} at {step}");
            }
        }
    }
}

#[test]
fn it_stays_positive_definite_over_ten_thousand_steps() {
    let steps = 10_000;
    let mut sequence = sequence(serde_json::json!({
        "motion": { "type": "constantVelocity", "dimensions": 1, "noise": 0.1 }, "timeStep": 1, "steps": steps,
        "pinnedMean": [0, 10, 100_000, 10],
        "pinnedCovariance": [[1e-4, 0, 0, 0], [0, 1e-6, 0, 0], [0, 0, 1e-4, 0], [0, 0, 0, 1e-6]],
        "observation": { "noise": 5 },
    }));
    for k in 0..=steps {
        sequence.measure(k, &[10.0 * k as f64]).unwrap();
        assert!(Factor::new(sequence.state(k).unwrap().covariance).is_some(), "{k}");
    }
    // origin and destination are known better than they are measured
    assert!((sequence.state(steps).unwrap().mean[0] - 100_000.0).abs() < 1e-3);
    assert!(sequence.destination().covariance[(0, 0)] < 1e-4);
}

/// The endpoints of a Markov sequence have their own joint density: then nothing is conditioned on anything.
fn markov(steps: usize, pins: &[usize]) -> ConditionallyMarkovSequence {
    let (h, q) = (1.5, 0.04);
    let start = dmatrix![0.5, 0.1; 0.1, 0.2];
    let marginal = |k: usize| {
        let (f, q) = constant_velocity(h * k as f64, q);
        &f * &start * f.transpose() + q
    };
    let covariance = DMatrix::from_fn(2 * pins.len(), 2 * pins.len(), |i, j| {
        let (later, earlier) = (pins[(i / 2).max(j / 2)], pins[(i / 2).min(j / 2)]);
        let block = constant_velocity(h * (later - earlier) as f64, q).0 * marginal(earlier);
        if i / 2 >= j / 2 { block[(i % 2, j % 2)] } else { block[(j % 2, i % 2)] }
    });
    let mean: Vec<f64> = pins.iter().flat_map(|&k| [1.0 + 0.3 * h * k as f64, 0.3]).collect();
    sequence(serde_json::json!({
        "motion": { "type": "constantVelocity", "dimensions": 1, "noise": 0.2 }, "timeStep": h, "steps": steps, "pins": pins,
        "pinnedMean": mean, "pinnedCovariance": rows(&covariance), "observation": { "noise": 0.3 },
    }))
}

#[test]
fn with_the_endpoints_of_a_markov_sequence_it_filters_as_kalman_does() {
    for mut sequence in [markov(12, &[0, 12]), markov(12, &[0, 5, 12])] {
        let start = Gaussian {
            mean: sequence.model.pinned.mean.rows(0, 2).into_owned(),
            covariance: sequence.model.pinned.covariance.view((0, 0), (2, 2)).into_owned(),
        };
        let mut filter = kalman::Filter::new(&start, 1);
        let (f, q) = constant_velocity(1.5, 0.04);
        for (k, z) in [1.2, 2.1, 2.2, 3.0, 3.3, 3.2, 4.1, 4.4].into_iter().enumerate() {
            if k > 0 {
                let offsets = DMatrix::zeros(2, 1);
                filter.predict(&kalman::TimeUpdate { transition: &f, offsets: &offsets, noise: &q });
            }
            let measurement = sequence.model.observation.measurement(&[Some(z)], None).unwrap();
            filter.correct(&measurement);
            sequence.measure(k, &[z]).unwrap();
            let state = sequence.state(k).unwrap();
            assert!((state.mean - filter.mean(0)).amax() < 1e-10);
            assert!((state.covariance - filter.current_covariance()).amax() < 1e-10);
            let start = sequence.state(0).unwrap();
            assert!((start.mean - filter.smoothed_start(0).mean).amax() < 1e-10);
        }
    }
}

#[test]
fn what_is_reciprocal_and_what_is_markov() {
    // (sequence, reciprocal, Markov)
    let mut independent_ends = vec![];
    for steps in [2, 3, 20, 500] {
        independent_ends.push(sequence(serde_json::json!({
            "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 0.1 }, "timeStep": 15, "steps": steps,
            "pinnedMean": [2000, 5000, 70, 0, 130_000, 10_000, 70, 0],
            "pinnedCovariance": rows(&DMatrix::from_fn(8, 8, |i, j| match i % 4 {
                _ if i != j => 0.0,
                0 | 1 => 1000.0,
                _ => 10.0,
            })),
            "observation": { "noise": 10 },
        })));
    }
    for sequence in &independent_ends {
        assert!(sequence.is_reciprocal(DEFAULT_TOLERANCE).unwrap(), "{}", sequence.steps());
        assert!(!sequence.is_markov(DEFAULT_TOLERANCE).unwrap(), "{}", sequence.steps());
    }
    for (steps, pins) in [(12, vec![0, 12]), (200, vec![0, 200]), (12, vec![0, 5, 12]), (12, vec![0, 5, 6, 12])] {
        let sequence = markov(steps, &pins);
        assert!(sequence.is_reciprocal(DEFAULT_TOLERANCE).unwrap(), "{pins:?}");
        assert!(sequence.is_markov(DEFAULT_TOLERANCE).unwrap(), "{pins:?}");
    }
    // a waypoint whose correlation with origin and destination no movement explains
    assert!(!with_a_waypoint().is_reciprocal(DEFAULT_TOLERANCE).unwrap());
    // arbitrary matrices: conditionally Markov and no more
    assert!(!given(6).is_reciprocal(DEFAULT_TOLERANCE).unwrap());
    // neighbouring pins have nothing between them
    assert!(given(1).is_markov(0.0).unwrap());
    // both sides differ by at most twice the larger one
    assert!(given(6).is_markov(2.0).unwrap());
}

#[test]
fn a_sequence_that_depends_on_its_past_alone_is_markov() {
    // G_{k,N} = 0 and G_{0,N} = 0: x_0 .. x_{N-1} is Markov and independent of x_N
    let zeros = vec![vec![vec![0.0]]; 4];
    let sequence = crate::internals::given_sequence(&value(serde_json::json!({
        "previous": vec![vec![vec![0.5]]; 4], "destination": zeros, "covariance": vec![vec![vec![0.3]]; 4],
        "boundary": { "originCovariance": [[1]], "destinationCovariance": [[2]] }, "observation": { "noise": 1 },
    })))
    .unwrap();
    assert!(sequence.is_markov(DEFAULT_TOLERANCE).unwrap());
}

#[test]
fn samples_have_the_density_of_the_states() {
    for sequence in [with_a_waypoint(), given(8)] {
        let joint = stacked(&sequence);
        let (count, size) = (20_000, joint.mean.len());
        let drawn = sequence.sample(7, count).unwrap();
        let drawn = DMatrix::from_fn(size, count, |i, j| drawn[j][i]);
        let mean = drawn.column_mean();
        let centred = DMatrix::from_fn(size, count, |i, j| drawn[(i, j)] - mean[i]);
        let covariance = &centred * centred.transpose() / count as f64;
        for i in 0..size {
            let deviation = |j: usize| joint.covariance[(j, j)].sqrt();
            // five standard errors
            let error = 5.0 / (count as f64).sqrt();
            assert!((mean[i] - joint.mean[i]).abs() < error * deviation(i), "mean {i}");
            for j in 0..size {
                let difference = (covariance[(i, j)] - joint.covariance[(i, j)]).abs();
                assert!(difference < 1.5 * error * deviation(i) * deviation(j), "covariance {i} {j}");
            }
        }
    }
}

#[test]
fn a_seed_is_a_sequence() {
    let sequence = with_a_waypoint();
    assert_eq!(sequence.sample(3, 2).unwrap(), sequence.sample(3, 2).unwrap());
    assert_ne!(sequence.sample(3, 1).unwrap(), sequence.sample(4, 1).unwrap());
    assert_eq!(sequence.sample(3, 0).unwrap(), Vec::<Vec<f64>>::new());
}

#[test]
fn reset_forgets_the_measurements_and_nothing_else() {
    let mut sequence = with_a_waypoint();
    let before = sequence.state(3).unwrap();
    sequence.measure(2, &[4.0]).unwrap();
    assert_ne!(sequence.state(3).unwrap(), before);
    sequence.reset();
    assert_eq!(sequence.state(3).unwrap(), before);
    assert_eq!(sequence.step(), 0);
}
#[test]
fn a_movement_towards_its_destination_takes_the_mean_end_for_the_centre() {
    let offset = |drift: serde_json::Value| {
        sequence(serde_json::json!({
            "motion": drift, "timeStep": 0.5, "steps": 4, "pinnedMean": [0, 3],
            "pinnedCovariance": [[1, 0], [0, 1]], "observation": { "noise": 1 },
        }))
        .model(2)
        .unwrap()
    };
    let custom = |gain: f64, offset: f64| {
        serde_json::json!({
            "type": "custom", "dimensions": 1, "drift": [[-0.4]], "offset": [offset],
            "destinationGain": [[gain]], "diffusion": [[0.2]],
        })
    };
    // dx = -0.4 (x - c) dt with c = 3 is dx = (-0.4 x + 1.2) dt
    let (offset_given, gain_given) = (offset(custom(0.4, 0.0)), offset(custom(0.0, 1.2)));
    assert!((offset_given.offset - gain_given.offset).amax() < 1e-14);
    assert_eq!(offset_given.previous, gain_given.previous);
}
