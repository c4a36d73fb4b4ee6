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
//! | `brownian` | [`brownian`] | `d` | `dx = dw` |
//! | `constantVelocity` | [`constant_velocity`] | `2d` | `dv = dw` |
//! | `constantAcceleration` | [`constant_acceleration`] | `3d` | `da = dw` |
//! | `integratedOrnsteinUhlenbeck` | [`integrated_ornstein_uhlenbeck`] | `2d` | `dv = damping (drift - v) dt + dw` |
//! | `meanReverting` | [`mean_reverting`] | `d` | `dx = rate (c - x) dt + dw` |
//! | `equilibriumRevertingVelocity` | [`equilibrium_reverting_velocity`] | `2d` | `dv = (stiffness (c - x) - damping v) dt + dw` |
//! | `custom` | [`custom`] | any | any |

use crate::error::{Code, Error, Result};
use crate::value::{Fields, Node, Value};
use nalgebra::{DMatrix, DVector};
use std::fmt;
use std::sync::Arc;

pub mod brownian;
pub mod constant_acceleration;
pub mod constant_velocity;
pub mod custom;
pub mod equilibrium_reverting_velocity;
pub mod integrated_ornstein_uhlenbeck;
pub mod mean_reverting;

/// The most axes that a model can have.
pub const MAX_DIMENSIONS: usize = 3;
/// The most candidates that `noise` can have.
pub const MAX_CANDIDATES: usize = 64;

/// One step of a motion model, `x_k = F x_{k-1} + M + B c + e`, `e ~ N(0, Q)`, with `c` the destination's centre.
///
/// ```
/// use whither::{Value, model::motion::Motion, value::Node};
/// let value: Value = serde_json::from_str(r#"{ "type": "constantVelocity", "dimensions": 2, "noise": 3 }"#).unwrap();
/// let motion = Motion::read(&Node::root(&value, "motion")).unwrap();
/// let step = motion.candidates[0].model.transition(2.0);
/// assert_eq!(step.transition.nrows(), 4); // x, y and their velocities
/// assert_eq!((step.transition[(0, 2)], step.transition[(1, 3)]), (2.0, 2.0));
/// assert_eq!(step.destination_gain, None);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// `F`, `s` by `s`.
    pub transition: DMatrix<f64>,
    /// `M`, of length `s`.
    pub offset: DVector<f64>,
    /// `B`, `s` by `d`; none where the model does not know the destination.
    pub destination_gain: Option<DMatrix<f64>>,
    /// `Q`, `s` by `s`, symmetric.
    pub noise: DMatrix<f64>,
}

/// One step of one axis of a model whose axes do not mix: the same equation with at most three components
/// (position, velocity, acceleration). What lies beyond `states` is zero.
///
/// ```
/// use whither::{Value, model::motion::Motion, value::Node};
/// let value: Value = serde_json::from_str(r#"{ "type": "constantVelocity", "dimensions": 2, "noise": 3 }"#).unwrap();
/// let motion = Motion::read(&Node::root(&value, "motion")).unwrap();
/// let axis = motion.candidates[0].model.axis(1, 2.0).unwrap();
/// assert_eq!((axis.states, axis.transition[0]), (2, [1.0, 2.0, 0.0]));
/// assert_eq!(motion.candidates[0].model.axis(2, 2.0), None); // there are two axes
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisTransition {
    /// How many components the axis has: 1, 2 or 3.
    pub states: usize,
    /// `F`.
    pub transition: [[f64; 3]; 3],
    /// `M`.
    pub offset: [f64; 3],
    /// `B`, for this axis of the destination's centre; zero where the model does not know the destination.
    pub destination_gain: [f64; 3],
    /// `Q`, symmetric.
    pub noise: [[f64; 3]; 3],
}

/// A motion model: what it is over any step.
///
/// ```
/// use whither::{Value, model::motion::Motion, value::Node};
/// let value: Value = serde_json::from_str(r#"{ "type": "constantAcceleration", "dimensions": 1, "noise": 3 }"#).unwrap();
/// let motion = Motion::read(&Node::root(&value, "motion")).unwrap();
/// let model = &motion.candidates[0].model;
/// assert_eq!((model.dimensions(), model.states()), (1, 3));
/// // two steps are one step of both
/// let (first, second, both) = (model.transition(0.5), model.transition(1.5), model.transition(2.0));
/// let carried = &second.transition * first.noise * second.transition.transpose() + second.noise;
/// assert!((second.transition * first.transition - both.transition).amax() < 1e-14);
/// assert!((carried - both.noise).amax() < 1e-12);
/// ```
pub trait MotionModel: Send + Sync {
    /// Spatial dimensions `d`, 1 to 3.
    fn dimensions(&self) -> usize;

    /// State components `s`.
    fn states(&self) -> usize;

