//! The density of the state at the first observation, before that observation; and whether that observation counts in Liang (5).

use super::matrix::Matrix;
use super::observation::ObservationModel;
use super::per_axis::PerAxis;
use crate::error::{Code, Error, Result};
use crate::math::gaussian::{Gaussian, condition};
use crate::math::kalman::Measurement;
use crate::value::{Node, Path, Value};
use nalgebra::{DMatrix, DVector};

/// What is known of the state `x_1` before the first observation `y_1` is taken in.
///
/// By default it is flat in position, and the other components have zero mean and the deviation that a second of the motion
/// model's noise gives them.
///
/// ```
/// use whither::Initial;
/// let fast = Initial::velocity(200.0); // flat in position; the velocity is N(0, 200^2) on each axis
/// let known = Initial::gaussian([0.0, 0.0], [[100.0, 0.0], [0.0, 4.0]]);
/// # let _ = (fast, known);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Initial {
    /// Flat in position, with zero mean and a deviation for the other components.
    Flat {
        /// The deviation of the velocity.
        velocity: Option<PerAxis>,
        /// The deviation of the acceleration.
        acceleration: Option<PerAxis>,
    },
    /// A Gaussian.
    Gaussian {
        /// `s` numbers.
        mean: Vec<f64>,
        /// `s` by `s`.
        covariance: Matrix,
        /// Whether the first observation counts as evidence, `p(y_1 | D_i, T)` in Liang (5): the likelihoods are then those of
        /// `y_1:k`. By default they are those of `y_2:k` given `y_1`: where a movement begins is mostly chance.
        evidence: bool,
    },
}

impl Default for Initial {
    fn default() -> Self {
        Self::Flat { velocity: None, acceleration: None }
    }
}

impl Initial {
    /// Flat in position; the velocity has zero mean and this deviation.
    pub fn velocity(deviation: impl Into<PerAxis>) -> Self {
        Self::Flat { velocity: Some(deviation.into()), acceleration: None }
    }

    /// A Gaussian; the first observation does not count as evidence.
    pub fn gaussian(mean: impl Into<Vec<f64>>, covariance: impl Into<Matrix>) -> Self {
        Self::Gaussian { mean: mean.into(), covariance: covariance.into(), evidence: false }
    }

    /// Reads `{ mean, covariance, evidence? }`, or `{ velocity?, acceleration? }`.
    pub(crate) fn read(node: &Node<'_>, dimensions: usize) -> Result<Self> {
        let fields = node.fields(&["mean", "covariance", "evidence", "velocity", "acceleration"])?;
        let evidence = fields.optional("evidence").map_or(Ok(false), |evidence| evidence.boolean())?;
        if fields.optional("mean").is_some() || fields.optional("covariance").is_some() {
            for key in ["velocity", "acceleration"] {
                if let Some(extra) = fields.optional(key) {
                    return Err(extra.error(Code::UnknownKey, "cannot be combined with mean and covariance"));
                }
            }
            let mean = fields.required("mean")?.floats()?;
            return Ok(Self::Gaussian { mean, covariance: Matrix::read(&fields.required("covariance")?)?, evidence });
        }
        if evidence && let Some(field) = fields.optional("evidence") {
            let must =
                "needs mean and covariance: of a density that is flat in position the first observation is no evidence";
            return Err(field.error(Code::OutOfRange, must));
        }
        let deviation = |key| fields.optional(key).map(|field| PerAxis::read(&field, dimensions)).transpose();
        Ok(Self::Flat { velocity: deviation("velocity")?, acceleration: deviation("acceleration")? })
    }

    fn to_value(&self) -> Value {
        match self {
            Self::Flat { velocity: None, acceleration: None } => Value::Null,
            Self::Flat { velocity, acceleration } => Value::some(vec![
                ("velocity", velocity.as_ref().map(PerAxis::to_value)),
                ("acceleration", acceleration.as_ref().map(PerAxis::to_value)),
            ]),
            Self::Gaussian { mean, covariance, evidence } => Value::some(vec![
                ("mean", Some(Value::numbers(mean))),
                ("covariance", Some(covariance.into())),
                ("evidence", evidence.then_some(Value::Bool(true))),
            ]),
        }
    }

