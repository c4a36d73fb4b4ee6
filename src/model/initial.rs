//! The density of the state at the first observation, before that observation.

use super::observation::{ObservationModel, read_covariance};
use crate::error::{Code, Error, Result};
use crate::math::gaussian::{Gaussian, condition};
use crate::math::kalman::Measurement;
use crate::value::{Node, Value};
use nalgebra::{DMatrix, DVector};

/// What is known of `x_1` before `y_1`.
///
/// ```
/// use whither::{Value, model::{initial::Initial, observation::ObservationModel}, value::Node};
/// let value: Value = serde_json::from_str(r#"[{ "noise": 2 }, { "velocity": 5 }]"#).unwrap();
/// let Value::List(parts) = &value else { panic!() };
/// let model = ObservationModel::read(&Node::root(&parts[0], "observation"), 1, 2).unwrap();
/// let initial = Initial::read(Some(Node::root(&parts[1], "initial")), 1, 2, &[0.0]).unwrap();
/// let first = initial.posterior(&model, &model.measurement(&[Some(7.0)], None).unwrap()).unwrap();
/// assert_eq!(first.mean.as_slice(), [7.0, 0.0]); // where it was seen, at rest
/// assert_eq!(first.covariance.as_slice(), [4.0, 0.0, 0.0, 25.0]);
/// ```
#[derive(Clone, Debug)]
pub struct Initial {
    prior: Prior,
    evidence: bool,
    value: Value,
}

#[derive(Clone, Debug)]
enum Prior {
    /// Any Gaussian.
    Given(Gaussian),
    /// Flat in position; the other components have zero mean and these deviations.
    Flat(Vec<f64>),
}

impl Initial {
    /// Reads `{ mean, covariance, evidence? }`, or `{ velocity?, acceleration? }` for a density that is flat in position. A deviation
    /// that is left out is taken from `defaults`, one for each component after the position; where that is zero too it is
    /// missing.
    ///
    /// # Errors
    /// `unknown-key`, `missing-key`, `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`, `not-positive-definite`.
    pub fn read(node: Option<Node<'_>>, dimensions: usize, states: usize, defaults: &[f64]) -> Result<Self> {
        let Some(node) = node else {
            check(defaults, "initial")?;
            return Ok(Self { prior: Prior::Flat(defaults.to_vec()), evidence: false, value: Value::Null });
        };
        let fields = node.fields(&["mean", "covariance", "evidence", "velocity", "acceleration"])?;
        let evidence = fields.optional("evidence").map_or(Ok(false), |evidence| evidence.boolean())?;
        if fields.optional("mean").is_some() || fields.optional("covariance").is_some() {
            for key in ["velocity", "acceleration"] {
                if let Some(extra) = fields.optional(key) {
                    return Err(extra.error(Code::UnknownKey, "has no place beside mean and covariance"));
                }
            }
            let mean = DVector::from_vec(fields.required("mean")?.vector(Some(states))?);
            let covariance = read_covariance(&fields.required("covariance")?, states)?;
            let prior = Prior::Given(Gaussian { mean, covariance });
            return Ok(Self { prior, evidence, value: node.value().clone() });
        }
        if evidence && let Some(field) = fields.optional("evidence") {
            let must =
                "needs mean and covariance: of a density that is flat in position the first observation is no evidence";
            return Err(field.error(Code::OutOfRange, must));
        }
        let mut deviations = defaults.to_vec();
        for (order, key) in [(1, "velocity"), (2, "acceleration")] {
            let Some(field) = fields.optional(key) else { continue };
            if states < (order + 1) * dimensions {
                return Err(field.error(Code::OutOfRange, &format!("the motion model has no {key}")));
            }
            let values = field.for_each_axis(dimensions, |n| n.positive())?;
            deviations[(order - 1) * dimensions..order * dimensions].copy_from_slice(&values);
        }
        check(&deviations, &node.path())?;
        Ok(Self { prior: Prior::Flat(deviations), evidence: false, value: node.value().clone() })
    }

    /// The scenario's own form.
    #[must_use]
    pub const fn to_value(&self) -> &Value {
        &self.value
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
    /// `y_1:k`. By default they are those of `y_2:k` given `y_1`: where a movement begins is mostly chance, and says more about
    /// the one before it than about where this one goes.
    #[must_use]
    pub const fn counted(&self) -> Option<&Gaussian> {
        match &self.prior {
            Prior::Given(prior) if self.evidence => Some(prior),
            _ => None,
        }
    }

    /// `p(x_1 | y_1)`.
    ///
    /// # Errors
    /// `missing-key` where an axis is missing that only the first observation could tell.
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

fn check(deviations: &[f64], path: &str) -> Result<()> {
    if deviations.iter().all(|x| x.is_finite() && *x > 0.0) {
        return Ok(());
    }
    let message =
        "missing mean and covariance: not every component after the position has noise to take a deviation from";
    Err(Error::new(Code::MissingKey, path, message))
}
