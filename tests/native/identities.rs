//! Identities between the methods, and invariances, over random models, steps and endpoints.

use crate::support::value;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use serde_json::{Value as Json, json};
use whither::{Predictor, Scenario};

/// A random problem, drawn from a seed: proptest shrinks the choices, the seed fills in the numbers.
#[derive(Clone, Debug)]
struct Problem {
    scenario: Json,
    observations: Vec<Observed>,
}

#[derive(Clone, Debug)]
struct Observed {
    time: f64,
    position: Vec<Option<f64>>,
    noise: Option<Json>,
}

#[derive(Clone, Copy, Debug)]
struct Choice {
    kind: usize,
    dimensions: usize,
    candidates: bool,
    matrix: bool,
    own_arrivals: bool,
    missing: bool,
    own_noise: bool,
    endpoints: usize,
    none: bool,
    steps: usize,
    seed: u64,
}

const KINDS: [&str; 7] = [
    "brownian",
    "constantVelocity",
    "constantAcceleration",
    "integratedOrnsteinUhlenbeck",
    "meanReverting",
    "equilibriumRevertingVelocity",
    "custom",
];

fn choices() -> impl Strategy<Value = Choice> {
    let flags = (any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>());
    (0..KINDS.len(), 1..=3usize, flags, 0..3usize, 2..9usize, any::<u64>()).prop_map(
        |(kind, dimensions, (candidates, matrix, own_arrivals, missing, own_noise, none), endpoints, steps, seed)| {
            Choice {
                kind,
                dimensions,
                candidates,
                matrix,
                own_arrivals,
                missing,
                own_noise,
                endpoints,
                none,
                steps,
                seed,
            }
        },
    )
}

/// Numbers from a seed.
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64) / (1u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn list(&mut self, n: usize, low: f64, high: f64) -> Vec<f64> {
        (0..n).map(|_| self.within(low, high)).collect()
    }

    fn matrix(&mut self, rows: usize, columns: usize, size: f64) -> Vec<Vec<f64>> {
        (0..rows).map(|_| self.list(columns, -size, size)).collect()
    }

    /// A root times its transpose, and something on the diagonal.
    fn covariance(&mut self, n: usize, size: f64) -> Vec<Vec<f64>> {
        let root = self.matrix(n, n, 1.0);
        let product = |i: usize, j: usize| (0..n).map(|k| root[i][k] * root[j][k]).sum::<f64>();
        (0..n).map(|i| (0..n).map(|j| size * (product(i, j) + if i == j { 0.3 } else { 0.0 })).collect()).collect()
    }
}

impl Choice {
    fn states(&self) -> usize {
        let d = self.dimensions;
        match KINDS[self.kind] {
            "brownian" | "meanReverting" => d,
            "constantAcceleration" => 3 * d,
            _ => 2 * d,
        }
    }

    fn motion(&self, draw: &mut Draw) -> Json {
        let (d, s) = (self.dimensions, self.states());
        let mut noise = json!(draw.list(d, 0.5, 3.0));
        if self.candidates {
            noise =
                json!({ "candidates": [draw.list(d, 0.5, 1.0), 2.0, draw.within(3.0, 5.0)], "weights": [1, 2, 0.5] });
        }
        let mut motion = json!({ "type": KINDS[self.kind], "dimensions": d, "noise": noise });
        match KINDS[self.kind] {
            "integratedOrnsteinUhlenbeck" => {
                motion["damping"] = json!(draw.within(0.2, 2.0));
                motion["drift"] = json!(draw.list(d, -1.0, 1.0));
            }
            "meanReverting" => motion["rate"] = json!(draw.within(0.1, 1.0)),
            "equilibriumRevertingVelocity" => {
                motion["stiffness"] = json!(draw.within(0.2, 2.0));
                motion["damping"] = json!(draw.within(0.2, 2.0));
            }
            "custom" => {
                // damped, so that no covariance grows beyond the digits of a double
                let mut drift = draw.matrix(s, s, 0.5);
                (0..s).for_each(|i| drift[i][i] -= 0.8);
                motion = json!({
                    "type": "custom",
                    "dimensions": d,
                    "drift": drift,
                    "offset": draw.list(s, -1.0, 1.0),
                    "diffusion": draw.covariance(s, 1.5),
                });
                if draw.unit() < 0.5 {
                    motion["destinationGain"] = json!(draw.matrix(s, d, 0.3));
                }
            }
            _ => {}
        }
        motion
    }

