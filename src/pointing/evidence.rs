//! The evidence on a target besides the endpoint density: its distance and direction from the start of the movement.

use super::course::{Course, Onset};
use super::parameters::{Direction, PointingConstants, Start};
use super::targets::Extent;
use super::{Space, Vector, cross, dot, minus};
use whither_kernel::bearings::Way;

/// `ln (distance^2 + core^2)^(-exponent/2)` at `offset` from the start: how likely a movement ends there, before it is observed.
/// The square of `onset`'s shortfall is added to that of the core.
#[must_use]
pub fn log_start(start: &Start, offset: &Vector, onset: &Onset) -> f64 {
    let core = start.core * start.core + onset.shortfall * onset.shortfall;
    -0.5 * start.exponent * (dot(offset, offset) + core).ln()
}

/// `m^2 / (m^2 + near^2)`, `m` the distance from the start in widths and heights of the target: a movement seldom ends
/// where it began.
#[must_use]
pub fn near(parameters: &PointingConstants, offset: &Vector, extent: &Extent, dimensions: usize) -> f64 {
    let PointingConstants { near, unit, .. } = parameters;
    let mut distance = 0.0;
    for (component, side) in offset.iter().zip(&extent.sides).take(dimensions) {
        let share = component / side;
        distance += share * share;
    }
    // a target right under the start keeps a chance
    distance += extent.square_of_unit * unit * unit;
    distance / (distance + near * near)
}

/// The direction from the start to where the pointer is now, and how much it counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DirectionNow<'a, S> {
    direction: &'a Direction,
    space: S,
    unit: f64,
    way: Vector,
    weight: f64,
}

impl<'a, S: Space> DirectionNow<'a, S> {
    /// Counts for more the farther the pointer has come and the slower it is.
    #[must_use]
    pub fn new(parameters: &'a PointingConstants, course: &Course<S>) -> Self {
        let PointingConstants { direction, unit, .. } = parameters;
        let way = minus(&course.position(), &course.start);
        let net = dot(&way, &way).sqrt();
        let weight = net / (net + direction.distance + direction.time * course.speed());
        Self { direction, space: course.space(), unit: *unit, way, weight: direction.power * weight }
    }

    /// The same for the hot loop, with the power of the ratio of densities beside it.
    #[must_use]
    pub fn way(&self, power: f64) -> Way {
        let net = dot(&self.way, &self.way).sqrt();
        let [x, y, z] = self.way;
        let unit = if net > 0.0 { [x / net, y / net, z / net] } else { [0.0; 3] };
        Way { unit, weight: self.weight, power }
    }

    /// The square of the angle beyond which nothing is lost any more.
    #[must_use]
    pub fn wide_squared(&self) -> f64 {
        self.direction.wide.powi(2)
    }

    /// The square of the angle below which nothing is gained any more.
    #[must_use]
    pub fn core_squared(&self) -> f64 {
        self.direction.core.powi(2)
    }

    /// `power w [2 ln(1 + theta^2/(wide^2 + z)) - ln(1 + theta^2/(core^2 + z))]`, with `theta` the angle at the start between
    /// the way covered and the destination at `offset`, and `z` the variance of the target's own direction.
    #[must_use]
    pub fn log_evidence(&self, offset: &Vector, extent: &Extent) -> f64 {
        // a zero that is not negative: what is at the start itself lies in no direction
        let (along, across) = (dot(&self.way, offset) + 0.0, cross(&self.way, offset));
        let angle = dot(&across, &across).sqrt().atan2(along).powi(2);
        let size = angular_variance(self.unit, offset, extent, self.space.dimensions());
        let term = |square: f64| (1.0 + angle / (square + size)).ln();
        self.weight * (2.0 * term(self.wide_squared()) - term(self.core_squared()))
    }
}

/// `z`, the variance of the direction from the start to a target at `offset`: `(tr(S) o^T o - o^T S o) / (d - 1) / (o^T o + unit^2)^2`.
#[must_use]
pub fn angular_variance(unit: f64, offset: &Vector, extent: &Extent, dimensions: usize) -> f64 {
    if dimensions == 1 {
        return 0.0;
    }
    let ([x, y, z], [xx, xy, yy, xz, yz, zz]) = (*offset, extent.covariance);
    let mixed = x * (y * xy + z * xz) + y * z * yz;
    let spread = xx * (y * y + z * z) + yy * (x * x + z * z) + zz * (x * x + y * y) - 2.0 * mixed;
    spread / (dimensions as f64 - 1.0) / (dot(offset, offset) + unit * unit).powi(2)
}
