//! Random problems: any motion model, one to three dimensions, endpoints and arrival priors of all kinds, tracks with missing
//! axes, equal times and noise of their own.

use crate::support::{relative, value};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use serde_json::{Value as Json, json};
use whither::Predictor;

/// A random problem, drawn from a seed: proptest shrinks the choices, the seed fills in the numbers.
#[derive(Clone, Debug)]
pub struct Problem {
    pub scenario: Json,
    pub observations: Vec<Observed>,
}

#[derive(Clone, Debug)]
pub struct Observed {
    pub time: f64,
    pub position: Vec<Option<f64>>,
    pub noise: Option<Json>,
}

#[derive(Clone, Copy, Debug)]
pub struct Choice {
    pub kind: usize,
    pub dimensions: usize,
    pub candidates: bool,
    pub matrix: bool,
    pub own_arrivals: bool,
    pub missing: bool,
    pub own_noise: bool,
    pub endpoints: usize,
    pub none: bool,
    pub steps: usize,
    pub seed: u64,
}

pub const KINDS: [&str; 7] = [
    "brownian",
    "constantVelocity",
    "constantAcceleration",
    "integratedOrnsteinUhlenbeck",
    "meanReverting",
    "equilibriumRevertingVelocity",
    "custom",
];

/// So many random cases, the same in every run unless `PROPTEST_RNG_SEED` selects others.
pub fn random(cases: u32) -> Config {
    let default = Config::default();
    let rng_seed = match default.rng_seed {
        RngSeed::Random => RngSeed::Fixed(2026),
        seed @ RngSeed::Fixed(_) => seed,
    };
    Config { cases, rng_seed, failure_persistence: None, ..default }
}

pub fn choices() -> impl Strategy<Value = Choice> {
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
pub struct Draw(pub u64);

impl Draw {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64) / (1u64 << 53) as f64
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn list(&mut self, n: usize, low: f64, high: f64) -> Vec<f64> {
        (0..n).map(|_| self.within(low, high)).collect()
    }

    pub fn matrix(&mut self, rows: usize, columns: usize, size: f64) -> Vec<Vec<f64>> {
        (0..rows).map(|_| self.list(columns, -size, size)).collect()
    }

    /// A root times its transpose, and something on the diagonal.
    pub fn covariance(&mut self, n: usize, size: f64) -> Vec<Vec<f64>> {
        let root = self.matrix(n, n, 1.0);
        let product = |i: usize, j: usize| (0..n).map(|k| root[i][k] * root[j][k]).sum::<f64>();
        (0..n).map(|i| (0..n).map(|j| size * (product(i, j) + if i == j { 0.3 } else { 0.0 })).collect()).collect()
    }
}

impl Choice {
    pub fn states(&self) -> usize {
        let d = self.dimensions;
        match KINDS[self.kind] {
            "brownian" | "meanReverting" => d,
            "constantAcceleration" => 3 * d,
            _ => 2 * d,
        }
    }

    pub fn motion(&self, draw: &mut Draw) -> Json {
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

    pub fn destination(&self, i: usize, draw: &mut Draw) -> Json {
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

    pub fn problem(&self) -> Problem {
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
        // in binary digits that a shifted clock keeps
        let exact = |time: f64| (time * f64::from(1 << 20)).round() / f64::from(1 << 20);
        let mut time = exact(draw.within(-50.0, 50.0));
        let observations = (0..self.steps).map(|k| {
            let mut position: Vec<_> = draw.list(axes, -4.0, 4.0).into_iter().map(Some).collect();
            if self.missing && k % 3 == 1 {
                position[0] = None;
            }
            if self.missing && k == 4 {
                position.fill(None);
            }
            let noise = (self.own_noise && k % 2 == 1).then(|| json!(draw.covariance(axes, 0.8)));
            time += if k % 4 == 3 { 0.0 } else { exact(draw.within(0.01, 1.0)) };
            Observed { time, position, noise }
        });
        Problem { scenario, observations: observations.collect() }
    }
}

impl Problem {
    pub fn predictor(&self, method: &str) -> Predictor {
        let mut scenario = self.scenario.clone();
        scenario["method"] = json!(method);
        if method == "singleFilterApproximate" {
            scenario["none"] = json!(0);
        }
        Predictor::new(&whither::internals::scenario(&value(&scenario)).unwrap())
    }

    pub fn followed(&self, method: &str) -> Predictor {
        let mut predictor = self.predictor(method);
        for observed in &self.observations {
            observed.by(&mut predictor);
        }
        predictor
    }
}

/// How far the methods of a family are apart at most, over all observations, in log likelihoods and probabilities.
pub fn apart(problem: &Problem, family: &[&str]) -> f64 {
    let mut predictors: Vec<Predictor> = family.iter().map(|method| problem.predictor(method)).collect();
    let mut most = 0.0f64;
    for observed in &problem.observations {
        predictors.iter_mut().for_each(|predictor| observed.by(predictor));
        let (first, others) = predictors.split_first_mut().unwrap();
        for other in others {
            most = most.max(relative(other.log_likelihoods(), first.log_likelihoods()));
            most = most.max(relative(other.probabilities(), first.probabilities()));
            assert_eq!(other.expired(), first.expired());
        }
    }
    most
}

impl Observed {
    pub fn by(&self, predictor: &mut Predictor) {
        let noise =
            self.noise.as_ref().map(|noise| whither::internals::noise(&value(noise), self.position.len()).unwrap());
        predictor.observe_with(self.time, &self.position, noise.as_ref()).unwrap();
    }
}
