//! The papers' methods as they are printed: one destination and arrival time at a time.

use super::configuration::Configuration;
use super::expiring::Expiring;
use super::filter_bank::FilterBank;
use super::node_posterior::NodePosterior;
use crate::engine::{Engine, Observed};
use crate::error::Result;
use crate::math::gaussian::Gaussian;
use crate::model::destination::Destinations;
use crate::posterior::arrival_time::ArrivalTime;
use crate::posterior::{Posterior, Shares};
use crate::value::{Node, Value};
use std::sync::Arc;

/// Any method, with any motion model.
#[derive(Clone, Debug)]
pub(crate) struct Stepwise {
    configuration: Arc<Configuration>,
    destinations: Arc<Destinations>,
    filters: Expiring<FilterBank>,
    /// Of the filters whose likelihoods hold, once it has been computed.
    nodes: Option<NodePosterior>,
}

impl Stepwise {
    /// Begins with `p(x_1 | y_1)`, or before the first observation, with `p(x_1)`, where its evidence counts.
    pub fn begin(configuration: Configuration, destinations: &Arc<Destinations>, first: Gaussian) -> Self {
        let filters = Expiring::new(FilterBank::begin(&configuration, destinations, first));
        Self::with(Arc::new(configuration), Arc::clone(destinations), filters)
    }

    /// Goes on with these filters.
    pub const fn with(
        configuration: Arc<Configuration>,
        destinations: Arc<Destinations>,
        filters: Expiring<FilterBank>,
    ) -> Self {
        Self { configuration, destinations, filters, nodes: None }
    }

    /// The engine that [`Engine::save`] wrote; the configuration's start is taken from there.
    ///
    /// # Errors
    /// Those of reading a value.
    pub fn load(node: &Node<'_>, configuration: Configuration, destinations: &Arc<Destinations>) -> Result<Self> {
        let fields = node.fields(&["start", "filters"])?;
        let configuration = configuration.load(&fields.required("start")?)?;
        let load = |node: &Node<'_>| FilterBank::load(node, &configuration, destinations);
        let filters = Expiring::load(&fields.required("filters")?, load)?;
        Ok(Self::with(Arc::new(configuration), Arc::clone(destinations), filters))
    }

    fn nodes(&mut self) -> (&NodePosterior, &Expiring<FilterBank>, &Destinations) {
        let Self { destinations, filters, nodes, .. } = self;
        let nodes = nodes.get_or_insert_with(|| NodePosterior::new(filters.evidence(), destinations));
        (nodes, filters, destinations)
    }
}

impl Engine for Stepwise {
    fn advance(&mut self, observed: &Observed<'_>) -> Result<()> {
        let (elapsed, measurement) = (observed.elapsed, observed.measurement()?);
        let is_alive = self.filters.now.plan.is_alive(elapsed);
        let destinations = &self.destinations;
        self.filters.advance(is_alive, |bank| bank.advance(destinations, elapsed, &measurement))?;
        self.nodes = None;
        Ok(())
    }

    fn observations(&self) -> u64 {
        self.filters.now.observations
    }

    fn expired(&self) -> bool {
        self.filters.expired()
    }

    fn probabilities(&mut self, none: f64, posterior: &mut Posterior) {
        let mut log_likelihoods = Vec::new();
        self.log_likelihoods(&mut log_likelihoods);
        let priors = self.destinations.priors();
        let log_evidence_of_none = self.filters.evidence().log_evidence_of_none(priors);
        posterior.update(priors, none, &log_likelihoods, log_evidence_of_none);
    }

    fn log_likelihoods(&mut self, into: &mut Vec<f64>) {
        let (nodes, filters, _) = self.nodes();
        nodes.log_likelihoods(filters.evidence(), into);
    }

    fn arrival(&mut self, shares: Shares<'_>) -> Option<ArrivalTime> {
        let (nodes, filters, _) = self.nodes();
        nodes.arrival(filters.evidence(), shares)
    }

    fn state(&mut self, shares: Shares<'_>, later: f64) -> Option<Gaussian> {
        let (nodes, filters, destinations) = self.nodes();
        nodes.state(filters, destinations, shares, later)
    }

    fn initial_state(&mut self, shares: Shares<'_>) -> Option<Gaussian> {
        let (nodes, filters, _) = self.nodes();
        nodes.initial_state(filters.evidence(), shares)
    }

    fn replan(&mut self, destinations: &Arc<Destinations>, origin: Option<&[usize]>) {
        let plan = self.configuration.plan(destinations);
        self.filters.replan(|bank| bank.replan(plan.clone(), origin), |bank| bank.plan.is_alive(bank.elapsed));
        self.destinations = Arc::clone(destinations);
        self.nodes = None;
    }

    fn save(&self) -> Value {
        Value::map([("start", self.configuration.save()), ("filters", self.filters.save(FilterBank::save))])
    }

    fn boxed(&self) -> Box<dyn Engine> {
        Box::new(self.clone())
    }
}
