//! The predictor: observations in, posteriors out.

mod edit;
mod form;
mod movement;
#[cfg(feature = "wasm")]
mod size;

use crate::engine::Lasting;
use crate::error::{Code, Error, Result};
use crate::math::gaussian::Gaussian;
use crate::model::destination::Destinations;
use crate::model::habits::Habits;
use crate::model::learnt::Learnt;
use crate::model::observation::ObservationNoise;
use crate::posterior::arrival_time::ArrivalTime;
use crate::posterior::remaining::Remaining;
use crate::posterior::{Best, Posterior};
use crate::scenario::Scenario;
use crate::value::{Path, number};
pub(crate) use movement::Movement;
use std::sync::Arc;

/// Predicts where one moving thing is going.
///
/// ```
/// use whither::{Predictor, Scenario};
/// let scenario: Scenario = serde_json::from_str(r#"{
///     "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 3000 },
///     "observation": { "noise": 1.5 },
///     "arrival": { "type": "horizon", "from": 0.05, "to": 0.5 },
///     "destinations": [
///         { "id": "left", "center": [0, 200], "size": [80, 80] },
///         { "id": "right", "center": [600, 200], "size": [80, 80] }
///     ]
/// }"#).unwrap();
/// let mut predictor = Predictor::new(&scenario);
/// for k in 0..10 {
///     let t = 0.016 * f64::from(k);
///     predictor.observe(t, &[300.0 + 900.0 * t, 200.0]).unwrap();
/// }
/// let best = predictor.best().unwrap();
/// assert_eq!(best.id, "right");
/// assert!(best.probability > 0.9);
/// ```
#[derive(Clone, Debug)]
pub struct Predictor {
    pub(crate) scenario: Arc<Scenario>,
    pub(crate) destinations: Arc<Destinations>,
    pub(crate) movement: Option<Movement>,
    pub(crate) habits: Habits,
    /// What was learnt of the user; none of a new one.
    learnt: Option<Box<Learnt>>,
    /// What outlasted the movements before.
    pub(crate) lasting: Lasting,
    posterior: Posterior,
    log_likelihoods: Vec<f64>,
    /// Whether the posterior is that of an earlier state.
    stale: bool,
}

impl Predictor {
    /// A predictor before its first observation.
    #[must_use]
    pub fn new(scenario: &Scenario) -> Self {
        Self::with_movement(Arc::new(scenario.clone()), Arc::clone(&scenario.destinations), None)
    }

    pub(crate) fn with_movement(
        scenario: Arc<Scenario>,
        destinations: Arc<Destinations>,
        movement: Option<Movement>,
    ) -> Self {
        Self {
            scenario,
            destinations,
            movement,
            habits: Habits::default(),
            learnt: None,
            lasting: Lasting::default(),
            posterior: Posterior::default(),
            log_likelihoods: Vec::new(),
            stale: true,
        }
    }

    /// Takes one observation in: `time` in seconds on any clock, `position` with one number for each axis. The first one
    /// begins the movement. An equal time is legal: with the method `pointing` the observation replaces the last one, in the axes
    /// that it has, and at the first time the movement begins with it, since rounded clocks and events stamped by the frame give
    /// several places one time; the methods of the papers count it as an observation of its own.
    ///
    /// # Errors
    /// `time-not-increasing`, `wrong-length`, `not-finite`; `out-of-range` for a position beyond 1e50 or a time more than
    /// 1e12 s after the first; nothing has changed then.
    pub fn observe(&mut self, time: f64, position: &[f64]) -> Result<()> {
        match *position {
            [x, y] => self.observe_with(time, &[Some(x), Some(y)], None),
            [x, y, z] => self.observe_with(time, &[Some(x), Some(y), Some(z)], None),
            _ => self.observe_with(time, &position.iter().map(|&x| Some(x)).collect::<Vec<_>>(), None),
        }
    }

    /// As [`Predictor::observe`]; none marks a missing axis, and `noise` (a deviation, one for each axis, or a covariance)
    /// replaces the scenario's for this observation.
    ///
    /// # Errors
    /// As [`Predictor::observe`], and those of the scenario's `observation.noise`.
    pub fn observe_with(
        &mut self,
        time: f64,
        position: &[Option<f64>],
        noise: Option<&ObservationNoise>,
    ) -> Result<()> {
        check_time("time", time)?;
        let model = &self.scenario.observation;
        let noise = noise.map(|noise| noise.check(&Path::root("noise"), model.axes())).transpose()?;
        model.check(position)?;
        let noise = noise.as_ref().unwrap_or_else(|| model.noise());
        let Some(movement) = &mut self.movement else {
            let mut movement = Movement::begin(&self.scenario, &self.destinations, time, position, noise)?;
            movement.engine.apply(&self.learnt(), self.scenario.learning.is_some());
            movement.engine.carry(&self.lasting);
            self.movement = Some(movement);
            self.stale = true;
            return Ok(());
        };
        movement.advance(&self.scenario, time, position, noise)?;
        self.stale |= !movement.engine.expired();
        Ok(())
    }

