//! The movement that a predictor follows, under a method of the papers or under the pointing model.

use super::Remaining;
use crate::error::{Code, Error, Result};
use crate::likelihood::candidates::Movement;
use crate::likelihood::plan::Plan;
use crate::likelihood::pointing::course::Course;
use crate::likelihood::pointing::{Pointing, parameters::axis_variances};
use crate::math::gaussian::Gaussian;
use crate::math::kalman::Measurement;
use crate::model::destination::Destinations;
use crate::posterior::Posterior;
use crate::posterior::arrival_time::Arrival;
use crate::scenario::{Engine, Scenario};
use crate::value::{Node, Value};
use nalgebra::DMatrix;
use std::sync::Arc;

/// The movement that is going on.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// `t_1` on the caller's clock.
    pub first_time: f64,
    /// `t_k` on the caller's clock.
    pub time: f64,
    /// The first position, or the prior's where it was not observed.
    pub start: Vec<f64>,
    followed: Followed,
}

#[derive(Clone, Debug)]
enum Followed {
    Papers {
        movement: Movement,
        /// The movement before every node had passed: what the probabilities stay at.
        frozen: Option<Box<Movement>>,
    },
    Pointing(Box<Pointing>),
}

/// One observation, checked.
pub(super) struct Observed<'a> {
    pub time: f64,
    pub position: &'a [Option<f64>],
    pub measurement: &'a Measurement,
    /// The covariance of all axes, those that are missing too.
    pub noise: &'a DMatrix<f64>,
}

impl Track {
    /// Begins at the first observation.
    pub(super) fn begin(scenario: &Scenario, destinations: &Destinations, observed: &Observed<'_>) -> Result<Self> {
        let first = scenario.initial.posterior(&scenario.observation, observed.measurement)?;
        let start = first.mean.as_slice()[..destinations.dimensions()].to_vec();
        let followed = match &scenario.engine {
            Engine::Papers { method, arrival, quadrature } => {
                let plan = Plan::new(destinations, arrival, quadrature, &start);
                let movement = Movement::begin(&scenario.motion, *method, destinations, plan, first);
                Followed::Papers { movement, frozen: None }
            }
            Engine::Pointing(parameters) => {
                let variances = axis_variances(observed.noise, "noise")?;
                let pointing = Pointing::begin(Arc::clone(parameters), destinations, &start, &variances);
                Followed::Pointing(Box::new(pointing))
            }
        };
        Ok(Self { first_time: observed.time, time: observed.time, start, followed })
    }

    fn elapsed(&self) -> f64 {
        match &self.followed {
            Followed::Papers { movement, .. } => movement.elapsed,
            Followed::Pointing(pointing) => pointing.course().elapsed,
        }
    }

    /// Whether every arrival node has passed.
    pub(super) const fn expired(&self) -> bool {
        matches!(self.followed, Followed::Papers { frozen: Some(_), .. })
    }

    /// Takes in one more observation.
    pub(super) fn advance(&mut self, destinations: &Destinations, observed: &Observed<'_>) -> Result<()> {
        let elapsed = observed.time - self.first_time;
        match &mut self.followed {
            Followed::Papers { movement, frozen } => {
                let expires = frozen.is_none() && !movement.plan.is_alive(elapsed);
                let before = expires.then(|| Box::new(movement.clone()));
                movement.advance(destinations, elapsed, observed.measurement)?;
                if expires {
                    *frozen = before;
                }
            }
            Followed::Pointing(pointing) => {
                pointing.advance(elapsed, observed.position, &axis_variances(observed.noise, "noise")?);
            }
        }
        self.time = observed.time;
        Ok(())
    }

    /// Brings the posterior up to date.
    pub(super) fn update(&mut self, posterior: &mut Posterior, destinations: &Destinations, none: f64) {
        match &mut self.followed {
            Followed::Papers { movement, frozen } => {
                posterior.update(frozen.as_deref().unwrap_or(movement), destinations, none);
            }
            Followed::Pointing(pointing) => posterior.update_pointing(pointing, destinations, none),
        }
    }

    /// The posterior of the arrival time, in seconds since the first observation; none where nothing can be reached.
    pub(super) fn arrival(
        &self,
        posterior: &Posterior,
        destinations: &Destinations,
        only: Option<usize>,
    ) -> Option<Arrival> {
        let shares = posterior.shares(destinations, only);
        match &self.followed {
            Followed::Papers { movement, frozen } => posterior.arrival(frozen.as_deref().unwrap_or(movement), &shares),
            Followed::Pointing(pointing) => Some(pointing.arrival(destinations, &shares)),
        }
    }

