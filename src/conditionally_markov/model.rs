//! The model of a sequence: Rezaie and Li (2)-(3), (10)-(11), induced by a Markov model or given matrix by matrix, and
//! waypoints.
//!
//! Some states are pinned: the origin `x_0`, the destination `x_N`, and any between. They have one joint Gaussian density,
//! whatever it is. Between two pins the sequence moves towards the next one, so that over any step within such a segment
//! ```text
//! x_k = G_{k,k-1} x_{k-1} + G_{k,p} x_p + g_k + e_k,   e_k ~ N(0, G_k),   p the next pin after k
//! ```
//! and over several steps it is of the same form again.

use super::description::{Boundary, GivenSequence, SequenceParameters, TimeStep};
use crate::error::{Code, Error, Result};
use crate::math::gaussian::{Factor, Gaussian, propagate};
use crate::model::arrival::MAX_TIME;
use crate::model::bridge::Bridge;
use crate::model::matrix::Matrix;
use crate::model::motion::{Motion, MotionModel};
use crate::model::observation::ObservationModel;
use crate::value::{Path, Value, number};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// The most steps that a sequence can have.
pub const MAX_STEPS: usize = 100_000;
/// The most components of a state that is given matrix by matrix.
const MAX_STATES: usize = 64;

/// One step of the sequence, `x_k = previous x_{k-1} + destination x_p + offset + e`, `e ~ N(0, covariance)`, towards the
/// next pinned state `x_p`.
///
/// ```
/// use whither::{ConditionallyMarkovSequence, Motion, Observation, SequenceParameters};
/// // a Brownian bridge over 4 steps: the first goes a quarter of the way
/// let sequence = ConditionallyMarkovSequence::new(&SequenceParameters {
///     motion: Motion::brownian(1, 1.0),
///     time_step: 1.0.into(),
///     steps: 4,
///     pins: None,
///     pinned_mean: vec![0.0, 8.0],
///     pinned_covariance: [[1.0, 0.0], [0.0, 1.0]].into(),
///     observation: Observation::deviation(1.0),
/// })?;
/// let step = sequence.model(1)?;
/// assert!((step.previous[(0, 0)] - 0.75).abs() < 1e-14 && (step.destination[(0, 0)] - 0.25).abs() < 1e-14);
/// # Ok::<(), whither::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct StepModel {
    /// `G_{k,k-1}`, `s` by `s`; (7).
    pub previous: DMatrix<f64>,
    /// `G_{k,N}` (`G_{k,p}` before a waypoint at step `p`), `s` by `s`; (8).
    pub destination: DMatrix<f64>,
    /// What the means add, of length `s`; zero where the Markov model has no offset.
    pub offset: DVector<f64>,
    /// `G_k`, `s` by `s`; (9).
    pub covariance: DMatrix<f64>,
}

/// Everything that is constant about a sequence.
#[derive(Debug)]
pub(super) struct Model {
    /// The steps of the pinned states, ascending; the first is 0, the last is `N`.
    pub pins: Vec<usize>,
    /// The joint density of the pinned states, stacked.
    pub pinned: Gaussian,
    /// Components `s` of one state.
    pub states: usize,
    /// Spatial dimensions `d`.
    pub dimensions: usize,
    /// How the states are measured.
    pub observation: ObservationModel,
    evolution: Evolution,
}

/// How the sequence moves between pins.
#[derive(Debug)]
enum Evolution {
    /// As a Markov model conditioned on the next pinned state.
    Induced {
        motion: Arc<dyn MotionModel>,
        times: Times,
        /// The centre of the destination, for motion models that know it.
        centre: Vec<f64>,
    },
    /// As steps 1 to `N - 1` are given.
    Given(Vec<StepModel>),
}

/// The times of the steps.
#[derive(Debug)]
enum Times {
    Regular(f64),
    /// The time of each step since step 0.
    Irregular(Vec<f64>),
}

