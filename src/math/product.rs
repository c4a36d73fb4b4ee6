//! Products of matrices, each in one form that is not generic: for every pair of kinds of matrices nalgebra makes its operator
//! anew, and behind it stands a blocked product for matrices far larger than any here.

use nalgebra::{DMatrix, DVector};

/// `A B`; nothing of either where their shapes do not fit.
///
/// ```
/// use nalgebra::dmatrix;
/// use whither::math::product::product;
/// assert_eq!(product(&dmatrix![1.0, 2.0; 3.0, 4.0], &dmatrix![5.0; 6.0]), dmatrix![17.0; 39.0]);
/// ```
#[must_use]
#[inline(never)]
pub fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut whole = DMatrix::zeros(a.nrows(), b.ncols());
    add(a.as_slice(), b.as_slice(), whole.as_mut_slice(), (a.nrows(), a.ncols()));
    whole
}

/// `A B'`.
///
/// ```
/// use nalgebra::dmatrix;
/// use whither::math::product::product_transposed;
/// assert_eq!(product_transposed(&dmatrix![1.0, 2.0], &dmatrix![5.0, 6.0; 7.0, 8.0]), dmatrix![17.0, 23.0]);
/// ```
#[must_use]
pub fn product_transposed(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    product(a, &b.transpose())
}

/// `A x`.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use whither::math::product::apply;
/// assert_eq!(apply(&dmatrix![1.0, 2.0; 3.0, 4.0], &dvector![5.0, 6.0]), dvector![17.0, 39.0]);
/// ```
#[must_use]
#[inline(never)]
pub fn apply(a: &DMatrix<f64>, x: &DVector<f64>) -> DVector<f64> {
    let mut whole = DVector::zeros(a.nrows());
    add(a.as_slice(), x.as_slice(), whole.as_mut_slice(), (a.nrows(), a.ncols()));
    whole
}

/// Adds to each column of `into` the columns of `a`, `rows` by `columns`, times what `b` has in that column.
fn add(a: &[f64], b: &[f64], into: &mut [f64], (rows, columns): (usize, usize)) {
    if rows == 0 || columns == 0 {
        return;
    }
    for (into, b) in into.chunks_exact_mut(rows).zip(b.chunks_exact(columns)) {
        for (a, factor) in a.chunks_exact(rows).zip(b) {
            for (sum, x) in into.iter_mut().zip(a) {
                *sum += factor * x;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_nalgebra_whatever_the_shapes() {
        for (n, m, l) in [(1, 1, 1), (2, 3, 4), (7, 9, 8), (12, 1, 12), (0, 2, 3), (2, 0, 3), (2, 3, 0)] {
            let a = DMatrix::from_fn(n, m, |i, j| (i as f64 - 0.5).powi(2) + 0.3 * j as f64);
            let b = DMatrix::from_fn(m, l, |i, j| 1.0 / (1.0 + i as f64 + 2.0 * j as f64));
            let x = DVector::from_fn(m, |i, _| 0.7 - i as f64);
            let near = |found: &DMatrix<f64>, expected: &DMatrix<f64>| {
                assert_eq!(found.shape(), expected.shape());
                assert!(found.iter().zip(expected.iter()).all(|(x, y)| (x - y).abs() <= 1e-14 * (1.0 + y.abs())));
            };
            near(&product(&a, &b), &(&a * &b));
            near(&product_transposed(&a, &b.transpose()), &(&a * &b));
            assert!((apply(&a, &x) - &a * &x).iter().all(|x| x.abs() < 1e-12));
        }
    }
}
