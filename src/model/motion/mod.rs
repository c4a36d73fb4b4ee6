//! Motion models: linear, time-invariant, Gaussian; Liang (1).
//!
//! ```text
//! dx = (A x + b + B c) dt + dw,   E[dw dw'] = W dt          c: the centre of the destination that is tried
//! x_k = F(h) x_{k-1} + M(h) + (B c)(h) + e,   e ~ N(0, Q(h))
//!
//! F(h) = exp(A h)    M(h) = int_0^h exp(A u) b du    Q(h) = int_0^h exp(A u) W exp(A' u) du
//! ```
//!
//! The state holds all positions, then all velocities, then all accelerations. `noise` is the square root of the
//! spectral density `W` of the one driven component of each axis, so `W = noise^2` there and zero elsewhere.
//!
//! | `type` | file | states | equation of an axis |
//! |---|---|---|---|
//! | `brownian` | `brownian` | `d` | `dx = dw` |
//! | `constantVelocity` | `constant_velocity` | `2d` | `dv = dw` |
//! | `constantAcceleration` | `constant_acceleration` | `3d` | `da = dw` |
//! | `integratedOrnsteinUhlenbeck` | `integrated_ornstein_uhlenbeck` | `2d` | `dv = damping (drift - v) dt + dw` |
//! | `meanReverting` | `mean_reverting` | `d` | `dx = rate (c - x) dt + dw` |
//! | `equilibriumRevertingVelocity` | `equilibrium_reverting_velocity` | `2d` | `dv = (stiffness (c - x) - damping v) dt + dw` |
//! | `custom` | `custom` | any | any |

use super::matrix::Matrix;
use super::per_axis::PerAxis;
use crate::error::{Code, Error, Result};
use crate::value::{Path, Value};
use std::sync::Arc;

mod brownian;
mod constant_acceleration;
mod constant_velocity;
mod custom;
mod equilibrium_reverting_velocity;
mod form;
mod integrated_ornstein_uhlenbeck;
mod mean_reverting;
mod noise;
mod transition;

use brownian::Brownian;
use constant_acceleration::ConstantAcceleration;
use constant_velocity::ConstantVelocity;
use custom::Custom;
use equilibrium_reverting_velocity::EquilibriumRevertingVelocity;
use integrated_ornstein_uhlenbeck::IntegratedOrnsteinUhlenbeck;
use mean_reverting::MeanReverting;
pub use noise::MotionNoise;
pub use transition::{AxisTransition, MotionModel, Transition};

/// The most axes that a model can have.
pub const MAX_DIMENSIONS: usize = 3;

/// How the object moves: linear, time-invariant, Gaussian, `dx = (A x + b + B c) dt + dw`, `E[dw dw'] = W dt`; Liang (1).
///
/// `c` is the centre of the destination that is tried. The state has all positions, then all velocities, then all accelerations;
/// `dimensions` is 1 to 3. `noise` is the square root of the spectral density of what drives each axis: `W` is `noise^2` there and
/// zero elsewhere. What is wrong with a motion is reported where it is used: by [`ScenarioBuilder::build`](crate::ScenarioBuilder::build).
///
/// ```
/// use whither::{Motion, MotionNoise};
/// let pointer = Motion::constant_velocity(2, 3000.0); // px/s^1.5
/// let vessel = Motion::integrated_ornstein_uhlenbeck(2, [0.2, 0.3], 0.01);
/// let bird = Motion::brownian(3, MotionNoise::candidates([1.0, 5.0]));
/// // a damped oscillation about the destination, matrix by matrix
/// let swing = Motion::Custom {
///     dimensions: 1,
///     drift: [[0.0, 1.0], [-4.0, -0.5]].into(),
///     diffusion: [[0.0, 0.0], [0.0, 9.0]].into(),
///     offset: None,
///     destination_gain: Some([[0.0], [4.0]].into()),
/// };
/// # let _ = (pointer, vessel, bird, swing);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// The position is a random walk, `dx = dw`; `s = d`. `noise` is in units of length per second^0.5.
    Brownian {
        /// `d`.
        dimensions: usize,
        /// What drives the position.
        noise: MotionNoise,
    },
    /// The velocity is a random walk, `dv = dw`; `s = 2d`. `noise` is in units of length per second^1.5.
    ConstantVelocity {
        /// `d`.
        dimensions: usize,
        /// What drives the velocity.
        noise: MotionNoise,
        /// How the noise grows with the speed: for the pointing model alone.
        speed_noise: Option<f64>,
    },
    /// The acceleration is a random walk, `da = dw`; `s = 3d`. `noise` is in units of length per second^2.5.
    ConstantAcceleration {
        /// `d`.
        dimensions: usize,
        /// What drives the acceleration.
        noise: MotionNoise,
    },
    /// The velocity reverts to a mean, `dv = damping (drift - v) dt + dw`; `s = 2d`.
    IntegratedOrnsteinUhlenbeck {
        /// `d`.
        dimensions: usize,
        /// What drives the velocity, in units of length per second^1.5.
        noise: MotionNoise,
        /// The rate of reverting, in 1/s; at least 0.
        damping: f64,
        /// The velocity to which it reverts.
        drift: PerAxis,
    },
    /// The position reverts to the destination, `dx = rate (c - x) dt + dw`; `s = d`.
    MeanReverting {
        /// `d`.
        dimensions: usize,
        /// What drives the position, in units of length per second^0.5.
        noise: MotionNoise,
        /// The rate of reverting, in 1/s; above 0.
        rate: f64,
    },
    /// A damped spring towards the destination, `dv = (stiffness (c - x) - damping v) dt + dw`; `s = 2d`.
    EquilibriumRevertingVelocity {
        /// `d`.
        dimensions: usize,
        /// What drives the velocity, in units of length per second^1.5.
        noise: MotionNoise,
        /// In 1/s^2; above 0.
        stiffness: f64,
        /// In 1/s; at least 0.
        damping: f64,
    },
    /// Any `A`, `b`, `B` and `W`, of `s >= d` components of which the first `d` are the position.
    Custom {
        /// `d`.
        dimensions: usize,
        /// `A`, `s` by `s`.
        drift: Matrix,
        /// `W`, `s` by `s`, symmetric and positive semi-definite. With `bridging` and `singleFilter` it must lead to each
        /// component of the endpoint.
        diffusion: Matrix,
        /// `b`, of length `s`; zero where it is left out.
        offset: Option<Vec<f64>>,
        /// `B`, `s` by `d`; zero where it is left out.
        destination_gain: Option<Matrix>,
    },
}

