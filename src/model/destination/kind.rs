//! What many destinations have in common.

use super::Arrival;
use crate::math::kernel::mixture::AXES;
use nalgebra::{DMatrix, DVector};

/// What many destinations have in common: the endpoint's covariance `S_i`, its size, the arrival prior.
///
/// ```
/// use whither::{Destination, Value, value::Node};
/// let value: Value = serde_json::from_str(r#"{ "id": "map", "mean": [500], "covariance": [[48]] }"#).unwrap();
/// let kind = Destination::read(&Node::root(&value, "destination"), 1, 2).unwrap().kind;
/// assert_eq!((kind.size(), kind.length()), (None, 1));
/// assert_eq!(kind.extent(1), 24.0); // an even density 24 wide has the variance 24^2 / 12 = 48
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    shape: Shape,
    arrival: Option<Box<Arrival>>,
}

/// Boxes are many and kept small; what they say is told from their sides.
#[derive(Clone, Debug, PartialEq)]
enum Shape {
    /// The sides, zero in axes that there are not, and the deviation of the velocity on arrival, zero where none is given.
    Box { sides: [f64; AXES], end_velocity: f64 },
    /// `S_i`, `l` by `l`.
    Covariance(Box<DMatrix<f64>>),
}

impl Kind {
    /// An even density over a box, with the deviation of the velocity on arrival.
    pub(super) fn of_box(size: &[f64], end_velocity: Option<f64>, arrival: Option<Arrival>) -> Self {
        let mut sides = [0.0; AXES];
        sides.iter_mut().zip(size).for_each(|(side, given)| *side = *given);
        let shape = Shape::Box { sides, end_velocity: end_velocity.unwrap_or(0.0) };
        Self { shape, arrival: arrival.map(Box::new) }
    }

    /// A Gaussian.
    pub(super) fn of_covariance(covariance: DMatrix<f64>, arrival: Option<Arrival>) -> Self {
        Self { shape: Shape::Covariance(Box::new(covariance)), arrival: arrival.map(Box::new) }
    }

    /// How many components of the state the endpoint names, `l`.
    #[must_use]
    pub fn length(&self) -> usize {
        match &self.shape {
            Shape::Box { sides, end_velocity } => dimensions(sides) * if *end_velocity > 0.0 { 2 } else { 1 },
            Shape::Covariance(covariance) => covariance.nrows(),
        }
    }

    /// One entry of the endpoint's covariance `S_i`; zero beyond it. A box's is that of a uniform density over it, `size^2 / 12`.
    #[must_use]
    pub fn variance(&self, row: usize, column: usize) -> f64 {
        match &self.shape {
            Shape::Covariance(covariance) => covariance.get((row, column)).copied().unwrap_or_default(),
            Shape::Box { .. } if row != column => 0.0,
            Shape::Box { sides, end_velocity } => match sides.get(row) {
                Some(side) if *side > 0.0 => side * side / 12.0,
                _ if row < self.length() => end_velocity * end_velocity,
                _ => 0.0,
            },
        }
    }

    /// The endpoint's covariance `S_i`, `l` by `l`.
    #[must_use]
    pub fn covariance(&self) -> DMatrix<f64> {
        match &self.shape {
            Shape::Covariance(covariance) => DMatrix::clone(covariance),
            Shape::Box { .. } => DMatrix::from_diagonal(&DVector::from_fn(self.length(), |i, _| self.variance(i, i))),
        }
    }

    /// The sides of the box, where it was given as `center` and `size`.
    #[must_use]
    pub fn size(&self) -> Option<&[f64]> {
        match &self.shape {
            Shape::Box { sides, .. } => sides.get(..dimensions(sides)),
            Shape::Covariance(_) => None,
        }
    }

    /// The deviation of the velocity on arrival, where given.
    #[must_use]
    pub fn end_velocity(&self) -> Option<f64> {
        match self.shape {
            Shape::Box { end_velocity, .. } if end_velocity > 0.0 => Some(end_velocity),
            _ => None,
        }
    }

    /// The arrival prior of its own, where given.
    #[must_use]
    pub fn arrival(&self) -> Option<&Arrival> {
        self.arrival.as_deref()
    }

    /// The extent that Fitts's law takes for the target's width: its smallest side, or the side of the uniform density
    /// whose variance is the endpoint's smallest in position.
    #[must_use]
    pub fn extent(&self, dimensions: usize) -> f64 {
        (0..dimensions).map(|axis| self.side(axis)).fold(f64::INFINITY, f64::min)
    }

    /// The side of the box along an axis, or that of the uniform density with the endpoint's variance there.
    #[must_use]
    pub fn side(&self, axis: usize) -> f64 {
        let given = self.size().and_then(|size| size.get(axis)).copied();
        given.unwrap_or_else(|| (12.0 * self.variance(axis, axis)).sqrt())
    }

    /// Equal kinds have equal fingerprints, and only they: all their numbers, bit by bit.
    pub(super) fn fingerprint(&self) -> Vec<u64> {
        let mut bits = Vec::new();
        match &self.shape {
            Shape::Box { sides, end_velocity } => {
                bits.push(end_velocity.to_bits());
                bits.extend(sides.iter().map(|side| side.to_bits()));
            }
            Shape::Covariance(covariance) => {
                bits.push(u64::MAX);
                bits.extend(covariance.iter().map(|x| x.to_bits()));
            }
        }
        if let Some(arrival) = &self.arrival {
            arrival.to_value().bits(&mut bits);
        }
        bits
    }
}

/// How many axes a box has.
fn dimensions(sides: &[f64; AXES]) -> usize {
    sides.iter().take_while(|side| **side > 0.0).count()
}
