//! Drawing complete sequences: the pinned states from their joint density, then the steps between from (2).

use super::model::Model;
use crate::error::{Code, Error, Result};
use crate::math::random::Random;
use nalgebra::{DMatrix, DVector};

/// The most numbers that are drawn at once (80 MB).
const MAX_NUMBERS: usize = 10_000_000;
/// A pivot this much smaller than its variance is rounding: the component is determined by those before it.
const NO_FREEDOM: f64 = 1e-14;

/// `count` sequences of `N + 1` states, each `(N + 1) s` numbers.
pub(super) fn sample(model: &Model, seed: u64, count: usize) -> Result<Vec<Vec<f64>>> {
    let (s, length) = (model.states, (model.steps() + 1) * model.states);
    let most = MAX_NUMBERS / length;
    if count > most {
        let message = format!("must be an integer from 0 to {most} for sequences of this length, got {count}");
        return Err(Error::new(Code::TooLarge, "count", message));
    }
    let mut random = Random::new(seed);
    let mut normal = |n: usize| DVector::from_fn(n, |_, _| random.normal());
    let mut sequences = vec![vec![0.0; length]; count];
    let root = semidefinite_root(&model.pinned.covariance);
    for sequence in &mut sequences {
        let drawn = &model.pinned.mean + &root * normal(root.nrows());
        for (pin, state) in model.pins.iter().zip(drawn.as_slice().chunks(s)) {
            sequence[pin * s..(pin + 1) * s].copy_from_slice(state);
        }
    }
    for pair in model.pins.windows(2) {
        for k in pair[0] + 1..pair[1] {
            let step = model.step(k)?;
            let root = semidefinite_root(&step.covariance);
            for sequence in &mut sequences {
                let at = |k: usize| DVector::from_column_slice(&sequence[k * s..(k + 1) * s]);
                let towards = &step.previous * at(k - 1) + &step.destination * at(pair[1]);
                let state = towards + &step.offset + &root * normal(s);
                sequence[k * s..(k + 1) * s].copy_from_slice(state.as_slice());
            }
        }
    }
    Ok(sequences)
}

/// `L` with `L L'` the covariance, which may be singular: just before a pin nothing may be left to chance.
fn semidefinite_root(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let n = covariance.nrows();
    let mut root = DMatrix::<f64>::zeros(n, n);
    for j in 0..n {
        let pivot = covariance[(j, j)] - root.row(j).norm_squared();
        if pivot <= NO_FREEDOM * covariance[(j, j)] {
            continue;
        }
        let diagonal = pivot.sqrt();
        for i in j..n {
            let dot = root.row(i).dot(&root.row(j));
            root[(i, j)] = (covariance[(i, j)] - dot) / diagonal;
        }
    }
    root
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn a_singular_covariance_has_a_root() {
        // the second component is twice the first, the third is free
        let covariance = dmatrix![4.0, 8.0, 1.0; 8.0, 16.0, 2.0; 1.0, 2.0, 3.0];
        let root = semidefinite_root(&covariance);
        assert!((&root * root.transpose() - covariance).amax() < 1e-14);
        assert_eq!(root[(1, 1)], 0.0);
    }
}