impl Times {
    fn new(time_step: &TimeStep, at: &Path<'_>, steps: usize) -> Result<Self> {
        let times = match time_step {
            TimeStep::Regular(step) => Self::Regular(at.positive(*step)?),
            TimeStep::Irregular(each) => {
                let mut time = 0.0;
                let mut times = vec![0.0];
                for step in at.vector(each, steps, |at, x| at.positive(x))? {
                    time += step;
                    times.push(time);
                }
                Self::Irregular(times)
            }
        };
        let total = times.between(0, steps);
        if total > MAX_TIME {
            let must = format!("must be at most 1e12 seconds for all steps, they take {}", number(total));
            return Err(at.error(Code::OutOfRange, &must, time_step.to_value()));
        }
        Ok(times)
    }

    /// The time from step `from` to step `to >= from`.
    fn between(&self, from: usize, to: usize) -> f64 {
        match self {
            Self::Regular(step) => (to - from) as f64 * step,
            Self::Irregular(times) => times[to] - times[from],
        }
    }
}

impl Model {
    /// The model that a Markov model induces.
    pub fn induced(parameters: &SequenceParameters) -> Result<Self> {
        let root = Path::root("");
        let SequenceParameters { motion, time_step, steps, pins, pinned_mean, pinned_covariance, observation } =
            parameters;
        let motion = one_model(motion, &root.key("motion"))?;
        let steps = root.key("steps").integer(*steps as f64, 1, MAX_STEPS)?;
        let times = Times::new(time_step, &root.key("timeStep"), steps)?;
        let pins = match pins {
            Some(pins) => check_pins(pins, &root.key("pins"), steps)?,
            None => vec![0, steps],
        };
        let (states, dimensions) = (motion.states(), motion.dimensions());
        let size = pins.len() * states;
        let mean = root.key("pinnedMean").vector(pinned_mean, size, |at, x| at.number(x))?;
        let covariance = pinned_covariance.covariance(&root.key("pinnedCovariance"), size)?;
        let observation = observation.model(&root.key("observation"), dimensions, states)?;
        let centre = mean[size - states..][..dimensions].to_vec();
        let evolution = Evolution::Induced { motion, times, centre };
        let pinned = Gaussian { mean: DVector::from_column_slice(mean), covariance };
        let model = Self { pins, pinned, states, dimensions, observation, evolution };
        model.can_be_pinned()?;
        Ok(model)
    }

    /// The model that is given matrix by matrix.
    pub fn given(sequence: &GivenSequence) -> Result<Self> {
        let root = Path::root("");
        let (pinned, s) = check_boundary(&sequence.boundary, &root.key("boundary"))?;
        let (place, between) = (root.key("previous"), sequence.previous.len());
        if between >= MAX_STEPS {
            let must = format!("must have at most {} matrices, has {between}", MAX_STEPS - 1);
            return Err(place.error(Code::TooLarge, &must, list(&sequence.previous)));
        }
        let square = |matrix: &Matrix, at: &Path<'_>| matrix.check(at, s, s);
        let previous = check_each(&sequence.previous, &place, between, square)?;
        let destination = check_each(&sequence.destination, &root.key("destination"), between, square)?;
        let covariance =
            check_each(&sequence.covariance, &root.key("covariance"), between, |matrix, at| matrix.covariance(at, s))?;
        let offset = match &sequence.offset {
            None => vec![DVector::zeros(s); between],
            Some(offset) => check_each(offset, &root.key("offset"), between, |offset, at| {
                Ok(DVector::from_column_slice(at.vector(offset, s, |at, x| at.number(x))?))
            })?,
        };
        let dimensions = match sequence.dimensions {
            Some(dimensions) => root.key("dimensions").integer(dimensions as f64, 1, s)?,
            None if s.is_multiple_of(2) => s / 2,
            None => s,
        };
        let observation = sequence.observation.model(&root.key("observation"), dimensions, s)?;
        let steps = previous
            .into_iter()
            .zip(destination)
            .zip(offset.into_iter().zip(covariance))
            .map(|((previous, destination), (offset, covariance))| StepModel {
                previous,
                destination,
                offset,
                covariance,
            })
            .collect();
        let (pins, evolution) = (vec![0, between + 1], Evolution::Given(steps));
        Ok(Self { pins, pinned, states: s, dimensions, observation, evolution })
    }

