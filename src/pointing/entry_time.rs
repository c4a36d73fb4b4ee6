//! The time to the entry into the target, as it is reported to the user.

use super::targets::Extent;
use super::{Vector, dot};
use crate::model::learnt::Learnt;
use whither_kernel::small_gaussian::{inverse, times};

/// The time to the entry into the target: a median that follows the nodes, how near the pointer is to the edges of the targets
/// that it may be going to, and how long the movement has lasted. The nodes' own mean is too early, since their work is to
/// rank destinations.
///
/// ```
/// use whither::{PointingConstants, pointing_constants::EntryTime};
/// let mouse: EntryTime = PointingConstants::default().remaining.unwrap();
/// assert!(mouse.low < 0.0 && 0.0 < mouse.high);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct EntryTime {
    /// `ln median = offset + nodes E[ln R] + near E[distance/(distance + e)] + elapsed t/(t + 1 s)`, with `e` the way to the
    /// edge of a destination and `t` the time since the first observation.
    pub offset: f64,
    /// Weight of the nodes' mean logarithm.
    pub nodes: f64,
    /// Weight of being near.
    pub near: f64,
    /// The distance that is half near.
    pub distance: f64,
    /// Weight of the time since the first observation: who has been long on the way is slow.
    pub elapsed: f64,
    /// The interval begins at the median times `exp(low)`.
    pub low: f64,
    /// The upper end of the interval is the median times `exp(high)`; between the two are about four fifths of the recorded samples, but not a
    /// tenth on each side.
    pub high: f64,
}

impl EntryTime {
    /// How near a destination is, from 1 in it to 0 far away: `offset` is the way to its centre, `extent` is its own.
    #[must_use]
    pub(crate) fn nearness(&self, offset: &Vector, extent: &Extent, dimensions: usize) -> f64 {
        // a box has the variance side^2/12, so its half side is the root of three variances; the edge is the ellipse in it
        let (precision, _) = inverse(&extent.covariance, dimensions);
        let half_sides = (dot(&times(&precision, offset), offset) / 3.0).sqrt();
        let edge = if half_sides > 1.0 { dot(offset, offset).sqrt() * (1.0 - 1.0 / half_sides) } else { 0.0 };
        self.distance / (self.distance + edge)
    }

    /// The median, and the ends of the interval, in seconds, for a user of whom this was learnt; within the resolution of a clock.
    #[must_use]
    pub(crate) fn at(&self, mean_log_node: f64, nearness: f64, elapsed: f64, learnt: &Learnt) -> [f64; 3] {
        let median =
            self.offset + self.nodes * mean_log_node + self.near * nearness + self.elapsed * elapsed / (elapsed + 1.0);
        let mean = median + learnt.mean;
        [mean, (median + self.low + learnt.low).min(mean), (median + self.high + learnt.high).max(mean)]
            .map(|log| log.clamp(-20.0, 20.0).exp())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_is_told_from_the_edge_of_the_box() {
        let entry =
            EntryTime { offset: 0.0, nodes: 1.0, near: -1.0, distance: 20.0, elapsed: 0.0, low: -1.0, high: 1.0 };
        let wide = Extent::of_box([300.0, 24.0]);
        let near = |x: f64, y: f64| entry.nearness(&[x, y, 0.0], &wide, 2);
        assert!((near(170.0, 0.0) - 0.5).abs() < 1e-12, "20 from its right edge");
        assert!((near(0.0, -32.0) - 0.5).abs() < 1e-12, "20 above its upper edge");
        assert_eq!([near(149.0, 0.0), near(0.0, 0.0)], [1.0, 1.0], "in it");
        // 12 on a side, 50 from the centre, so 44 from the edge
        let square = Extent::of_box([12.0, 12.0]);
        assert!((entry.nearness(&[30.0, 40.0, 0.0], &square, 2) - 20.0 / (20.0 + 44.0)).abs() < 1e-12);
    }
}
