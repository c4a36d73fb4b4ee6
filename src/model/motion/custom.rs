//! `custom`: any linear, time-invariant, Gaussian motion.
//!
//! ```text
//! dx = (A x + b + B c) dt + dw,   E[dw dw'] = W dt
//! F(h) = exp(A h)    M(h) = int_0^h exp(A u) b du    B(h) = int_0^h exp(A u) B du    Q(h) = int_0^h exp(A u) W exp(A' u) du
//! ```
//!
//! Source: Liang (1); the integrals are those of [`whither_kernel::van_loan`]. Keys: `drift` is `A`, `s` by `s`, with the `d` positions
//! first; `diffusion` is `W`, `s` by `s`, symmetric and positive semi-definite; `offset` is `b` and `destinationGain` is
//! `B`, `s` by `d`, both zero where they are left out. Axes may mix, so there is no step of one axis.
//!
//! The methods `bridging` and `singleFilter` need noise that leads to each component of the endpoint.
//! A drift that grows overflows where `exp(A h)` does: a step of 1000 time constants is `e^1000`.

use super::super::matrix::Matrix;
use super::{AxisTransition, MotionModel, Transition};
use crate::error::{Code, Result};
use crate::math::van_loan::series;
use crate::value::Path;
use nalgebra::{DMatrix, DVector};
use whither_kernel::van_loan::Series;

/// The most state components that a custom model can have.
const MAX_STATES: usize = 64;

/// How far below zero rounding may push a diffusion that is positive semi-definite, in units of its own diagonal.
const ROUNDING: f64 = 1e-10;

/// Any linear, time-invariant, Gaussian motion; `s >= d`.
#[derive(Clone, Debug)]
pub struct Custom {
    dimensions: usize,
    states: usize,
    offset: Option<DVector<f64>>,
    destination_gain: Option<DMatrix<f64>>,
    equation: Series,
}

impl Custom {
    pub fn new(
        at: &Path<'_>,
        dimensions: usize,
        drift: &Matrix,
        diffusion: &Matrix,
        offset: Option<&[f64]>,
        destination_gain: Option<&Matrix>,
    ) -> Result<Self> {
        let (place, states) = (at.key("drift"), drift.rows());
        if states < dimensions {
            let must = format!("must have a row for each of the {dimensions} positions at least, has {states}");
            return Err(place.error(Code::WrongLength, &must, drift));
        }
        if states > MAX_STATES {
            return Err(place.error(
                Code::TooLarge,
                &format!("must have at most {MAX_STATES} rows, has {states}"),
                drift,
            ));
        }
        let drift = drift.check(&place, states, states)?;
        let place = at.key("diffusion");
        let density = diffusion.check(&place, states, states)?;
        if !is_positive_semidefinite(&density) {
            let must = "must be symmetric and positive semi-definite";
            return Err(place.error(Code::NotPositiveDefinite, must, diffusion));
        }
        let offset = offset.map(|offset| at.key("offset").vector(offset, states, |at, x| at.number(x))).transpose()?;
        let gain =
            destination_gain.map(|gain| gain.check(&at.key("destinationGain"), states, dimensions)).transpose()?;
        let equation = series(&drift, &density);
        Ok(Self {
            dimensions,
            states,
            offset: offset.map(DVector::from_column_slice),
            destination_gain: gain,
            equation,
        })
    }
}

impl MotionModel for Custom {
    fn dimensions(&self) -> usize {
        self.dimensions
    }

    fn states(&self) -> usize {
        self.states
    }

    fn depends_on_destination(&self) -> bool {
        self.destination_gain.as_ref().is_some_and(|gain| gain.iter().any(|g| *g != 0.0))
    }

    fn axis(&self, _axis: usize, _step: f64) -> Option<AxisTransition> {
        None
    }

    fn transition(&self, step: f64) -> Transition {
        let s = self.states;
        let constant = self.offset.is_some() || self.depends_on_destination();
        let over = if constant { self.equation.step(step) } else { self.equation.step_without_integral(step) };
        let integral = DMatrix::from_vec(s, if constant { s } else { 0 }, over.integral);
        Transition {
            offset: match &self.offset {
                Some(offset) => &integral * offset,
                None => DVector::zeros(s),
            },
            destination_gain: match &self.destination_gain {
                Some(gain) if self.depends_on_destination() => Some(&integral * gain),
                _ => None,
            },
            transition: DMatrix::from_vec(s, s, over.transition),
            noise: DMatrix::from_vec(s, s, over.noise),
        }
    }
}

/// Elimination with the largest pivot, of the matrix scaled to a unit diagonal so that units do not matter (next to a zero
/// on the diagonal all must be zero): where the largest pivot left is zero, nothing else may be left.
fn is_positive_semidefinite(matrix: &DMatrix<f64>) -> bool {
    let states = matrix.nrows();
    let scale: Vec<f64> = (0..states).map(|i| matrix[(i, i)].abs().sqrt()).collect();
    let mut left = DMatrix::from_fn(states, states, |i, j| match matrix[(i, j)] {
        0.0 => 0.0,
        x => x / scale[i] / scale[j],
    });
    if left.iter().any(|x| !x.is_finite()) || (&left - left.transpose()).amax() > ROUNDING {
        return false;
    }
    for _ in 0..states {
        let pivot = (0..states).fold(0, |best, i| if left[(i, i)] > left[(best, best)] { i } else { best });
        let largest = left[(pivot, pivot)];
        if largest <= ROUNDING {
            break;
        }
        let column = left.column(pivot).into_owned();
        left -= &column * column.transpose() / largest;
    }
    left.amax() <= ROUNDING
}
