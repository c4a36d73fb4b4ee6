//! Matrices as lists of rows.

use crate::error::{Code, Result};
use crate::math::gaussian::{Factor, is_symmetric};
use crate::value::{LARGEST, Node, Path, Value};
use nalgebra::DMatrix;

/// The square of the smallest deviation that [`Path::positive`] takes.
const SMALLEST_VARIANCE: f64 = 1.0 / (LARGEST * LARGEST);

/// A matrix as a list of rows. Whatever takes one takes arrays, vectors and nalgebra's matrices too.
///
/// ```
/// use whither::Matrix;
/// assert_eq!(Matrix::from([[1.0, 0.5], [0.5, 2.0]]), Matrix::from(vec![vec![1.0, 0.5], vec![0.5, 2.0]]));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix(Vec<Vec<f64>>);

impl From<Vec<Vec<f64>>> for Matrix {
    fn from(rows: Vec<Vec<f64>>) -> Self {
        Self(rows)
    }
}

impl<const ROWS: usize, const COLUMNS: usize> From<[[f64; COLUMNS]; ROWS]> for Matrix {
    fn from(rows: [[f64; COLUMNS]; ROWS]) -> Self {
        Self(rows.map(|row| row.to_vec()).to_vec())
    }
}

impl From<&DMatrix<f64>> for Matrix {
    fn from(matrix: &DMatrix<f64>) -> Self {
        Self(matrix.row_iter().map(|row| row.iter().copied().collect()).collect())
    }
}

impl From<DMatrix<f64>> for Matrix {
    fn from(matrix: DMatrix<f64>) -> Self {
        Self::from(&matrix)
    }
}

impl From<&Matrix> for Value {
    fn from(matrix: &Matrix) -> Self {
        Self::List(matrix.0.iter().map(Self::numbers).collect())
    }
}

impl Matrix {
    pub(crate) fn read(node: &Node<'_>) -> Result<Self> {
        Ok(Self(node.items()?.map(|row| row.floats()).collect::<Result<_>>()?))
    }

    /// How many rows there are.
    pub(crate) fn rows(&self) -> usize {
        self.0.len()
    }

    /// The matrix, if it is of this shape and finite.
    pub(crate) fn check(&self, at: &Path<'_>, rows: usize, columns: usize) -> Result<DMatrix<f64>> {
        if self.rows() != rows {
            let must = format!("must have {rows} rows of {columns} numbers, has {} rows", self.rows());
            return Err(at.error(Code::WrongLength, &must, self));
        }
        let mut numbers = Vec::with_capacity(rows * columns);
        for (i, row) in self.0.iter().enumerate() {
            numbers.extend(at.index(i).vector(row, columns, |at, x| at.number(x))?);
        }
        Ok(DMatrix::from_row_slice(rows, columns, &numbers))
    }

    /// The matrix, if it is a covariance of `n` components: symmetric and positive definite.
    pub(crate) fn covariance(&self, at: &Path<'_>, n: usize) -> Result<DMatrix<f64>> {
        let matrix = self.check(at, n, n)?;
        if (0..n).any(|i| matrix[(i, i)] > 0.0 && matrix[(i, i)] < SMALLEST_VARIANCE) {
            return Err(at.error(Code::OutOfRange, "must have variances of at least 1e-100", self));
        }
        if !is_symmetric(&matrix) || Factor::new(matrix.clone()).is_none() {
            return Err(at.error(Code::NotPositiveDefinite, "must be symmetric and positive definite", self));
        }
        Ok(matrix)
    }
}
