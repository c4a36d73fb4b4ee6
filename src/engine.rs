//! The trait of engines: what a predictor needs of one in the course of a movement, whichever family it is of.
//!
//! | engine | methods |
//! |---|---|
//! | [`likelihood::stepwise`](crate::likelihood::stepwise) | the papers', one destination and arrival time at a time |
//! | [`likelihood::pseudo_observation`](crate::likelihood::pseudo_observation) | `pseudoObservation`, all destinations at once |
//! | [`pointing::engine`](crate::pointing::engine) | `pointing` |
//!
//! A scenario begins its engine at the first observation (`scenario::begin`), and loads it from a snapshot. Times are seconds
//! since the first observation.

use crate::error::Result;
use crate::math::gaussian::Gaussian;
use crate::math::kalman::Measurement;
use crate::model::destination::Destinations;
use crate::model::learnt::Learnt;
use crate::model::observation::ObservationModel;
use crate::posterior::arrival_time::ArrivalTime;
use crate::posterior::remaining::Remaining;
use crate::posterior::{Posterior, Shares};
use crate::value::Value;
use nalgebra::DMatrix;
use std::fmt;
use std::sync::Arc;

/// One observation, checked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Observed<'a> {
    /// `t_k - t_1`.
    pub elapsed: f64,
    /// None marks a missing axis.
    pub position: &'a [Option<f64>],
    /// The covariance of all axes, those that are missing too.
    pub noise: &'a DMatrix<f64>,
    /// How the state is observed.
    pub model: &'a ObservationModel,
}

impl Observed<'_> {
    /// The axes that are there, as an observation of the state.
    ///
    /// # Errors
    /// Those of [`ObservationModel::measurement`].
    pub fn measurement(&self) -> Result<Measurement> {
        self.model.measurement(self.position, Some(self.noise))
    }
}

/// What of a movement outlasts it; zeros where nothing does.
pub(crate) type Lasting = [f64; 7];

/// An engine in the course of one movement.
pub(crate) trait Engine: Send + Sync {
    /// Takes in one more observation.
    ///
    /// # Errors
    /// `out-of-range`, `not-finite`, and those of the noise where the engine cannot use it; nothing has changed then.
    fn advance(&mut self, observed: &Observed<'_>) -> Result<()>;

    /// How many observations there were.
    fn observations(&self) -> u64;

    /// Whether every arrival node has passed, so that the probabilities stay as they are.
    fn expired(&self) -> bool {
        false
    }

    /// Liang (3): writes the probabilities of the destinations and of none of them, whose prior is `none`.
    fn probabilities(&mut self, none: f64, posterior: &mut Posterior);

    /// Writes `log p(y_2:k | y_1, D_i)`, marginalised over arrival time and noise.
    fn log_likelihoods(&mut self, into: &mut Vec<f64>);

    /// The posterior of the arrival time, mixed over destinations by their shares; none where they cannot be reached any more.
    fn arrival(&mut self, shares: Shares<'_>) -> Option<ArrivalTime>;

    /// The time to go from `elapsed`, that of the latest observation.
    fn remaining(&mut self, shares: Shares<'_>, elapsed: f64) -> Option<Remaining> {
        self.arrival(shares).map(|arrival| Remaining::until(&arrival, elapsed))
    }

    /// The state `later` seconds after the latest observation, given that the object goes to one of `shares`.
    fn state(&mut self, shares: Shares<'_>, later: f64) -> Option<Gaussian>;

    /// The state at the first observation, given all observations.
    fn initial_state(&mut self, shares: Shares<'_>) -> Option<Gaussian>;

    /// Other destinations in mid-movement; `origin` holds which old one each was, where the motion model depends on them.
    fn replan(&mut self, destinations: &Arc<Destinations>, origin: Option<&[usize]>);

    /// From now on this holds of the user, and with `keeps` a movement that begins keeps what [`Engine::learn`] needs. Only the pointing
    /// model knows users.
    fn apply(&mut self, _learnt: &Learnt, _keeps: bool) {}

    /// Learns, once a movement, that it goes to the destination at this place.
    fn learn(&mut self, _chosen: usize, _learnt: &mut Learnt) {}

    /// What outlasts the movement.
    fn lasting(&self) -> Lasting {
        Lasting::default()
    }

    /// Begins with what [`Engine::lasting`] of an earlier movement was.
    fn carry(&mut self, _lasting: &Lasting) {}

    /// What a snapshot keeps.
    fn save(&self) -> Value;

    /// A copy of its own.
    fn boxed(&self) -> Box<dyn Engine>;
}

// Not a supertrait: each engine's would be linked in for all that it holds, a twelfth of the WebAssembly.
impl fmt::Debug for dyn Engine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Engine")
    }
}

impl Clone for Box<dyn Engine> {
    fn clone(&self) -> Self {
        self.boxed()
    }
}
