//! `algorithm1`: Liang's Algorithm 1, Liang (7)-(11).
//!
//! The prediction of `x_k` is conditioned on the pseudo-observation `a_i` of `x_T`, (10), and the observation's density
//! under it, (11), is multiplied into the likelihood of each destination and node.
//!
//! ```
//! use whither::{Predictor, Scenario};
//! // a random walk observed at 0 and, after one of two seconds, at 1, on its way to N(4, 3); every noise is 1
//! let scenario: Scenario = serde_json::from_str(r#"{
//!     "method": "algorithm1", "arrival": { "type": "discrete", "times": [2], "weights": [1] },
//!     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
//!     "destinations": [{ "id": "there", "mean": [4], "covariance": [[3]] }]
//! }"#).unwrap();
//! let mut predictor = Predictor::new(&scenario);
//! predictor.observe(0.0, &[0.0]).unwrap();
//! predictor.observe(1.0, &[1.0]).unwrap();
//! // (10): x_2 ~ N(0, 2) becomes N(4/3, 4/3); (11): y_2 = 1 is of N(4/3, 7/3)
//! let expected = -0.5 * (14.0 / 3.0 * std::f64::consts::PI).ln() - 1.0 / 42.0;
//! assert!((predictor.log_likelihoods()[0] - expected).abs() < 1e-13);
//! ```

use super::{Likelihood, Scene, Step};
use crate::error::Result;
use crate::math::gaussian::{Factor, condition, propagate};
use crate::model::endpoint::Endpoint;
use crate::value::{Node, Value};

/// Accumulated log likelihoods for each destination and node.
#[derive(Clone, Debug, Default)]
pub(crate) struct Algorithm1 {
    table: Vec<f64>,
}

impl Likelihood for Algorithm1 {
    fn begin(&mut self, scene: &Scene<'_>) {
        self.table = vec![0.0; scene.table_length()];
    }

    fn advance(&mut self, scene: &Scene<'_>, step: &Step<'_>) {
        if step.measurement.value.is_empty() {
            return;
        }
        let prediction = step.predicted.current_covariance();
        let observation = &step.measurement.matrix;
        for node in scene.nodes_ahead(scene.elapsed) {
            // (10): L_*, Sigma_*
            let endpoint = Endpoint::after(scene.motion, node.remaining, node.covariance.nrows());
            let noise = &endpoint.noise + &node.covariance;
            let Some(conditioned) = condition(&prediction, &endpoint.matrix, &noise) else { continue };
            // (11): Sigma_y
            let error = propagate(observation, &conditioned.covariance(), &step.measurement.noise);
            let Some(density) = Factor::new(error) else { continue };
            for &i in node.members {
                let i = i as usize;
                let mut mean = step.predicted.mean(i);
                mean.gemv(1.0, &conditioned.gain, &scene.endpoint_error(i, &endpoint, &mean), 1.0);
                self.table[scene.plan.rows[i] + node.index] += density.log_density(step.measurement.error(&mean));
            }
        }
    }

    fn log_likelihoods(&self, scene: &Scene<'_>, table: &mut [f64]) {
        scene.copy_nodes_ahead(&self.table, table);
    }

    fn boxed(&self) -> Box<dyn Likelihood> {
        Box::new(self.clone())
    }

    fn save(&self) -> Value {
        Value::exact_numbers(&self.table)
    }

    fn load(&mut self, scene: &Scene<'_>, node: &Node<'_>) -> Result<()> {
        self.table = node.exact_numbers(scene.table_length())?;
        Ok(())
    }
}