    fn destination(&self, i: usize, draw: &mut Draw) -> Json {
        let (d, s) = (self.dimensions, self.states());
        let length = [d, s, d + (s - d) / 2][(self.endpoints + i) % 3];
        let mut destination = if i.is_multiple_of(2) || length != d {
            json!({ "mean": draw.list(length, -6.0, 6.0), "covariance": draw.covariance(length, 1.0) })
        } else {
            json!({ "center": draw.list(d, -6.0, 6.0), "size": draw.list(d, 0.5, 2.0) })
        };
        destination["id"] = json!(format!("d{i}"));
        destination["prior"] = json!(draw.within(0.5, 2.0));
        if self.own_arrivals && i > 0 {
            destination["arrival"] = match i % 3 {
                0 => json!({ "type": "logNormal", "median": draw.within(3.0, 6.0), "spread": 0.4 }),
                1 => json!({ "type": "discrete", "times": [1.5, 4.0, 9.0], "weights": [1, 2, 1] }),
                _ => json!({ "type": "fitts", "intercept": 2, "slope": 0.7, "spread": 0.3 }),
            };
        }
        destination
    }

    fn problem(&self) -> Problem {
        let mut draw = Draw(self.seed);
        let s = self.states();
        let motion = self.motion(&mut draw);
        let axes = if self.matrix { (self.dimensions + 1).min(s) } else { self.dimensions };
        let mut observation = json!({ "noise": draw.covariance(axes, 0.5) });
        if self.matrix {
            observation["matrix"] = json!(draw.matrix(axes, s, 1.0));
        }
        let scenario = json!({
            "motion": motion,
            "observation": observation,
            "initial": { "mean": draw.list(s, -2.0, 2.0), "covariance": draw.covariance(s, 2.0) },
            "arrival": { "type": "uniform", "from": draw.within(0.5, 2.0), "to": draw.within(5.0, 8.0) },
            "quadrature": { "rule": if draw.unit() < 0.5 { "simpson" } else { "gaussLegendre" }, "points": 5 },
            "none": if self.none { 0.2 } else { 0.0 },
            "destinations": (0..4).map(|i| self.destination(i, &mut draw)).collect::<Vec<_>>(),
        });
        let mut time = draw.within(-50.0, 50.0);
        let observations = (0..self.steps).map(|k| {
            let mut position: Vec<_> = draw.list(axes, -4.0, 4.0).into_iter().map(Some).collect();
            if self.missing && k % 3 == 1 {
                position[0] = None;
            }
            if self.missing && k == 4 {
                position.fill(None);
            }
            let noise = (self.own_noise && k % 2 == 1).then(|| json!(draw.covariance(axes, 0.8)));
            time += if k % 4 == 3 { 0.0 } else { draw.within(0.01, 1.0) };
            Observed { time, position, noise }
        });
        Problem { scenario, observations: observations.collect() }
    }
}

impl Problem {
    fn predictor(&self, method: &str) -> Predictor {
        let mut scenario = self.scenario.clone();
        scenario["method"] = json!(method);
        if method == "singleFilterApproximate" {
            scenario["none"] = json!(0);
        }
        Predictor::new(&Scenario::from_value(&value(&scenario)).unwrap()).unwrap()
    }

    fn followed(&self, method: &str) -> Predictor {
        let mut predictor = self.predictor(method);
        for observed in &self.observations {
            observed.by(&mut predictor);
        }
        predictor
    }
}

impl Observed {
    fn by(&self, predictor: &mut Predictor) {
        predictor.observe_with(self.time, &self.position, self.noise.as_ref().map(value).as_ref()).unwrap();
    }
}

