//! What destinations of the same size share.

use super::Arrival;
use nalgebra::{DMatrix, DVector};
use std::hash::{Hash, Hasher};
use whither_kernel::mixture::AXES;

/// What destinations share whose endpoints differ in their means alone: the endpoint's covariance `S_i` and the arrival prior,
/// so that every matrix serves all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct EndpointClass {
    shape: Shape,
    arrival: Option<Box<Arrival>>,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    /// A uniform density over a box, with the deviation of the velocity on arrival.
    Box { size: [f64; AXES], dimensions: usize, end_velocity: Option<f64> },
    /// `S_i`, `l` by `l`.
    Gaussian(Box<DMatrix<f64>>),
}

impl EndpointClass {
    /// Sides beyond the dimensions are zero.
    pub(super) fn of_box(
        size: [f64; AXES],
        dimensions: usize,
        end_velocity: Option<f64>,
        arrival: Option<Box<Arrival>>,
    ) -> Self {
        Self { shape: Shape::Box { size, dimensions, end_velocity }, arrival }
    }

    pub(super) fn of_covariance(covariance: DMatrix<f64>, arrival: Option<Box<Arrival>>) -> Self {
        Self { shape: Shape::Gaussian(Box::new(covariance)), arrival }
    }

    /// How many components of the state the endpoint names, `l`.
    #[must_use]
    pub fn length(&self) -> usize {
        match &self.shape {
            Shape::Box { dimensions, end_velocity, .. } => dimensions * if end_velocity.is_some() { 2 } else { 1 },
            Shape::Gaussian(covariance) => covariance.nrows(),
        }
    }

    /// One entry of the endpoint's covariance `S_i`; zero beyond it. A box's is that of a uniform density over it, `size^2 / 12`.
    #[must_use]
    pub fn variance(&self, row: usize, column: usize) -> f64 {
        match &self.shape {
            Shape::Gaussian(covariance) => covariance.get((row, column)).copied().unwrap_or_default(),
            Shape::Box { .. } if row != column => 0.0,
            Shape::Box { size, dimensions, end_velocity } => match (size.get(row), end_velocity) {
                (Some(side), _) if row < *dimensions => side * side / 12.0,
                (_, Some(deviation)) if row < 2 * dimensions => deviation * deviation,
                _ => 0.0,
            },
        }
    }

    /// Whether both are boxes that differ in their sizes alone, as far as the endpoint goes.
    #[must_use]
    pub fn is_resized(&self, other: &Self) -> bool {
        let (Shape::Box { end_velocity: one, .. }, Shape::Box { end_velocity: another, .. }) =
            (&self.shape, &other.shape)
        else {
            return false;
        };
        one == another
    }

    /// Whether the endpoint's axes depend on each other.
    #[must_use]
    pub fn mixes_axes(&self, dimensions: usize) -> bool {
        let Shape::Gaussian(covariance) = &self.shape else { return false };
        let n = covariance.nrows();
        (0..n).any(|i| (0..i).any(|j| i % dimensions != j % dimensions && covariance[(i, j)] != 0.0))
    }

    /// The endpoint's covariance `S_i`, `l` by `l`.
    #[must_use]
    pub fn covariance(&self) -> DMatrix<f64> {
        match &self.shape {
            Shape::Gaussian(covariance) => DMatrix::clone(covariance),
            Shape::Box { .. } => DMatrix::from_diagonal(&DVector::from_fn(self.length(), |i, _| self.variance(i, i))),
        }
    }

    /// The sides of the box, where it was given as `center` and `size`.
    #[must_use]
    pub fn size(&self) -> Option<&[f64]> {
        match &self.shape {
            Shape::Box { size, dimensions, .. } => size.get(..*dimensions),
            Shape::Gaussian(_) => None,
        }
    }

    /// The deviation of the velocity on arrival, where given.
    #[must_use]
    pub fn end_velocity(&self) -> Option<f64> {
        match self.shape {
            Shape::Box { end_velocity, .. } => end_velocity,
            Shape::Gaussian(_) => None,
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

    /// Equal classes have equal fingerprints, and only they.
    pub(super) fn fingerprint(&self) -> Fingerprint {
        let mut more = Vec::new();
        let box_of = match &self.shape {
            Shape::Box { size: [x, y, z], end_velocity, .. } => {
                [end_velocity.unwrap_or(0.0), *x, *y, *z].map(f64::to_bits)
            }
            Shape::Gaussian(covariance) => {
                more.extend(covariance.iter().map(|x| x.to_bits()));
                [u64::MAX; 1 + AXES]
            }
        };
        if let Some(arrival) = &self.arrival {
            arrival.to_value().bits(&mut more);
        }
        Fingerprint { box_of, more }
    }
}

/// All numbers of a class, bit by bit.
#[derive(PartialEq, Eq)]
pub(super) struct Fingerprint {
    box_of: [u64; 1 + AXES],
    /// Empty for a box without an arrival prior: thousands of sizes are not allocated.
    more: Vec<u64>,
}

impl Hash for Fingerprint {
    /// The words made one, since the hash itself takes byte by byte: a rotation, a difference and a product for each.
    fn hash<H: Hasher>(&self, state: &mut H) {
        let mix = |hash: u64, word: &u64| (hash.rotate_left(5) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        state.write_u64(self.box_of.iter().chain(&self.more).fold(0, mix));
    }
}
