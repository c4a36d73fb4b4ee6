//! Gaussians of fixed size, in arrays, so that an observation allocates nothing: roots of covariances and their conditioning,
//! the inverse of small matrices, and in [`axis_filter`] the Kalman filter of one axis.
//!
//! Sizes that only a scenario gives (all axes together, several components observed at once) are with [`crate::dense`]: with room for the largest state they would copy the square of its size in every
//! step. Of an array that has room for more, only the part that the arguments name is read.

pub mod axis_filter;

use crate::vectors::Number;

/// A deviation whose square is no number with all its digits.
pub const VANISHING: f64 = 1e-150;

/// A square matrix, by rows.
pub type Matrix<const S: usize> = [[f64; S]; S];

/// A symmetric matrix over at most three axes: xx, xy, yy, xz, yz, zz.
pub type Symmetric<N = f64> = [N; 6];

/// Turns the first `rows` rows of `columns` numbers into the lower triangle with the same square, its diagonal not
/// negative; as `math::gaussian::triangularise` of whither.
#[inline(always)]
pub fn triangularise<const ROWS: usize, const COLUMNS: usize>(
    a: &mut [[f64; COLUMNS]; ROWS],
    rows: usize,
    columns: usize,
) {
    for i in 0..rows.min(ROWS) {
        let (upper, lower) = a.split_at_mut(i + 1);
        let row = &mut upper[i];
        let pivot = row[i];
        let mut reflector = [0.0; COLUMNS];
        let mut square = 0.0;
        for q in i..columns {
            square += row[q] * row[q];
            (reflector[q], row[q]) = (row[q], 0.0);
        }
        let norm = square.sqrt();
        if norm < VANISHING {
            continue;
        }
        row[i] = norm;
        let sign = if pivot > 0.0 { -1.0 } else { 1.0 };
        reflector[i] = pivot - sign * norm;
        let scale = 1.0 / (norm * (norm + pivot.abs()));
        for row in &mut lower[..rows - i - 1] {
            let mut dot = 0.0;
            for q in i..columns {
                dot += row[q] * reflector[q];
            }
            for q in i..columns {
                row[q] -= dot * scale * reflector[q];
            }
            row[i] *= sign;
        }
    }
}

/// Conditions the covariance `L L'` of `size` components on an observation of component `at` with this variance: returns the
/// gain and the prediction error's variance.
///
/// A rotation for each column, from the component's own to the first, turns `[R^1/2, H L]` into `[S^1/2, 0]`; it turns the
/// rows of `[0, L]` into those of `[K S^1/2, L+]` and leaves `L` triangular.
#[inline(always)]
pub fn condition<const SIZE: usize>(
    root: &mut [[f64; SIZE]; SIZE],
    size: usize,
    at: usize,
    variance: f64,
) -> ([f64; SIZE], f64) {
    let mut deviation = variance.sqrt();
    let mut gain = [0.0; SIZE];
    for q in (0..=at).rev() {
        let known = root[at][q];
        let total = (deviation * deviation + known * known).sqrt();
        let over = 1.0 / total;
        let (cosine, sine) = (deviation * over, known * over);
        for p in q..size {
            let (entry, scaled) = (root[p][q], gain[p]);
            root[p][q] = cosine * entry - sine * scaled;
            gain[p] = sine * entry + cosine * scaled;
        }
        deviation = total;
    }
    // so far it was K S^1/2
    let over = 1.0 / deviation;
    for entry in &mut gain {
        *entry *= over;
    }
    (gain, deviation * deviation)
}

/// A root of a positive semi-definite matrix over `s` components, lower triangular.
pub fn root<const S: usize>(p: &Matrix<S>, s: usize) -> Matrix<S> {
    let mut root = [[0.0; S]; S];
    for j in 0..s {
        let mut diagonal = 0.0;
        for i in j..s {
            let mut left = p[i][j];
            for q in 0..j {
                left -= root[i][q] * root[j][q];
            }
            if i > j {
                root[i][j] = left / diagonal;
            } else if left > 4.0 * f64::EPSILON * p[j][j] {
                diagonal = left.sqrt();
                root[j][j] = diagonal;
            } else {
                break;
            }
        }
    }
    root
}

/// The inverse and the determinant of a positive definite matrix by its adjugate, for numbers and for [`crate::vectors::Lanes`]
/// alike; the entries of axes that there are not are without meaning.
#[inline(always)]
pub fn inverse<N: Number>(matrix: &Symmetric<N>, dimensions: usize) -> (Symmetric<N>, N) {
    let [xx, xy, yy, xz, yz, zz] = *matrix;
    let (zero, one) = (N::of(0.0), N::of(1.0));
    if dimensions == 1 {
        return ([one / xx, zero, zero, zero, zero, zero], xx);
    }
    let f = xx * yy - xy * xy;
    if dimensions == 2 {
        let over = one / f;
        return ([yy * over, (zero - xy) * over, xx * over, zero, zero, zero], f);
    }
    let (a, b, c) = (yy * zz - yz * yz, xz * yz - xy * zz, xx * zz - xz * xz);
    let (d, e) = (xy * yz - xz * yy, xy * xz - xx * yz);
    let determinant = xx * a + xy * b + xz * d;
    let over = one / determinant;
    ([a * over, b * over, c * over, d * over, e * over, f * over], determinant)
}

/// A symmetric matrix times a vector.
#[must_use]
pub fn times(matrix: &Symmetric, v: &[f64; 3]) -> [f64; 3] {
    let [xx, xy, yy, xz, yz, zz] = *matrix;
    let [x, y, z] = *v;
    [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z]
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, dmatrix};

    fn dense<const S: usize>(a: &Matrix<S>) -> DMatrix<f64> {
        DMatrix::from_fn(S, S, |i, j| a[i][j])
    }

    #[test]
    fn a_triangle_keeps_the_square() {
        let mut rows = [[3.0, 4.0], [0.0, 5.0]];
        triangularise(&mut rows, 2, 2);
        assert!((dense(&rows) - dmatrix![5.0, 0.0; 4.0, 3.0]).amax() < 1e-14);
    }

    #[test]
    fn roots_of_semi_definite_matrices_have_their_square() {
        // the second component is twice the first
        let matrix = [[4.0, 8.0, 1.0], [8.0, 16.0, 2.0], [1.0, 2.0, 3.0]];
        let found = dense(&root(&[[4.0, 2.0], [2.0, 2.0]], 2));
        assert!((found - dmatrix![2.0, 0.0; 1.0, 1.0]).amax() < 1e-15);
        let first = dense(&root(&matrix, 2));
        assert!(((&first * first.transpose()) - dmatrix![4.0, 8.0, 0.0; 8.0, 16.0, 0.0; 0.0, 0.0, 0.0]).amax() < 1e-14);
    }

    #[test]
    fn the_inverse_is_one_and_has_its_determinant() {
        let matrix = dmatrix![4.0, 1.0, -0.5; 1.0, 3.0, 0.25; -0.5, 0.25, 2.0];
        for d in 1..=3 {
            let part = matrix.view((0, 0), (d, d)).into_owned();
            let (found, determinant) = inverse(&[4.0, 1.0, 3.0, -0.5, 0.25, 2.0], d);
            let place = [[0, 1, 3], [1, 2, 4], [3, 4, 5]];
            let found = DMatrix::from_fn(d, d, |i, j| found[place[i][j]]);
            assert!((found * &part - DMatrix::identity(d, d)).amax() < 1e-15);
            assert!((determinant - part.determinant()).abs() < 1e-13);
        }
    }
}