impl Motion {
    /// [`Motion::Brownian`].
    pub fn brownian(dimensions: usize, noise: impl Into<MotionNoise>) -> Self {
        Self::Brownian { dimensions, noise: noise.into() }
    }

    /// [`Motion::ConstantVelocity`], with a noise that does not depend on the speed.
    pub fn constant_velocity(dimensions: usize, noise: impl Into<MotionNoise>) -> Self {
        Self::ConstantVelocity { dimensions, noise: noise.into(), speed_noise: None }
    }

    /// [`Motion::ConstantAcceleration`].
    pub fn constant_acceleration(dimensions: usize, noise: impl Into<MotionNoise>) -> Self {
        Self::ConstantAcceleration { dimensions, noise: noise.into() }
    }

    /// [`Motion::IntegratedOrnsteinUhlenbeck`] that comes to rest: without a drift.
    pub fn integrated_ornstein_uhlenbeck(dimensions: usize, noise: impl Into<MotionNoise>, damping: f64) -> Self {
        Self::IntegratedOrnsteinUhlenbeck { dimensions, noise: noise.into(), damping, drift: PerAxis::All(0.0) }
    }

    /// [`Motion::MeanReverting`].
    pub fn mean_reverting(dimensions: usize, noise: impl Into<MotionNoise>, rate: f64) -> Self {
        Self::MeanReverting { dimensions, noise: noise.into(), rate }
    }

    /// [`Motion::EquilibriumRevertingVelocity`].
    pub fn equilibrium_reverting_velocity(
        dimensions: usize,
        noise: impl Into<MotionNoise>,
        stiffness: f64,
        damping: f64,
    ) -> Self {
        Self::EquilibriumRevertingVelocity { dimensions, noise: noise.into(), stiffness, damping }
    }

    /// [`Motion::Custom`] without offset and destination gain.
    pub fn custom(dimensions: usize, drift: impl Into<Matrix>, diffusion: impl Into<Matrix>) -> Self {
        let (drift, diffusion) = (drift.into(), diffusion.into());
        Self::Custom { dimensions, drift, diffusion, offset: None, destination_gain: None }
    }

