//! Sequences as they are described, by a Markov model or matrix by matrix, and how they are read.

use crate::error::{Code, Result};
use crate::model::matrix::Matrix;
use crate::model::motion::Motion;
use crate::model::observation::Observation;
use crate::value::{Node, Value};

/// A sequence that is induced by a motion model, from an origin to a destination, by way of waypoints if there are any; Rezaie and
/// Li (10)-(11) with (7)-(9). [`ConditionallyMarkovSequence::new`](crate::ConditionallyMarkovSequence::new) validates it, with an
/// example.
///
/// ```
/// use whither::{Motion, Observation, SequenceParameters};
/// let walk = SequenceParameters {
///     motion: Motion::brownian(1, 1.0),
///     time_step: [1.0, 2.0, 1.0].into(),
///     steps: 3,
///     pins: None,
///     pinned_mean: vec![0.0, 8.0],
///     pinned_covariance: [[1.0, 0.0], [0.0, 1.0]].into(),
///     observation: Observation::deviation(1.0),
/// };
/// assert!(whither::ConditionallyMarkovSequence::new(&walk).is_ok());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SequenceParameters {
    /// How it would move if nothing were known of where it is going. A motion model that depends on its destination's centre takes
    /// the destination's mean position for it.
    pub motion: Motion,
    /// The length of each step, in seconds.
    pub time_step: TimeStep,
    /// `N`, up to 100 000: the states are `x_0` to `x_N`.
    pub steps: usize,
    /// The steps whose states are pinned, ascending, from 0 to `steps`; these two alone unless given.
    pub pins: Option<Vec<usize>>,
    /// The mean of the pinned states, one behind the other.
    pub pinned_mean: Vec<f64>,
    /// Their joint covariance.
    pub pinned_covariance: Matrix,
    /// How states are measured.
    pub observation: Observation,
}

/// The length of the steps of a sequence, in seconds.
///
/// ```
/// use whither::TimeStep;
/// assert_eq!(TimeStep::from(0.5), TimeStep::Regular(0.5));
/// assert_eq!(TimeStep::from([0.5, 1.0]), TimeStep::Irregular(vec![0.5, 1.0]));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum TimeStep {
    /// The same for all steps.
    Regular(f64),
    /// One for each step.
    Irregular(Vec<f64>),
}

impl From<f64> for TimeStep {
    fn from(step: f64) -> Self {
        Self::Regular(step)
    }
}

impl From<Vec<f64>> for TimeStep {
    fn from(steps: Vec<f64>) -> Self {
        Self::Irregular(steps)
    }
}

impl<const N: usize> From<[f64; N]> for TimeStep {
    fn from(steps: [f64; N]) -> Self {
        Self::Irregular(steps.to_vec())
    }
}

/// A sequence that is given matrix by matrix, Rezaie and Li (2): `x_k = previous x_{k-1} + destination x_N + offset + e`.
/// [`ConditionallyMarkovSequence::from_parameters`](crate::ConditionallyMarkovSequence::from_parameters) validates it.
///
/// ```
/// use whither::{Boundary, ConditionallyMarkovSequence, GivenSequence, Observation};
/// let sequence = ConditionallyMarkovSequence::from_parameters(&GivenSequence {
///     previous: vec![[[0.5]].into()],
///     destination: vec![[[0.5]].into()],
///     offset: None,
///     covariance: vec![[[1.0]].into()],
///     boundary: Boundary {
///         origin_mean: None,
///         destination_mean: Some(vec![8.0]),
///         gain: None,
///         origin_covariance: [[1.0]].into(),
///         destination_covariance: [[4.0]].into(),
///     },
///     observation: Observation::deviation(0.1),
///     dimensions: None,
/// })?;
/// assert_eq!(sequence.state(1)?.mean[0], 4.0);
/// # Ok::<(), whither::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct GivenSequence {
    /// `G_{k,k-1}` for each step `k = 1 .. N - 1`, `s` by `s`.
    pub previous: Vec<Matrix>,
    /// `G_{k,N}` for each of these steps.
    pub destination: Vec<Matrix>,
    /// What is added in each of these steps, `s` numbers; zero where it is left out.
    pub offset: Option<Vec<Vec<f64>>>,
    /// `G_k`, the covariance of `e`, for each of these steps.
    pub covariance: Vec<Matrix>,
    /// The origin and the destination.
    pub boundary: Boundary,
    /// How states are measured.
    pub observation: Observation,
    /// How many components of a state are its position: half of them unless given, all where their number is odd.
    pub dimensions: Option<usize>,
}

