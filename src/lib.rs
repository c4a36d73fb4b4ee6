//! Whither ("to which place") predicts where a moving thing is heading while it is still on its way: which on-screen icon a
//! pointer goes to, which harbour a vessel, which airport an aircraft.
//!
//! # The problem
//!
//! Something moves. Its motion is linear, Gaussian and time-invariant, `dx = (A x + b + B c) dt + dw`, `E[dw dw'] = W dt`;
//! its position is observed with noise, at any times. It will arrive at one of `N` destinations, each a Gaussian over the
//! endpoint `G~ x_T ~ N(a_i, S_i)`, at an unknown time `T`. Wanted after every observation: `p(D_i | y_1:k)`, and also
//! `p(T | y_1:k)`, the state now, later and at the start, and the probability that it goes to none of them.
//!
//! # Start here
//!
//! A [`Scenario`] is how the object moves, how it is observed, where it may go and when it may arrive, built from types and
//! validated at once; a [`Predictor`] takes observations and answers.
//!
//! ```
//! use whither::{Arrival, Destination, Initial, Motion, Observation, Predictor, Scenario};
//!
//! let scenario = Scenario::builder(Motion::constant_velocity(2, 0.3), Observation::deviation(5.0))
//!     .initial(Initial::velocity(8.0))
//!     .arrival(Arrival::uniform(1200.0, 3600.0))
//!     .none(0.05)
//!     .destination(Destination::new("Cowes", [9000.0, 0.0]).size(400.0))
//!     .destination(Destination::new("Portsmouth", [14000.0, 8000.0]).size(400.0))
//!     .build()?;
//! let mut vessel = Predictor::new(&scenario);
//! for minute in 0..10 {
//!     let t = 60.0 * f64::from(minute);
//!     vessel.observe(t, &[6.0 * t, 0.1 * t])?;
//! }
//! assert_eq!(vessel.best().unwrap().id, "Cowes");
//! assert!(vessel.arrival(None)?.unwrap().mean < 2600.0);
//! # Ok::<(), whither::Error>(())
//! ```
//!
//! The same scenario as JSON, or in any other format of serde's:
//!
//! ```
//! let scenario: whither::Scenario = serde_json::from_str(r#"{
//!     "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 0.3 }, "observation": { "noise": 5 },
//!     "initial": { "velocity": 8 }, "arrival": { "type": "uniform", "from": 1200, "to": 3600 }, "none": 0.05,
//!     "destinations": [
//!         { "id": "Cowes", "center": [9000, 0], "size": 400 },
//!         { "id": "Portsmouth", "center": [14000, 8000], "size": 400 }
//!     ]
//! }"#)?;
//! # let _ = scenario;
//! # Ok::<(), serde_json::Error>(())
//! ```
//!
//! Pointers on a screen have [`pointer_scenario`], rays [`ray_scenario`], hands in space [`hand_scenario`], movements between places that are known [`ConditionallyMarkovSequence`], recorded
//! movements [`study`].
//!
//! # Features
//!
//! | feature | what | by default |
//! |---|---|---|
//! | `fit` | [`study`]'s learning of a scenario's constants from recorded movements | off |
//! | `wasm`, `wasm-fit`, `wasm-pointing` | the classes of the npm package, for its own build | off |
//!
//! # Units
//!
//! Seconds for time; any unit of length, the same everywhere (pixels on a page). Deviations, not variances, where one number
//! stands for noise. Matrices are lists of rows. The state has all positions, then all velocities, then all accelerations.
//! `d` is the number of axes (1 to 3), `s` the number of state components, `l <= s` that of an endpoint.
//!
//! # Words
//!
//! | word | meaning |
//! |---|---|
//! | destination | one of the nominal places the object may go to |
//! | endpoint | the first `l` components of the state on arrival, `G~ x_T`, and its density for a destination |
//! | arrival time | `T`, when the object is at its destination; *time to go* is `T - t_k` |
//! | observation | a noisy position (or any linear function of the state) at a time |
//! | motion model | how the state moves without regard to the endpoint |
//! | scenario | the complete configuration |
//! | track | one recorded movement |
//! | predictor | everything that turns observations into answers, as in the papers (in Stone Soup the word means the time update) |
//! | prediction error | an observation less its prediction; its density is Liang's PED |
//! | evidence | the density of what was observed, `p(y_2:k given y_1)`, or `p(y_1:k)` where the scenario counts the first observation |
//! | posterior | the probabilities given the observations |
//!
//! # Where each equation is
//!
//! *Liang*: "On Destination Prediction Based on Markov Bridging Distributions", 2019. *Ardeshiri*: "Efficient Bridging-Based
//! Destination Inference in Object Tracking", 2017. *Rezaie and Li*: "Destination-Directed Trajectory Modeling and Prediction
//! Using Conditionally Markov Sequences", 2018.
//!
//! | equation | what | file |
//! |---|---|---|
//! | Liang (1) | transition `F, M, Q` | `src/model/motion/mod.rs`, and a file for each `type` there |
//! | Liang (2) | observation | `src/model/observation.rs` |
//! | Liang (3) | posterior of the destinations | `src/posterior/mod.rs` |
//! | Liang (4) | the pseudo-observation of the endpoint | `src/model/destination.rs` |
//! | Liang (5) | likelihood given the arrival time | `src/likelihood/mod.rs` |
//! | Liang (5) for `y_1` | the first observation's evidence | `src/model/initial.rs` |
//! | Liang (6), Ardeshiri (17) | sum over the arrival time | `src/model/arrival.rs`, by the rules of `src/math/quadrature.rs` |
//! | Liang (7)-(11) | Algorithm 1 | `src/likelihood/algorithm1.rs` |
//! | Liang (8) | Kalman prediction | `src/math/kalman.rs` |
//! | Liang (9) | the endpoint given a state before it | `src/model/endpoint.rs` |
//! | Liang (10) | state, forecast, paths given the endpoint | `src/likelihood/states.rs`, mixed in `src/likelihood/node_posterior.rs` |
//! | Liang (11) telescoped, the default | product of prediction errors | `src/likelihood/pseudo_observation/dense.rs` as the oracle; fast in `src/likelihood/pseudo_observation/telescoped.rs`, with the hot loop in `kernel/src/mixture.rs` |
//! | Liang (12)-(13) | Algorithm 2 | `src/likelihood/algorithm2.rs` |
//! | Liang's references 12 to 14 | original bridging distributions | `src/likelihood/bridging.rs` |
//! | Ardeshiri (6), Rezaie and Li (7)-(9) | the transition towards `x_T` | `src/model/bridge.rs` |
//! | Ardeshiri (12)-(15) | single filter, exact and approximate | `src/likelihood/single_filter.rs` |
//! | Ardeshiri, section 3 | the smoothed start | `src/math/kalman.rs` |
//! | Rezaie and Li (2)-(3), (10)-(11) | conditionally Markov sequences | `src/conditionally_markov/model.rs` |
//! | Rezaie and Li (12) | filtering, prediction | `src/conditionally_markov/filter.rs` |
//!
//! # Errors in the printed papers
//!
//! Each was checked numerically; the corrected form is what is built.
//!
//! - Liang (13): the prediction inside the pseudo-observation is `F(h) mu + M(h)`; the printed `F(h) mu - M(h)` breaks the
//!   identity with Algorithm 1 whenever `M` is not zero.
//! - Liang's Bhattacharyya distance: the logarithm's denominator is `sqrt(det S1 det S2)`.
//! - Ardeshiri, Table 1, line 12: `(I - K C) P`, not `(I - K) P`.
//! - Rezaie and Li (12): the `x_k` on the right-hand side is `x_{k-1}`.
#![forbid(unsafe_code)]

