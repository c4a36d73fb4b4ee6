//! Roots of small covariances in arrays of fixed size: [`super::gaussian`]'s array form for a filter of one axis.
//!
//! The root is lower triangular, its rows first those of the first state and then those of the state now; only the part of
//! an array that the arguments name is read.

use super::gaussian::VANISHING;

/// Turns the first `rows` rows of `columns` numbers into the lower triangle with the same square, its diagonal not
/// negative; see [`super::gaussian::triangularise`].
///
/// ```
/// let mut rows = [[3.0, 4.0], [0.0, 5.0]];
/// whither::math::small_root::triangularise(&mut rows, 2, 2);
/// for (found, expected) in rows.as_flattened().iter().zip([5.0, 0.0, 4.0, 3.0]) {
///     assert!((found - expected).abs() < 1e-14);
/// }
/// ```
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

/// Conditions the covariance `L L'` of `size` components on an observation of component `at` with this variance; gives the
/// gain and the prediction error's variance.
///
/// A rotation for each column, from the component's own to the first, turns `[R^1/2, H L]` into `[S^1/2, 0]`; it turns the
/// rows of `[0, L]` into those of `[K S^1/2, L+]` and leaves `L` triangular.
///
/// ```
/// let mut root = [[2.0]];
/// let (gain, spread) = whither::math::small_root::condition(&mut root, 1, 0, 4.0);
/// assert!((gain[0] - 0.5).abs() < 1e-15 && (spread - 8.0).abs() < 1e-14 && (root[0][0] - 2f64.sqrt()).abs() < 1e-15);
/// ```
pub fn condition<const SIZE: usize>(
    root: &mut [[f64; SIZE]; SIZE],
    size: usize,
    at: usize,
    variance: f64,
) -> ([f64; SIZE], f64) {
    let mut deviation = variance.sqrt();
    let mut leaning = [0.0; SIZE];
    for q in (0..=at).rev() {
        let known = root[at][q];
        let total = (deviation * deviation + known * known).sqrt();
        let (cosine, sine) = (deviation / total, known / total);
        for p in q..size {
            let (entry, lean) = (root[p][q], leaning[p]);
            root[p][q] = cosine * entry - sine * lean;
            leaning[p] = sine * entry + cosine * lean;
        }
        deviation = total;
    }
    for lean in &mut leaning {
        *lean /= deviation;
    }
    (leaning, deviation * deviation)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conditioning_is_that_of_whole_matrices() {
        let root = [[2.0, 0.0, 0.0], [0.5, 1.0, 0.0], [-0.3, 0.7, 0.4]];
        let whole = nalgebra::DMatrix::from_fn(3, 3, |i, j| root[i][j]);
        let seen = nalgebra::DMatrix::from_row_slice(1, 3, &[0.0, 1.0, 0.0]);
        let expected = crate::math::gaussian::condition_root(&whole, &seen, &nalgebra::dmatrix![0.3]).unwrap();
        let mut found = root;
        let (gain, spread) = condition(&mut found, 3, 1, 0.3);
        let found = nalgebra::DMatrix::from_fn(3, 3, |i, j| found[i][j]);
        assert!((found - &expected.root).amax() < 1e-15);
        assert!((0..3).all(|i| (gain[i] - expected.gain[(i, 0)]).abs() < 1e-15));
        assert!((spread - expected.prediction_error.root()[(0, 0)].powi(2)).abs() < 1e-15);
    }
}
