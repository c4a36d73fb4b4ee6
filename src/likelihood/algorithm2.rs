//! `algorithm2`: Liang's Algorithm 2, Liang (12)-(13).
//!
//! The posterior of `x_{k-1}` is conditioned on the pseudo-observation, (12), as a smoother would; then the transition to
//! `x_k`, itself conditioned on the pseudo-observation, gives the observation's density (13).
//!
//! The printed (13) has `F(h) mu - M(h)` where the prediction of `x_k` is `F(h) mu + M(h)`. With the printed sign
//! Algorithm 2 contradicts Algorithm 1 whenever `M` is not zero; here it is put right.
//!
//! ```
//! use whither::{Predictor, Scenario};
//! // a random walk observed at 0 and, after one of two seconds, at 1, on its way to N(4, 3); every noise is 1
//! let scenario: Scenario = serde_json::from_str(r#"{
//!     "method": "algorithm2", "arrival": { "type": "discrete", "times": [2], "weights": [1] },
//!     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
//!     "destinations": [{ "id": "there", "mean": [4], "covariance": [[3]] }]
//! }"#).unwrap();
//! let mut predictor = Predictor::new(&scenario);
//! predictor.observe(0.0, &[0.0]).unwrap();
//! predictor.observe(1.0, &[1.0]).unwrap();
//! // (12): x_1 ~ N(0, 1) becomes N(2/3, 5/6); (13): x_2 = (4 x_1 + 4) / 5 + N(0, 4/5), so y_2 = 1 is of N(4/3, 7/3)
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
pub(crate) struct Algorithm2 {
    table: Vec<f64>,
}

impl Likelihood for Algorithm2 {
    fn begin(&mut self, scene: &Scene<'_>) {
        self.table = vec![0.0; scene.table_length()];
    }

    fn advance(&mut self, scene: &Scene<'_>, step: &Step<'_>) {
        if step.measurement.value.is_empty() {
            return;
        }
        let posterior = step.before.current_covariance();
        let transition = step.transition;
        let observation = &step.measurement.matrix;
        let waited = scene.elapsed - step.elapsed_before;
        for node in scene.nodes_ahead(scene.elapsed) {
            let length = node.covariance.nrows();
            // (12): x_{k-1} given the pseudo-observation
            let total = Endpoint::after(scene.motion, node.remaining + waited, length);
            // (13): x_k given x_{k-1} and the pseudo-observation; L_y, and (I - L_y B_y) Q of the noise that is left
            let rest = Endpoint::after(scene.motion, node.remaining, length);
            let (Some(before), Some(onward)) = (
                condition(&posterior, &total.matrix, &(&total.noise + &node.covariance)),
                condition(&transition.noise, &rest.matrix, &(&rest.noise + &node.covariance)),
            ) else {
                continue;
            };
            let prediction = &transition.transition - &onward.gain * (&rest.matrix * &transition.transition);
            let state = propagate(&prediction, &before.covariance(), &onward.covariance());
            let Some(density) = Factor::new(propagate(observation, &state, &step.measurement.noise)) else { continue };
            for &i in node.members {
                let i = i as usize;
                let mut smoothed = step.before.mean(i);
                smoothed.gemv(1.0, &before.gain, &scene.endpoint_error(i, &total, &smoothed), 1.0);
                let mut bridged = transition.predict(&smoothed, scene.destinations.center(i));
                bridged.gemv(1.0, &onward.gain, &scene.endpoint_error(i, &rest, &bridged), 1.0);
                self.table[scene.plan.rows[i] + node.index] += density.log_density(step.measurement.error(&bridged));
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