    /// The density for a motion model of `states` components in `dimensions` axes. A deviation that is left out is taken from
    /// `defaults`, one for each component after the position; where that is zero too it is missing.
    ///
    /// # Errors
    /// `missing-key`, `wrong-length`, `not-finite`, `out-of-range`, `not-positive-definite`.
    pub(crate) fn density(
        &self,
        at: &Path<'_>,
        dimensions: usize,
        states: usize,
        defaults: &[f64],
    ) -> Result<InitialDensity> {
        let prior = match self {
            Self::Gaussian { mean, covariance, .. } => {
                let mean = at.key("mean").vector(mean, states, |at, x| at.number(x))?;
                let covariance = covariance.covariance(&at.key("covariance"), states)?;
                Prior::Given(Gaussian { mean: DVector::from_column_slice(mean), covariance })
            }
            Self::Flat { velocity, acceleration } => {
                let mut deviations = defaults.to_vec();
                for (order, key, given) in [(1, "velocity", velocity), (2, "acceleration", acceleration)] {
                    let Some(given) = given else { continue };
                    let place = at.key(key);
                    if states < (order + 1) * dimensions {
                        let must = format!("the motion model has no {key}");
                        return Err(place.error(Code::OutOfRange, &must, given.to_value()));
                    }
                    let values = given.check(&place, dimensions, |at, x| at.positive(x))?;
                    deviations[(order - 1) * dimensions..order * dimensions].copy_from_slice(&values);
                }
                if !deviations.iter().all(|x| x.is_finite() && *x > 0.0) {
                    let message = "missing mean and covariance: not every component after the position has noise to take \
                                   a deviation from";
                    return Err(Error::new(Code::MissingKey, at.to_string(), message));
                }
                Prior::Flat(deviations)
            }
        };
        Ok(InitialDensity { prior, description: self.clone() })
    }
}

/// `p(x_1)`.
#[derive(Clone, Debug)]
pub struct InitialDensity {
    prior: Prior,
    description: Initial,
}

#[derive(Clone, Debug)]
enum Prior {
    /// Any Gaussian.
    Given(Gaussian),
    /// Flat in position; the other components have zero mean and these deviations.
    Flat(Vec<f64>),
}

impl InitialDensity {
    /// The scenario's own form.
    #[must_use]
    pub fn to_value(&self) -> Value {
        self.description.to_value()
    }

    /// Whether nothing is known of the position before the first observation.
    #[must_use]
    pub const fn is_flat(&self) -> bool {
        matches!(self.prior, Prior::Flat(_))
    }

    /// The deviations of the components after the position, where the density is flat in position.
    #[must_use]
    pub fn flat_deviations(&self) -> Option<&[f64]> {
        match &self.prior {
            Prior::Flat(deviations) => Some(deviations),
            Prior::Given(_) => None,
        }
    }

    /// `p(x_1)` where the evidence of the first observation counts, Liang (5)'s `p(y_1 | D_i, T)`: the likelihoods are then those of
    /// `y_1:k`. By default they are those of `y_2:k` given `y_1`: where a movement begins is mostly chance, evidence about
    /// the movement before it more than about where this one goes.
    #[must_use]
    pub const fn counted(&self) -> Option<&Gaussian> {
        match (&self.prior, &self.description) {
            (Prior::Given(prior), Initial::Gaussian { evidence: true, .. }) => Some(prior),
            _ => None,
        }
    }

    /// `p(x_1 | y_1)`.
    ///
    /// # Errors
    /// `missing-key` where an axis is missing that only the first observation could give.
    pub fn posterior(&self, model: &ObservationModel, first: &Measurement) -> Result<Gaussian> {
        match &self.prior {
            Prior::Given(prior) => {
                if first.value.is_empty() {
                    return Ok(prior.clone());
                }
                let error = &first.value - &first.matrix * &prior.mean;
                let conditioning = condition(&prior.covariance, &first.matrix, &first.noise).ok_or_else(|| {
                    Error::new(Code::NotPositiveDefinite, "noise", "the first observation has no density")
                })?;
                Ok(Gaussian { mean: &prior.mean + &conditioning.gain * &error, covariance: conditioning.covariance() })
            }
            Prior::Flat(deviations) => {
                let (axes, states) = (model.axes(), first.matrix.ncols());
                if first.value.len() < axes {
                    return Err(Error::new(
                        Code::MissingKey,
                        "position",
                        format!("the first observation must have all {axes} axes: initial is flat in position"),
                    ));
                }
                let mut mean = DVector::zeros(states);
                mean.rows_mut(0, axes).copy_from(&first.value);
                let mut covariance = DMatrix::zeros(states, states);
                covariance.view_mut((0, 0), (axes, axes)).copy_from(&first.noise);
                for (i, deviation) in deviations.iter().enumerate() {
                    covariance[(axes + i, axes + i)] = deviation * deviation;
                }
                Ok(Gaussian { mean, covariance })
            }
        }
    }
}
