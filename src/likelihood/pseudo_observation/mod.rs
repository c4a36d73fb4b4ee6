//! `pseudoObservation`, at the speed of the machine, where the motion model does not depend on the destination.
//!
//! The telescoped form of `dense` is the ratio of two Gaussian densities of the endpoint, so its
//! logarithm is a quadratic in the endpoint's mean whose coefficients depend on nothing but the node and the class of the
//! endpoint's covariance:
//!
//! ```text
//! p(D_i | y_1:k) ~ prior_i sum_n w_n N(a_i; m_n, V_n + S) / N(a_i; u_n, U_n + S)
//! ```
//!
//! | part | what |
//! |---|---|
//! | `telescoped` | the filters, and the sums over nodes |
//! | `candidate` | one noise candidate: a filter of each axis, or one of the complete state |
//! | `separable` | which models' axes do not mix; their filters are `whither_kernel::axes` |
//! | `whither_kernel::endpoints` | `m_n, V_n, u_n, U_n` there |
//! | `coupled` | both where they do |
//! | `classes` | the destinations in flat arrays |
//! | `coefficients` | the coefficients, by `whither_kernel::ratios` |
//! | `pruning` | what can add nothing, of very many destinations |
//! | `conversion` | from separate axes to the complete state and back |
//! | `whither_kernel::mixture` | the sum |
//!
//! `dense` computes the same one pair at a time: the oracle, which a test compares this with.

mod candidate;
pub(crate) mod classes;
pub(crate) mod coefficients;
mod conversion;
pub(crate) mod coupled;
pub(crate) mod dense;
pub(crate) mod pruning;
pub(crate) mod separable;
mod telescoped;
#[cfg(test)]
mod tests;

use super::configuration::Configuration;
use super::expiring::Expiring;
use super::stepwise::Stepwise;
use crate::engine::{Engine, Observed};
use crate::error::Result;
use crate::math::gaussian::Gaussian;
use crate::model::destination::Destinations;
use crate::posterior::arrival_time::ArrivalTime;
use crate::posterior::{Posterior, Shares};
use crate::value::{Node, Value};
use std::sync::Arc;
use telescoped::Telescoped;

/// The engine: probabilities from flat arrays, everything else from the dense form, made when it is needed.
#[derive(Clone, Debug)]
pub(crate) struct PseudoObservation {
    configuration: Arc<Configuration>,
    destinations: Arc<Destinations>,
    filters: Expiring<Telescoped>,
    dense: Option<Box<Stepwise>>,
}

impl PseudoObservation {
    /// Begins with `p(x_1 | y_1)`, or before the first observation, with `p(x_1)`, where its evidence counts.
    pub fn begin(configuration: Configuration, destinations: &Arc<Destinations>, first: &Gaussian) -> Self {
        let filters = Expiring::new(Telescoped::begin(&configuration, destinations, first));
        Self { configuration: Arc::new(configuration), destinations: Arc::clone(destinations), filters, dense: None }
    }

    /// The engine that [`Engine::save`] wrote; the configuration's start is taken from there.
    ///
    /// # Errors
    /// Those of reading a value.
    pub fn load(node: &Node<'_>, configuration: Configuration, destinations: &Arc<Destinations>) -> Result<Self> {
        let fields = node.fields(&["start", "filters"])?;
        let configuration = configuration.load(&fields.required("start")?)?;
        let load = |node: &Node<'_>| Telescoped::load(node, &configuration, destinations);
        let filters = Expiring::load(&fields.required("filters")?, load)?;
        Ok(Self {
            configuration: Arc::new(configuration),
            destinations: Arc::clone(destinations),
            filters,
            dense: None,
        })
    }

    fn dense(&mut self) -> Option<&mut Stepwise> {
        if self.dense.is_none() {
            let filters = self.filters.map(|filters| filters.dense(&self.configuration, &self.destinations))?;
            self.dense = Some(Box::new(Stepwise::with(
                Arc::clone(&self.configuration),
                Arc::clone(&self.destinations),
                filters,
            )));
        }
        self.dense.as_deref_mut()
    }
}

impl Engine for PseudoObservation {
    fn advance(&mut self, observed: &Observed<'_>) -> Result<()> {
        let is_alive = self.filters.now.is_alive(observed.elapsed);
        let (configuration, destinations) = (&self.configuration, &self.destinations);
        self.filters.advance(is_alive, |filters| filters.advance(configuration, destinations, observed))?;
        self.dense = None;
        Ok(())
    }

    fn observations(&self) -> u64 {
        self.filters.now.observations()
    }

    fn expired(&self) -> bool {
        self.filters.expired()
    }

    fn probabilities(&mut self, none: f64, posterior: &mut Posterior) {
        let destinations = &self.destinations;
        match self.filters.evidence_mut().probabilities(none, &mut posterior.probabilities) {
            Some(none) => posterior.none = none,
            None => posterior.set_to_prior(destinations.priors(), none),
        }
    }

    fn log_likelihoods(&mut self, into: &mut Vec<f64>) {
        self.filters.evidence_mut().log_likelihoods(into);
    }

    fn arrival(&mut self, shares: Shares<'_>) -> Option<ArrivalTime> {
        self.dense()?.arrival(shares)
    }

    fn state(&mut self, shares: Shares<'_>, later: f64) -> Option<Gaussian> {
        self.dense()?.state(shares, later)
    }

    fn initial_state(&mut self, shares: Shares<'_>) -> Option<Gaussian> {
        self.dense()?.initial_state(shares)
    }

    fn replan(&mut self, destinations: &Arc<Destinations>, _origin: Option<&[usize]>) {
        let replan = |filters: &mut Telescoped| filters.replan(&self.configuration, destinations);
        self.filters.replan(replan, |filters| filters.is_alive(filters.elapsed()));
        self.destinations = Arc::clone(destinations);
        self.dense = None;
    }

    fn save(&self) -> Value {
        let filters = self.filters.save(|filters| filters.save(&self.configuration, &self.destinations));
        Value::map([("start", self.configuration.save()), ("filters", filters)])
    }

    fn boxed(&self) -> Box<dyn Engine> {
        Box::new(self.clone())
    }
}