/// The largest difference relative to `1 + |b|`; minus infinity equals itself.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    crate::support::relative(a, b)
}

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config(300))]

    /// Within a family the log likelihoods are the same, after every observation.
    #[test]
    fn methods_of_a_family_are_the_same(choice in choices()) {
        let problem = choice.problem();
        for family in [&["pseudoObservation", "algorithm1", "algorithm2"][..], &["singleFilter", "bridging"]] {
            let mut predictors: Vec<Predictor> = family.iter().map(|method| problem.predictor(method)).collect();
            for observed in &problem.observations {
                predictors.iter_mut().for_each(|predictor| observed.by(predictor));
                let (first, others) = predictors.split_first_mut().unwrap();
                for (other, method) in others.iter_mut().zip(&family[1..]) {
                    let apart = difference(other.log_likelihoods(), first.log_likelihoods());
                    prop_assert!(apart < 1e-9, "{method}: {apart:e}");
                    let apart = difference(other.probabilities(), first.probabilities());
                    prop_assert!(apart < 1e-9, "{method}: {apart:e}");
                    prop_assert_eq!(other.expired(), first.expired());
                }
            }
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
            let apart = difference(&found, problem.followed(method).probabilities());
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
            let whole = problem.followed(method).probabilities().to_vec();
            let mut parts = split.followed(method).probabilities().to_vec();
            let half = parts.pop().unwrap();
            let expected = whole[1] * share;
            prop_assert!((half - expected).abs() <= 1e-12, "{method}");
            parts[1] += half;
            prop_assert!(difference(&parts, &whole) < 1e-12, "{method}");
        }
    }

    /// Everything moved by one vector: nothing changes, where the model has no place of its own.
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
            let apart = difference(
                moved.followed(method).log_likelihoods(),
                problem.followed(method).log_likelihoods(),
            );
            prop_assert!(apart < 1e-9, "{method}: {apart:e}");
        }
    }

    /// `log p(y_2:k | y_1, D_i)` is what the joint Gaussian of all observations and the endpoint says, stacked.
    #[test]
    fn the_evidence_is_the_batch_density(choice in choices()) {
        let problem = choice.problem();
        let batch = Batch::new(&problem);
        let mut pseudo = problem.followed("pseudoObservation");
        prop_assume!(!pseudo.expired());
        let expected: Vec<f64> = (0..4).map(|i| batch.log_likelihood(i)).collect();
        let apart = difference(pseudo.log_likelihoods(), &expected);
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
        assert!(difference(one, other) > 1e-3, "{one:?} {other:?}");
    }
}

/// The observations and the endpoint as one Gaussian vector, written down from the process: `x_k = Phi_k x_1 + offsets +
/// noises`, all covariances by summing over the noises that two states share. No filter, no recursion.
struct Batch<'a> {
    problem: &'a Problem,
    scenario: Scenario,
}

impl<'a> Batch<'a> {
    fn new(problem: &'a Problem) -> Self {
        Self { problem, scenario: Scenario::from_value(&value(&problem.scenario)).unwrap() }
    }

    fn log_likelihood(&self, i: usize) -> f64 {
        let whither::scenario::Engine::Papers { arrival, quadrature, .. } = &self.scenario.engine else { panic!() };
        let destination = self.scenario.destinations.get(i);
        let first = &self.problem.observations[0];
        let start = self.first_position(first);
        let d = self.scenario.motion.dimensions();
        let distance = destination.mean[..d].iter().zip(&start).map(|(a, y)| (a - y) * (a - y)).sum::<f64>().sqrt();
        let grid =
            destination.kind.arrival.as_ref().unwrap_or(arrival).grid(quadrature, distance, destination.kind.extent(d));
        let last = self.problem.observations[self.problem.observations.len() - 1].time - first.time;
        let mut sum = Vec::new();
        for candidate in &self.scenario.motion.candidates {
            for (time, log_weight) in grid.times.iter().zip(&grid.log_weights).filter(|(time, _)| **time > last) {
                let with = |count: usize| self.density(candidate.model.as_ref(), &destination, count, Some(*time));
                sum.push(candidate.weight.ln() + log_weight + with(self.problem.observations.len()) - with(1));
            }
        }
        whither::math::log_sum_exp::log_sum_exp(&sum)
    }

    /// The mean of the first position given the first observation: what Fitts's law takes the distance from.
    fn first_position(&self, first: &Observed) -> Vec<f64> {
        let (mean, covariance) = self.initial();
        let Some((y, g, v)) = self.measured(first) else { return mean.as_slice().to_vec() };
        let gain = &covariance * g.transpose() * (&g * &covariance * g.transpose() + v).try_inverse().unwrap();
        (&mean + gain * (y - &g * &mean)).as_slice().to_vec()
    }

    fn initial(&self) -> (DVector<f64>, DMatrix<f64>) {
        let initial = &self.problem.scenario["initial"];
        (DVector::from_vec(crate::support::numbers(&initial["mean"])), square(&initial["covariance"]))
    }

