//! The directions in which places lie from the start of a movement, and what the way covered since implies of them.
//!
//! With `t` the angle at the start between the way and the place, `z` the variance of the place's direction, `w` and `c` the
//! squares of the angles beyond and below which it does not matter, the evidence is
//! ```text
//! B = [(w + z + t^2)^2 (c + z) / ((w + z)^2 (c + z + t^2))]^weight
//! ```
//! All but `t` follows from the start: it is computed once a movement, and a step has one root and two divisions for each place.

use crate::mixture::AXES;
use crate::vectors::{Block, Lanes};

/// Where `log2` of a sum is below this, it may have been cut off.
const CERTAIN: f64 = -500.0;

/// A line is a plane in which nothing lies beside it.
const PLANE: usize = 2;

/// Much more than the difference of any two exponents.
const FAR: f64 = 1e9;

/// How many numbers there are of each place.
#[must_use]
pub fn numbers(dimensions: usize) -> usize {
    dimensions.max(PLANE) + 2
}

/// How the movement has gone on since.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// The direction, of length one; zero where there is none.
    pub unit: [f64; AXES],
    /// The weight of the evidence.
    pub weight: f64,
    /// The power of the ratio of densities that it is multiplied by.
    pub power: f64,
}

/// Turns the sums `N_i / S_i` of places into the exponents `power log2(N_i / S_i) + log2 B_i`, and returns the largest, and the
/// largest of those whose sums may have been cut off.
///
/// Of each block of places `bearings` has [`numbers`] blocks: the unit vectors towards them, zero at the start itself, then `w + z`
/// and `(w + z)^2 / (c + z)`.
#[inline(never)]
pub fn exponents(dimensions: usize, bearings: &[Block], way: &Way, sums: &mut [Block]) -> (f64, f64) {
    match dimensions {
        3 => over::<3, 5>(bearings.as_chunks().0, way, sums),
        _ => over::<2, 4>(bearings.as_chunks().0, way, sums),
    }
}

#[inline(always)]
fn over<const D: usize, const NUMBERS: usize>(
    bearings: &[[Block; NUMBERS]],
    way: &Way,
    sums: &mut [Block],
) -> (f64, f64) {
    let s = Lanes::splat;
    let (power, weight, unit) = (s(way.power), s(way.weight), way.unit.map(s));
    let (mut most, mut doubtful) = (s(f64::MIN), s(f64::MIN));
    for (bearing, exponent) in bearings.iter().zip(sums) {
        // the squared lengths of the sum of two unit vectors and of their difference
        let (mut sum, mut difference) = (s(0.0), s(0.0));
        for axis in 0..D {
            let component = Lanes::load(&bearing[axis]);
            let (together, apart) = (component + unit[axis], component - unit[axis]);
            sum = sum + together * together;
            difference = difference + apart * apart;
        }
        let angle = Lanes::squared_angle(sum, difference);
        let (wide, over) = (Lanes::load(&bearing[D]), Lanes::load(&bearing[D + 1]));
        let wider = wide + angle;
        let evidence = Lanes::log2_ratio(wider * wider, wide * wide + over * angle);
        let ratio = Lanes::load(exponent).log2();
        let product = power * ratio + weight * evidence;
        most = product.at_least(most);
        // below all that is certain unless the ratio is below `CERTAIN`
        doubtful = product.at_most(s(FAR * CERTAIN) - s(FAR) * ratio).at_least(doubtful);
        product.store(exponent);
    }
    (most.most(), doubtful.most())
}
