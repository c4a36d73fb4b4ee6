//! `pseudoObservation`: the product of the prediction errors of Liang (11), telescoped.
//!
//! ```text
//! log p(y_2:k | y_1, D_i, T) = log p(y_2:k | y_1)
//!                            + log N(a_i; G~(F_R m_k + M_R), G~(F_R P_k F_R' + Q_R)G~' + S_i)    R = T - t_k
//!                            - log N(a_i; G~(F_R m_1 + M_R), G~(F_R P_1 F_R' + Q_R)G~' + S_i)    R = T - t_1
//! ```
//! with `m, P` the Kalman posterior: each factor of (11) is the ratio of two such densities, by (7). Nothing accumulates for
//! a destination or a node, so both may change at any time.
//!
//! ```
//! use whither::{Predictor, Scenario};
//! // a random walk observed at 0 and, after one of two seconds, at 1, on its way to N(4, 3); every noise is 1
//! let scenario: Scenario = serde_json::from_str(r#"{
//!     "method": "pseudoObservation", "arrival": { "type": "discrete", "times": [2], "weights": [1] },
//!     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
//!     "destinations": [{ "id": "there", "mean": [4], "covariance": [[3]] }]
//! }"#).unwrap();
//! let mut predictor = Predictor::new(&scenario);
//! predictor.observe(0.0, &[0.0]).unwrap();
//! predictor.observe(1.0, &[1.0]).unwrap();
//! // ln N(1; 0, 3) + ln N(4; 2/3, 14/3) - ln N(4; 0, 6), which is ln N(1; 4/3, 7/3), as of algorithm1
//! let expected = -0.5 * (14.0 / 3.0 * std::f64::consts::PI).ln() - 1.0 / 42.0;
//! assert!((predictor.log_likelihoods()[0] - expected).abs() < 1e-12);
//! ```

use crate::likelihood::{Likelihood, Scene};
use crate::math::gaussian::{Factor, propagate};
use crate::model::endpoint::Endpoint;

/// The likelihoods; nothing accumulates.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Dense;

impl Likelihood for Dense {
    fn log_likelihoods(&self, scene: &Scene<'_>, table: &mut [f64]) {
        table.fill(f64::NEG_INFINITY);
        let covariance = scene.filter.current_covariance();
        for node in scene.nodes_ahead(scene.elapsed) {
            let length = node.covariance.nrows();
            let now = Endpoint::after(scene.motion, node.remaining, length);
            let start = Endpoint::after(scene.motion, node.since_first, length);
            let density = |endpoint: &Endpoint, covariance| {
                Factor::new(propagate(&endpoint.matrix, covariance, &(&endpoint.noise + &node.covariance)))
            };
            let (Some(from_now), Some(from_start)) =
                (density(&now, &covariance), density(&start, &scene.first.covariance))
            else {
                continue;
            };
            for &i in node.members {
                let i = i as usize;
                table[scene.plan.rows[i] + node.index] = scene.filter.evidence(i)
                    + from_now.log_density(scene.endpoint_error(i, &now, &scene.filter.mean(i)))
                    - from_start.log_density(scene.endpoint_error(i, &start, &scene.first.mean));
            }
        }
    }

    fn boxed(&self) -> Box<dyn Likelihood> {
        Box::new(*self)
    }
}