    /// Whether `B` is not zero: the movement knows where it is going.
    fn depends_on_destination(&self) -> bool {
        false
    }

    /// One step of one axis, `step >= 0` seconds; none where axes mix, or there is no such axis.
    fn axis(&self, axis: usize, step: f64) -> Option<AxisTransition>;

    /// One step of the whole state, `step >= 0` seconds. Zero gives the identity and no noise.
    fn transition(&self, step: f64) -> Transition {
        assemble(self.dimensions(), self.states(), self.depends_on_destination(), |axis| self.axis(axis, step))
    }

    /// The model as a scenario writes it.
    fn to_value(&self) -> Value;
}

impl fmt::Debug for dyn MotionModel + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("MotionModel")
    }
}

/// The whole state's step from those of the axes: component `i` of axis `k` stands at `i d + k`.
#[inline(never)]
fn assemble(
    dimensions: usize,
    states: usize,
    depends_on_destination: bool,
    axis: impl Fn(usize) -> Option<AxisTransition>,
) -> Transition {
    let mut whole = Transition {
        transition: DMatrix::zeros(states, states),
        offset: DVector::zeros(states),
        destination_gain: depends_on_destination.then(|| DMatrix::zeros(states, dimensions)),
        noise: DMatrix::zeros(states, states),
    };
    for k in 0..dimensions {
        let Some(one) = axis(k) else { continue };
        for i in 0..one.states {
            let row = i * dimensions + k;
            for j in 0..one.states {
                whole.transition[(row, j * dimensions + k)] = one.transition[i][j];
                whole.noise[(row, j * dimensions + k)] = one.noise[i][j];
            }
            whole.offset[row] = one.offset[i];
            if let Some(gain) = &mut whole.destination_gain {
                gain[(row, k)] = one.destination_gain[i];
            }
        }
    }
    whole
}

/// A motion model and its share in the average over noise candidates.
///
/// ```
/// use whither::{Value, model::motion::Motion, value::Node};
/// let value: Value = serde_json::from_str(r#"{
///     "type": "brownian", "dimensions": 1, "noise": { "candidates": [2, 5], "weights": [1, 3] }
/// }"#).unwrap();
/// let motion = Motion::read(&Node::root(&value, "motion")).unwrap();
/// let [calm, lively] = &motion.candidates[..] else { panic!() };
/// assert_eq!((calm.weight, lively.weight), (0.25, 0.75));
/// assert_eq!(lively.model.transition(1.0).noise[(0, 0)], 25.0);
/// ```
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The model.
    pub model: Arc<dyn MotionModel>,
    /// Its prior probability; those of all candidates sum to one.
    pub weight: f64,
}

/// The `motion` of a scenario: one model, or one for each noise candidate.
///
/// ```
/// use whither::{model::motion::Motion, value::{Node, Value}};
/// let value = Value::map([
///     ("type", Value::text("brownian")),
///     ("dimensions", Value::Number(2.0)),
///     ("noise", Value::Number(3.0)),
/// ]);
/// let motion = Motion::read(&Node::root(&value, "motion")).unwrap();
/// let step = motion.candidates[0].model.transition(0.5);
/// assert_eq!(step.noise[(1, 1)], 4.5); // 3^2 * 0.5
/// assert_eq!(motion.to_value(), value);
/// ```
#[derive(Clone, Debug)]
pub struct Motion {
    /// One model, or one for each noise candidate; never empty.
    pub candidates: Vec<Candidate>,
    /// How much the noise grows with the speed, `speedNoise`: of `constantVelocity` under the method `pointing` only.
    pub speed_noise: Option<f64>,
    dimensions: usize,
    states: usize,
    depends_on_destination: bool,
    /// The weights as they were given, so that a scenario written and read again is the same to the bit.
    given_weights: Option<Vec<f64>>,
}

/// One `type`: the keys that it has, and how it is built from them and, of each axis, the noise.
#[derive(Clone, Copy)]
struct Kind {
    keys: &'static [&'static str],
    build: Build,
}

