//! Likelihoods and states written down from the process: an oracle without filter or recursion.

use crate::problem::{Observed, Problem};
use crate::support::{numbers, value};
use nalgebra::{Cholesky, DMatrix, DVector};
use serde_json::Value as Json;
use whither::internals::{MotionModel, Parts, parts};
use whither::{Gaussian, Scenario};

/// The states at all times, the observations and the endpoint as one Gaussian vector, written down from the process: `x_k =
/// Phi_k x_1 + offsets + noises`, all covariances by summing over the noises that two states share. No filter, no recursion.
pub struct Batch<'a> {
    problem: &'a Problem,
    scenario: Scenario,
    method: &'a str,
}

/// A linear observation of the stacked states: `y`, `G`, `V`.
type Linear = (DVector<f64>, DMatrix<f64>, DMatrix<f64>);

impl<'a> Batch<'a> {
    pub fn new(problem: &'a Problem, method: &'a str) -> Self {
        Self { problem, scenario: whither::internals::scenario(&value(&problem.scenario)).unwrap(), method }
    }

    fn parts(&self) -> Parts<'_> {
        parts(&self.scenario)
    }

    /// `log p(y_2:k | y_1, D_i)`, or `log p(y_1:k | D_i)` where the first observation's evidence counts; of the approximate
    /// method up to what does not depend on the destination.
    pub fn log_likelihood(&self, i: usize) -> f64 {
        let each: Vec<f64> = self.nodes(i).into_iter().map(|(_, _, log)| log).collect();
        whither::internals::log_sum_exp(&each)
    }

    /// The state at `time`, given that the object goes to one of the destinations.
    pub fn state(&self, time: f64) -> Gaussian {
        let mut parts = Vec::new();
        for i in 0..self.parts().destinations.len() {
            let prior = self.parts().destinations.priors()[i].ln();
            for (candidate, arrival, log) in self.nodes(i) {
                let at = (time - self.problem.observations[0].time).min(arrival);
                parts.push((prior + log, self.state_given(candidate, i, arrival, at)));
            }
        }
        let logs: Vec<f64> = parts.iter().map(|(log, _)| *log).collect();
        let total = whither::internals::log_sum_exp(&logs);
        let s = self.parts().motion.states();
        let (mut mean, mut square) = (DVector::zeros(s), DMatrix::zeros(s, s));
        for (log, part) in &parts {
            mean += &part.mean * (log - total).exp();
        }
        for (log, part) in &parts {
            let apart = &part.mean - &mean;
            square += (&part.covariance + &apart * apart.transpose()) * (log - total).exp();
        }
        Gaussian { mean, covariance: square }
    }

    /// Candidate, arrival time, and log of weight times likelihood.
    fn nodes(&self, i: usize) -> Vec<(usize, f64, f64)> {
        let (arrival, quadrature) = self.parts().arrival.unwrap();
        let destination = self.endpoint(i);
        let first = &self.problem.observations[0];
        let start = self.first_position(first);
        let d = self.parts().motion.dimensions();
        let distance = destination.mean.iter().take(d).zip(&start).map(|(a, y)| (a - y) * (a - y)).sum::<f64>().sqrt();
        let class = self.parts().destinations.class(i);
        let grid = whither::internals::grid(class.arrival().unwrap_or(arrival), quadrature, distance, class.extent(d));
        let last = self.problem.observations[self.problem.observations.len() - 1].time - first.time;
        let conditioned = usize::from(self.problem.scenario["initial"]["evidence"] != Json::Bool(true));
        let mut nodes = Vec::new();
        for (c, candidate) in self.parts().motion.candidates.iter().enumerate() {
            for (time, log_weight) in grid.times.iter().zip(&grid.log_weights).filter(|(time, _)| **time > last) {
                let stack = Stack::new(self, candidate.model.as_ref(), &destination, &[], *time);
                let with = |count: usize| stack.log_density(self, &destination, count);
                let log = match self.method {
                    // the denominator is dropped
                    "singleFilterApproximate" => with(self.problem.observations.len()),
                    _ => with(self.problem.observations.len()) - with(conditioned),
                };
                nodes.push((c, *time, candidate.weight.ln() + log_weight + log));
            }
        }
        nodes
    }

    /// `N(a_i, S_i)`.
    fn endpoint(&self, i: usize) -> Gaussian {
        let destinations = self.parts().destinations;
        Gaussian { mean: DVector::from_vec(destinations.mean(i)), covariance: destinations.class(i).covariance() }
    }

    fn state_given(&self, candidate: usize, i: usize, arrival: f64, at: f64) -> Gaussian {
        let destination = self.endpoint(i);
        let model = self.parts().motion.candidates[candidate].model.as_ref();
        let stack = Stack::new(self, model, &destination, &[at], arrival);
        let (y, g, v) = stack.observed(self, &destination, self.problem.observations.len());
        let cross = &stack.covariance * g.transpose();
        let precision = (&g * &cross + v).try_inverse().unwrap();
        let mean = &stack.mean + &cross * &precision * (y - &g * &stack.mean);
        let covariance = &stack.covariance - &cross * precision * cross.transpose();
        let (s, k) = (model.states(), self.problem.observations.len());
        Gaussian {
            mean: mean.rows(k * s, s).into_owned(),
            covariance: covariance.view((k * s, k * s), (s, s)).into_owned(),
        }
    }

    fn bridges(&self) -> bool {
        matches!(self.method, "bridging" | "singleFilter")
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
        (DVector::from_vec(numbers(&initial["mean"])), square(&initial["covariance"]))
    }

    fn measured(&self, observed: &Observed) -> Option<Linear> {
        let observation = &self.problem.scenario["observation"];
        let present: Vec<usize> = (0..observed.position.len()).filter(|&r| observed.position[r].is_some()).collect();
        let noise = square(observed.noise.as_ref().unwrap_or(&observation["noise"]));
        let matrix = |r: usize, c: usize| match observation.get("matrix") {
            Some(matrix) => matrix[r][c].as_f64().unwrap(),
            None => f64::from(u8::from(r == c)),
        };
        let states = self.parts().motion.states();
        (!present.is_empty()).then(|| {
            (
                DVector::from_iterator(present.len(), present.iter().map(|&r| observed.position[r].unwrap())),
                DMatrix::from_fn(present.len(), states, |r, c| matrix(present[r], c)),
                DMatrix::from_fn(present.len(), present.len(), |r, c| noise[(present[r], present[c])]),
            )
        })
    }
}

