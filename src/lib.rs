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
//! A [`Scenario`] says how the object moves, how it is observed, where it may go and when it may arrive; a [`Predictor`] takes
//! observations and answers. Both, in five lines:
//!
//! ```
//! use whither::{Predictor, Scenario};
//!
//! let scenario: Scenario = serde_json::from_str(r#"{
//!     "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 0.3 },
//!     "observation": { "noise": 5 },
//!     "initial": { "velocity": 8 },
//!     "arrival": { "type": "uniform", "from": 1200, "to": 3600 },
//!     "none": 0.05,
//!     "destinations": [
//!         { "id": "Cowes", "center": [9000, 0], "size": 400 },
//!         { "id": "Portsmouth", "center": [14000, 8000], "size": 400 }
//!     ]
//! }"#)?;
//! let mut vessel = Predictor::new(&scenario);
//! for minute in 0..10 {
//!     let t = 60.0 * f64::from(minute);
//!     vessel.observe(t, &[6.0 * t, 0.1 * t])?;
//! }
//! assert_eq!(vessel.best().unwrap().id, "Cowes");
//! assert!(vessel.arrival(None)?.unwrap().mean < 2600.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! For pointers on a screen there is [`pointer::pointer_scenario`].
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
//! | scenario | the whole configuration |
//! | track | one recorded movement |
//! | predictor | the whole engine, as in the papers (in Stone Soup the word means the time update) |
//! | prediction error | an observation less its prediction; its density is Liang's PED |
//! | evidence | the density of what was observed, `p(y_2:k given y_1)`, or `p(y_1:k)` where the scenario counts the first observation |
//! | posterior | what is believed after the observations |
//!
//! # Where each equation is
//!
//! *Liang*: "On Destination Prediction Based on Markov Bridging Distributions", 2019. *Ardeshiri*: "Efficient Bridging-Based
//! Destination Inference in Object Tracking", 2017. *Rezaie and Li*: "Destination-Directed Trajectory Modeling and Prediction
//! Using Conditionally Markov Sequences", 2018.
//!
//! | equation | what | item |
//! |---|---|---|
//! | Liang (1) | transition `F, M, Q` | [`model::motion`] |
//! | Liang (2) | observation | [`model::observation`] |
//! | Liang (3) | posterior of the destinations | `posterior::Posterior::update` |
//! | Liang (4) | the pseudo-observation of the endpoint | [`model::destination`] |
//! | Liang (5) | likelihood given the arrival time | [`likelihood`] |
//! | Liang (5), `p(y_1 given D, T)` | the first observation's evidence | [`model::initial::Initial::counted`] |
//! | Liang (6), Ardeshiri (17) | sum over the arrival time | [`model::arrival`], [`math::quadrature`] |
//! | Liang (7)-(11) | Algorithm 1 | [`likelihood::algorithm1`] |
//! | Liang (8) | Kalman prediction | [`math::kalman::Filter::predict`] |
//! | Liang (9) | the endpoint seen from a state before it | [`model::endpoint`] |
//! | Liang (10), or the bridged posterior, mixed | state, forecast, paths | `likelihood::node_posterior` |
//! | Liang (12)-(13) | Algorithm 2 | [`likelihood::algorithm2`] |
//! | product of Liang (11), telescoped | the default | [`likelihood::pseudo_observation`] |
//! | Liang's references 12 to 14 | original bridging distributions | [`likelihood::bridging`] |
//! | Ardeshiri (6), Rezaie and Li (7)-(9) | the transition towards `x_T` | [`model::bridge`] |
//! | Ardeshiri (12)-(15), Table 1 | single filter, exact and approximate | [`likelihood::single_filter`] |
//! | Ardeshiri, after Table 1 | the smoothed start | [`math::kalman::Filter::smoothed_start`] |
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

pub mod conditionally_markov;
pub mod error;
pub mod value;
#[cfg(any(feature = "wasm", feature = "wasm-fit", feature = "wasm-pointing"))]
#[doc(hidden)]
pub mod wasm;

pub mod math;
pub mod model;

pub mod posterior;

mod engine;
pub mod likelihood;

pub mod pointing;

pub mod scenario;

pub mod predictor;

pub mod pointer;
pub mod snapshot;
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
pub use model::matrix::Matrix;
pub use model::motion::{Motion, MotionNoise};
pub use model::observation::{Observation, ObservationNoise};
pub use model::per_axis::PerAxis;
pub use pointer::{PointerOptions, PointerTarget, pointer_scenario};
pub use pointing::parameters::Parameters as PointingConstants;
pub use posterior::Best;
pub use posterior::arrival_time::ArrivalTime;
pub use posterior::remaining::Remaining;
pub use predictor::Predictor;
pub use scenario::{Scenario, ScenarioBuilder};
pub use value::Value;

/// The README's Rust code is run as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