mod conditionally_markov;
mod error;
mod value;
#[cfg(any(feature = "wasm", feature = "wasm-fit", feature = "wasm-pointing"))]
#[doc(hidden)]
pub mod wasm;

mod math;
mod model;

mod posterior;

mod engine;
mod likelihood;

mod pointing;

mod scenario;

mod predictor;

mod pointer;
mod snapshot;
pub mod study;

#[doc(hidden)]
pub mod internals;

pub use conditionally_markov::{
    Boundary, ConditionallyMarkovSequence, GivenSequence, SequenceParameters, StepModel, TimeStep,
};
pub use error::{Code, Error, Result};
pub use likelihood::Method;
pub use math::gaussian::Gaussian;
pub use math::quadrature::Quadrature;
pub use model::arrival::Arrival;
pub use model::destination::Destination;
pub use model::habits::Learning;
pub use model::initial::Initial;
pub use model::learnt::Learnt;
pub use model::matrix::Matrix;
pub use model::motion::{Motion, MotionNoise};
pub use model::observation::{Observation, ObservationNoise};
pub use model::per_axis::PerAxis;
pub use pointer::hand::{HandOptions, HandTarget, LengthUnit, hand_scenario};
pub use pointer::ray::{AngleUnit, RayMap, RayOptions, RayTarget, ray_scenario};
pub use pointer::{PointerOptions, PointerTarget, pointer_scenario};
pub use pointing::parameters::PointingConstants;
pub use posterior::Best;
pub use posterior::arrival_time::ArrivalTime;
pub use posterior::remaining::Remaining;
pub use predictor::Predictor;
pub use scenario::{Scenario, ScenarioBuilder};
pub use snapshot::Snapshot;

/// The parts of [`PointingConstants`].
pub mod pointing_constants {
    pub use crate::pointing::entry_time::EntryTime;
    pub use crate::pointing::parameters::{Direction, Power, Start, TimeToGo};
}

/// The README's Rust code is run as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