    fn refresh(&mut self) {
        if !std::mem::take(&mut self.stale) {
            return;
        }
        let none = self.scenario.none;
        match &mut self.movement {
            Some(movement) => movement.engine.probabilities(none, &mut self.posterior),
            None => self.posterior.set_to_prior(self.destinations.priors(), none),
        }
    }

    /// How many destinations there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.destinations.len()
    }

    /// Never true: the last destination cannot be removed.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.destinations.is_empty()
    }

    /// Spatial dimensions `d`.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.scenario.motion.dimensions()
    }

    /// Components `s` of the state: positions, then velocities, then accelerations.
    #[must_use]
    pub fn states(&self) -> usize {
        self.scenario.motion.states()
    }

    /// Components of one observation.
    #[must_use]
    pub fn axes(&self) -> usize {
        self.scenario.observation.axes()
    }

    /// The scenario.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The ids of the destinations, in order.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = &str> {
        self.destinations.ids()
    }

    /// The place of a destination in the order.
    ///
    /// # Errors
    /// `unknown-id`.
    pub fn index_of(&self, id: &str) -> Result<usize> {
        self.destinations.index_of(id)
    }

    /// `p(D_i | y_1:k)` for each destination, in order, Liang (3); they sum to `1 - none`. Before the first observation, and
    /// after it alone unless its evidence counts (`initial.evidence`), they are the priors. Of 4096 destinations and
    /// more, `pseudoObservation` gives 0 for those that together have less than 1e-14.
    pub fn probabilities(&mut self) -> &[f64] {
        self.refresh();
        &self.posterior.probabilities
    }

    /// The probability that the object is going to none of the destinations.
    pub fn none(&mut self) -> f64 {
        self.refresh();
        self.posterior.none
    }

    /// The most probable destination; none before the first observation.
    pub fn best(&mut self) -> Option<Best> {
        self.movement.as_ref()?;
        self.refresh();
        let index = self.posterior.best();
        let probability = self.posterior.probabilities[index];
        Some(Best { index, id: self.destinations.id(index).to_owned(), probability })
    }

    /// `log p(y_2:k | y_1, D_i)`, marginalised over the arrival time, Liang (6), and the noise candidates; `log p(y_1:k | D_i)`
    /// where the first observation's evidence counts (`initial.evidence`).
    pub fn log_likelihoods(&mut self) -> &[f64] {
        match &mut self.movement {
            Some(movement) => movement.engine.log_likelihoods(&mut self.log_likelihoods),
            None => {
                self.log_likelihoods.clear();
                self.log_likelihoods.resize(self.destinations.len(), 0.0);
            }
        }
        &self.log_likelihoods
    }

    /// Whether every arrival node has passed; the probabilities stay as they last were.
    #[must_use]
    pub fn expired(&self) -> bool {
        self.movement.as_ref().is_some_and(|movement| movement.engine.expired())
    }

    /// The posterior of the arrival time on the caller's clock, for one destination or mixed over all of them; none before
    /// the first observation, and where every node of it has passed while others have not.
    ///
    /// # Errors
    /// `unknown-id`.
    pub fn arrival(&mut self, id: Option<&str>) -> Result<Option<ArrivalTime>> {
        let only = id.map(|id| self.destinations.index_of(id)).transpose()?;
        self.refresh();
        let Self { movement, posterior, destinations, .. } = self;
        Ok(movement.as_mut().and_then(|movement| movement.arrival(posterior, destinations.priors(), only)))
    }

    /// The time to go and an interval, from the posterior of the arrival time; none before the second observation and after every
    /// node has passed.
    pub fn remaining(&mut self) -> Option<Remaining> {
        self.refresh();
        self.movement.as_mut()?.remaining(&self.posterior, self.destinations.priors())
    }

    /// The state now, given that the object is going to one of the destinations; none before the first observation. Each method
    /// answers by its own family: Liang (10) where the endpoint is a pseudo-observation (and for `singleFilterApproximate`, whose
    /// integrand is the same), the bridged posterior for `bridging` and `singleFilter`.
    pub fn state(&mut self) -> Option<Gaussian> {
        self.state_after(0.0, None)
    }

    /// The state at the first observation given all of them, `p(x_1 | y_1:k)`; none before the first observation.
    pub fn initial_state(&mut self) -> Option<Gaussian> {
        self.refresh();
        self.movement.as_mut()?.initial_state(&self.posterior, self.destinations.priors())
    }

    /// The state at `time`, which is the last observation's or later, by the method's own family as [`Predictor::state`]; none
    /// before the first observation.
    ///
    /// # Errors
    /// `not-finite`, `out-of-range`.
    pub fn forecast(&mut self, time: f64) -> Result<Option<Gaussian>> {
        let later = self.after_last("time", time)?;
        Ok(later.and_then(|later| self.state_after(later, None)))
    }

    /// The expected positions on the way to one destination, `d` numbers for each of `times`, none of which may lie before
    /// the last observation; empty before the first observation.
    ///
    /// # Errors
    /// `unknown-id`, `not-finite`, `out-of-range`.
    pub fn path(&mut self, id: &str, times: &[f64]) -> Result<Vec<f64>> {
        let only = self.destinations.index_of(id)?;
        let mut path = Vec::with_capacity(times.len() * self.dimensions());
        for (i, &time) in times.iter().enumerate() {
            let later = self.after_last(&format!("times[{i}]"), time)?;
            let state =
                later.and_then(|later| self.state_after(later, Some(only)).or_else(|| self.state_after(later, None)));
            if let Some(state) = state {
                path.extend(state.mean.iter().take(self.dimensions()));
            }
        }
        Ok(path)
    }

    fn after_last(&self, path: &str, time: f64) -> Result<Option<f64>> {
        check_time(path, time)?;
        self.movement.as_ref().map(|movement| movement.after_last(path, time)).transpose()
    }

    fn state_after(&mut self, later: f64, only: Option<usize>) -> Option<Gaussian> {
        self.refresh();
        self.movement.as_mut()?.state(&self.posterior, self.destinations.priors(), later, only)
    }

    /// Forgets the movement but for how much the hand shakes, where that is followed; the next observation begins a new one with the same scenario and destinations.
    pub fn reset(&mut self) {
        if let Some(movement) = self.movement.take() {
            self.lasting = movement.engine.lasting();
        }
        self.stale = true;
    }

    /// Records what was selected in the end: learnt from where the scenario asks for `learning`, without effect where it does not.
    /// What is learnt holds from now on, for this movement and the ones after it: priors ([`Learning`](crate::Learning)), and with the
    /// method `pointing` how far the model holds for the user ([`Predictor::learnt`]). For the latter the movement up to the last entry
    /// into the destination counts, once: a second choice before [`Predictor::reset`] teaches priors alone. Where something was chosen
    /// by other means than this movement, reset before.
    ///
    /// # Errors
    /// `unknown-id`.
    pub fn chosen(&mut self, id: &str) -> Result<()> {
        let place = self.destinations.index_of(id)?;
        if let Some(learning) = &self.scenario.learning {
            let mut learnt = self.learnt();
            if let Some(movement) = &mut self.movement {
                movement.engine.learn(place, &mut learnt);
            }
            self.learnt = kept(learnt);
            self.habits.chosen(learning, id);
            self.apply_habits();
        }
        Ok(())
    }

    /// What the outcomes of movements have taught about the user, by [`Predictor::chosen`] or set by [`Predictor::set_learnt`].
    #[must_use]
    pub fn learnt(&self) -> Learnt {
        self.learnt.as_deref().copied().unwrap_or_default()
    }

    /// Goes on with what was learnt before, or by another predictor; with [`Learnt::default`] it is forgotten. The counts of choices
    /// stay. It holds at once, in mid-movement too, with the method `pointing`; others have no use for it.
    ///
    /// # Errors
    /// `not-finite`, `out-of-range`; nothing has changed then.
    pub fn set_learnt(&mut self, learnt: Learnt) -> Result<()> {
        self.apply_learnt(learnt.check(&Path::root("learnt"))?);
        Ok(())
    }

    /// The same for numbers that were checked before.
    pub(crate) fn apply_learnt(&mut self, learnt: Learnt) {
        self.learnt = kept(learnt);
        if let Some(movement) = &mut self.movement {
            movement.engine.apply(&learnt, false);
        }
        self.stale = true;
    }

    /// Puts the priors that were learnt in force, in mid-movement too.
    pub(crate) fn apply_habits(&mut self) {
        self.put_in_force(Destinations::clone(&self.destinations), None);
    }

    /// Puts destinations in force, with the priors that were learnt for them, in mid-movement too; `origin` as in
    /// [`Engine::replan`](crate::engine::Engine::replan).
    fn put_in_force(&mut self, destinations: Destinations, origin: Option<&[usize]>) {
        let destinations = match &self.scenario.learning {
            Some(learning) => {
                let priors = self.habits.priors(learning, &destinations);
                destinations.with_priors(priors)
            }
            None => destinations,
        };
        self.destinations = Arc::new(destinations);
        if let Some(movement) = &mut self.movement {
            movement.engine.replan(&self.destinations, origin);
        }
        self.stale = true;
    }
}

/// What was learnt of a user, none of a new one.
fn kept(learnt: Learnt) -> Option<Box<Learnt>> {
    (learnt != Learnt::default()).then(|| Box::new(learnt))
}

fn check_time(path: &str, time: f64) -> Result<()> {
    if time.is_finite() {
        return Ok(());
    }
    Err(Error::new(Code::NotFinite, path, format!("must be a finite number, got {}", number(time))))
}
