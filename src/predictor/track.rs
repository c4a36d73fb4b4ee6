//! The movement that a predictor follows, under a method of the papers or under the pointing model.

use super::Remaining;
use crate::error::{Code, Error, Result};
use crate::likelihood::Method;
use crate::likelihood::candidates::Movement;
use crate::likelihood::plan::Plan;
use crate::likelihood::pseudo_observation::Telescoped;
use crate::math::gaussian::Gaussian;
use crate::model::destination::Destinations;
use crate::pointing::course::Course;
use crate::pointing::targets::Targets;
use crate::pointing::{Pointing, parameters::axis_variances};
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
    /// `pseudoObservation` where the motion model does not know the destination.
    Telescoped {
        now: Box<Telescoped>,
        /// As it was before every node had passed.
        before: Option<Box<Telescoped>>,
        /// The same densely, once something has been asked that the probabilities do not say.
        dense: Option<Box<(Movement, Option<Movement>)>>,
    },
    Pointing(Box<Pointing>),
}

/// One observation, checked.
pub(super) struct Observed<'a> {
    pub time: f64,
    pub position: &'a [Option<f64>],
    /// The covariance of all axes, those that are missing too.
    pub noise: &'a DMatrix<f64>,
}

impl Observed<'_> {
    /// The variances in each axis, where the noise of each that was observed is its own.
    fn variances(&self) -> Option<[f64; 3]> {
        let n = self.noise.nrows();
        let seen = |i: usize| self.position.get(i).is_some_and(Option::is_some);
        let apart = |i: usize, j: usize| self.noise[(i, j)] == 0.0 || !seen(i) || !seen(j);
        let own = n <= 3 && (0..n).all(|i| (0..i).all(|j| apart(i, j)));
        own.then(|| std::array::from_fn(|k| if k < n { self.noise[(k, k)] } else { 0.0 }))
    }
}

/// Whether the likelihoods are those of the telescoped form.
fn telescopes(scenario: &Scenario) -> bool {
    let method = matches!(scenario.engine, Engine::Papers { method: Method::PseudoObservation, .. });
    method && !scenario.motion.depends_on_destination()
}

impl Track {
    /// Begins at the first observation.
    pub(super) fn begin(scenario: &Scenario, destinations: &Destinations, observed: &Observed<'_>) -> Result<Self> {
        let measurement = scenario.observation.measurement(observed.position, Some(observed.noise))?;
        let posterior = scenario.initial.posterior(&scenario.observation, &measurement)?;
        let start = posterior.mean.as_slice()[..destinations.dimensions()].to_vec();
        let prior = scenario.initial.counted();
        let first = prior.cloned().unwrap_or(posterior);
        let followed = match &scenario.engine {
            Engine::Papers { method, arrival, quadrature } => {
                let plan = Plan::new(destinations, arrival, quadrature, &start);
                if telescopes(scenario) {
                    let separately = scenario.observation.is_position();
                    let mut now = Telescoped::begin(&scenario.motion, destinations, &plan, &first, separately);
                    if prior.is_some() {
                        now = now.before_first_observation();
                    }
                    Followed::Telescoped { now: Box::new(now), before: None, dense: None }
                } else {
                    let mut movement = Movement::begin(&scenario.motion, *method, destinations, plan, first);
                    if prior.is_some() {
                        movement = movement.before_first_observation();
                    }
                    Followed::Papers { movement, frozen: None }
                }
            }
            Engine::Pointing(parameters) => {
                let variances = axis_variances(observed.noise, "noise")?;
                let pointing = Pointing::begin(Arc::clone(parameters), targets(destinations), &start, &variances);
                Followed::Pointing(Box::new(pointing))
            }
        };
        let mut track = Self { first_time: observed.time, time: observed.time, start, followed };
        if prior.is_some() {
            track.advance(scenario, destinations, observed)?;
        }
        Ok(track)
    }

