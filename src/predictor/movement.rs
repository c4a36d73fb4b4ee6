//! The movement that a predictor follows: the caller's clock, and the engine.

use crate::engine::{Engine, Observed};
use crate::error::{Code, Error, Result};
use crate::math::gaussian::Gaussian;
use crate::model::arrival::MAX_TIME;
use crate::model::destination::Destinations;
use crate::posterior::arrival_time::ArrivalTime;
use crate::posterior::remaining::Remaining;
use crate::posterior::{Posterior, shares};
use crate::scenario::Scenario;
use crate::value::{Node, Value, number};
use nalgebra::DMatrix;
use std::sync::Arc;

/// The movement that is going on.
#[derive(Clone, Debug)]
pub(crate) struct Movement {
    /// `t_1` on the caller's clock.
    pub first_time: f64,
    /// `t_k` on the caller's clock.
    pub time: f64,
    /// What computes its posterior.
    pub engine: Box<dyn Engine>,
}

impl Movement {
    /// Begins at the first observation.
    ///
    /// # Errors
    /// As [`Scenario::begin`].
    pub fn begin(
        scenario: &Scenario,
        destinations: &Arc<Destinations>,
        time: f64,
        position: &[Option<f64>],
        noise: &DMatrix<f64>,
    ) -> Result<Self> {
        let first = Observed { elapsed: 0.0, position, noise, model: &scenario.observation };
        Ok(Self { first_time: time, time, engine: scenario.begin(destinations, &first)? })
    }

    /// Takes in one more observation.
    ///
    /// # Errors
    /// `time-not-increasing`, `out-of-range`, and as [`Engine::advance`].
    pub fn advance(
        &mut self,
        scenario: &Scenario,
        time: f64,
        position: &[Option<f64>],
        noise: &DMatrix<f64>,
    ) -> Result<()> {
        if time < self.time {
            let last = number(self.time);
            let message = format!("must be at least the last observation's, {last}, got {}", number(time));
            return Err(Error::new(Code::TimeNotIncreasing, "time", message));
        }
        let elapsed = time - self.first_time;
        if elapsed > MAX_TIME {
            let first = number(self.first_time);
            let message =
                format!("must be at most 1e12 seconds after the first observation's, {first}, got {}", number(time));
            return Err(Error::new(Code::OutOfRange, "time", message));
        }
        self.engine.advance(&Observed { elapsed, position, noise, model: &scenario.observation })?;
        self.time = time;
        Ok(())
    }

    /// How long after the latest observation `time` is; `path` names it in errors.
    ///
    /// # Errors
    /// `out-of-range`.
    pub fn after_last(&self, path: &str, time: f64) -> Result<f64> {
        let later = time - self.time;
        if time < self.time {
            let last = number(self.time);
            let message = format!("must be at least the last observation's time, {last}, got {}", number(time));
            return Err(Error::new(Code::OutOfRange, path, message));
        }
        if later > MAX_TIME {
            let message = format!("must be at most 1e12 seconds after the last observation, got {}", number(time));
            return Err(Error::new(Code::OutOfRange, path, message));
        }
        Ok(later)
    }

    /// The posterior of the arrival time on the caller's clock; none where nothing can be reached.
    pub fn arrival(&mut self, posterior: &Posterior, priors: &[f64], only: Option<usize>) -> Option<ArrivalTime> {
        let shares = self.shares(posterior, priors, only);
        let mut arrival = self.engine.arrival(&shares)?;
        arrival.times.iter_mut().for_each(|time| *time += self.first_time);
        arrival.mean += self.first_time;
        Some(arrival)
    }

    /// The time to go; none before the second observation and after every node has passed.
    pub fn remaining(&mut self, posterior: &Posterior, priors: &[f64]) -> Option<Remaining> {
        if self.engine.observations() < 2 || self.engine.expired() {
            return None;
        }
        let shares = self.shares(posterior, priors, None);
        self.engine.remaining(&shares, self.time - self.first_time)
    }

    /// The state `later` seconds after the latest observation, given one destination or any of them.
    pub fn state(
        &mut self,
        posterior: &Posterior,
        priors: &[f64],
        later: f64,
        only: Option<usize>,
    ) -> Option<Gaussian> {
        let shares = self.shares(posterior, priors, only);
        self.engine.state(&shares, later)
    }

    /// The smoothed state at the first observation.
    pub fn initial_state(&mut self, posterior: &Posterior, priors: &[f64]) -> Option<Gaussian> {
        let shares = self.shares(posterior, priors, None);
        self.engine.initial_state(&shares)
    }

    /// The destinations with their shares of the probability that is not none, or one of them alone.
    fn shares(&mut self, posterior: &Posterior, priors: &[f64], only: Option<usize>) -> Vec<(usize, f64)> {
        shares::beside_none(&posterior.probabilities, priors, only, || {
            let mut log_likelihoods = Vec::new();
            self.engine.log_likelihoods(&mut log_likelihoods);
            log_likelihoods
        })
    }

    /// What a snapshot keeps.
    pub fn save(&self) -> Value {
        Value::map([
            ("firstTime", Value::exact(self.first_time)),
            ("time", Value::exact(self.time)),
            ("engine", self.engine.save()),
        ])
    }

    /// The movement that [`Movement::save`] wrote.
    ///
    /// # Errors
    /// Those of reading a value.
    pub fn load(node: &Node<'_>, scenario: &Scenario, destinations: &Arc<Destinations>) -> Result<Self> {
        let fields = node.fields(&["firstTime", "time", "engine"])?;
        Ok(Self {
            first_time: fields.required("firstTime")?.exact()?,
            time: fields.required("time")?.exact()?,
            engine: scenario.load(destinations, &fields.required("engine")?)?,
        })
    }
}
