//! One Gaussian density whose axes are correlated: for places that share an endpoint's covariance, and for places each of
//! which has its own variances.

use super::{AXES, HALF_LOG2_E, Places, Term, at};
use crate::vectors::Lanes;

/// A Gaussian density, the covariance that all places share included.
#[derive(Clone, Copy, Debug, Default)]
pub struct SharedDensity {
    /// The mean.
    pub mean: [f64; AXES],
    /// The precision times `-log2(e)/2`, what is not on the diagonal doubled: xx, xy, yy, xz, yz, zz.
    pub curvature: [f64; 6],
    /// What multiplies the power, the normaliser.
    pub factor: f64,
}

impl SharedDensity {
    #[inline(always)]
    fn offset(&self, axis: usize, coordinates: &[Lanes]) -> Lanes {
        coordinates[axis] - Lanes::splat(self.mean[axis])
    }

    #[inline(always)]
    fn times(&self, entry: usize, offset: Lanes) -> Lanes {
        Lanes::splat(self.curvature[entry]) * offset
    }
}

macro_rules! shared {
    ($d:literal: $($axis:literal)+, |$term:ident, $coordinates:ident| $exponent:expr) => {
        impl Term<$d> for SharedDensity {
            /// Coordinates.
            type Place = [Lanes; $d];

            #[inline(always)]
            fn place(places: &Places<'_>, i: usize) -> Option<Self::Place> {
                Some([$(at(places.coordinates[$axis], i)?),+])
            }

            #[inline(always)]
            fn exponent_and_factor(&self, $coordinates: &Self::Place) -> (Lanes, Lanes) {
                let $term = self;
                ($exponent, Lanes::splat(self.factor))
            }
        }
    };
}

shared!(1: 0, |term, coordinates| {
    let x = term.offset(0, coordinates);
    x * term.times(0, x)
});
shared!(2: 0 1, |term, coordinates| {
    let (x, y) = (term.offset(0, coordinates), term.offset(1, coordinates));
    x * (term.times(0, x) + term.times(1, y)) + y * term.times(2, y)
});
shared!(3: 0 1 2, |term, coordinates| {
    let (x, y, z) = (term.offset(0, coordinates), term.offset(1, coordinates), term.offset(2, coordinates));
    let across = term.times(1, y) + term.times(3, z);
    x * (term.times(0, x) + across) + y * (term.times(2, y) + term.times(4, z)) + z * term.times(5, z)
});

/// A Gaussian density, to each of whose variances every place adds its own.
#[derive(Clone, Copy, Debug, Default)]
pub struct Density {
    /// The mean.
    pub mean: [f64; AXES],
    /// The variances.
    pub variance: [f64; AXES],
    /// The covariances of the axes 0 and 1, 0 and 2, 1 and 2.
    pub covariance: [f64; AXES],
    /// What multiplies the density, `(2 pi)^(-d/2)` included.
    pub factor: f64,
}

impl Density {
    #[inline(always)]
    fn axis(&self, axis: usize, coordinate: Lanes, own: Lanes) -> (Lanes, Lanes) {
        (coordinate - Lanes::splat(self.mean[axis]), Lanes::splat(self.variance[axis]) + own)
    }

    /// The exponent and the factor, of the squared distance times the determinant, and the determinant.
    #[inline(always)]
    fn over(&self, square: Lanes, determinant: Lanes) -> (Lanes, Lanes) {
        let inverse = Lanes::splat(1.0) / determinant;
        (Lanes::splat(-HALF_LOG2_E) * (square * inverse), Lanes::splat(self.factor) * inverse.sqrt())
    }
}

macro_rules! place {
    ($d:literal: $($axis:literal)+) => {
        /// Coordinates, and their variances.
        type Place = ([Lanes; $d], [Lanes; $d]);

        #[inline(always)]
        fn place(places: &Places<'_>, i: usize) -> Option<Self::Place> {
            Some(([$(at(places.coordinates[$axis], i)?),+], [$(at(places.variances[$axis], i)?),+]))
        }
    };
}

impl Term<1> for Density {
    place!(1: 0);

    #[inline(always)]
    fn exponent_and_factor(&self, (coordinates, variances): &Self::Place) -> (Lanes, Lanes) {
        let (x, xx) = self.axis(0, coordinates[0], variances[0]);
        self.over(x * x, xx)
    }
}

impl Term<2> for Density {
    place!(2: 0 1);

    #[inline(always)]
    fn exponent_and_factor(&self, (coordinates, variances): &Self::Place) -> (Lanes, Lanes) {
        let (x, xx) = self.axis(0, coordinates[0], variances[0]);
        let (y, yy) = self.axis(1, coordinates[1], variances[1]);
        let xy = Lanes::splat(self.covariance[0]);
        let mixed = xy * x * y;
        self.over(yy * x * x - (mixed + mixed) + xx * y * y, xx * yy - xy * xy)
    }
}

impl Term<3> for Density {
    place!(3: 0 1 2);

    #[inline(always)]
    fn exponent_and_factor(&self, (coordinates, variances): &Self::Place) -> (Lanes, Lanes) {
        let (x, xx) = self.axis(0, coordinates[0], variances[0]);
        let (y, yy) = self.axis(1, coordinates[1], variances[1]);
        let (z, zz) = self.axis(2, coordinates[2], variances[2]);
        let [xy, xz, yz] = self.covariance.map(Lanes::splat);
        // the adjugate's upper triangle
        let (a, b, c) = (yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
        let (e, f, g) = (xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy);
        let mixed = b * x * y + c * x * z + f * y * z;
        self.over(a * x * x + e * y * y + g * z * z + (mixed + mixed), xx * a + xy * b + xz * c)
    }
}
