//! The noise that drives a motion model, or candidates for it.

use super::super::per_axis::PerAxis;
use crate::error::{Code, Result};
use crate::value::{Node, Path, Value};

/// The most candidates that [`MotionNoise`] can have.
const MAX_CANDIDATES: usize = 64;

/// The square root of the spectral density of what drives a motion, or candidates for it.
///
/// Candidates run the model once for each and average over them by evidence (Bayesian model averaging).
///
/// ```
/// use whither::{Motion, MotionNoise};
/// let one = Motion::brownian(2, 3.0);
/// let each_axis_its_own = Motion::brownian(2, [3.0, 4.0]);
/// let calm_or_lively = Motion::brownian(2, MotionNoise::candidates([1.0, 9.0]));
/// assert_ne!(one, each_axis_its_own);
/// assert_ne!(one, calm_or_lively);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum MotionNoise {
    /// One noise.
    Known(PerAxis),
    /// One of several noises.
    Candidates {
        /// Up to 64 noises.
        noises: Vec<PerAxis>,
        /// The prior weight of each; the same for all where there are none.
        weights: Option<Vec<f64>>,
    },
}

impl<T: Into<PerAxis>> From<T> for MotionNoise {
    fn from(noise: T) -> Self {
        Self::Known(noise.into())
    }
}

impl MotionNoise {
    /// Candidates of equal weight.
    pub fn candidates<T: Into<PerAxis>>(noises: impl IntoIterator<Item = T>) -> Self {
        Self::Candidates { noises: noises.into_iter().map(Into::into).collect(), weights: None }
    }

    pub(super) fn read(node: &Node<'_>, dimensions: usize) -> Result<Self> {
        if !matches!(node.value(), Value::Map(_)) {
            return PerAxis::read(node, dimensions).map(Self::Known);
        }
        let fields = node.fields(&["candidates", "weights"])?;
        let candidates = fields.required("candidates")?;
        let noises = candidates.items()?.map(|item| PerAxis::read(&item, dimensions)).collect::<Result<_>>()?;
        let weights = fields.optional("weights").map(|weights| weights.floats()).transpose();
        Ok(Self::Candidates { noises, weights: weights? })
    }

    /// Of each candidate the noise of each axis and the weight, where they are given.
    pub(super) fn check(&self, at: &Path<'_>, dimensions: usize) -> Result<Vec<(Vec<f64>, f64)>> {
        let (noises, weights) = match self {
            Self::Known(noise) => return Ok(vec![(noise.check(at, dimensions, |at, x| at.positive(x))?, 1.0)]),
            Self::Candidates { noises, weights } => (noises, weights),
        };
        let place = at.key("candidates");
        let count = noises.len();
        let list = || Value::List(noises.iter().map(PerAxis::to_value).collect());
        if count == 0 {
            return Err(place.error(Code::WrongLength, "must have at least one candidate", list()));
        }
        if count > MAX_CANDIDATES {
            let must = format!("must have at most {MAX_CANDIDATES} candidates, has {count}");
            return Err(place.error(Code::TooLarge, &must, list()));
        }
        let each = noises.iter().enumerate();
        let each = each.map(|(i, noise)| noise.check(&place.index(i), dimensions, |at, x| at.positive(x)));
        let noises = each.collect::<Result<Vec<_>>>()?;
        let Some(weights) = weights else { return Ok(noises.into_iter().map(|noise| (noise, 1.0)).collect()) };
        let place = at.key("weights");
        let checked = place.vector(weights, count, |at, x| at.positive(x))?;
        if !checked.iter().sum::<f64>().is_finite() {
            return Err(place.error(Code::OutOfRange, "must have a finite sum", weights.as_slice()));
        }
        Ok(noises.into_iter().zip(checked.iter().copied()).collect())
    }

    pub(super) fn to_value(&self) -> Value {
        let (noises, weights) = match self {
            Self::Known(noise) => return noise.to_value(),
            Self::Candidates { noises, weights } => (noises, weights),
        };
        let mut entries = vec![("candidates".into(), Value::List(noises.iter().map(PerAxis::to_value).collect()))];
        entries.extend(weights.iter().map(|weights| ("weights".into(), Value::numbers(weights))));
        Value::Map(entries)
    }
}