    /// The model, or one for each noise candidate, of what is described at `at`.
    ///
    /// # Errors
    /// `wrong-length`, `not-finite`, `out-of-range`, `too-large`, `not-positive-definite`.
    pub(crate) fn models(&self, at: &Path<'_>) -> Result<MotionModels> {
        let dimensions = check_dimensions(&at.key("dimensions"), self.dimensions() as f64)?;
        let noises = match self.noise() {
            Some(noise) => noise.check(&at.key("noise"), dimensions)?,
            None => vec![(Vec::new(), 1.0)],
        };
        let total: f64 = noises.iter().map(|(_, weight)| weight).sum();
        let mut candidates = Vec::with_capacity(noises.len());
        for (noise, weight) in noises {
            candidates.push(Candidate { model: self.model(at, dimensions, noise)?, weight: weight / total });
        }
        let speed_noise = match self {
            Self::ConstantVelocity { speed_noise: Some(growth), .. } => {
                Some(at.key("speedNoise").not_negative(*growth)?)
            }
            _ => None,
        };
        let Some(first) = candidates.first().map(|candidate| Arc::clone(&candidate.model)) else {
            return Err(Error::new(Code::WrongLength, at.to_string(), "must have at least one noise candidate"));
        };
        Ok(MotionModels {
            candidates,
            speed_noise,
            dimensions,
            states: first.states(),
            depends_on_destination: first.depends_on_destination(),
            description: self.clone(),
        })
    }

    /// Spatial dimensions `d`.
    pub(crate) const fn dimensions(&self) -> usize {
        let (Self::Brownian { dimensions, .. }
        | Self::ConstantVelocity { dimensions, .. }
        | Self::ConstantAcceleration { dimensions, .. }
        | Self::IntegratedOrnsteinUhlenbeck { dimensions, .. }
        | Self::MeanReverting { dimensions, .. }
        | Self::EquilibriumRevertingVelocity { dimensions, .. }
        | Self::Custom { dimensions, .. }) = self;
        *dimensions
    }

    fn noise(&self) -> Option<&MotionNoise> {
        match self {
            Self::Brownian { noise, .. }
            | Self::ConstantVelocity { noise, .. }
            | Self::ConstantAcceleration { noise, .. }
            | Self::IntegratedOrnsteinUhlenbeck { noise, .. }
            | Self::MeanReverting { noise, .. }
            | Self::EquilibriumRevertingVelocity { noise, .. } => Some(noise),
            Self::Custom { .. } => None,
        }
    }

    fn model(&self, at: &Path<'_>, dimensions: usize, noise: Vec<f64>) -> Result<Arc<dyn MotionModel>> {
        Ok(match self {
            Self::Brownian { .. } => Arc::new(Brownian::new(noise)),
            Self::ConstantVelocity { .. } => Arc::new(ConstantVelocity::new(noise)),
            Self::ConstantAcceleration { .. } => Arc::new(ConstantAcceleration::new(noise)),
            Self::IntegratedOrnsteinUhlenbeck { damping, drift, .. } => {
                Arc::new(IntegratedOrnsteinUhlenbeck::new(at, noise, *damping, drift)?)
            }
            Self::MeanReverting { rate, .. } => Arc::new(MeanReverting::new(at, noise, *rate)?),
            Self::EquilibriumRevertingVelocity { stiffness, damping, .. } => {
                Arc::new(EquilibriumRevertingVelocity::new(at, noise, *stiffness, *damping)?)
            }
            Self::Custom { drift, diffusion, offset, destination_gain, .. } => {
                Arc::new(Custom::new(at, dimensions, drift, diffusion, offset.as_deref(), destination_gain.as_ref())?)
            }
        })
    }
}

fn check_dimensions(at: &Path<'_>, dimensions: f64) -> Result<usize> {
    at.integer(dimensions, 1, MAX_DIMENSIONS).map_err(|error| match error.code() {
        Code::TooLarge => Error::new(Code::OutOfRange, error.path(), error.message()),
        _ => error,
    })
}

/// A motion model and its share in the average over noise candidates.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The model.
    pub model: Arc<dyn MotionModel>,
    /// Its prior probability; those of all candidates sum to one.
    pub weight: f64,
}

/// The motion models of a scenario.
#[derive(Clone, Debug)]
pub struct MotionModels {
    /// One model, or one for each noise candidate; never empty.
    pub candidates: Vec<Candidate>,
    /// How much the noise grows with the speed, `speedNoise`: of `constantVelocity` under the method `pointing` only.
    pub speed_noise: Option<f64>,
    dimensions: usize,
    states: usize,
    depends_on_destination: bool,
    description: Motion,
}

impl MotionModels {
    /// Spatial dimensions `d`.
    #[must_use]
    pub const fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// State components `s`.
    #[must_use]
    pub const fn states(&self) -> usize {
        self.states
    }

    /// Whether the movement knows where it is going; the same for every candidate.
    #[must_use]
    pub const fn depends_on_destination(&self) -> bool {
        self.depends_on_destination
    }

    /// The motion as a scenario writes it; reading it again gives the same.
    #[must_use]
    pub fn to_value(&self) -> Value {
        self.description.to_value()
    }
}

#[cfg(test)]
mod tests;
