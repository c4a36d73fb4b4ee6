//! The operations as instructions of WebAssembly, all of them safe functions.

use super::{BIAS, Block, NEAREST, TWO_52};
use bytemuck::must_cast;
use core::arch::wasm32::{
    f64x2_add, f64x2_div, f64x2_mul, f64x2_pmax, f64x2_pmin, f64x2_splat, f64x2_sqrt, f64x2_sub, i64x2_add, i64x2_shl,
    i64x2_sub, u64x2_shr, u64x2_splat, v128, v128_or,
};

// no loops and no arrays of arrays: at the level for size they would stay in memory
#[derive(Clone, Copy, Debug)]
pub struct Vector(v128, v128);

impl Vector {
    #[inline(always)]
    pub fn splat(x: f64) -> Self {
        let both = f64x2_splat(x);
        Self(both, both)
    }

    #[inline(always)]
    pub fn load(block: &Block) -> Self {
        let [low, high] = must_cast(*block);
        Self(low, high)
    }

    #[inline(always)]
    pub fn store(self, block: &mut Block) {
        *block = must_cast([self.0, self.1]);
    }

    #[inline(always)]
    fn each(self, f: impl Fn(v128) -> v128) -> Self {
        Self(f(self.0), f(self.1))
    }

    #[inline(always)]
    fn both(self, other: Self, f: impl Fn(v128, v128) -> v128) -> Self {
        Self(f(self.0, other.0), f(self.1, other.1))
    }

    #[inline(always)]
    pub fn add(self, other: Self) -> Self {
        self.both(other, |x, y| f64x2_add(x, y))
    }

    #[inline(always)]
    pub fn sub(self, other: Self) -> Self {
        self.both(other, |x, y| f64x2_sub(x, y))
    }

    #[inline(always)]
    pub fn mul(self, other: Self) -> Self {
        self.both(other, |x, y| f64x2_mul(x, y))
    }

    #[inline(always)]
    pub fn div(self, other: Self) -> Self {
        self.both(other, |x, y| f64x2_div(x, y))
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.each(|x| f64x2_sqrt(x))
    }

    #[inline(always)]
    pub fn at_least(self, least: Self) -> Self {
        // pmax(a, b) is `a < b ? b : a`
        self.both(least, |x, least| f64x2_pmax(least, x))
    }

    #[inline(always)]
    pub fn at_most(self, most: Self) -> Self {
        // pmin(a, b) is `b < a ? b : a`
        self.both(most, |x, most| f64x2_pmin(x, most))
    }

    #[inline(always)]
    pub fn add_to_exponent(self, integer: Self) -> Self {
        self.both(integer, |x, integer| i64x2_add(x, i64x2_shl(integer, 52)))
    }

    /// Of normal numbers above zero: minus itself over the power of two that brings it within a factor of 1.51 of `other`, and
    /// the exponent of that power.
    #[inline(always)]
    pub fn less_a_power(self, other: Self) -> (Self, Self) {
        let bits = self.both(other, |x, other| u64x2_shr(i64x2_add(i64x2_sub(x, other), u64x2_splat(NEAREST)), 52));
        // the 2048 of `NEAREST` goes to the bit of the sign
        let minus = self.both(bits, |x, bits| i64x2_sub(x, i64x2_shl(bits, 52)));
        (minus, bits.each(|bits| f64x2_sub(v128_or(bits, u64x2_splat(TWO_52)), f64x2_splat(BIAS))))
    }
}
