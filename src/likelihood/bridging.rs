//! `bridging`: the original bridging distributions (Liang's references 12 to 14).
//!
//! The endpoint `z = G~ x_T ~ N(a_i, S_i)` is independent of `x_1`, and the state moves towards it by the bridged
//! transition of [`crate::model::bridge`]. For each destination and arrival time one Kalman filter runs on `[x_k; z]`; its
//! evidence is the likelihood. Covariances and gains are the same for all destinations of a kind, so they are kept once.
//!
//! ```
//! use whither::{Predictor, Scenario};
//! // a random walk observed at 0 and, after one of two seconds, at 1, on its way to N(4, 3); every noise is 1
//! let scenario: Scenario = serde_json::from_str(r#"{
//!     "method": "bridging", "arrival": { "type": "discrete", "times": [2], "weights": [1] },
//!     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
//!     "destinations": [{ "id": "there", "mean": [4], "covariance": [[3]] }]
//! }"#).unwrap();
//! let mut predictor = Predictor::new(&scenario);
//! predictor.observe(0.0, &[0.0]).unwrap();
//! predictor.observe(1.0, &[1.0]).unwrap();
//! // the bridge goes half of the way, with the variance 1/2: x_2 ~ N(2, 1/4 + 3/4 + 1/2), so y_2 = 1 is of N(2, 5/2)
//! let expected = -0.5 * (5.0 * std::f64::consts::PI).ln() - 0.2;
//! assert!((predictor.log_likelihoods()[0] - expected).abs() < 1e-13);
//! ```

use super::states::{StateQuery, States};
use super::{Likelihood, Scene, Step};
use crate::error::Result;
use crate::math::gaussian::{condition, propagate};
use crate::model::bridge::Bridge;
use crate::model::motion::Transition;
use crate::value::{Node, Value};
use nalgebra::{DMatrix, DVector};

/// The bridged filters: a covariance for each group and node, a mean and a log evidence for each destination and node.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bridging {
    /// `s + l` square, one for each group and node.
    covariances: Vec<DMatrix<f64>>,
    /// `[x_k; z]` for each destination and node, `2 s` numbers apart.
    means: Vec<f64>,
    table: Vec<f64>,
}

impl Bridging {
    fn stride(scene: &Scene<'_>) -> usize {
        2 * scene.filter.states
    }
}

/// The bridged transition of `[x_k; z]`: `z` stays, and the state moves towards it.
struct Onward<'a> {
    bridge: Bridge,
    step: &'a Transition,
    rest: &'a Transition,
    /// `s + l` square.
    matrix: DMatrix<f64>,
    noise: DMatrix<f64>,
    /// What the step adds to the state, where that is the same for every destination.
    offset: Option<DVector<f64>>,
}

impl<'a> Onward<'a> {
    /// Over `step`, with `rest` left to the arrival, towards the first `l` components there; none where they are determined.
    fn new(step: &'a Transition, rest: &'a Transition, l: usize) -> Option<Self> {
        let bridge = Bridge::new(&step.transition, &step.noise, &rest.transition, &rest.noise, l)?;
        let s = step.offset.len();
        let mut matrix = DMatrix::identity(s + l, s + l);
        matrix.view_mut((0, 0), (s, s)).copy_from(&bridge.previous);
        matrix.view_mut((0, s), (s, l)).copy_from(&bridge.destination);
        let mut noise = DMatrix::zeros(s + l, s + l);
        noise.view_mut((0, 0), (s, s)).copy_from(&bridge.covariance);
        let depends = step.destination_gain.is_some() || rest.destination_gain.is_some();
        let offset = (!depends).then(|| bridge.offset(&step.offset, &rest.offset));
        Some(Self { bridge, step, rest, matrix, noise, offset })
    }

    /// The mean of `[x_k; z]` after the step, for the destination around `center`.
    fn mean(&self, before: &DVector<f64>, center: &[f64]) -> DVector<f64> {
        let mut mean = &self.matrix * before;
        let mut state = mean.rows_mut(0, self.step.offset.len());
        match &self.offset {
            Some(offset) => state += offset,
            None => state += self.bridge.offset(&self.step.constant(center), &self.rest.constant(center)),
        }
        mean
    }
}