    fn elapsed(&self) -> f64 {
        match &self.followed {
            Followed::Papers { movement, .. } => movement.elapsed,
            Followed::Telescoped { now, .. } => now.elapsed(),
            Followed::Pointing(pointing) => pointing.course().elapsed,
        }
    }

    /// Whether every arrival node has passed.
    pub(super) const fn expired(&self) -> bool {
        matches!(self.followed, Followed::Papers { frozen: Some(_), .. } | Followed::Telescoped { before: Some(_), .. })
    }

    /// Takes in one more observation.
    pub(super) fn advance(
        &mut self,
        scenario: &Scenario,
        destinations: &Destinations,
        observed: &Observed<'_>,
    ) -> Result<()> {
        let elapsed = observed.time - self.first_time;
        let measurement = || scenario.observation.measurement(observed.position, Some(observed.noise));
        match &mut self.followed {
            Followed::Papers { movement, frozen, .. } => {
                let expires = frozen.is_none() && !movement.plan.is_alive(elapsed);
                let last = expires.then(|| Box::new(movement.clone()));
                movement.advance(destinations, elapsed, &measurement()?)?;
                if expires {
                    *frozen = last;
                }
            }
            Followed::Telescoped { now, before, dense, .. } => {
                let expires = before.is_none() && !now.is_alive(elapsed);
                let last = expires.then(|| now.clone());
                let separate = observed.variances().filter(|_| now.is_separable());
                if let Some(variances) = separate {
                    now.advance_separately(elapsed, observed.position, &variances);
                } else {
                    if now.is_separable()
                        && let Some(plan) = scenario.engine.plan(destinations, &self.start)
                    {
                        now.couple(destinations, &plan);
                    }
                    now.advance(elapsed, &measurement()?)?;
                }
                if expires {
                    *before = last;
                }
                *dense = None;
            }
            Followed::Pointing(pointing) => {
                pointing.advance(elapsed, observed.position, &axis_variances(observed.noise, "noise")?);
                let start = &pointing.course().start;
                self.start.iter_mut().zip(start).for_each(|(to, from)| *to = *from);
            }
        }
        self.time = observed.time;
        Ok(())
    }

    /// Brings the probabilities up to date.
    pub(super) fn update(&mut self, posterior: &mut Posterior, destinations: &Destinations, none: f64) {
        match &mut self.followed {
            Followed::Papers { movement, frozen, .. } => {
                posterior.update(frozen.as_deref().unwrap_or(movement), destinations, none);
            }
            Followed::Telescoped { now, before, .. } => {
                let believed = before.as_deref_mut().unwrap_or(now);
                match believed.probabilities(destinations, none, &mut posterior.probabilities) {
                    Some(none) => posterior.none = none,
                    None => posterior.believe_prior(destinations, none),
                }
            }
            Followed::Pointing(pointing) => posterior.none = pointing.posterior(none, &mut posterior.probabilities),
        }
    }

    /// Brings the log likelihoods up to date too.
    pub(super) fn log_likelihoods(&mut self, posterior: &mut Posterior, destinations: &Destinations) {
        match &mut self.followed {
            Followed::Papers { .. } => {}
            Followed::Telescoped { now, before, .. } => {
                let believed = before.as_deref_mut().unwrap_or(now);
                believed.log_likelihoods(destinations, &mut posterior.log_likelihoods);
            }
            Followed::Pointing(pointing) => pointing.log_likelihoods(&mut posterior.log_likelihoods),
        }
    }