/// The states at the observations, at some times more, and at the arrival, stacked.
struct Stack {
    states: usize,
    blocks: usize,
    mean: DVector<f64>,
    covariance: DMatrix<f64>,
}

impl Stack {
    fn new(batch: &Batch<'_>, model: &dyn MotionModel, destination: &Gaussian, more: &[f64], arrival: f64) -> Self {
        let (s, d) = (model.states(), model.dimensions());
        let observations = &batch.problem.observations;
        let mut times: Vec<f64> = observations.iter().map(|o| o.time - observations[0].time).collect();
        times.extend(more);
        times.push(arrival);
        let center = destination.mean.rows(0, d).into_owned();
        let (first_mean, first_covariance) = batch.initial();
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
        let blocks = times.len();
        let mut covariance = DMatrix::zeros(blocks * s, blocks * s);
        for j in 0..blocks {
            for k in j..blocks {
                // cov(x_j, x_k), j <= k
                let onward = steps[j..k].iter().fold(DMatrix::identity(s, s), |f, step| &step.transition * f);
                let cross = &covariances[j] * onward.transpose();
                covariance.view_mut((j * s, k * s), (s, s)).copy_from(&cross);
                covariance.view_mut((k * s, j * s), (s, s)).copy_from(&cross.transpose());
            }
        }
        let mean = DVector::from_fn(blocks * s, |row, _| means[row / s][row % s]);
        let mut stack = Self { states: s, blocks, mean, covariance };
        if batch.bridges() {
            stack.bridge(destination);
        }
        stack
    }

    /// The endpoint made independent of the start: what lies between keeps its density given both.
    fn bridge(&mut self, destination: &Gaussian) {
        let (s, l, n) = (self.states, destination.mean.len(), self.mean.len());
        let endpoints =
            DMatrix::from_fn(s + l, n, |r, c| f64::from(u8::from(c == if r < s { r } else { n - s + r - s })));
        let between = &endpoints * &self.covariance * endpoints.transpose();
        let gain = &self.covariance * endpoints.transpose() * between.clone().try_inverse().unwrap();
        let mut wanted = DVector::zeros(s + l);
        wanted.rows_mut(0, s).copy_from(&self.mean.rows(0, s));
        wanted.rows_mut(s, l).copy_from(&destination.mean);
        let mut apart = DMatrix::zeros(s + l, s + l);
        apart.view_mut((0, 0), (s, s)).copy_from(&self.covariance.view((0, 0), (s, s)));
        apart.view_mut((s, s), (l, l)).copy_from(&destination.covariance);
        self.mean = &self.mean + &gain * (wanted - &endpoints * &self.mean);
        self.covariance = &self.covariance + &gain * (apart - between) * gain.transpose();
    }

    /// The first `count` observations, and the pseudo-observation of the endpoint where there is one.
    fn observed(&self, batch: &Batch<'_>, destination: &Gaussian, count: usize) -> Linear {
        let observations = batch.problem.observations[..count].iter().enumerate();
        let mut parts: Vec<(usize, Linear)> =
            observations.filter_map(|(k, observed)| batch.measured(observed).map(|linear| (k, linear))).collect();
        if !batch.bridges() {
            let (s, l) = (self.states, destination.mean.len());
            let endpoint = DMatrix::from_fn(l, s, |r, c| f64::from(u8::from(r == c)));
            let (mean, covariance) = (destination.mean.clone(), destination.covariance.clone());
            parts.push((self.blocks - 1, (mean, endpoint, covariance)));
        }
        let rows = parts.iter().map(|(_, (y, ..))| y.len()).sum();
        let mut y = DVector::zeros(rows);
        let (mut g, mut v) = (DMatrix::zeros(rows, self.mean.len()), DMatrix::zeros(rows, rows));
        let mut at = 0;
        for (block, (value, matrix, noise)) in parts {
            let m = value.len();
            y.rows_mut(at, m).copy_from(&value);
            g.view_mut((at, block * self.states), (m, self.states)).copy_from(&matrix);
            v.view_mut((at, at), (m, m)).copy_from(&noise);
            at += m;
        }
        (y, g, v)
    }

    /// `log p(y_1:count)`, with the pseudo-observation where there is one.
    fn log_density(&self, batch: &Batch<'_>, destination: &Gaussian, count: usize) -> f64 {
        let (y, g, v) = self.observed(batch, destination, count);
        let error = &y - &g * &self.mean;
        let root = Cholesky::new(&g * &self.covariance * g.transpose() + v).unwrap();
        let log_determinant = 2.0 * root.l().diagonal().map(f64::ln).sum();
        -0.5 * (error.dot(&root.solve(&error)) + log_determinant + y.len() as f64 * (2.0 * std::f64::consts::PI).ln())
    }
}

fn square(json: &Json) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = json.as_array().unwrap().iter().map(numbers).collect();
    DMatrix::from_fn(rows.len(), rows.len(), |r, c| rows[r][c])
}