impl Likelihood for Bridging {
    fn begin(&mut self, scene: &Scene<'_>) {
        let (s, stride) = (scene.filter.states, Self::stride(scene));
        self.table = vec![0.0; scene.table_length()];
        self.means = vec![0.0; scene.table_length() * stride];
        self.covariances = vec![DMatrix::zeros(0, 0); scene.node_count()];
        for node in scene.nodes_ahead(scene.elapsed) {
            let l = node.covariance.nrows();
            let mut joint = DMatrix::zeros(s + l, s + l);
            joint.view_mut((0, 0), (s, s)).copy_from(&scene.first.covariance);
            joint.view_mut((s, s), (l, l)).copy_from(&node.covariance);
            self.covariances[node.number] = joint;
            for &i in node.members {
                let place = (scene.plan.rows[i as usize] + node.index) * stride;
                self.means[place..place + s].copy_from_slice(scene.first.mean.as_slice());
                self.means[place + s..place + s + l].copy_from_slice(&scene.destinations.mean(i as usize));
            }
        }
    }

    fn advance(&mut self, scene: &Scene<'_>, step: &Step<'_>) {
        let (s, stride) = (scene.filter.states, Self::stride(scene));
        let m = step.measurement.value.len();
        for node in scene.nodes_ahead(scene.elapsed) {
            let rest = scene.motion.transition(node.remaining);
            let Some(onward) = Onward::new(step.transition, &rest, node.covariance.nrows()) else { continue };
            let size = onward.matrix.nrows();
            let predicted = propagate(&onward.matrix, &self.covariances[node.number], &onward.noise);
            let mut observation = DMatrix::zeros(m, size);
            observation.columns_mut(0, s).copy_from(&step.measurement.matrix);
            let correction = if m == 0 {
                None
            } else {
                let Some(correction) = condition(&predicted, &observation, &step.measurement.noise) else { continue };
                Some(correction)
            };
            for &i in node.members {
                let i = i as usize;
                let row = scene.plan.rows[i] + node.index;
                let place = row * stride;
                let before = DVector::from_column_slice(&self.means[place..place + size]);
                let mut mean = onward.mean(&before, scene.destinations.center(i));
                if let Some(correction) = &correction {
                    let error = &step.measurement.value - &observation * &mean;
                    mean.gemv(1.0, &correction.gain, &error, 1.0);
                    self.table[row] += correction.prediction_error.log_density(error);
                }
                self.means[place..place + size].copy_from_slice(mean.as_slice());
            }
            self.covariances[node.number] = correction.map_or(predicted, |correction| correction.covariance());
        }
    }

    fn log_likelihoods(&self, scene: &Scene<'_>, table: &mut [f64]) {
        scene.copy_nodes_ahead(&self.table, table);
    }

    /// The posterior of `[x_k; z]`, moved on by the bridged transition.
    fn states(&self, query: &StateQuery<'_>) -> Option<States> {
        let (scene, node) = (query.evidence, query.node);
        let (s, stride) = (scene.filter.states, Self::stride(&scene));
        let (onward, left) = query.onward(&scene);
        let (step, rest) = (scene.motion.transition(onward), scene.motion.transition(left));
        let onward = Onward::new(&step, &rest, node.covariance.nrows())?;
        let predicted = propagate(&onward.matrix, &self.covariances[node.number], &onward.noise);
        let mean = |&i: &usize| {
            let place = (scene.plan.rows[i] + node.index) * stride;
            let before = DVector::from_column_slice(&self.means[place..place + onward.matrix.nrows()]);
            onward.mean(&before, scene.destinations.center(i)).rows(0, s).into_owned()
        };
        Some(States {
            means: query.members.iter().map(mean).collect(),
            covariance: predicted.view((0, 0), (s, s)).into_owned(),
        })
    }

    fn boxed(&self) -> Box<dyn Likelihood> {
        Box::new(self.clone())
    }

    fn save(&self) -> Value {
        Value::map([
            ("evidence", Value::exact_numbers(&self.table)),
            ("means", Value::exact_numbers(&self.means)),
            ("covariances", Value::List(self.covariances.iter().map(|c| Value::exact_numbers(c.iter())).collect())),
        ])
    }

    fn load(&mut self, scene: &Scene<'_>, node: &Node<'_>) -> Result<()> {
        self.begin(&Scene { elapsed: 0.0, ..*scene });
        let fields = node.fields(&["evidence", "means", "covariances"])?;
        self.table = fields.required("evidence")?.exact_numbers(self.table.len())?;
        self.means = fields.required("means")?.exact_numbers(self.means.len())?;
        let list = fields.required("covariances")?;
        for (covariance, item) in self.covariances.iter_mut().zip(list.items()?) {
            let (rows, columns) = covariance.shape();
            *covariance = DMatrix::from_column_slice(rows, columns, &item.exact_numbers(rows * columns)?);
        }
        Ok(())
    }
}