type Build = fn(&Fields<'_>, Vec<f64>, usize) -> Result<Arc<dyn MotionModel>>;

/// Every `type`; without the methods of the papers the one that the pointing model moves by.
const KINDS: &[(&str, Kind)] = &[
    brownian::KIND,
    constant_velocity::KIND,
    constant_acceleration::KIND,
    integrated_ornstein_uhlenbeck::KIND,
    mean_reverting::KIND,
    equilibrium_reverting_velocity::KIND,
    custom::KIND,
];

impl Motion {
    /// Reads `{ "type", "dimensions", ... }`.
    ///
    /// # Errors
    /// `missing-key`, `unknown-key`, `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`, `too-large`,
    /// `not-positive-definite`.
    pub fn read(node: &Node<'_>) -> Result<Self> {
        let kind = node.tag("type", KINDS)?;
        let fields = node.fields(kind.keys)?;
        let dimensions = dimensions(&fields.required("dimensions")?)?;
        let noise = match kind.keys.contains(&"noise") {
            true => NoiseCandidates::read(&fields.required("noise")?, dimensions)?,
            false => NoiseCandidates::fixed(Vec::new()),
        };
        let build = |noise: Vec<f64>| (kind.build)(&fields, noise, dimensions);
        let models = noise.noises.into_iter().map(build).collect::<Result<Vec<_>>>()?;
        let speed_noise = match fields.optional("speedNoise") {
            Some(node) => Some(node.not_negative()?),
            None => None,
        };
        Self::average(models, noise.weights, speed_noise, node)
    }

    fn average(
        models: Vec<Arc<dyn MotionModel>>,
        given_weights: Option<Vec<f64>>,
        speed_noise: Option<f64>,
        node: &Node<'_>,
    ) -> Result<Self> {
        let Some(first) = models.first().cloned() else {
            return Err(node.error(Code::WrongLength, "must have at least one noise candidate"));
        };
        let weights = given_weights.clone().unwrap_or_else(|| vec![1.0; models.len()]);
        let sum: f64 = weights.iter().sum();
        Ok(Self {
            candidates: models
                .into_iter()
                .zip(weights)
                .map(|(model, weight)| Candidate { model, weight: weight / sum })
                .collect(),
            speed_noise,
            dimensions: first.dimensions(),
            states: first.states(),
            depends_on_destination: first.depends_on_destination(),
            given_weights,
        })
    }

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
        let mut entries = match self.candidates.first().map(|c| c.model.to_value()) {
            Some(Value::Map(entries)) => entries,
            _ => Vec::new(),
        };
        if self.candidates.len() > 1 || self.given_weights.is_some() {
            let each = self.candidates.iter().filter_map(|c| noise_of(c.model.to_value())).collect();
            let mut noise = vec![("candidates".to_owned(), Value::List(each))];
            if let Some(weights) = &self.given_weights {
                noise.push(("weights".to_owned(), Value::numbers(weights)));
            }
            for (key, value) in &mut entries {
                if key == "noise" {
                    *value = Value::Map(std::mem::take(&mut noise));
                }
            }
        }
        if let Some(speed_noise) = self.speed_noise {
            entries.push(("speedNoise".to_owned(), Value::Number(speed_noise)));
        }
        Value::Map(entries)
    }
}

fn noise_of(model: Value) -> Option<Value> {
    let Value::Map(entries) = model else { return None };
    entries.into_iter().find_map(|(key, value)| (key == "noise").then_some(value))
}

fn dimensions(node: &Node<'_>) -> Result<usize> {
    node.whole(1, MAX_DIMENSIONS).map_err(|error| match error.code() {
        Code::TooLarge => Error::new(Code::OutOfRange, error.path(), error.message()),
        _ => error,
    })
}

/// `noise`: a number, one for each axis, or `{ "candidates", "weights"? }`.
struct NoiseCandidates {
    noises: Vec<Vec<f64>>,
    weights: Option<Vec<f64>>,
}

impl NoiseCandidates {
    fn fixed(noise: Vec<f64>) -> Self {
        Self { noises: vec![noise], weights: None }
    }

    fn read(node: &Node<'_>, dimensions: usize) -> Result<Self> {
        if !matches!(node.value(), Value::Map(_)) {
            return Ok(Self::fixed(node.for_each_axis(dimensions, |n| n.positive())?));
        }
        let fields = node.fields(&["candidates", "weights"])?;
        let candidates = fields.required("candidates")?;
        let items = candidates.items()?;
        let count = items.len();
        if count == 0 {
            return Err(candidates.error(Code::WrongLength, "must have at least one candidate"));
        }
        if count > MAX_CANDIDATES {
            let must = format!("must have at most {MAX_CANDIDATES} candidates, has {count}");
            return Err(candidates.error(Code::TooLarge, &must));
        }
        let noises =
            items.map(|item| item.for_each_axis(dimensions, |n| n.positive())).collect::<Result<Vec<Vec<f64>>>>()?;
        let weights = match fields.optional("weights") {
            None => None,
            Some(weights) => {
                weights.vector(Some(count))?;
                let given = weights.numbers(|item| item.positive())?;
                if !given.iter().sum::<f64>().is_finite() {
                    return Err(weights.error(Code::OutOfRange, "must have a finite sum"));
                }
                Some(given)
            }
        };
        Ok(Self { noises, weights })
    }
}

/// One number where all axes have the same, a list where they differ.
fn axis_value(axes: &[f64]) -> Value {
    match axes {
        [first, rest @ ..] if rest.iter().all(|x| x == first) => Value::Number(*first),
        _ => Value::numbers(axes),
    }
}

#[cfg(test)]
mod tests;
