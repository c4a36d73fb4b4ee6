//! `custom`: any linear, time-invariant, Gaussian motion.
//!
//! ```text
//! dx = (A x + b + B c) dt + dw,   E[dw dw'] = W dt
//! F(h) = exp(A h)    M(h) = int_0^h exp(A u) b du    B(h) = int_0^h exp(A u) B du    Q(h) = int_0^h exp(A u) W exp(A' u) du
//! ```
//!
//! Source: Liang (1); the integrals are those of [`VanLoan`]. Keys: `drift` is `A`, `s` by `s`, with the `d` positions
//! first; `diffusion` is `W`, `s` by `s`, symmetric and positive semi-definite; `offset` is `b` and `destinationGain` is
//! `B`, `s` by `d`, both zero where they are left out. Axes may mix, so there is no step of one axis.
//!
//! The methods `bridging` and `singleFilter` need noise that leads to each component of the endpoint.
//! A drift that grows overflows where `exp(A h)` does: a step of 1000 time constants is `e^1000`.

use super::{AxisTransition, Kind, MotionModel, Transition};
use crate::error::{Code, Result};
use crate::math::van_loan::VanLoan;
use crate::value::{Fields, Node, Value};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

pub(super) const KIND: (&str, Kind) = (
    "custom",
    Kind {
        keys: &["type", "dimensions", "drift", "offset", "destinationGain", "diffusion"],
        build: |fields, _, dimensions| Ok(Arc::new(Custom::read(fields, dimensions)?)),
    },
);

/// The most state components that a custom model can have.
pub const MAX_STATES: usize = 64;

/// How far below zero rounding may push a diffusion that is positive semi-definite, in units of its own diagonal.
const ROUNDING: f64 = 1e-10;

/// Any linear, time-invariant, Gaussian motion; `s >= d`.
///
/// ```
/// use whither::{model::motion::Motion, value::{Node, Value}};
/// let value = Value::map([
///     ("type", Value::text("custom")),
///     ("dimensions", Value::Number(1.0)),
///     ("drift", Value::List(vec![Value::numbers(&[0.0, 1.0]), Value::numbers(&[0.0, 0.0])])),
///     ("diffusion", Value::List(vec![Value::numbers(&[0.0, 0.0]), Value::numbers(&[0.0, 4.0])])),
/// ]);
/// let motion = Motion::read(&Node::root(&value, "motion")).unwrap();
/// let step = motion.candidates[0].model.transition(0.5); // this one is `constantVelocity` with the noise 2
/// assert_eq!(step.transition[(0, 1)], 0.5);
/// assert!((step.noise[(1, 1)] - 2.0).abs() < 1e-15);
/// ```
#[derive(Clone, Debug)]
pub struct Custom {
    dimensions: usize,
    drift: DMatrix<f64>,
    offset: Option<DVector<f64>>,
    destination_gain: Option<DMatrix<f64>>,
    diffusion: DMatrix<f64>,
    equation: VanLoan,
}

impl Custom {
    fn read(fields: &Fields<'_>, dimensions: usize) -> Result<Self> {
        let node = fields.required("drift")?;
        let states = node.items()?.len();
        if states < dimensions {
            let must = format!("must have a row for each of the {dimensions} positions at least, has {states}");
            return Err(node.error(Code::WrongLength, &must));
        }
        if states > MAX_STATES {
            return Err(node.error(Code::TooLarge, &format!("must have at most {MAX_STATES} rows, has {states}")));
        }
        let drift = DMatrix::from_row_slice(states, states, &node.matrix(states, states)?);
        let diffusion = diffusion(&fields.required("diffusion")?, states)?;
        let offset = match fields.optional("offset") {
            Some(node) => Some(DVector::from_vec(node.vector(Some(states))?)),
            None => None,
        };
        let destination_gain = match fields.optional("destinationGain") {
            Some(node) => Some(DMatrix::from_row_slice(states, dimensions, &node.matrix(states, dimensions)?)),
            None => None,
        };
        let equation = VanLoan::new(&drift, &diffusion);
        Ok(Self { dimensions, drift, offset, destination_gain, diffusion, equation })
    }
}

impl MotionModel for Custom {
    fn dimensions(&self) -> usize {
        self.dimensions
    }

    fn states(&self) -> usize {
        self.drift.nrows()
    }

    fn depends_on_destination(&self) -> bool {
        self.destination_gain.as_ref().is_some_and(|gain| gain.iter().any(|g| *g != 0.0))
    }

    fn axis(&self, _axis: usize, _step: f64) -> Option<AxisTransition> {
        None
    }

    fn transition(&self, step: f64) -> Transition {
        let over = self.equation.step(step);
        Transition {
            offset: match &self.offset {
                Some(offset) => &over.integral * offset,
                None => DVector::zeros(self.states()),
            },
            destination_gain: match &self.destination_gain {
                Some(gain) if self.depends_on_destination() => Some(&over.integral * gain),
                _ => None,
            },
            transition: over.transition,
            noise: over.noise,
        }
    }

    fn to_value(&self) -> Value {
        let mut entries = vec![
            ("type".to_owned(), Value::text("custom")),
            ("dimensions".to_owned(), Value::Number(self.dimensions as f64)),
            ("drift".to_owned(), rows(&self.drift)),
            ("diffusion".to_owned(), rows(&self.diffusion)),
        ];
        if let Some(offset) = &self.offset {
            entries.push(("offset".to_owned(), Value::numbers(offset)));
        }
        if let Some(gain) = &self.destination_gain {
            entries.push(("destinationGain".to_owned(), rows(gain)));
        }
        Value::Map(entries)
    }
}

fn rows(matrix: &DMatrix<f64>) -> Value {
    Value::List(matrix.row_iter().map(|row| Value::numbers(row.iter())).collect())
}

fn diffusion(node: &Node<'_>, states: usize) -> Result<DMatrix<f64>> {
    let matrix = DMatrix::from_row_slice(states, states, &node.matrix(states, states)?);
    if is_positive_semidefinite(&matrix) {
        Ok(matrix)
    } else {
        Err(node.error(Code::NotPositiveDefinite, "must be symmetric and positive semi-definite"))
    }
}

/// Elimination with the largest pivot, of the matrix scaled to a unit diagonal so that units do not matter (beside a zero
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
