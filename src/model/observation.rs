//! Observations, Liang (2): `y_k = G x_k + v`, `v ~ N(0, V)`, and what is left of them where axes are missing.

use crate::error::{Code, Error, Result};
use crate::math::gaussian::{Factor, is_symmetric};
use crate::math::kalman::Measurement;
use crate::value::{LARGEST, Node, Value};
use nalgebra::{DMatrix, DVector};

/// How the state is observed: the matrix `G` (positions by default) and the covariance `V`.
///
/// ```
/// use whither::{Value, model::observation::ObservationModel, value::Node};
/// let value: Value = serde_json::from_str(r#"{ "noise": 3 }"#).unwrap();
/// let model = ObservationModel::read(&Node::root(&value, "observation"), 2, 4).unwrap();
/// assert!(model.is_position() && model.axes() == 2);
/// assert_eq!(model.noise().as_slice(), [9.0, 0.0, 0.0, 9.0]); // a deviation is squared
/// ```
#[derive(Clone, Debug)]
pub struct ObservationModel {
    /// `G`, `m` by `s`; none where positions are observed as they are, `G = [I 0]`.
    matrix: Option<DMatrix<f64>>,
    noise: DMatrix<f64>,
    states: usize,
    value: Value,
}

impl ObservationModel {
    /// Reads `{ noise, matrix? }`. `noise` is a deviation (one number, or one for each axis) or a covariance matrix.
    ///
    /// # Errors
    /// `missing-key`, `unknown-key`, `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`, `not-positive-definite`.
    pub fn read(node: &Node<'_>, dimensions: usize, states: usize) -> Result<Self> {
        let fields = node.fields(&["noise", "matrix"])?;
        let matrix = match fields.optional("matrix") {
            None => None,
            Some(matrix) => {
                let rows = matrix.items()?.len();
                if rows == 0 || rows > 32 {
                    return Err(matrix.error(Code::WrongLength, "must have 1 to 32 rows"));
                }
                Some(DMatrix::from_row_slice(rows, states, &matrix.matrix(rows, states)?))
            }
        };
        let axes = matrix.as_ref().map_or(dimensions, DMatrix::nrows);
        let noise = read_noise(&fields.required("noise")?, axes)?;
        Ok(Self { matrix, noise, states, value: node.value().clone() })
    }

    /// The scenario's own form.
    #[must_use]
    pub const fn to_value(&self) -> &Value {
        &self.value
    }

    /// The number of components `m` of one observation.
    #[must_use]
    pub fn axes(&self) -> usize {
        self.noise.nrows()
    }

    /// Whether an observation is a position as it is, `G = [I 0]`.
    #[must_use]
    pub const fn is_position(&self) -> bool {
        self.matrix.is_none()
    }

    /// The covariance `V`, `m` by `m`.
    #[must_use]
    pub const fn noise(&self) -> &DMatrix<f64> {
        &self.noise
    }

    /// Whether this can be an observation; none marks a missing axis.
    ///
    /// # Errors
    /// `wrong-length`, `not-finite`, `out-of-range`.
    pub fn check(&self, position: &[Option<f64>]) -> Result<()> {
        let axes = self.axes();
        if position.len() != axes {
            let message = format!("must have {axes} numbers, has {}", position.len());
            return Err(Error::new(Code::WrongLength, "position", message));
        }
        for (i, y) in position.iter().enumerate() {
            if let Some(y) = y
                && !(y.abs() <= LARGEST)
            {
                Node::root(&Value::Number(*y), &format!("position[{i}]")).number()?;
            }
        }
        Ok(())
    }

    /// An observation as a measurement: none marks a missing axis, `noise` replaces `V` for this one.
    ///
    /// # Errors
    /// As [`ObservationModel::check`].
    pub fn measurement(&self, position: &[Option<f64>], noise: Option<&DMatrix<f64>>) -> Result<Measurement> {
        self.check(position)?;
        let (rows, values): (Vec<usize>, Vec<f64>) =
            position.iter().enumerate().filter_map(|(i, y)| y.map(|y| (i, y))).unzip();
        let covariance = noise.unwrap_or(&self.noise);
        Ok(Measurement {
            value: DVector::from_vec(values),
            matrix: DMatrix::from_fn(rows.len(), self.states, |r, c| match &self.matrix {
                Some(matrix) => matrix[(rows[r], c)],
                None => f64::from(u8::from(rows[r] == c)),
            }),
            noise: DMatrix::from_fn(rows.len(), rows.len(), |r, c| covariance[(rows[r], rows[c])]),
        })
    }

    /// Reads the noise of one observation: the same forms as the scenario's.
    ///
    /// # Errors
    /// As [`ObservationModel::read`].
    pub fn read_noise(&self, node: &Node<'_>) -> Result<DMatrix<f64>> {
        read_noise(node, self.axes())
    }
}

/// The square of the smallest deviation that [`Node::positive`] takes.
const SMALLEST_VARIANCE: f64 = 1.0 / (LARGEST * LARGEST);

fn read_noise(node: &Node<'_>, axes: usize) -> Result<DMatrix<f64>> {
    if let Value::List(items) = node.value()
        && items.iter().any(|item| matches!(item, Value::List(_)))
    {
        return read_covariance(node, axes);
    }
    let deviations = node.for_each_axis(axes, |n| n.positive())?;
    Ok(DMatrix::from_diagonal(&DVector::from_iterator(axes, deviations.iter().map(|x| x * x))))
}

/// Reads a covariance matrix, `n` by `n`, symmetric and positive definite.
///
/// # Errors
/// `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`, `not-positive-definite`.
pub fn read_covariance(node: &Node<'_>, n: usize) -> Result<DMatrix<f64>> {
    let matrix = DMatrix::from_row_slice(n, n, &node.matrix(n, n)?);
    if (0..n).any(|i| matrix[(i, i)] > 0.0 && matrix[(i, i)] < SMALLEST_VARIANCE) {
        return Err(node.error(Code::OutOfRange, "must have variances of at least 1e-100"));
    }
    if !is_symmetric(&matrix) || Factor::new(matrix.clone()).is_none() {
        return Err(node.error(Code::NotPositiveDefinite, "must be symmetric and positive definite"));
    }
    Ok(matrix)
}