/// The boundary condition, Rezaie and Li (3): `x_N ~ N(destination_mean, destination_covariance)` and
/// `x_0 = origin_mean + gain (x_N - destination_mean) + e_0`, `e_0 ~ N(0, origin_covariance)`; what is left out is zero.
///
/// ```
/// use whither::Boundary;
/// let independent = Boundary {
///     origin_mean: None,
///     destination_mean: Some(vec![8.0]),
///     gain: None,
///     origin_covariance: [[1.0]].into(),
///     destination_covariance: [[4.0]].into(),
/// };
/// assert_eq!(independent.clone(), independent);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// `s` numbers.
    pub origin_mean: Option<Vec<f64>>,
    /// `s` numbers.
    pub destination_mean: Option<Vec<f64>>,
    /// `G_{0,N}`, `s` by `s`.
    pub gain: Option<Matrix>,
    /// `G_0`, `s` by `s`.
    pub origin_covariance: Matrix,
    /// `C_N`, `s` by `s`; `s` is at most 64.
    pub destination_covariance: Matrix,
}

impl SequenceParameters {
    /// Reads `{ motion, timeStep, steps, pins?, pinnedMean, pinnedCovariance, observation }`.
    pub(crate) fn read(node: &Node<'_>) -> Result<Self> {
        let keys = ["motion", "timeStep", "steps", "pins", "pinnedMean", "pinnedCovariance", "observation"];
        let fields = node.fields(&keys)?;
        let motion = Motion::read(&fields.required("motion")?)?;
        let steps = fields.required("steps")?.integer(1, super::MAX_STEPS)?;
        Ok(Self {
            time_step: TimeStep::read(&fields.required("timeStep")?)?,
            steps,
            pins: fields.optional("pins").map(|pins| read_pins(&pins, steps)).transpose()?,
            pinned_mean: fields.required("pinnedMean")?.floats()?,
            pinned_covariance: Matrix::read(&fields.required("pinnedCovariance")?)?,
            observation: Observation::read(&fields.required("observation")?, motion.dimensions())?,
            motion,
        })
    }
}

impl TimeStep {
    fn read(node: &Node<'_>) -> Result<Self> {
        match node.value() {
            Value::List(_) => Ok(Self::Irregular(node.floats()?)),
            Value::Number(step) => Ok(Self::Regular(*step)),
            _ => Err(node.error(Code::WrongType, "must be a number, or a list with the length of each step")),
        }
    }

    pub(super) fn to_value(&self) -> Value {
        match self {
            Self::Regular(step) => Value::Number(*step),
            Self::Irregular(steps) => Value::numbers(steps),
        }
    }
}

fn read_pins(node: &Node<'_>, steps: usize) -> Result<Vec<usize>> {
    let pin = |item: Node<'_>| match item.float()? {
        x if x.fract() == 0.0 && (0.0..=steps as f64).contains(&x) => Ok(x as usize),
        _ => Err(item.error(Code::OutOfRange, &format!("must be an integer from 0 to {steps}"))),
    };
    node.items()?.map(pin).collect()
}

impl GivenSequence {
    /// Reads `{ previous, destination, offset?, covariance, boundary, observation, dimensions? }`.
    pub(crate) fn read(node: &Node<'_>) -> Result<Self> {
        let keys = ["previous", "destination", "offset", "covariance", "boundary", "observation", "dimensions"];
        let fields = node.fields(&keys)?;
        let matrices = |key| fields.required(key)?.items()?.map(|item| Matrix::read(&item)).collect::<Result<Vec<_>>>();
        let boundary = Boundary::read(&fields.required("boundary")?)?;
        let states = boundary.destination_covariance.rows();
        let dimensions = fields.optional("dimensions").map(|dimensions| dimensions.integer(1, states)).transpose()?;
        let offset = match fields.optional("offset") {
            Some(offset) => Some(offset.items()?.map(|item| item.floats()).collect::<Result<Vec<_>>>()?),
            None => None,
        };
        Ok(Self {
            previous: matrices("previous")?,
            destination: matrices("destination")?,
            offset,
            covariance: matrices("covariance")?,
            boundary,
            observation: Observation::read(&fields.required("observation")?, dimensions.unwrap_or(states))?,
            dimensions,
        })
    }
}

impl Boundary {
    /// Reads `{ originMean?, destinationMean?, gain?, originCovariance, destinationCovariance }`.
    fn read(node: &Node<'_>) -> Result<Self> {
        let keys = ["originMean", "destinationMean", "gain", "originCovariance", "destinationCovariance"];
        let fields = node.fields(&keys)?;
        let mean = |key| fields.optional(key).map(|mean| mean.floats()).transpose();
        Ok(Self {
            origin_mean: mean("originMean")?,
            destination_mean: mean("destinationMean")?,
            gain: fields.optional("gain").map(|gain| Matrix::read(&gain)).transpose()?,
            origin_covariance: Matrix::read(&fields.required("originCovariance")?)?,
            destination_covariance: Matrix::read(&fields.required("destinationCovariance")?)?,
        })
    }
}
