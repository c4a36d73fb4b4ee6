//! What the start of a movement implies of places besides their direction: how likely a movement ends there before it is
//! observed, and that it seldom ends where it began.
//!
//! ```text
//! 1 / S_i = volume (r^2 + core^2)^(exponent/2),  near_i = [m^2 / (m^2 + near^2)]^share
//! ```
//! with `r` the distance, `m` the distance in sides of the place and, so that a place right under the start keeps a chance, one unit
//! of length more.

use crate::mixture::{AXES, Places};
use crate::small_gaussian::Symmetric;
use crate::vectors::{Block, Lanes, Shift};

/// Powers of two beyond this leave too little room for the rest of a product.
const MODERATE: f64 = 288.0;

/// The numbers of the equations.
#[derive(Clone, Copy, Debug)]
pub struct StartDensity {
    /// Where the movement began.
    pub start: [f64; AXES],
    /// `log2` of the volume.
    pub log_volume: f64,
    /// `core^2`.
    pub core: f64,
    /// `exponent / 2`.
    pub half_exponent: f64,
    /// `near^2`.
    pub near: f64,
    /// `share`.
    pub share: f64,
}

impl StartDensity {
    /// Writes `1 / S_i` of places, and multiplies `priors` by `near_i`; returns whether all of both are far from the limits of
    /// numbers. `covariance` is that of the endpoints of all, without one each has its own variances: `side^2 / 12`.
    #[inline(never)]
    pub fn evaluate(
        &self,
        dimensions: usize,
        places: &Places<'_>,
        covariance: Option<&Symmetric>,
        over_start: &mut [Block],
        priors: &mut [Block],
    ) -> bool {
        match dimensions {
            1 => self.over::<1>(places, covariance, over_start, priors),
            2 => self.over::<2>(places, covariance, over_start, priors),
            _ => self.over::<3>(places, covariance, over_start, priors),
        }
    }

    #[inline(always)]
    fn over<const D: usize>(
        &self,
        places: &Places<'_>,
        covariance: Option<&Symmetric>,
        over_start: &mut [Block],
        priors: &mut [Block],
    ) -> bool {
        let (s, none) = (Lanes::splat, Shift::by(0.0));
        let mut largest = s(0.0);
        for (i, (over_start, prior)) in over_start.iter_mut().zip(priors).enumerate() {
            let (mut square, mut sides, mut volume) = (s(0.0), s(0.0), s(1.0));
            for axis in 0..D {
                let offset = Lanes::load(&places.coordinates[axis][i]) - s(self.start[axis]);
                let variance = match covariance {
                    Some(covariance) => s(covariance[[0, 2, 5][axis]]),
                    None => Lanes::load(&places.variances[axis][i]),
                };
                let side = s(12.0) * variance;
                let offset = offset * offset;
                square = square + offset;
                sides = sides + offset / side;
                volume = volume * side;
            }
            let log_volume = volume.log2();
            sides = sides + (s(-1.0 / D as f64) * log_volume).exp2(&none);
            let over = s(self.log_volume) + s(self.half_exponent) * (square + s(self.core)).log2();
            let near = s(self.share) * Lanes::log2_ratio(sides, sides + s(self.near));
            over.exp2(&none).store(over_start);
            (Lanes::load(prior) * near.exp2(&none)).store(prior);
            // a third, since these are not multiplied with one another
            for log in [over, near, s(0.3) * log_volume, s(0.3) * sides.log2()] {
                largest = (log * log).at_least(largest);
            }
        }
        largest.most() < MODERATE * MODERATE
    }
}
