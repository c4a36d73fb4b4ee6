//! Observations, Liang (2): `y_k = G x_k + v`, `v ~ N(0, V)`, and what is left of them where axes are missing.

use super::matrix::Matrix;
use super::per_axis::PerAxis;
use crate::error::{Code, Error, Result};
use crate::math::kalman::Measurement;
use crate::value::{Node, Path, Value};
use nalgebra::{DMatrix, DVector};

/// The most components of one observation.
const MOST_ROWS: usize = 32;

/// How the state is observed: `y_k = G x_k + v`, `v ~ N(0, V)`; Liang (2).
///
/// ```
/// use whither::Observation;
/// let position = Observation::deviation(1.5); // on each axis, in the unit of the positions
/// let radar = Observation::covariance([[4.0, 1.0], [1.0, 9.0]]);
/// let first_axis_alone = Observation::deviation(2.0).matrix([[1.0, 0.0, 0.0, 0.0]]); // of a state of four components
/// # let _ = (position, radar, first_axis_alone);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    noise: ObservationNoise,
    matrix: Option<Matrix>,
}

/// The noise of an observation, `v ~ N(0, V)`: a deviation for all axes or for each, or the covariance `V`.
///
/// ```
/// use whither::{Matrix, ObservationNoise};
/// let rough: ObservationNoise = 20.0.into();
/// let correlated: ObservationNoise = Matrix::from([[4.0, 1.0], [1.0, 9.0]]).into();
/// assert_ne!(rough, correlated);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum ObservationNoise {
    /// Standard deviations, of axes that do not depend on one another.
    Deviation(PerAxis),
    /// `V`, symmetric and positive definite.
    Covariance(Matrix),
}

impl<T: Into<PerAxis>> From<T> for ObservationNoise {
    fn from(deviation: T) -> Self {
        Self::Deviation(deviation.into())
    }
}

impl From<Matrix> for ObservationNoise {
    fn from(covariance: Matrix) -> Self {
        Self::Covariance(covariance)
    }
}

impl Observation {
    /// Positions with noise of this standard deviation, on all axes or on each.
    pub fn deviation(deviation: impl Into<PerAxis>) -> Self {
        Self { noise: ObservationNoise::Deviation(deviation.into()), matrix: None }
    }

    /// Positions with noise of this covariance `V`.
    pub fn covariance(covariance: impl Into<Matrix>) -> Self {
        Self { noise: ObservationNoise::Covariance(covariance.into()), matrix: None }
    }

    /// Observes `G x` in place of the position: `G` has 1 to 32 rows of `s` numbers.
    #[must_use]
    pub fn matrix(self, matrix: impl Into<Matrix>) -> Self {
        Self { matrix: Some(matrix.into()), ..self }
    }

    /// Reads `{ noise, matrix? }`.
    pub(crate) fn read(node: &Node<'_>, dimensions: usize) -> Result<Self> {
        let fields = node.fields(&["noise", "matrix"])?;
        let matrix = fields.optional("matrix").map(|matrix| Matrix::read(&matrix)).transpose()?;
        let axes = matrix.as_ref().map_or(dimensions, Matrix::rows);
        Ok(Self { noise: ObservationNoise::read(&fields.required("noise")?, axes)?, matrix })
    }

    fn to_value(&self) -> Value {
        let noise = match &self.noise {
            ObservationNoise::Deviation(deviation) => deviation.to_value(),
            ObservationNoise::Covariance(covariance) => covariance.into(),
        };
        Value::some(vec![("noise", Some(noise)), ("matrix", self.matrix.as_ref().map(Value::from))])
    }

    /// The model of observations of a motion model with `states` components in `dimensions` axes.
    ///
    /// # Errors
    /// `wrong-length`, `not-finite`, `out-of-range`, `not-positive-definite`.
    pub(crate) fn model(&self, at: &Path<'_>, dimensions: usize, states: usize) -> Result<ObservationModel> {
        let matrix = match &self.matrix {
            None => None,
            Some(matrix) => {
                let place = at.key("matrix");
                if matrix.rows() == 0 || matrix.rows() > MOST_ROWS {
                    return Err(place.error(Code::WrongLength, "must have 1 to 32 rows", matrix));
                }
                Some(matrix.check(&place, matrix.rows(), states)?)
            }
        };
        let noise = self.noise.check(&at.key("noise"), matrix.as_ref().map_or(dimensions, DMatrix::nrows))?;
        Ok(ObservationModel { matrix, noise, states, description: self.clone() })
    }
}

impl ObservationNoise {
    pub(crate) fn read(node: &Node<'_>, axes: usize) -> Result<Self> {
        match node.value() {
            Value::List(items) if items.iter().any(|item| matches!(item, Value::List(_))) => {
                Matrix::read(node).map(Self::Covariance)
            }
            _ => PerAxis::read(node, axes).map(Self::Deviation),
        }
    }

    /// The covariance `V` of so many axes.
    pub(crate) fn check(&self, at: &Path<'_>, axes: usize) -> Result<DMatrix<f64>> {
        match self {
            Self::Covariance(covariance) => covariance.covariance(at, axes),
            Self::Deviation(deviation) => {
                let deviations = deviation.check(at, axes, |at, x| at.positive(x))?;
                Ok(DMatrix::from_diagonal(&DVector::from_iterator(axes, deviations.iter().map(|x| x * x))))
            }
        }
    }
}

/// The model of the observations: the matrix `G` (positions by default) and the covariance `V`.
#[derive(Clone, Debug)]
pub struct ObservationModel {
    /// `G`, `m` by `s`; none where positions are observed as they are, `G = [I 0]`.
    matrix: Option<DMatrix<f64>>,
    noise: DMatrix<f64>,
    states: usize,
    description: Observation,
}

impl ObservationModel {
    /// The scenario's own form.
    #[must_use]
    pub fn to_value(&self) -> Value {
        self.description.to_value()
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
            if let Some(y) = y {
                Path::root("position").index(i).number(*y)?;
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
}
