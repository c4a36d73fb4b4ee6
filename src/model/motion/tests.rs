use super::*;
use crate::value::Node;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn value(json: &str) -> Value {
    serde_json::from_str(json).unwrap()
}

fn models(node: &Node<'_>) -> Result<MotionModels> {
    Motion::read(node)?.models(node.place())
}

fn read(json: &str) -> Result<MotionModels> {
    models(&Node::root(&value(json), "motion"))
}

fn only(motion: &MotionModels) -> &dyn MotionModel {
    &*motion.candidates[0].model
}

/// One of each, in two dimensions, with everything that can be given.
const EACH: [&str; 7] = [
    r#"{"type": "brownian", "dimensions": 2, "noise": [1.5, 2.0]}"#,
    r#"{"type": "constantVelocity", "dimensions": 2, "noise": 2.0, "speedNoise": 0.5}"#,
    r#"{"type": "constantAcceleration", "dimensions": 2, "noise": [20.0, 10.0]}"#,
    r#"{"type": "integratedOrnsteinUhlenbeck", "dimensions": 2, "noise": 2.0, "damping": 1.5, "drift": [0.4, -0.2]}"#,
    r#"{"type": "meanReverting", "dimensions": 2, "noise": {"candidates": [1.0, [2.0, 3.0]], "weights": [1.0, 3.0]}, "rate": 0.8}"#,
    r#"{"type": "equilibriumRevertingVelocity", "dimensions": 2, "noise": {"candidates": [1.0, 2.0, 4.0]}, "stiffness": 4.0, "damping": 3.0}"#,
    r#"{"type": "custom", "dimensions": 1, "drift": [[0.0, 1.0], [-1.0, -1.0]], "diffusion": [[0.0, 0.0], [0.0, 4.0]], "offset": [0.0, 0.5], "destinationGain": [[0.0], [1.0]]}"#,
];

#[test]
fn what_is_read_is_written_again() {
    for json in EACH {
        assert_eq!(read(json).unwrap().to_value(), value(json));
    }
}

#[test]
fn no_time_is_the_identity_without_noise() {
    for json in EACH {
        let motion = read(json).unwrap();
        let (s, d) = (motion.states(), motion.dimensions());
        let step = only(&motion).transition(0.0);
        assert_eq!(step.transition, DMatrix::identity(s, s), "{json}");
        assert_eq!(step.noise, DMatrix::zeros(s, s), "{json}");
        assert_eq!(step.offset, DVector::zeros(s), "{json}");
        assert_eq!(step.destination_gain, motion.depends_on_destination().then(|| DMatrix::zeros(s, d)), "{json}");
    }
}