    /// The movement, and as it was before every node had passed, for what the probabilities do not say; the posterior then
    /// holds the weights of all nodes.
    fn dense(
        &mut self,
        scenario: &Scenario,
        destinations: &Destinations,
        posterior: &mut Posterior,
    ) -> Option<(&Movement, &Movement)> {
        match &mut self.followed {
            Followed::Papers { movement, frozen, .. } => Some((movement, frozen.as_deref().unwrap_or(movement))),
            Followed::Telescoped { now, before, dense, .. } => {
                if dense.is_none() {
                    let both = densely(now, before.as_deref(), scenario, destinations, &self.start)?;
                    posterior.weigh_nodes(both.1.as_ref().unwrap_or(&both.0), destinations);
                    *dense = Some(Box::new(both));
                }
                let (movement, before) = dense.as_deref()?;
                Some((movement, before.as_ref().unwrap_or(movement)))
            }
            Followed::Pointing(_) => None,
        }
    }

    /// The posterior of the arrival time, in seconds since the first observation; none where nothing can be reached.
    pub(super) fn arrival(
        &mut self,
        scenario: &Scenario,
        posterior: &mut Posterior,
        destinations: &Destinations,
        only: Option<usize>,
    ) -> Option<Arrival> {
        if let Followed::Pointing(pointing) = &self.followed {
            return Some(pointing.arrival(&pointing.shares(&posterior.probabilities, only)));
        }
        let (_, believed) = self.dense(scenario, destinations, posterior)?;
        posterior.arrival(believed, &posterior.shares(destinations, only))
    }

    /// The time to go; none before the second observation and after every node has passed.
    pub(super) fn remaining(
        &mut self,
        scenario: &Scenario,
        posterior: &mut Posterior,
        destinations: &Destinations,
    ) -> Option<Remaining> {
        let elapsed = self.elapsed();
        let observations = match &self.followed {
            Followed::Papers { movement, .. } => movement.observations,
            Followed::Telescoped { now, .. } => now.observations(),
            Followed::Pointing(pointing) => pointing.course().observations,
        };
        if observations < 2 || self.expired() {
            return None;
        }
        if let Followed::Pointing(pointing) = &self.followed
            && let Some([mean, low, high]) = pointing.entry_time(&pointing.shares(&posterior.probabilities, None))
        {
            return Some(Remaining { mean, low, high });
        }
        let arrival = self.arrival(scenario, posterior, destinations, None)?;
        Some(Remaining {
            mean: arrival.mean - elapsed,
            low: arrival.quantile(0.1) - elapsed,
            high: arrival.quantile(0.9) - elapsed,
        })
    }

    /// The state `later` seconds after the latest observation, given one destination or any of them.
    pub(super) fn state(
        &mut self,
        scenario: &Scenario,
        posterior: &mut Posterior,
        destinations: &Destinations,
        later: f64,
        only: Option<usize>,
    ) -> Option<Gaussian> {
        if let Followed::Pointing(pointing) = &self.followed {
            return pointing.state(&pointing.shares(&posterior.probabilities, only), later);
        }
        let (movement, believed) = self.dense(scenario, destinations, posterior)?;
        posterior.state(believed, movement, destinations, &posterior.shares(destinations, only), later)
    }

    /// The smoothed state at the first observation.
    pub(super) fn initial_state(
        &mut self,
        scenario: &Scenario,
        posterior: &mut Posterior,
        destinations: &Destinations,
    ) -> Option<Gaussian> {
        if let Followed::Pointing(pointing) = &self.followed {
            return pointing.initial_state(&pointing.shares(&posterior.probabilities, None));
        }
        let (_, believed) = self.dense(scenario, destinations, posterior)?;
        posterior.initial_state(believed, &posterior.shares(destinations, None))
    }