    /// `N`.
    pub fn steps(&self) -> usize {
        self.pins.last().copied().unwrap_or_default()
    }

    /// The first pin after step `k`; `N` after that.
    pub fn next_pin(&self, k: usize) -> usize {
        self.pins[self.pins.partition_point(|&pin| pin <= k).min(self.pins.len() - 1)]
    }

    /// A step that exists.
    pub fn check_step(&self, step: usize) -> Result<()> {
        let last = self.steps();
        if step <= last {
            return Ok(());
        }
        let message = format!("must be an integer from 0 to {last}, got {step}");
        Err(Error::new(Code::OutOfRange, "step", message))
    }

    /// The model of step `k`, which is no pin.
    pub fn step(&self, k: usize) -> Result<StepModel> {
        self.check_step(k)?;
        if self.pins.binary_search(&k).is_ok() {
            let pins: Vec<String> = self.pins.iter().map(|&pin| number(pin as f64)).collect();
            let message = format!(
                "must be a step between pins, got {k}: the states at {} are drawn first, from their joint density",
                pins.join(", ")
            );
            return Err(Error::new(Code::OutOfRange, "step", message));
        }
        self.between(k - 1, k)
    }

    /// The model of the movement from step `from` to step `to`, with `from < to <` the next pin.
    pub fn between(&self, from: usize, to: usize) -> Result<StepModel> {
        match &self.evolution {
            Evolution::Induced { motion, times, centre } => {
                let step = motion.transition(times.between(from, to));
                let rest = motion.transition(times.between(to, self.next_pin(from)));
                let bridge = Bridge::new(&step.transition, &step.noise, &rest.transition, &rest.noise, self.states)
                    .ok_or_else(not_pinnable)?;
                let offset = bridge.offset(&step.constant(centre), &rest.constant(centre));
                let Bridge { previous, destination, covariance, .. } = bridge;
                Ok(StepModel { previous, destination, offset, covariance })
            }
            Evolution::Given(steps) => {
                let (first, others) = (&steps[from], &steps[from + 1..to]);
                Ok(others.iter().fold(first.clone(), |so_far, next| StepModel {
                    destination: &next.previous * &so_far.destination + &next.destination,
                    offset: &next.previous * &so_far.offset + &next.offset,
                    covariance: propagate(&next.previous, &so_far.covariance, &next.covariance),
                    previous: &next.previous * &so_far.previous,
                }))
            }
        }
    }

    /// Refuses a motion model whose noise does not reach every component of the state.
    fn can_be_pinned(&self) -> Result<()> {
        let segment = self.pins.windows(2).find(|pair| pair[1] - pair[0] > 1);
        segment.map_or(Ok(()), |pair| self.between(pair[0], pair[0] + 1).map(|_| ()))
    }
}

fn not_pinnable() -> Error {
    Error::new(
        Code::NotPositiveDefinite,
        "motion",
        "must have noise that reaches every component of the state: otherwise the state at the end is determined by the one at the start",
    )
}

fn one_model(motion: &Motion, at: &Path<'_>) -> Result<Arc<dyn MotionModel>> {
    let models = motion.models(at)?;
    if models.speed_noise.is_some() {
        let message = "speedNoise makes the model nonlinear, a sequence needs a linear one";
        return Err(Error::new(Code::UnknownKey, at.key("speedNoise").to_string(), message));
    }
    match models.candidates.as_slice() {
        [only] => Ok(Arc::clone(&only.model)),
        several => {
            let message = format!("must be one noise, got {} candidates: a sequence has one model", several.len());
            Err(Error::new(Code::OutOfRange, at.key("noise").to_string(), message))
        }
    }
}

