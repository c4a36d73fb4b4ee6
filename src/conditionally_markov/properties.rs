//! Whether a sequence is reciprocal, whether it is Markov: Rezaie and Li, Theorem 3.2.
//!
//! ```text
//! reciprocal:  G_k^-1 G_{k,N} = G'_{k+1,k} G_{k+1}^-1 G_{k+1,N},  k = 1 .. N - 2
//! Markov:      the same for k = 0 as well
//! ```
//! Each side minus the other is a block `(k, N)` of the inverse of the covariance of the complete sequence: a sequence is
//! reciprocal if that inverse is block tridiagonal but for the corner `(0, N)`, and Markov if the corner vanishes too. With
//! waypoints the same holds for every block: those of a state and the next pin, and those of two pins.

use super::model::{Model, StepModel};
use crate::error::{Code, Error, Result};
use crate::math::gaussian::Factor;
use nalgebra::{DMatrix, DVector};

/// Whether every equation of Theorem 3.2 holds, with or without `k = 0`, to `tolerance` of the larger side.
pub(super) fn holds(model: &Model, and_markov: bool, tolerance: f64) -> Result<bool> {
    if !(tolerance.is_finite() && tolerance >= 0.0) {
        let message = format!("must be at least 0, got {}", crate::value::number(tolerance));
        return Err(Error::new(Code::OutOfRange, "tolerance", message));
    }
    Ok(between_pins(model, tolerance)? && of_pins(model, and_markov, tolerance)?)
}

/// The blocks of a state and the next pin.
fn between_pins(model: &Model, tolerance: f64) -> Result<bool> {
    let pinned = deviations(&model.pinned.covariance);
    for (segment, pair) in model.pins.windows(2).enumerate() {
        let end = pinned.rows((segment + 1) * model.states, model.states).into_owned();
        let mut next = None;
        for k in (pair[0] + 1..pair[1]).rev() {
            let step = model.step(k)?;
            let left = towards(&step, k)?;
            if let Some(right) = next
                && !agree(&left, &right, &deviations(&step.covariance), &end, tolerance)
            {
                return Ok(false);
            }
            next = Some(&step.previous.transpose() * &left);
        }
    }
    Ok(true)
}

/// The blocks of two pins.
fn of_pins(model: &Model, and_markov: bool, tolerance: f64) -> Result<bool> {
    let (pins, s) = (&model.pins, model.states);
    let size = pins.len() * s;
    let factor = Factor::new(model.pinned.covariance.clone())
        .ok_or_else(|| Error::new(Code::NotPositiveDefinite, "pinnedCovariance", "must be positive definite"))?;
    let precision = factor.solve(&DMatrix::identity(size, size));
    let scale = precision.diagonal().map(|x| x.sqrt().recip());
    for i in 0..pins.len() {
        for j in i + 1..pins.len() {
            let is_corner = i == 0 && j + 1 == pins.len();
            if pins[j] - pins[i] == 1 || (is_corner && !and_markov) {
                continue;
            }
            let left = -precision.view((i * s, j * s), (s, s));
            let (rows, columns) = (scale.rows(i * s, s).into_owned(), scale.rows(j * s, s).into_owned());
            let agrees = if j == i + 1 {
                let step = model.step(pins[i] + 1)?;
                let right = step.previous.transpose() * &towards(&step, pins[i] + 1)?;
                agree(&left, &right, &rows, &columns, tolerance)
            } else {
                // a partial correlation of two pins that no path of the movement explains
                scaled(&left, &rows, &columns) <= tolerance
            };
            if !agrees {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// `G_k^-1 G_{k,N}`.
fn towards(step: &StepModel, k: usize) -> Result<DMatrix<f64>> {
    let factor = Factor::new(step.covariance.clone()).ok_or_else(|| {
        let message = "must be positive definite for the sequence to be nonsingular";
        Error::new(Code::NotPositiveDefinite, format!("covariance[{}]", k - 1), message)
    })?;
    Ok(factor.solve(&step.destination))
}

fn deviations(covariance: &DMatrix<f64>) -> DVector<f64> {
    covariance.diagonal().map(f64::sqrt)
}

/// The largest entry once rows and columns are freed from their units.
fn scaled(matrix: &DMatrix<f64>, rows: &DVector<f64>, columns: &DVector<f64>) -> f64 {
    matrix.map_with_location(|i, j, x| (x * rows[i] * columns[j]).abs()).max()
}

fn agree(
    left: &DMatrix<f64>,
    right: &DMatrix<f64>,
    rows: &DVector<f64>,
    columns: &DVector<f64>,
    tolerance: f64,
) -> bool {
    let size = scaled(left, rows, columns).max(scaled(right, rows, columns));
    scaled(&(left - right), rows, columns) <= tolerance * size
}
