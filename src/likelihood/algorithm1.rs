//! `algorithm1`: Liang's Algorithm 1, (10)-(11).
//!
//! The prediction of `x_k` is conditioned on the pseudo-observation `a_i` of `x_T`, (10), and the observation's density
//! under it, (11), is multiplied into the likelihood of each destination and node.

use super::{Likelihood, Scene, Step};
use crate::error::Result;
use crate::math::gaussian::{Factor, condition, propagate};
use crate::model::endpoint::Endpoint;
use crate::value::{Node, Value};

/// The engine: log likelihoods for each destination and node.
#[derive(Clone, Debug, Default)]
pub struct Algorithm1 {
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
            let noise = &endpoint.noise + node.covariance;
            let Some(conditioned) = condition(&prediction, &endpoint.matrix, &noise) else { continue };
            // (11): Sigma_y
            let error = propagate(observation, &conditioned.covariance, &step.measurement.noise);
            let Some(density) = Factor::new(error) else { continue };
            for &i in &node.group.members {
                let i = i as usize;
                let predicted = step.predicted.mean(i);
                let mean = &predicted + &conditioned.gain * scene.endpoint_error(i, &endpoint, &predicted);
                self.table[scene.plan.rows[i] + node.index] +=
                    density.log_density(&(&step.measurement.value - observation * mean));
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
