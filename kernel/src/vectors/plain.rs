//! The operations as plain loops.

use super::{BIAS, Block, NEAREST, TWO_52, WIDTH};

#[derive(Clone, Copy, Debug)]
pub struct Vector(Block);

impl Vector {
    #[inline(always)]
    pub const fn splat(x: f64) -> Self {
        Self([x; WIDTH])
    }

    #[inline(always)]
    pub const fn load(block: &Block) -> Self {
        Self(*block)
    }

    #[inline(always)]
    pub const fn store(self, block: &mut Block) {
        *block = self.0;
    }

    #[inline(always)]
    fn each(mut self, f: impl Fn(f64) -> f64) -> Self {
        self.0.iter_mut().for_each(|x| *x = f(*x));
        self
    }

    #[inline(always)]
    fn both(mut self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        self.0.iter_mut().zip(other.0).for_each(|(x, y)| *x = f(*x, y));
        self
    }

    #[inline(always)]
    pub fn add(self, other: Self) -> Self {
        self.both(other, |x, y| x + y)
    }

    #[inline(always)]
    pub fn sub(self, other: Self) -> Self {
        self.both(other, |x, y| x - y)
    }

    #[inline(always)]
    pub fn mul(self, other: Self) -> Self {
        self.both(other, |x, y| x * y)
    }

    #[inline(always)]
    pub fn div(self, other: Self) -> Self {
        self.both(other, |x, y| x / y)
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.each(f64::sqrt)
    }

    #[inline(always)]
    pub fn at_least(self, least: Self) -> Self {
        self.both(least, |x, least| if x > least { x } else { least })
    }

    #[inline(always)]
    pub fn at_most(self, most: Self) -> Self {
        self.both(most, |x, most| if most < x { most } else { x })
    }

    #[inline(always)]
    pub fn add_to_exponent(self, integer: Self) -> Self {
        self.both(integer, |x, integer| f64::from_bits(x.to_bits().wrapping_add(integer.to_bits() << 52)))
    }

    /// Of normal numbers above zero: minus itself over the power of two that brings it within a factor of 1.51 of `other`, and
    /// the exponent of that power.
    #[inline(always)]
    pub fn less_a_power(self, other: Self) -> (Self, Self) {
        let bits = self.both(other, |x, other| {
            f64::from_bits(x.to_bits().wrapping_sub(other.to_bits()).wrapping_add(NEAREST) >> 52)
        });
        // the 2048 of `NEAREST` goes to the bit of the sign
        let minus = self.both(bits, |x, bits| f64::from_bits(x.to_bits().wrapping_sub(bits.to_bits() << 52)));
        (minus, bits.each(|bits| f64::from_bits(bits.to_bits() | TWO_52) - BIAS))
    }
}
