//! The evidence written down from the process: an oracle without filter or recursion.

use crate::problem::{Observed, Problem};
use crate::support::{numbers, value};
use nalgebra::{DMatrix, DVector};
use serde_json::Value as Json;
use whither::Scenario;

/// What is seen of the state at one of the times: which, `y`, `G`, `V`.
type Seen = (usize, DVector<f64>, DMatrix<f64>, DMatrix<f64>);

/// The observations and the endpoint as one Gaussian vector, written down from the process: `x_k = Phi_k x_1 + offsets +
/// noises`, all covariances by summing over the noises that two states share. No filter, no recursion.
pub struct Batch<'a> {
    problem: &'a Problem,
    scenario: Scenario,
}

impl<'a> Batch<'a> {
    pub fn new(problem: &'a Problem) -> Self {
        Self { problem, scenario: Scenario::from_value(&value(&problem.scenario)).unwrap() }
    }

    pub fn log_likelihood(&self, i: usize) -> f64 {
        let whither::scenario::Engine::Papers { arrival, quadrature, .. } = &self.scenario.engine else { panic!() };
        let destination = self.scenario.destinations.get(i);
        let first = &self.problem.observations[0];
        let start = self.first_position(first);
        let d = self.scenario.motion.dimensions();
        let distance = destination.mean[..d].iter().zip(&start).map(|(a, y)| (a - y) * (a - y)).sum::<f64>().sqrt();
        let grid = destination.kind.arrival().unwrap_or(arrival).grid(quadrature, distance, destination.kind.extent(d));
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
        (DVector::from_vec(numbers(&initial["mean"])), square(&initial["covariance"]))
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
        let mut seen: Vec<Seen> = observations
            .iter()
            .enumerate()
            .filter_map(|(k, observed)| self.measured(observed).map(|(y, g, v)| (k, y, g, v)))
            .collect();
        let l = destination.mean.len();
        let endpoint = DMatrix::from_fn(l, s, |r, c| f64::from(u8::from(r == c)));
        let a = DVector::from_column_slice(&destination.mean);
        seen.push((times.len() - 1, a, endpoint, destination.kind.covariance()));
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
    let rows: Vec<Vec<f64>> = json.as_array().unwrap().iter().map(numbers).collect();
    DMatrix::from_fn(rows.len(), rows.len(), |r, c| rows[r][c])
}
