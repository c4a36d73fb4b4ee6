//! Which engine a scenario has: begun at the first observation, or loaded from a snapshot.

use super::{Method, Scenario, Setup};
use crate::engine::{Engine, Observed};
use crate::error::Result;
use crate::likelihood::configuration::Configuration;
use crate::likelihood::pseudo_observation::PseudoObservation;
use crate::likelihood::stepwise::Stepwise;
use crate::model::destination::Destinations;
use crate::pointing::engine::PointingEngine;
use crate::pointing::parameters::PointingConstants;
use crate::value::Node;
use std::sync::Arc;

impl Scenario {
    /// The engine after the first observation.
    ///
    /// # Errors
    /// `wrong-length` where an axis is missing of which the initial density has no information, and as [`Engine::advance`].
    pub(crate) fn begin(&self, destinations: &Arc<Destinations>, first: &Observed<'_>) -> Result<Box<dyn Engine>> {
        let posterior = self.initial.posterior(&self.observation, &first.measurement()?)?;
        let start = posterior.mean.as_slice()[..destinations.dimensions()].to_vec();
        let prior = self.initial.counted();
        let state = prior.cloned().unwrap_or(posterior);
        let mut engine: Box<dyn Engine> = match self.choice(start) {
            Choice::PseudoObservation(configuration) => {
                Box::new(PseudoObservation::begin(configuration, destinations, &state))
            }
            Choice::Stepwise(configuration) => Box::new(Stepwise::begin(configuration, destinations, state)),
            Choice::Pointing(parameters, start) => {
                Box::new(PointingEngine::begin(parameters, destinations, &start, first)?)
            }
        };
        if prior.is_some() {
            engine.advance(first)?;
        }
        Ok(engine)
    }

    /// The engine that [`Engine::save`] wrote.
    ///
    /// # Errors
    /// Those of reading a value.
    pub(crate) fn load(&self, destinations: &Arc<Destinations>, node: &Node<'_>) -> Result<Box<dyn Engine>> {
        Ok(match self.choice(Vec::new()) {
            Choice::PseudoObservation(configuration) => {
                Box::new(PseudoObservation::load(node, configuration, destinations)?)
            }
            Choice::Stepwise(configuration) => Box::new(Stepwise::load(node, configuration, destinations)?),
            Choice::Pointing(parameters, _) => Box::new(PointingEngine::load(node, parameters, destinations)?),
        })
    }

    fn choice(&self, start: Vec<f64>) -> Choice {
        let (method, arrival, quadrature) = match &self.setup {
            Setup::Papers { method, arrival, quadrature } => (*method, arrival.clone(), quadrature.clone()),
            Setup::Pointing(parameters) => return Choice::Pointing(Arc::clone(parameters), start),
        };
        // one filter for all destinations, and nothing accumulates
        let telescopes = method == Method::PseudoObservation && !self.motion.depends_on_destination();
        let configuration = Configuration {
            motion: self.motion.clone(),
            method,
            arrival,
            quadrature,
            observes_position: self.observation.is_position(),
            first_counts: self.initial.counted().is_some(),
            start,
        };
        if telescopes { Choice::PseudoObservation(configuration) } else { Choice::Stepwise(configuration) }
    }
}

/// An engine, with what it begins with.
enum Choice {
    PseudoObservation(Configuration),
    Stepwise(Configuration),
    Pointing(Arc<PointingConstants>, Vec<f64>),
}