fn check_pins(pins: &[usize], at: &Path<'_>, steps: usize) -> Result<Vec<usize>> {
    let numbers: Vec<f64> = pins.iter().map(|&pin| pin as f64).collect();
    if let Some(i) = pins.iter().position(|&pin| pin > steps) {
        let must = format!("must be an integer from 0 to {steps}");
        return Err(at.index(i).error(Code::OutOfRange, &must, numbers[i]));
    }
    let complete = pins.len() >= 2 && pins.first() == Some(&0) && pins.last() == Some(&steps);
    if !complete || pins.windows(2).any(|pair| pair[0] >= pair[1]) {
        let must = format!("must be ascending integers that begin with 0 and end with steps, {steps}");
        return Err(at.error(Code::OutOfRange, &must, numbers.as_slice()));
    }
    Ok(pins.to_vec())
}

/// The joint density of the boundary condition (3), and the number of components of one state.
fn check_boundary(boundary: &Boundary, at: &Path<'_>) -> Result<(Gaussian, usize)> {
    let Boundary { origin_mean, destination_mean, gain, origin_covariance, destination_covariance } = boundary;
    let (place, s) = (at.key("destinationCovariance"), destination_covariance.rows());
    if s == 0 || s > MAX_STATES {
        let must = format!("must have 1 to {MAX_STATES} rows");
        return Err(place.error(Code::WrongLength, &must, destination_covariance));
    }
    let c_n = destination_covariance.covariance(&place, s)?;
    let g_0 = origin_covariance.covariance(&at.key("originCovariance"), s)?;
    let place = at.key("gain");
    let g_0n = gain.as_ref().map_or_else(|| Ok(DMatrix::zeros(s, s)), |gain| gain.check(&place, s, s))?;
    let mut mean = DVector::zeros(2 * s);
    for (key, given, from) in [("originMean", origin_mean, 0), ("destinationMean", destination_mean, s)] {
        if let Some(given) = given {
            mean.rows_mut(from, s).copy_from_slice(at.key(key).vector(given, s, |at, x| at.number(x))?);
        }
    }
    let mut covariance = DMatrix::zeros(2 * s, 2 * s);
    let cross = &g_0n * &c_n;
    covariance.view_mut((0, 0), (s, s)).copy_from(&propagate(&g_0n, &c_n, &g_0));
    covariance.view_mut((0, s), (s, s)).copy_from(&cross);
    covariance.view_mut((s, 0), (s, s)).tr_copy_from(&cross);
    covariance.view_mut((s, s), (s, s)).copy_from(&c_n);
    if Factor::new(covariance.clone()).is_none() {
        let must = "must leave the joint covariance of origin and destination positive definite";
        return Err(place.error(Code::NotPositiveDefinite, must, gain.as_ref().map_or(Value::Null, Value::from)));
    }
    Ok((Gaussian { mean, covariance }, s))
}

/// One item for each of steps 1 to `N - 1`.
fn check_each<T, U>(
    items: &[T],
    at: &Path<'_>,
    count: usize,
    check: impl Fn(&T, &Path<'_>) -> Result<U>,
) -> Result<Vec<U>>
where
    for<'a> Value: From<&'a T>,
{
    if items.len() != count {
        let must = format!("must have {count} items, one for each step between the endpoints, has {}", items.len());
        return Err(at.error(Code::WrongLength, &must, list(items)));
    }
    items.iter().enumerate().map(|(i, item)| check(item, &at.index(i))).collect()
}

fn list<T>(items: &[T]) -> Value
where
    for<'a> Value: From<&'a T>,
{
    Value::List(items.iter().map(Value::from).collect())
}
