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

/// Products beyond these have no inverse, or will soon have none.
const RANGE: [f64; 2] = [1e-280, 1e280];

/// The numbers of the equations.
#[derive(Clone, Copy, Debug)]
pub struct StartDensity {
    /// How many axes there are.
    pub dimensions: usize,
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
        places: &Places<'_>,
        covariance: Option<&Symmetric>,
        over_start: &mut [Block],
        priors: &mut [Block],
    ) -> bool {
        let s = Lanes::splat;
        let (mut largest, mut least_volume, mut most_sides) = (s(0.0), s(f64::MAX), s(0.0));
        for (i, (over_start, prior)) in over_start.iter_mut().zip(priors).enumerate() {
            let (mut square, mut sides, mut volume) = (s(0.0), s(0.0), s(1.0));
            for axis in 0..self.dimensions.min(AXES) {
                let at = |list: &[Block]| list.get(i).map_or(s(0.0), Lanes::load);
                let offset = at(places.coordinates[axis]) - s(self.start[axis]);
                let variance = match covariance {
                    Some(covariance) => s(covariance[[0, 2, 5][axis]]),
                    None => at(places.variances[axis]),
                };
                let (side, offset) = (s(12.0) * variance, offset * offset);
                square = square + offset;
                sides = sides + offset / side;
                volume = volume * side;
            }
            least_volume = volume.at_most(least_volume);
            most_sides = sides.at_least(most_sides);
            sides = sides
                + match self.dimensions {
                    1 => s(1.0) / volume,
                    2 => s(1.0) / volume.sqrt(),
                    _ => exp2(s(-1.0 / 3.0) * log2(volume, s(1.0))),
                };
            let over = s(self.log_volume) + s(self.half_exponent) * log2(square + s(self.core), s(1.0));
            let near = s(self.share) * log2(sides, sides + s(self.near));
            exp2(over).store(over_start);
            (Lanes::load(prior) * exp2(near)).store(prior);
            largest = (near * near).at_least((over * over).at_least(largest));
        }
        let [least, most] = RANGE;
        largest.most() < MODERATE * MODERATE && most_sides.most() < most && least_volume.least() > least
    }
}

// not inlined: what is done once a movement need not be fast four times

#[inline(never)]
fn log2(a: Lanes, b: Lanes) -> Lanes {
    Lanes::log2_ratio(a, b)
}

#[inline(never)]
fn exp2(x: Lanes) -> Lanes {
    x.exp2(&Shift::by(0.0))
}