    /// The time to go; none before the second observation and after every node has passed.
    pub(super) fn remaining(&self, posterior: &Posterior, destinations: &Destinations) -> Option<Remaining> {
        let elapsed = self.elapsed();
        let observations = match &self.followed {
            Followed::Papers { movement, .. } => movement.observations,
            Followed::Pointing(pointing) => pointing.course().observations,
        };
        if observations < 2 || self.expired() {
            return None;
        }
        let arrival = self.arrival(posterior, destinations, None)?;
        Some(Remaining {
            mean: arrival.mean - elapsed,
            low: arrival.quantile(0.1) - elapsed,
            high: arrival.quantile(0.9) - elapsed,
        })
    }

    /// The state `later` seconds after the latest observation, given one destination or any of them.
    pub(super) fn state(
        &self,
        posterior: &Posterior,
        destinations: &Destinations,
        later: f64,
        only: Option<usize>,
    ) -> Option<Gaussian> {
        let shares = posterior.shares(destinations, only);
        match &self.followed {
            Followed::Papers { movement, frozen } => {
                posterior.state(frozen.as_deref().unwrap_or(movement), movement, destinations, &shares, later)
            }
            Followed::Pointing(pointing) => Some(pointing.state(destinations, &shares, later)),
        }
    }

    /// The smoothed state at the first observation.
    pub(super) fn initial_state(&self, posterior: &Posterior, destinations: &Destinations) -> Option<Gaussian> {
        let shares = posterior.shares(destinations, None);
        match &self.followed {
            Followed::Papers { movement, frozen } => {
                posterior.initial_state(frozen.as_deref().unwrap_or(movement), &shares)
            }
            Followed::Pointing(pointing) => Some(pointing.initial_state(destinations, &shares)),
        }
    }

    /// Other destinations in mid-movement; `origin` tells which old one each was, where the motion model knows them.
    pub(super) fn replan(&mut self, scenario: &Scenario, destinations: &Destinations, origin: Option<&[usize]>) {
        match &mut self.followed {
            Followed::Papers { movement, frozen } => {
                let Some(plan) = scenario.engine.plan(destinations, &self.start) else { return };
                let alive = plan.is_alive(movement.elapsed);
                movement.replan(plan.clone(), origin);
                *frozen = match frozen.take() {
                    _ if alive => None,
                    Some(mut before) => {
                        before.replan(plan, origin);
                        Some(before)
                    }
                    None => Some(Box::new(movement.clone())),
                };
            }
            Followed::Pointing(pointing) => pointing.replan(destinations),
        }
    }

    /// What a snapshot keeps.
    pub(crate) fn save(&self) -> Value {
        let (movement, frozen) = match &self.followed {
            Followed::Papers { movement, frozen } => {
                (movement.save(), frozen.as_ref().map_or(Value::Null, |movement| movement.save()))
            }
            Followed::Pointing(pointing) => (pointing.course().save(), Value::Null),
        };
        Value::map([
            ("firstTime", Value::exact(self.first_time)),
            ("time", Value::exact(self.time)),
            ("start", Value::exact_numbers(&self.start)),
            ("movement", movement),
            ("frozen", frozen),
        ])
    }

    /// The track that [`Track::save`] wrote.
    ///
    /// # Errors
    /// Those of reading a value.
    pub(crate) fn load(node: &Node<'_>, scenario: &Scenario, destinations: &Destinations) -> Result<Self> {
        let fields = node.fields(&["firstTime", "time", "start", "movement", "frozen"])?;
        let start = fields.required("start")?.exact_numbers(destinations.dimensions())?;
        let saved = fields.required("movement")?;
        let followed = match &scenario.engine {
            Engine::Papers { method, arrival, quadrature } => {
                let load = |node: &Node<'_>| {
                    let plan = Plan::new(destinations, arrival, quadrature, &start);
                    Movement::load(node, &scenario.motion, *method, destinations, plan)
                };
                let frozen = fields.optional("frozen").map(|frozen| load(&frozen).map(Box::new)).transpose()?;
                Followed::Papers { movement: load(&saved)?, frozen }
            }
            Engine::Pointing(parameters) => {
                if fields.optional("frozen").is_some() {
                    return Err(Error::new(Code::UnknownKey, "frozen", "has no place with the method \"pointing\""));
                }
                let course = Course::load(&saved, destinations.dimensions())?;
                Followed::Pointing(Box::new(Pointing::resume(Arc::clone(parameters), destinations, course)))
            }
        };
        Ok(Self {
            first_time: fields.required("firstTime")?.exact()?,
            time: fields.required("time")?.exact()?,
            start,
            followed,
        })
    }
}
