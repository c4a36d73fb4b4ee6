//! The targets of a movement as flat arrays for the hot loop, by the covariance of their endpoints.

use super::{Symmetric, Vector, dot};
use crate::math::grouped::Grouped;
use std::ops::Range;
use whither_kernel::layout::{FEW, Layout};
use whither_kernel::mixture::{AXES, Places};

/// What targets of one size have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The covariance of the endpoint in position, `S_i`.
    pub covariance: Symmetric,
    /// The sides of the box over which a uniform density has these variances; zero in axes beyond the dimensions.
    pub sides: Vector,
    /// The square of a unit of length, the sides' geometric mean being one.
    pub square_of_unit: f64,
}

impl Extent {
    /// From the covariance, and the sides in so many dimensions.
    #[must_use]
    pub fn new(covariance: Symmetric, sides: Vector, dimensions: usize) -> Self {
        let volume: f64 = sides.iter().take(dimensions).product();
        let square_of_unit = match dimensions {
            2 => 1.0 / volume,
            d => (-2.0 / d as f64 * volume.ln()).exp(),
        };
        Self { covariance, sides, square_of_unit }
    }

    /// A uniform density over a box on a screen: variances of `side^2 / 12`.
    #[cfg(any(test, feature = "wasm-pointing"))]
    #[must_use]
    pub fn of_box([x, y]: [f64; 2]) -> Self {
        Self::new([x * x / 12.0, 0.0, y * y / 12.0, 0.0, 0.0, 0.0], [x, y, 0.0], 2)
    }

    /// One entry of the covariance.
    #[must_use]
    pub fn variance(&self, row: usize, column: usize) -> f64 {
        const PLACES: [[usize; AXES]; AXES] = [[0, 1, 3], [1, 2, 4], [3, 4, 5]];
        self.covariance[PLACES[row][column]]
    }

    /// The lower triangular root of the covariance, Cholesky's.
    #[must_use]
    pub fn root(&self) -> [Vector; AXES] {
        let mut root = [[0.0; AXES]; AXES];
        for r in 0..AXES {
            for c in 0..=r {
                let known = dot(&root[r], &root[c]);
                let left = self.variance(r, c) - known;
                root[r][c] = if r == c { left.max(0.0).sqrt() } else { left / root[c][c] };
            }
        }
        root
    }

    /// Whether the axes of the endpoint are independent.
    fn is_separable(&self) -> bool {
        let [_, xy, _, xz, yz, _] = self.covariance;
        xy == 0.0 && xz == 0.0 && yz == 0.0
    }
}

/// One target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Its centre, the mean of the endpoint.
    pub center: Vector,
    /// Its place in the list of extents.
    pub extent: usize,
    /// Its prior weight; only ratios matter.
    pub prior: f64,
}

/// Targets that are evaluated together.
#[derive(Clone, Debug)]
pub struct Class {
    /// The covariance of their endpoints; none where each has its own variances.
    pub covariance: Option<Symmetric>,
    /// Their blocks.
    pub blocks: Range<usize>,
}

/// All targets, in order.
#[derive(Clone, Debug)]
pub struct Targets {
    dimensions: usize,
    centers: Vec<Vector>,
    priors: Vec<f64>,
    extents: Vec<Extent>,
    extent_of: Vec<u32>,
    classes: Vec<Class>,
    layout: Layout,
}

impl Targets {
    /// Targets in so many dimensions; every number of an extent is one of a place in `extents`.
    #[must_use]
    pub fn new(dimensions: usize, extents: Vec<Extent>, list: impl ExactSizeIterator<Item = Target>) -> Self {
        let count = list.len();
        let mut targets = Self {
            dimensions,
            centers: Vec::with_capacity(count),
            priors: Vec::with_capacity(count),
            extents,
            extent_of: Vec::with_capacity(count),
            classes: Vec::new(),
            layout: Layout::default(),
        };
        for Target { center, extent, prior } in list {
            targets.centers.push(center);
            targets.priors.push(prior);
            targets.extent_of.push(extent as u32);
        }
        targets.classify();
        targets
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.priors.len()
    }

    /// The centre of one.
    #[must_use]
    pub fn center(&self, i: usize) -> Vector {
        self.centers[i]
    }

    /// The place of a target's extent in the list of them: equal for targets that have one.
    #[must_use]
    pub fn extent_number(&self, i: usize) -> usize {
        self.extent_of[i] as usize
    }

    /// The extent of one.
    #[must_use]
    pub fn extent(&self, i: usize) -> &Extent {
        &self.extents[self.extent_number(i)]
    }

    /// The prior weights, not normalised.
    #[must_use]
    pub fn priors(&self) -> &[f64] {
        &self.priors
    }

    /// Those that are evaluated together.
    #[must_use]
    pub fn classes(&self) -> &[Class] {
        &self.classes
    }

    /// The order of the blocks.
    #[must_use]
    pub const fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The centres, and where each has its own the variances, of some blocks.
    #[must_use]
    pub fn places(&self, blocks: &Range<usize>) -> Places<'_> {
        self.layout.places(blocks, [0.0; AXES])
    }

    /// Those of one extent together; where an extent has few, among others that are alike in being separable.
    fn classify(&mut self) {
        let members = Grouped::new(&self.extent_of, self.extents.len());
        let Self { dimensions, centers, extents, extent_of, classes, layout, .. } = self;
        let mut place = |members: &[u32], covariance: Option<Symmetric>| {
            let blocks = layout.place(members, covariance.is_none());
            if !members.is_empty() {
                classes.push(Class { covariance, blocks });
            }
        };
        let mut pool = Vec::new();
        for (number, extent) in extents.iter().enumerate() {
            let members = members.of(number);
            let is_one_of_several = members.len() < centers.len();
            if is_one_of_several && members.len() < FEW && extent.is_separable() {
                pool.extend_from_slice(members);
            } else {
                place(members, Some(extent.covariance));
            }
        }
        place(&pool, None);
        let variance = |i: usize, axis| extents[extent_of[i] as usize].variance(axis, axis);
        layout.finish((centers.len(), *dimensions), &|i, axis| centers[i][axis], &variance);
    }
}
