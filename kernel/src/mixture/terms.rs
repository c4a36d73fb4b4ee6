//! The ratios of two densities: for places that share an endpoint's covariance, and for places that have each its own.

use super::{AXES, HALF_LOG2_E, Places, Term, at};
use crate::vectors::Lanes;

/// A quadratic in the plane with one curvature for both axes, expanded about the origin of the [`Places`]: the cheapest form, for
/// where its terms do not cancel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ball {
    /// The factor of the squared distance from the origin.
    pub curvature: f64,
    /// The factors of the offsets from the origin.
    pub slope: [f64; AXES],
    /// What is left of the exponent.
    pub constant: f64,
    /// Before the power.
    pub factor: f64,
}

/// Any quadratic, about a centre of its own: `c + sum_k d_k (b_k + sum_{j >= k} A_kj d_j)`, `d = a - centre`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ellipsoid {
    /// What offsets are measured from.
    pub center: [f64; AXES],
    /// `A`, the upper triangle, its off-diagonal entries doubled; the rest is not read.
    pub curvature: [[f64; AXES]; AXES],
    /// `b`.
    pub slope: [f64; AXES],
    /// `c`.
    pub constant: f64,
    /// Before the power.
    pub factor: f64,
}

/// The ratio of two Gaussians without correlation between axes, to each of whose variances every place adds its own.
#[derive(Clone, Copy, Debug, Default)]
pub struct Own {
    /// The numerator's mean.
    pub mean: [f64; AXES],
    /// The numerator's variances.
    pub variance: [f64; AXES],
    /// The denominator's mean.
    pub start_mean: [f64; AXES],
    /// The denominator's variances.
    pub start_variance: [f64; AXES],
    /// What is added to the exponent.
    pub constant: f64,
    /// What multiplies the ratio.
    pub factor: f64,
}

/// One axis of an [`Own`] term: the ratio's exponent over a common denominator, that denominator, the start's variance.
#[inline(always)]
fn own_axis(
    coordinate: Lanes,
    own: Lanes,
    (mean, variance): (f64, f64),
    (start_mean, start_variance): (f64, f64),
) -> (Lanes, Lanes, Lanes) {
    let variance = Lanes::splat(variance) + own;
    let start_variance = Lanes::splat(start_variance) + own;
    let offset = coordinate - Lanes::splat(mean);
    let start_offset = coordinate - Lanes::splat(start_mean);
    let numerator = offset * offset * start_variance - start_offset * start_offset * variance;
    (numerator, variance * start_variance, start_variance)
}

impl Term<2> for Ball {
    /// Offsets from the origin, and their squared length.
    type Place = ([Lanes; 2], Lanes);

    #[inline(always)]
    fn place(places: &Places<'_>, i: usize) -> Option<Self::Place> {
        let x = at(places.coordinates[0], i)? - Lanes::splat(places.origin[0]);
        let y = at(places.coordinates[1], i)? - Lanes::splat(places.origin[1]);
        Some(([x, y], x * x + y * y))
    }

    #[inline(always)]
    fn factor(&self) -> f64 {
        self.factor
    }

    #[inline(always)]
    fn exponent_and_factor(&self, ([x, y], square): &Self::Place) -> (Lanes, Lanes) {
        let exponent = Lanes::splat(self.curvature) * *square
            + Lanes::splat(self.slope[0]) * *x
            + Lanes::splat(self.slope[1]) * *y
            + Lanes::splat(self.constant);
        (exponent, Lanes::splat(self.factor))
    }
}

macro_rules! terms {
    ($d:literal: $first:literal $($rest:literal)*, $([$row:literal $($column:literal)*])*) => {
        impl Term<$d> for Ellipsoid {
            /// Coordinates.
            type Place = [Lanes; $d];

            #[inline(always)]
            fn place(places: &Places<'_>, i: usize) -> Option<Self::Place> {
                Some([at(places.coordinates[$first], i)?, $(at(places.coordinates[$rest], i)?),*])
            }

            #[inline(always)]
            fn factor(&self) -> f64 {
                self.factor
            }

            #[inline(always)]
            fn exponent_and_factor(&self, place: &Self::Place) -> (Lanes, Lanes) {
                let offsets = [
                    place[$first] - Lanes::splat(self.center[$first]),
                    $(place[$rest] - Lanes::splat(self.center[$rest])),*
                ];
                let exponent = Lanes::splat(self.constant)
                    $(+ offsets[$row] * (
                        Lanes::splat(self.curvature[$row][$row]) * offsets[$row]
                        $(+ Lanes::splat(self.curvature[$row][$column]) * offsets[$column])*
                        + Lanes::splat(self.slope[$row])
                    ))*;
                (exponent, Lanes::splat(self.factor))
            }
        }

        impl Term<$d> for Own {
            /// Coordinates, and their variances.
            type Place = ([Lanes; $d], [Lanes; $d]);

            #[inline(always)]
            fn place(places: &Places<'_>, i: usize) -> Option<Self::Place> {
                Some((
                    [at(places.coordinates[$first], i)?, $(at(places.coordinates[$rest], i)?),*],
                    [at(places.variances[$first], i)?, $(at(places.variances[$rest], i)?),*],
                ))
            }

            #[inline(always)]
            fn factor(&self) -> f64 {
                self.factor
            }

            // over the common denominator, so that one division and one root serve all axes
            #[inline(always)]
            fn exponent_and_factor(&self, (coordinates, variances): &Self::Place) -> (Lanes, Lanes) {
                let (numerator, product, start_product) = own_axis(
                    coordinates[$first],
                    variances[$first],
                    (self.mean[$first], self.variance[$first]),
                    (self.start_mean[$first], self.start_variance[$first]),
                );
                $(
                    let (next, other, start_variance) = own_axis(
                        coordinates[$rest],
                        variances[$rest],
                        (self.mean[$rest], self.variance[$rest]),
                        (self.start_mean[$rest], self.start_variance[$rest]),
                    );
                    let numerator = numerator * other + next * product;
                    let product = product * other;
                    let start_product = start_product * start_variance;
                )*
                let inverse = Lanes::splat(1.0) / product;
                let exponent = Lanes::splat(self.constant) - Lanes::splat(HALF_LOG2_E) * (numerator * inverse);
                (exponent, Lanes::splat(self.factor) * start_product * inverse.sqrt())
            }
        }
    };
}

terms!(2: 0 1, [0 1] [1]);
terms!(3: 0 1 2, [0 1 2] [1 2] [2]);
