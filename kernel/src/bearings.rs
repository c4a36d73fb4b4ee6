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

/// How many blocks are worked on together, in loops of few operations each: processors do not look far ahead.
const TOGETHER: usize = 16;

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

impl Way {
    /// All exponents times `factor`.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { weight: factor * self.weight, power: factor * self.power, ..self }
    }
}

/// Turns the sums `N_i / S_i` of places into the exponents `power log2(N_i / S_i) + log2 B_i`, and returns the largest, and the
/// largest of those whose sums may have been cut off.
///
/// Of each block of places `bearings` has [`numbers`] blocks: the unit vectors towards them, zero at the start itself, then `w + z`
/// and `(w + z)^2 / (c + z)`.
#[inline(never)]
pub fn exponents(dimensions: usize, bearings: &[Block], way: &Way, sums: &mut [Block]) -> (f64, f64) {
    let (s, count) = (Lanes::splat, numbers(dimensions));
    let (power, weight, unit) = (s(way.power), s(way.weight), way.unit.map(s));
    for sum in &mut *sums {
        Lanes::load(sum).log2().store(sum);
    }
    let (mut most, mut doubtful) = (s(f64::MIN), s(f64::MIN));
    let mut angles = [Block::default(); TOGETHER];
    for (bearings, ratios) in bearings.chunks(TOGETHER * count).zip(sums.chunks_mut(TOGETHER)) {
        for (bearing, into) in bearings.chunks_exact(count).zip(&mut angles) {
            // the squared lengths of the sum of two unit vectors and of their difference
            let (mut sum, mut difference) = (s(0.0), s(0.0));
            for (component, unit) in bearing[..count - 2].iter().zip(unit) {
                let component = Lanes::load(component);
                let (together, apart) = (component + unit, component - unit);
                sum = sum + together * together;
                difference = difference + apart * apart;
            }
            Lanes::squared_angle(sum, difference).store(into);
        }
        for ((bearing, angle), exponent) in bearings.chunks_exact(count).zip(&angles).zip(ratios) {
            let (angle, wide, over) =
                (Lanes::load(angle), Lanes::load(&bearing[count - 2]), Lanes::load(&bearing[count - 1]));
            let wider = wide + angle;
            let evidence = Lanes::log2_ratio(wider * wider, wide * wide + over * angle);
            let ratio = Lanes::load(exponent);
            let product = power * ratio + weight * evidence;
            most = product.at_least(most);
            // below all that is certain unless the ratio is below `CERTAIN`
            doubtful = product.at_most(s(FAR * CERTAIN) - s(FAR) * ratio).at_least(doubtful);
            product.store(exponent);
        }
    }
    (most.most(), doubtful.most())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_those_of_the_equation() {
        let (wide, core, variance) = (0.36f64, 0.0256, 0.003);
        let way = Way { unit: [0.6, 0.8, 0.0], weight: 1.4, power: 1.7 };
        for angle in [0.0, 1e-6, 0.1, 1.0, 2.0, std::f64::consts::PI] {
            let (x, y) = (0.6 * f64::cos(angle) - 0.8 * f64::sin(angle), 0.6 * f64::sin(angle) + 0.8 * f64::cos(angle));
            let (w, c, square) = (wide + variance, core + variance, angle * angle);
            let evidence = (w + square).powi(2) * c / (w * w * (c + square));
            let mut sums = [[0.25, 8.0, 1e-160, 1.0]];
            let expected = sums[0].map(|sum: f64| 1.7 * sum.log2() + 1.4 * evidence.log2());
            let (most, doubtful) = exponents(2, &[x, y, w, w * w / c].map(|number| [number; 4]), &way, &mut sums);
            for (found, expected) in sums[0].iter().zip(expected) {
                assert!((found - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{angle}: {found} {expected}");
            }
            assert_eq!((most, doubtful), (sums[0][1], sums[0][2]));
        }
    }

    #[test]
    fn on_a_line_and_in_space_there_are_as_many_numbers_as_are_read() {
        assert_eq!([1, 2, 3].map(numbers), [4, 4, 5]);
        let way = Way { unit: [0.0, 0.0, 1.0], weight: 1.0, power: 0.0 };
        let bearing = [0.0, 0.0, -1.0, 2.0, 8.0].map(|number| [number; 4]);
        let (most, _) = exponents(3, &bearing, &way, &mut [[1.0; 4]]);
        let square = std::f64::consts::PI.powi(2);
        assert!((most - ((2.0 + square).powi(2) / (4.0 + 8.0 * square)).log2()).abs() < 1e-12);
    }
}
