//! The pointing model as an engine.

use super::Pointing;
use super::course::Course;
use super::parameters::{PointingConstants, axis_variances};
use super::space::AnySpace;
use super::targets::Targets;
use super::trail::Trail;
use crate::engine::{Engine, Lasting, Observed};
use crate::error::Result;
use crate::math::gaussian::Gaussian;
use crate::model::destination::Destinations;
use crate::model::learnt::Learnt;
use crate::posterior::arrival_time::ArrivalTime;
use crate::posterior::remaining::Remaining;
use crate::posterior::{Posterior, Shares};
use crate::value::{Node, Value};
use std::sync::Arc;

/// One movement under the pointing model.
#[derive(Clone, Debug)]
pub(crate) struct PointingEngine(Pointing<AnySpace>);

impl PointingEngine {
    /// Begins at `start`, the first position.
    ///
    /// # Errors
    /// `out-of-range` where the noise is correlated between axes.
    pub fn begin(
        parameters: Arc<PointingConstants>,
        destinations: &Destinations,
        start: &[f64],
        first: &Observed<'_>,
    ) -> Result<Self> {
        let variances = axis_variances(first.noise, "noise")?;
        Ok(Self(Pointing::begin(AnySpace(start.len()), parameters, targets(destinations), start, &variances)))
    }

    /// The engine that [`Engine::save`] wrote.
    ///
    /// # Errors
    /// Those of reading a value.
    pub fn load(node: &Node<'_>, parameters: Arc<PointingConstants>, destinations: &Destinations) -> Result<Self> {
        let course = Course::load(node, AnySpace(destinations.dimensions()), &parameters)?;
        let mut pointing = Pointing::resume(parameters, targets(destinations), course);
        if let Some(trail) = node.get("trail") {
            pointing.trail = Some(Box::new(Trail::load(&trail)?));
        }
        Ok(Self(pointing))
    }
}

impl Engine for PointingEngine {
    fn advance(&mut self, observed: &Observed<'_>) -> Result<()> {
        let variances = axis_variances(observed.noise, "noise")?;
        self.0.advance(observed.elapsed, observed.position, &variances);
        Ok(())
    }

    fn observations(&self) -> u64 {
        self.0.course().observations
    }

    fn probabilities(&mut self, none: f64, posterior: &mut Posterior) {
        posterior.none = self.0.posterior(none, &mut posterior.probabilities);
    }

    fn log_likelihoods(&mut self, into: &mut Vec<f64>) {
        self.0.log_likelihoods(into);
    }

    fn arrival(&mut self, shares: Shares<'_>) -> Option<ArrivalTime> {
        Some(self.0.arrival(shares))
    }

    fn remaining(&mut self, shares: Shares<'_>, elapsed: f64) -> Option<Remaining> {
        let Some([mean, low, high]) = self.0.entry_time(shares) else {
            return Some(Remaining::until(&self.0.arrival(shares), elapsed));
        };
        Some(Remaining { mean, low, high })
    }

    fn state(&mut self, shares: Shares<'_>, later: f64) -> Option<Gaussian> {
        self.0.state(shares, later).map(Gaussian::from)
    }

    fn initial_state(&mut self, shares: Shares<'_>) -> Option<Gaussian> {
        self.0.initial_state(shares).map(Gaussian::from)
    }

    fn replan(&mut self, destinations: &Arc<Destinations>, _origin: Option<&[usize]>) {
        self.0.replan(targets(destinations));
    }

    fn apply(&mut self, learnt: &Learnt, keeps: bool) {
        self.0.apply(learnt);
        if keeps {
            self.0.keep_trail();
        }
    }

    fn learn(&mut self, chosen: usize, learnt: &mut Learnt) {
        self.0.learn(chosen, learnt);
    }

    fn lasting(&self) -> Lasting {
        self.0.course().lasting()
    }

    fn carry(&mut self, lasting: &Lasting) {
        self.0.carry(lasting);
    }

    fn save(&self) -> Value {
        let mut value = self.0.course().save();
        if let (Value::Map(entries), Some(trail)) = (&mut value, &self.0.trail) {
            entries.push(("trail".into(), trail.save()));
        }
        value
    }

    fn boxed(&self) -> Box<dyn Engine> {
        Box::new(self.clone())
    }
}

/// The destinations as targets, which hold for every movement among them.
fn targets(destinations: &Destinations) -> Arc<Targets> {
    destinations.kept(|| Targets::from(destinations))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::destination::Destination;

    #[test]
    fn targets_are_made_once_for_the_same_destinations() {
        let list = ["a", "b"].map(|id| Destination::new(id, [1.0, 2.0]).size(9.0));
        let destinations = Destinations::new(&list, 2, 4).unwrap();
        let found = targets(&destinations);
        assert!(Arc::ptr_eq(&found, &targets(&destinations)));
        let learnt = targets(&destinations.with_priors(vec![0.25, 0.75]));
        assert_eq!((found.priors(), learnt.priors()), (&[1.0, 1.0][..], &[0.25, 0.75][..]));
    }
}
