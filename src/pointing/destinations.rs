//! The destinations of a scenario as targets.

use super::targets::{Extent, Target, Targets};
use crate::model::destination::{Destinations, EndpointClass};

impl From<&Destinations> for Targets {
    fn from(destinations: &Destinations) -> Self {
        let d = destinations.dimensions();
        let extents = destinations.classes().iter().map(|class| extent(class, d)).collect();
        let target = |i: usize| Target {
            center: *destinations.position(i),
            extent: destinations.class_number(i),
            prior: destinations.priors()[i],
        };
        Self::new(d, extents, (0..destinations.len()).map(target))
    }
}

/// The position block of the endpoint's covariance, and the sides.
fn extent(class: &EndpointClass, dimensions: usize) -> Extent {
    let at = |r: usize, c: usize| if r < dimensions { class.variance(r, c) } else { 0.0 };
    let side = |axis: usize| if axis < dimensions { class.side(axis) } else { 0.0 };
    let covariance = [at(0, 0), at(1, 0), at(1, 1), at(2, 0), at(2, 1), at(2, 2)];
    Extent::new(covariance, [side(0), side(1), side(2)], dimensions)
}