    /// Other destinations in mid-movement; `origin` tells which old one each was, where the motion model knows them.
    pub(super) fn replan(&mut self, scenario: &Scenario, destinations: &Destinations, origin: Option<&[usize]>) {
        match &mut self.followed {
            Followed::Papers { movement, frozen, .. } => {
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
            Followed::Telescoped { now, before, dense, .. } => {
                let Some(plan) = scenario.engine.plan(destinations, &self.start) else { return };
                let separately = scenario.observation.is_position();
                now.replan(destinations, &plan, separately);
                *before = match before.take() {
                    _ if plan.is_alive(now.elapsed()) => None,
                    Some(mut before) => {
                        before.replan(destinations, &plan, separately);
                        Some(before)
                    }
                    None => Some(now.clone()),
                };
                *dense = None;
            }
            Followed::Pointing(pointing) => pointing.replan(targets(destinations)),
        }
    }

    /// What a snapshot keeps.
    pub(crate) fn save(&self, scenario: &Scenario, destinations: &Destinations) -> Value {
        let (movement, frozen) = match &self.followed {
            Followed::Telescoped { now, before, .. } => {
                densely(now, before.as_deref(), scenario, destinations, &self.start)
                    .map_or((Value::Null, Value::Null), |(movement, before)| {
                        (movement.save(), before.map_or(Value::Null, |before| before.save()))
                    })
            }
            Followed::Papers { movement, frozen, .. } => {
                (movement.save(), frozen.as_ref().map_or(Value::Null, |movement| movement.save()))
            }
            Followed::Pointing(pointing) => (pointing.course().save(), Value::Null),
        };
        let shifts = match &self.followed {
            Followed::Telescoped { now, before, .. } => {
                let before = before.as_ref().map_or([0.0; 2], |before| before.shifts());
                Value::exact_numbers(now.shifts().iter().chain(&before))
            }
            _ => Value::Null,
        };
        Value::map([
            ("shifts", shifts),
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
        let fields = node.fields(&["shifts", "firstTime", "time", "start", "movement", "frozen"])?;
        let start = fields.required("start")?.exact_numbers(destinations.dimensions())?;
        let saved = fields.required("movement")?;
        let followed = match &scenario.engine {
            Engine::Papers { method, arrival, quadrature } => {
                let load = |node: &Node<'_>| {
                    let plan = Plan::new(destinations, arrival, quadrature, &start);
                    let mut movement = Movement::load(node, &scenario.motion, *method, destinations, plan)?;
                    movement.first_counts = scenario.initial.counted().is_some();
                    Ok(movement)
                };
                let frozen = fields.optional("frozen").map(|frozen| load(&frozen).map(Box::new)).transpose()?;
                let movement = load(&saved)?;
                if telescopes(scenario) {
                    let shifts = fields.required("shifts")?.exact_numbers(4)?;
                    let resume = |movement: &Movement, shifts: [f64; 2]| {
                        let separately = scenario.observation.is_position();
                        let resumed = Telescoped::resume(&scenario.motion, destinations, movement, separately);
                        Box::new(resumed.with_shifts(shifts))
                    };
                    let before = frozen.as_deref().map(|before| resume(before, [shifts[2], shifts[3]]));
                    Followed::Telescoped { now: resume(&movement, [shifts[0], shifts[1]]), before, dense: None }
                } else {
                    Followed::Papers { movement, frozen }
                }
            }
            Engine::Pointing(parameters) => {
                if fields.optional("frozen").is_some() {
                    return Err(Error::new(Code::UnknownKey, "frozen", "has no place with the method \"pointing\""));
                }
                let course = Course::load(&saved, destinations.dimensions())?;
                Followed::Pointing(Box::new(Pointing::resume(Arc::clone(parameters), targets(destinations), course)))
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

fn targets(destinations: &Destinations) -> Arc<Targets> {
    Arc::new(Targets::from(destinations))
}

/// What [`Followed::Telescoped`] follows, as the dense engines have it.
fn densely(
    now: &Telescoped,
    before: Option<&Telescoped>,
    scenario: &Scenario,
    destinations: &Destinations,
    start: &[f64],
) -> Option<(Movement, Option<Movement>)> {
    let movement = |telescoped: &Telescoped| {
        telescoped.movement(&scenario.motion, destinations, scenario.engine.plan(destinations, start)?)
    };
    Some((movement(now)?, before.and_then(movement)))
}