#[test]
fn positions_stand_before_velocities_and_axes_have_their_own_noise() {
    let motion = read(r#"{"type": "constantVelocity", "dimensions": 3, "noise": [1.0, 2.0, 3.0]}"#).unwrap();
    let step = only(&motion).transition(0.5);
    for axis in 0..3 {
        assert_eq!(step.transition[(axis, axis + 3)], 0.5);
        assert_eq!(step.noise[(axis + 3, axis + 3)], 0.5 * [1.0, 4.0, 9.0][axis]);
        assert_eq!(step.noise[(axis, (axis + 1) % 3)], 0.0);
    }
}

#[test]
fn candidates_are_weighted_and_share_everything_but_the_noise() {
    let motion = read(EACH[4]).unwrap();
    let weights: Vec<f64> = motion.candidates.iter().map(|c| c.weight).collect();
    assert_eq!(weights, [0.25, 0.75]);
    let [first, second] = [0, 1].map(|i| motion.candidates[i].model.transition(0.3));
    assert_eq!(first.transition, second.transition);
    assert!((second.noise[(1, 1)] / first.noise[(1, 1)] - 9.0).abs() < 1e-14);
}

#[test]
fn white_noise_is_integrated_once_twice_and_three_times() {
    // the variances of Brownian motion and of its first two integrals at h = 2: 2, 8/3, 32/20
    let of = |kind: &str| {
        let json = format!(r#"{{"type": "{kind}", "dimensions": 1, "noise": 1.0}}"#);
        only(&read(&json).unwrap()).transition(2.0).noise[(0, 0)]
    };
    assert_eq!(of("brownian"), 2.0);
    assert!((of("constantVelocity") - 8.0 / 3.0).abs() < 1e-15);
    assert!((of("constantAcceleration") - 1.6).abs() < 1e-15);
}

#[derive(Debug)]
struct Expected {
    step: f64,
    transition: Vec<Vec<f64>>,
    offset: Vec<Vec<f64>>,
    gain: Vec<Vec<f64>>,
    noise: Vec<Vec<f64>>,
    scales: [Vec<Vec<f64>>; 3],
}

fn table(node: &Node<'_>, key: &str) -> Vec<Vec<f64>> {
    let table = node.get(key).unwrap();
    table.items().unwrap().map(|row| row.vector(None).unwrap()).collect()
}

impl Expected {
    fn read(node: &Node<'_>) -> Self {
        let scale = node.get("scale").unwrap();
        Self {
            step: node.get("step").unwrap().number().unwrap(),
            transition: table(node, "transition"),
            offset: table(node, "offset"),
            gain: table(node, "gain"),
            noise: table(node, "noise"),
            scales: ["transition", "offset", "gain"].map(|key| table(&scale, key)),
        }
    }

    /// The largest error of any entry, in units of that entry's own scale.
    fn error(&self, found: &Transition) -> f64 {
        let relative = |found: f64, expected: f64, scale: f64| {
            if scale == 0.0 { found.abs() } else { (found - expected).abs() / scale }
        };
        let mut worst = 0.0f64;
        for i in 0..self.transition.len() {
            for j in 0..self.transition.len() {
                let error = relative(found.transition[(i, j)], self.transition[i][j], self.scales[0][i][j]);
                let deviation = (self.noise[i][i] * self.noise[j][j]).sqrt();
                worst = worst.max(error).max(relative(found.noise[(i, j)], self.noise[i][j], deviation));
            }
            worst = worst.max(relative(found.offset[i], self.offset[i][0], self.scales[1][i][0]));
            for (j, expected) in self.gain[i].iter().enumerate() {
                let gain = found.destination_gain.as_ref().map_or(0.0, |gain| gain[(i, j)]);
                worst = worst.max(relative(gain, *expected, self.scales[2][i][j]));
            }
        }
        worst
    }
}

/// From `tests/steps.py`: 150 digits, by eigenvalues; steps from 1e-6 to 1e3 time constants.
#[test]
fn every_entry_is_right_from_a_millionth_of_a_time_constant_to_a_thousand() {
    let cases = value(include_str!("tests/steps.json"));
    let root = Node::root(&cases, "steps");
    let mut compared = 0;
    for case in root.items().unwrap() {
        let motion = models(&case.get("motion").unwrap()).unwrap();
        for expected in case.get("steps").unwrap().items().unwrap().map(|step| Expected::read(&step)) {
            let error = expected.error(&only(&motion).transition(expected.step));
            assert!(error < 1e-10, "{} over {}: {error:e}", case.get("name").unwrap().value().quoted(), expected.step);
            compared += 1;
        }
    }
    assert_eq!(compared, 13 * 8);
}

/// A model and its longest time constant; the numbers that it is made of.
fn any_axis_model() -> impl Strategy<Value = (String, f64)> {
    let positive = || (-3.0..3.0f64).prop_map(f64::exp);
    (0..6usize, 1..4usize, positive(), positive(), positive(), -2.0..2.0f64).prop_map(
        |(kind, d, noise, a, b, drift)| {
            let head = format!(r#""dimensions": {d}, "noise": {noise:?}"#);
            match kind {
                0 => (format!(r#"{{"type": "brownian", {head}}}"#), 1.0),
                1 => (format!(r#"{{"type": "constantVelocity", {head}}}"#), 1.0),
                2 => (format!(r#"{{"type": "constantAcceleration", {head}}}"#), 1.0),
                3 => (
                    format!(
                        r#"{{"type": "integratedOrnsteinUhlenbeck", {head}, "damping": {a:?}, "drift": {drift:?}}}"#
                    ),
                    1.0 / a,
                ),
                4 => (format!(r#"{{"type": "meanReverting", {head}, "rate": {a:?}}}"#), 1.0 / a),
                _ => (
                    format!(
                        r#"{{"type": "equilibriumRevertingVelocity", {head}, "stiffness": {a:?}, "damping": {b:?}}}"#
                    ),
                    1.0 / a.sqrt(),
                ),
            }
        },
    )
}

/// The same equation as `custom`, from the equation in the head of each file.
fn as_custom(json: &str) -> MotionModels {
    let value = value(json);
    let node = Node::root(&value, "motion");
    let number = |key: &str| node.get(key).map_or(0.0, |node| node.number().unwrap());
    let d = number("dimensions") as usize;
    // one axis: rows of A, b, B, of which the last is driven
    let (drift, offset, gain): (Vec<Vec<f64>>, f64, f64) = match node.get("type").unwrap().text().unwrap() {
        "brownian" => (vec![vec![0.0]], 0.0, 0.0),
        "constantVelocity" => (vec![vec![0.0, 1.0], vec![0.0, 0.0]], 0.0, 0.0),
        "constantAcceleration" => (vec![vec![0.0, 1.0, 0.0], vec![0.0, 0.0, 1.0], vec![0.0; 3]], 0.0, 0.0),
        "integratedOrnsteinUhlenbeck" => {
            let damping = number("damping");
            (vec![vec![0.0, 1.0], vec![0.0, -damping]], damping * number("drift"), 0.0)
        }
        "meanReverting" => (vec![vec![-number("rate")]], 0.0, number("rate")),
        _ => {
            let (stiffness, damping) = (number("stiffness"), number("damping"));
            (vec![vec![0.0, 1.0], vec![-stiffness, -damping]], 0.0, stiffness)
        }
    };
    let parts = drift.len();
    let s = parts * d;
    let entry = |value: f64| Value::Number(value);
    let grid = |columns: usize, at: &dyn Fn(usize, usize) -> f64| {
        Value::List((0..s).map(|i| Value::List((0..columns).map(|j| entry(at(i, j))).collect())).collect())
    };
    let driven = |i: usize| i / d == parts - 1;
    let density = number("noise").powi(2);
    let custom = Value::map([
        ("type", Value::text("custom")),
        ("dimensions", entry(d as f64)),
        ("drift", grid(s, &|i, j| if i % d == j % d { drift[i / d][j / d] } else { 0.0 })),
        ("diffusion", grid(s, &|i, j| if i == j && driven(i) { density } else { 0.0 })),
        ("offset", Value::List((0..s).map(|i| entry(if driven(i) { offset } else { 0.0 })).collect())),
        ("destinationGain", grid(d, &|i, j| if driven(i) && i % d == j { gain } else { 0.0 })),
    ]);
    models(&Node::root(&custom, "custom")).unwrap()
}

/// The largest difference of two transitions, in units of the entry in `scale`, and of deviations for the noise.
fn difference(a: &Transition, b: &Transition, scale: &Transition) -> f64 {
    let relative = |x: f64, y: f64, scale: f64| if x == y { 0.0 } else { (x - y).abs() / scale };
    let mut worst = 0.0f64;
    let s = a.offset.len();
    for i in 0..s {
        for j in 0..s {
            let deviation = (a.noise[(i, i)] * a.noise[(j, j)]).sqrt();
            worst = worst
                .max(relative(a.transition[(i, j)], b.transition[(i, j)], scale.transition[(i, j)].abs()))
                .max(relative(a.noise[(i, j)], b.noise[(i, j)], deviation));
        }
        worst = worst.max(relative(a.offset[i], b.offset[i], scale.offset[i].abs()));
    }
    match (&a.destination_gain, &b.destination_gain, &scale.destination_gain) {
        (Some(a), Some(b), Some(scale)) => {
            a.iter().zip(b).zip(scale).fold(worst, |worst, ((x, y), scale)| worst.max(relative(*x, *y, scale.abs())))
        }
        (None, None, None) => worst,
        _ => f64::INFINITY,
    }
}

/// The largest size that each entry has on the way, since what has decayed keeps the rounding of what it was.
fn largest(model: &dyn MotionModel, step: f64) -> Transition {
    let sizes = (0..30).map(|halvings| model.transition(step * 0.5f64.powi(halvings))).map(|part| Transition {
        transition: part.transition.abs(),
        offset: part.offset.abs(),
        destination_gain: part.destination_gain.map(|gain| gain.abs()),
        noise: part.noise,
    });
    let join = |a: Transition, b: Transition| Transition {
        transition: a.transition.sup(&b.transition),
        offset: a.offset.sup(&b.offset),
        destination_gain: a.destination_gain.zip(b.destination_gain).map(|(a, b)| a.sup(&b)),
        noise: a.noise,
    };
    sizes.reduce(join).unwrap()
}

/// The first step and then the second as one.
fn compose(first: &Transition, second: &Transition) -> Transition {
    let f = &second.transition;
    let gains = first.destination_gain.as_ref().zip(second.destination_gain.as_ref());
    Transition {
        transition: f * &first.transition,
        offset: f * &first.offset + &second.offset,
        destination_gain: gains.map(|(a, b)| f * a + b),
        noise: f * &first.noise * f.transpose() + &second.noise,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(2026), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn closed_forms_agree_with_van_loan((json, tau) in any_axis_model(), power in -6.0..3.0f64) {
        let step = tau * 10f64.powf(power);
        let (closed, general) = (read(&json).unwrap(), as_custom(&json));
        let (a, b) = (only(&closed).transition(step), only(&general).transition(step));
        let scale = largest(only(&closed), step);
        let error = difference(&a, &b, &scale);
        prop_assert!(error < 1e-10, "{json} over {step:e}: {error:e}\n{a:?}\n{b:?}");
    }

    #[test]
    fn two_steps_are_one_step_of_both((json, tau) in any_axis_model(), powers in (-4.0..2.0f64, -4.0..2.0f64)) {
        let (first, second) = (tau * 10f64.powf(powers.0), tau * 10f64.powf(powers.1));
        for motion in [read(&json).unwrap(), as_custom(&json)] {
            let model = only(&motion);
            let composed = compose(&model.transition(first), &model.transition(second));
            let scale = largest(model, first + second);
            let error = difference(&model.transition(first + second), &composed, &scale);
            prop_assert!(error < 1e-12, "{json} over {first:e} + {second:e}: {error:e}");
        }
    }
}

/// Code and complete text of the errors of motions.
#[test]
fn bad_motions_are_refused_by_name() {
    let custom = |rest: &str| format!(r#"{{"type": "custom", "dimensions": 2, {rest}}}"#);
    let cases = [
        (r#"7"#.to_owned(), "wrong-type", "motion: must be an object, got 7"),
        (r#"{"dimensions": 2}"#.to_owned(), "missing-key", "motion.type: missing key \"type\""),
        (
            r#"{"type": "warp"}"#.to_owned(),
            "out-of-range",
            "motion.type: must be one of \"brownian\", \"constantVelocity\", \"constantAcceleration\", \"integratedOrnsteinUhlenbeck\", \"meanReverting\", \"equilibriumRevertingVelocity\", \"custom\", got \"warp\"",
        ),
        (
            r#"{"type": "brownian", "dimensions": 4, "noise": 1}"#.to_owned(),
            "out-of-range",
            "motion.dimensions: must be an integer from 1 to 3, got 4",
        ),
        (
            r#"{"type": "brownian", "dimensions": 2, "noise": 1, "rate": 2}"#.to_owned(),
            "unknown-key",
            "motion.rate: unknown key \"rate\", expected one of \"type\", \"dimensions\", \"noise\"",
        ),
        (
            r#"{"type": "brownian", "dimensions": 2, "noise": [1, 2, 3]}"#.to_owned(),
            "wrong-length",
            "motion.noise: must have 2 numbers, has 3, got [1, 2, 3]",
        ),
        (
            r#"{"type": "brownian", "dimensions": 2, "noise": [1, 0]}"#.to_owned(),
            "out-of-range",
            "motion.noise[1]: must be greater than 0, got 0",
        ),
        (
            format!(r#"{{"type": "brownian", "dimensions": 1, "noise": {{"candidates": {:?}}}}}"#, vec![1.0; 65]),
            "too-large",
            "motion.noise.candidates: must have at most 64 candidates, has 65, got [1, 1, 1, 1, ...]",
        ),
        (
            r#"{"type": "brownian", "dimensions": 1, "noise": {"candidates": []}}"#.to_owned(),
            "wrong-length",
            "motion.noise.candidates: must have at least one candidate, got []",
        ),
        (
            r#"{"type": "brownian", "dimensions": 1, "noise": {"candidates": [1, 2], "weights": [1]}}"#.to_owned(),
            "wrong-length",
            "motion.noise.weights: must have 2 numbers, has 1, got [1]",
        ),
        (
            r#"{"type": "brownian", "dimensions": 1, "noise": {"candidates": [1, 2], "weights": [1, -1]}}"#.to_owned(),
            "out-of-range",
            "motion.noise.weights[1]: must be greater than 0, got -1",
        ),
        (
            r#"{"type": "meanReverting", "dimensions": 1, "noise": 1, "rate": 0}"#.to_owned(),
            "out-of-range",
            "motion.rate: must be greater than 0, got 0",
        ),
        (
            r#"{"type": "equilibriumRevertingVelocity", "dimensions": 1, "noise": 1, "damping": 1}"#.to_owned(),
            "missing-key",
            "motion.stiffness: missing key \"stiffness\"",
        ),
        (
            custom(r#""drift": [[0]], "diffusion": [[1]]"#),
            "wrong-length",
            "motion.drift: must have a row for each of the 2 positions at least, has 1, got [[0]]",
        ),
        (
            custom(r#""drift": [[0, 0], [0]], "diffusion": [[1, 0], [0, 1]]"#),
            "wrong-length",
            "motion.drift[1]: must have 2 numbers, has 1, got [0]",
        ),
        (
            custom(r#""drift": [[0, 0], [0, 0]], "diffusion": [[1, 2], [2, 1]]"#),
            "not-positive-definite",
            "motion.diffusion: must be symmetric and positive semi-definite, got [[1, 2], [2, 1]]",
        ),
        (
            custom(r#""drift": [[0, 0], [0, 0]], "diffusion": [[1, 0.5], [0, 1]]"#),
            "not-positive-definite",
            "motion.diffusion: must be symmetric and positive semi-definite, got [[1, 0.5], [0, 1]]",
        ),
        (
            custom(r#""drift": [[0, 0], [0, 0]], "diffusion": [[0, 1e-20], [1e-20, 1]]"#),
            "not-positive-definite",
            "motion.diffusion: must be symmetric and positive semi-definite, got [[0, 1e-20], [1e-20, 1]]",
        ),
        (
            custom(r#""drift": [[0, 0], [0, 0]], "diffusion": [[1, 0], [0, 1]], "destinationGain": [[1], [1]]"#),
            "wrong-length",
            "motion.destinationGain[0]: must have 2 numbers, has 1, got [1]",
        ),
    ];
    for (json, code, text) in cases {
        let error = read(&json).expect_err(&json);
        assert_eq!((error.code().as_str(), error.to_string().as_str()), (code, text), "{json}");
    }
}

#[test]
fn a_diffusion_may_be_singular_whatever_its_units() {
    // rank one, with deviations of 1e-4 and 1e4
    let json = r#"{"type": "custom", "dimensions": 1, "drift": [[0, 1], [0, 0]], "diffusion": [[1e-8, 1], [1, 1e8]]}"#;
    assert!(read(json).is_ok());
}
