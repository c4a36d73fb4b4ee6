//! The model of a sequence: Rezaie and Li (2)-(3), induced by a Markov model (10)-(11) or given matrix by matrix, and
//! waypoints.
//!
//! Some states are pinned: the origin `x_0`, the destination `x_N`, and any between. They have one joint Gaussian density,
//! whatever it is. Between two pins the sequence moves towards the next one, so that over any step within such a segment
//! ```text
//! x_k = G_{k,k-1} x_{k-1} + G_{k,p} x_p + g_k + e_k,   e_k ~ N(0, G_k),   p the next pin after k
//! ```
//! and over several steps it is of the same form again.

use crate::error::{Code, Error, Result};
use crate::math::gaussian::{Factor, Gaussian, propagate};
use crate::model::arrival::MAX_TIME;
use crate::model::bridge::Bridge;
use crate::model::motion::{Motion, MotionModel};
use crate::model::observation::{Observation, ObservationModel, read_covariance};
use crate::value::{Fields, Node, Value, number};
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
/// use whither::{ConditionallyMarkovSequence, Value};
/// // a Brownian bridge over 4 steps: the first goes a quarter of the way
/// let value: Value = serde_json::from_str(r#"{
///     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "timeStep": 1, "steps": 4,
///     "pinnedMean": [0, 8], "pinnedCovariance": [[1, 0], [0, 1]], "observation": { "noise": 1 }
/// }"#).unwrap();
/// let step = ConditionallyMarkovSequence::new(&value).unwrap().model(1).unwrap();
/// assert!((step.previous[(0, 0)] - 0.75).abs() < 1e-14 && (step.destination[(0, 0)] - 0.25).abs() < 1e-14);
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
    /// As steps 1 to `N - 1` say.
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
    fn read(node: &Node<'_>, steps: usize) -> Result<Self> {
        let times = Self::read_any(node, steps)?;
        let whole = times.between(0, steps);
        if whole > MAX_TIME {
            let must = format!("must be at most 1e12 seconds for all steps, they take {}", number(whole));
            return Err(node.error(Code::OutOfRange, &must));
        }
        Ok(times)
    }

    fn read_any(node: &Node<'_>, steps: usize) -> Result<Self> {
        match node.value() {
            Value::List(_) => {
                node.vector(Some(steps))?;
                let mut time = 0.0;
                let mut times = vec![0.0];
                for item in node.items()? {
                    time += item.positive()?;
                    times.push(time);
                }
                Ok(Self::Irregular(times))
            }
            Value::Number(_) => Ok(Self::Regular(node.positive()?)),
            _ => Err(node.error(Code::WrongType, "must be a number, or a list with the length of each step")),
        }
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
    /// Reads `{ motion, timeStep, steps, pins?, pinnedMean, pinnedCovariance, observation }`.
    pub fn induced(node: &Node<'_>) -> Result<Self> {
        let keys = ["motion", "timeStep", "steps", "pins", "pinnedMean", "pinnedCovariance", "observation"];
        let fields = node.fields(&keys)?;
        let motion = read_motion(&fields.required("motion")?)?;
        let steps = fields.required("steps")?.whole(1, MAX_STEPS)?;
        let times = Times::read(&fields.required("timeStep")?, steps)?;
        let pins = match fields.optional("pins") {
            Some(node) => read_pins(&node, steps)?,
            None => vec![0, steps],
        };
        let (states, dimensions) = (motion.states(), motion.dimensions());
        let size = pins.len() * states;
        let mean = DVector::from_vec(fields.required("pinnedMean")?.vector(Some(size))?);
        let covariance = read_covariance(&fields.required("pinnedCovariance")?, size)?;
        let node = fields.required("observation")?;
        let observation = Observation::read(&node, dimensions)?.model(node.place(), dimensions, states)?;
        let centre = mean.rows(size - states, dimensions).iter().copied().collect();
        let evolution = Evolution::Induced { motion, times, centre };
        let model = Self { pins, pinned: Gaussian { mean, covariance }, states, dimensions, observation, evolution };
        model.can_be_pinned(&fields)?;
        Ok(model)
    }

    /// Reads `{ previous, destination, offset?, covariance, boundary, observation, dimensions? }`.
    pub fn given(node: &Node<'_>) -> Result<Self> {
        let keys = ["previous", "destination", "offset", "covariance", "boundary", "observation", "dimensions"];
        let fields = node.fields(&keys)?;
        let (pinned, states) = read_boundary(&fields.required("boundary")?)?;
        let between = fields.required("previous")?.items()?.len();
        if between >= MAX_STEPS {
            let must = format!("must have at most {} matrices, has {between}", MAX_STEPS - 1);
            return Err(fields.required("previous")?.error(Code::TooLarge, &must));
        }
        let square = |node: &Node<'_>| Ok(DMatrix::from_row_slice(states, states, &node.matrix(states, states)?));
        let previous = read_each(&fields.required("previous")?, between, square)?;
        let destination = read_each(&fields.required("destination")?, between, square)?;
        let covariance = read_each(&fields.required("covariance")?, between, |node| read_covariance(node, states))?;
        let offset = match fields.optional("offset") {
            Some(node) => read_each(&node, between, |node| Ok(DVector::from_vec(node.vector(Some(states))?)))?,
            None => vec![DVector::zeros(states); between],
        };
        let dimensions = match fields.optional("dimensions") {
            Some(node) => node.whole(1, states)?,
            None if states.is_multiple_of(2) => states / 2,
            None => states,
        };
        let node = fields.required("observation")?;
        let observation = Observation::read(&node, dimensions)?.model(node.place(), dimensions, states)?;
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
        Ok(Self { pins, pinned, states, dimensions, observation, evolution })
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
        let message = format!("must be a whole number from 0 to {last}, got {step}");
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
                    .ok_or_else(|| not_pinnable("motion"))?;
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
    fn can_be_pinned(&self, fields: &Fields<'_>) -> Result<()> {
        match self.pins.windows(2).find(|pair| pair[1] - pair[0] > 1) {
            Some(pair) => match self.between(pair[0], pair[0] + 1) {
                Err(_) => Err(not_pinnable(&fields.required("motion")?.path())),
                Ok(_) => Ok(()),
            },
            None => Ok(()),
        }
    }
}

fn not_pinnable(path: &str) -> Error {
    Error::new(
        Code::NotPositiveDefinite,
        path,
        "must have noise that reaches every component of the state: otherwise the state at the end is determined by the one at the start",
    )
}

fn read_motion(node: &Node<'_>) -> Result<Arc<dyn MotionModel>> {
    let motion = Motion::read(node)?.models(node.place())?;
    if motion.speed_noise.is_some() {
        let message = "speedNoise makes the model nonlinear, a sequence needs a linear one";
        return Err(Error::new(Code::UnknownKey, format!("{}.speedNoise", node.path()), message));
    }
    match motion.candidates.as_slice() {
        [only] => Ok(Arc::clone(&only.model)),
        several => {
            let message = format!("must be one noise, got {} candidates: a sequence has one model", several.len());
            Err(Error::new(Code::OutOfRange, format!("{}.noise", node.path()), message))
        }
    }
}

fn read_pins(node: &Node<'_>, steps: usize) -> Result<Vec<usize>> {
    let must = format!("must be ascending whole numbers that begin with 0 and end with steps, {steps}");
    let pins = node
        .items()?
        .map(|item| match item.value() {
            Value::Number(x) if x.fract() == 0.0 && *x >= 0.0 && *x <= steps as f64 => Ok(*x as usize),
            Value::Number(_) => Err(item.error(Code::OutOfRange, &format!("must be a whole number from 0 to {steps}"))),
            _ => item.whole(0, steps),
        })
        .collect::<Result<Vec<_>>>()?;
    let ends = pins.len() >= 2 && pins.first() == Some(&0) && pins.last() == Some(&steps);
    if !ends || pins.windows(2).any(|pair| pair[0] >= pair[1]) {
        return Err(node.error(Code::OutOfRange, &must));
    }
    Ok(pins)
}

/// Reads the boundary condition (3), `{ originMean?, destinationMean?, gain?, originCovariance, destinationCovariance }`,
/// with `gain` `G_{0,N}` and `originCovariance` `G_0`; and the number of components of one state.
fn read_boundary(node: &Node<'_>) -> Result<(Gaussian, usize)> {
    let keys = ["originMean", "destinationMean", "gain", "originCovariance", "destinationCovariance"];
    let fields = node.fields(&keys)?;
    let destination = fields.required("destinationCovariance")?;
    let s = destination.items()?.len();
    if s == 0 || s > MAX_STATES {
        return Err(destination.error(Code::WrongLength, &format!("must have 1 to {MAX_STATES} rows")));
    }
    let c_n = read_covariance(&destination, s)?;
    let g_0 = read_covariance(&fields.required("originCovariance")?, s)?;
    let gain = match fields.optional("gain") {
        Some(node) => DMatrix::from_row_slice(s, s, &node.matrix(s, s)?),
        None => DMatrix::zeros(s, s),
    };
    let mut mean = DVector::zeros(2 * s);
    for (key, from) in [("originMean", 0), ("destinationMean", s)] {
        if let Some(node) = fields.optional(key) {
            mean.rows_mut(from, s).copy_from_slice(&node.vector(Some(s))?);
        }
    }
    let mut covariance = DMatrix::zeros(2 * s, 2 * s);
    let cross = &gain * &c_n;
    covariance.view_mut((0, 0), (s, s)).copy_from(&propagate(&gain, &c_n, &g_0));
    covariance.view_mut((0, s), (s, s)).copy_from(&cross);
    covariance.view_mut((s, 0), (s, s)).tr_copy_from(&cross);
    covariance.view_mut((s, s), (s, s)).copy_from(&c_n);
    if Factor::new(covariance.clone()).is_none() {
        let must = "must leave the joint covariance of origin and destination positive definite";
        return Err(fields.required("gain")?.error(Code::NotPositiveDefinite, must));
    }
    Ok((Gaussian { mean, covariance }, s))
}

/// Reads one item for each of steps 1 to `N - 1`.
fn read_each<T>(node: &Node<'_>, count: usize, read: impl Fn(&Node<'_>) -> Result<T>) -> Result<Vec<T>> {
    let items = node.items()?;
    if items.len() != count {
        let must = format!("must have {count} items, one for each step between the ends, has {}", items.len());
        return Err(node.error(Code::WrongLength, &must));
    }
    items.map(|item| read(&item)).collect()
}