    fn measured(&self, observed: &Observed) -> Option<(DVector<f64>, DMatrix<f64>, DMatrix<f64>)> {
        let observation = &self.problem.scenario["observation"];
        let seen: Vec<usize> = (0..observed.position.len()).filter(|&r| observed.position[r].is_some()).collect();
        let noise = square(observed.noise.as_ref().unwrap_or(&observation["noise"]));
        let matrix = |r: usize, c: usize| match observation.get("matrix") {
            Some(matrix) => matrix[r][c].as_f64().unwrap(),
            None => f64::from(u8::from(r == c)),
        };
        let states = self.scenario.motion.states();
        (!seen.is_empty()).then(|| {
            (
                DVector::from_iterator(seen.len(), seen.iter().map(|&r| observed.position[r].unwrap())),
                DMatrix::from_fn(seen.len(), states, |r, c| matrix(seen[r], c)),
                DMatrix::from_fn(seen.len(), seen.len(), |r, c| noise[(seen[r], seen[c])]),
            )
        })
    }

    /// `log p(y_1:count, a)`, the pseudo-observation `a` being made of the state at `end`.
    fn density(
        &self,
        model: &dyn whither::model::motion::MotionModel,
        destination: &whither::Destination,
        count: usize,
        end: Option<f64>,
    ) -> f64 {
        let s = model.states();
        let observations = &self.problem.observations[..count];
        let mut times: Vec<f64> = observations.iter().map(|o| o.time - observations[0].time).collect();
        times.extend(end);
        let d = model.dimensions();
        let center = DVector::from_column_slice(&destination.mean[..d]);
        let (first_mean, first_covariance) = self.initial();
        // means and covariances of all states
        let (mut means, mut covariances) = (vec![first_mean], vec![first_covariance]);
        let steps: Vec<_> = times.windows(2).map(|pair| model.transition(pair[1] - pair[0])).collect();
        for step in &steps {
            let offset = match &step.destination_gain {
                Some(gain) => &step.offset + gain * &center,
                None => step.offset.clone(),
            };
            means.push(&step.transition * means.last().unwrap() + offset);
            covariances
                .push(&step.transition * covariances.last().unwrap() * step.transition.transpose() + &step.noise);
        }
        let cross = |j: usize, k: usize| {
            // cov(x_j, x_k), j <= k
            let onward = steps[j..k].iter().fold(DMatrix::identity(s, s), |f, step| &step.transition * f);
            &covariances[j] * onward.transpose()
        };
        // what is seen of each
        let mut seen: Vec<(usize, DVector<f64>, DMatrix<f64>, DMatrix<f64>)> = observations
            .iter()
            .enumerate()
            .filter_map(|(k, observed)| self.measured(observed).map(|(y, g, v)| (k, y, g, v)))
            .collect();
        let l = destination.mean.len();
        let endpoint = DMatrix::from_fn(l, s, |r, c| f64::from(u8::from(r == c)));
        let a = DVector::from_column_slice(&destination.mean);
        seen.push((times.len() - 1, a, endpoint, destination.kind.covariance.clone()));
        let rows: usize = seen.iter().map(|(_, y, ..)| y.len()).sum();
        let mut error = DVector::zeros(rows);
        let mut covariance = DMatrix::zeros(rows, rows);
        let mut at = 0;
        for (n, (j, y, g, v)) in seen.iter().enumerate() {
            error.rows_mut(at, y.len()).copy_from(&(y - g * &means[*j]));
            let mut beside = at;
            for (k, z, h, _) in &seen[n..] {
                let mut block = g * cross(*j, *k) * h.transpose();
                if beside == at {
                    block += v;
                }
                covariance.view_mut((at, beside), (y.len(), z.len())).copy_from(&block);
                covariance.view_mut((beside, at), (z.len(), y.len())).copy_from(&block.transpose());
                beside += z.len();
            }
            at += y.len();
        }
        let root = nalgebra::Cholesky::new(covariance).unwrap();
        let log_determinant = 2.0 * root.l().diagonal().map(f64::ln).sum();
        -0.5 * (error.dot(&root.solve(&error)) + log_determinant + rows as f64 * (2.0 * std::f64::consts::PI).ln())
    }
}

fn square(json: &Json) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = json.as_array().unwrap().iter().map(crate::support::numbers).collect();
    DMatrix::from_fn(rows.len(), rows.len(), |r, c| rows[r][c])
}
