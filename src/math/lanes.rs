//! Eight numbers at a time, and `2^x` of them.
//!
//! Natively these are plain loops over arrays, which the compiler turns into vector instructions. The WebAssembly is built
//! for size, where it does not, so there the instructions are named: all of them safe functions.

use std::ops::{Add, Div, Mul, Sub};

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
use plain::Vector;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
use simd128::Vector;

/// How many numbers there are in [`Lanes`].
pub const WIDTH: usize = 8;

/// Eight numbers in memory; flat arrays are lists of them.
pub type Block = [f64; WIDTH];

/// The exponents that [`Lanes::exp2`] takes as they are lie within this of the shift.
pub const MOST_EXPONENT: f64 = 960.0;

/// Eight numbers that are worked on together.
#[derive(Clone, Copy, Debug)]
pub struct Lanes(Vector);

/// A [`Shift`] beyond this is taken as this; there exponents have no fraction left.
const MOST_SHIFT: f64 = 1e15;

/// The polynomial nearest to `2^(r/8)` for `|r| <= 1/2` in relative error, which is 9e-16 (exchange algorithm of Remez).
const POLYNOMIAL: [f64; 7] = [
    1.0,
    0.086_643_397_570_005_58,
    0.003_753_539_171_233_660_7,
    0.000_108_406_461_838_332_56,
    2.348_176_073_204_416e-6,
    4.069_397_194_323_364e-8,
    5.875_635_917_075_096e-10,
];

impl Lanes {
    /// The same number eight times.
    #[inline(always)]
    #[must_use]
    pub fn splat(x: f64) -> Self {
        Self(Vector::splat(x))
    }

    /// From memory.
    #[inline(always)]
    #[must_use]
    pub fn load(block: &Block) -> Self {
        Self(Vector::load(block))
    }

    /// To memory.
    #[inline(always)]
    pub fn store(self, block: &mut Block) {
        self.0.store(block);
    }

    /// The square root of each.
    #[inline(always)]
    #[must_use]
    pub fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    /// The larger of each and `least`; `least` in the place of NaN.
    #[inline(always)]
    #[must_use]
    pub fn at_least(self, least: Self) -> Self {
        Self(self.0.at_least(least.0))
    }

    /// The smaller of each and `most`; NaN stays.
    #[inline(always)]
    #[must_use]
    pub fn at_most(self, most: Self) -> Self {
        Self(self.0.at_most(most.0))
    }

    /// The sum of all eight.
    #[inline(always)]
    #[must_use]
    pub fn sum(self) -> f64 {
        let mut block = [0.0; WIDTH];
        self.store(&mut block);
        block.iter().sum()
    }

    /// `2^(x - shift)` of each to a relative 2e-14. Beyond [`MOST_EXPONENT`] on either side the result stays what it is there,
    /// and NaN counts as the least, so no result is subnormal, infinite or NaN.
    ///
    /// The exponent is split into a whole number and a rest `r` in `[-1/2, 1/2]`; `2^(r/8)` is a polynomial, three squarings
    /// make it `2^r`, and the whole number is added to the bits of its exponent. The shift is part of that whole number, so it
    /// changes no digit.
    #[inline(always)]
    #[must_use]
    pub fn exp2(self, shift: &Shift) -> Self {
        let [c0, c1, c2, c3, c4, c5, c6] = POLYNOMIAL;
        let (s, rounder) = (Self::splat, Self::splat(shift.rounder));
        let x = self.at_most(s(shift.most)).at_least(s(shift.least));
        let whole = x + rounder;
        let r = x - (whole - rounder);
        let p = s(c6) * r + s(c5);
        let p = p * r + s(c4);
        let p = p * r + s(c3);
        let p = p * r + s(c2);
        let p = p * r + s(c1);
        let p = p * r + s(c0);
        let p = p * p;
        let p = p * p;
        let p = p * p;
        Self(p.0.add_to_exponent(whole.0))
    }
}

/// A whole number that [`Lanes::exp2`] takes off every exponent.
#[derive(Clone, Copy, Debug)]
pub struct Shift {
    /// `1.5 * 2^52 - shift`: added to a number below `2^51`, it leaves the nearest whole number, shifted, in the last bits.
    rounder: f64,
    least: f64,
    most: f64,
}

impl Shift {
    /// A shift by the whole number nearest to `x`.
    #[must_use]
    pub fn by(x: f64) -> Self {
        let shift = x.round().clamp(-MOST_SHIFT, MOST_SHIFT);
        Self { rounder: 6_755_399_441_055_744.0 - shift, least: shift - MOST_EXPONENT, most: shift + MOST_EXPONENT }
    }
}

impl Add for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0.add(other.0))
    }
}

impl Sub for Lanes {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0.sub(other.0))
    }
}

impl Mul for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0.mul(other.0))
    }
}

impl Div for Lanes {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0.div(other.0))
    }
}

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod plain {
    use super::{Block, WIDTH};

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
        pub fn add_to_exponent(self, whole: Self) -> Self {
            self.both(whole, |x, whole| f64::from_bits(x.to_bits().wrapping_add(whole.to_bits() << 52)))
        }
    }
}

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod simd128 {
    use super::Block;
    use core::arch::wasm32::{
        f64x2, f64x2_add, f64x2_div, f64x2_extract_lane, f64x2_mul, f64x2_pmax, f64x2_pmin, f64x2_splat, f64x2_sqrt,
        f64x2_sub, i64x2_add, i64x2_shl, v128,
    };

    // no loops and no arrays of arrays: at the level for size they would stay in memory
    #[derive(Clone, Copy, Debug)]
    pub struct Vector(v128, v128, v128, v128);

    impl Vector {
        #[inline(always)]
        pub fn splat(x: f64) -> Self {
            let both = f64x2_splat(x);
            Self(both, both, both, both)
        }

        #[inline(always)]
        pub fn load(block: &Block) -> Self {
            let [a, b, c, d, e, f, g, h] = *block;
            Self(f64x2(a, b), f64x2(c, d), f64x2(e, f), f64x2(g, h))
        }

        #[inline(always)]
        pub fn store(self, block: &mut Block) {
            let low = |v| f64x2_extract_lane::<0>(v);
            let high = |v| f64x2_extract_lane::<1>(v);
            *block = [
                low(self.0),
                high(self.0),
                low(self.1),
                high(self.1),
                low(self.2),
                high(self.2),
                low(self.3),
                high(self.3),
            ];
        }

        #[inline(always)]
        fn each(self, f: impl Fn(v128) -> v128) -> Self {
            Self(f(self.0), f(self.1), f(self.2), f(self.3))
        }

        #[inline(always)]
        fn both(self, other: Self, f: impl Fn(v128, v128) -> v128) -> Self {
            Self(f(self.0, other.0), f(self.1, other.1), f(self.2, other.2), f(self.3, other.3))
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
        pub fn add_to_exponent(self, whole: Self) -> Self {
            self.both(whole, |x, whole| i64x2_add(x, i64x2_shl(whole, 52)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exp2(x: f64) -> f64 {
        let mut block = [0.0; WIDTH];
        Lanes::splat(x).exp2(&Shift::by(0.0)).store(&mut block);
        assert!(block.iter().all(|y| y.to_bits() == block[0].to_bits()));
        block[0]
    }

    #[test]
    fn powers_of_two_are_within_2e_14_everywhere() {
        let mut worst = 0.0f64;
        // an irrational stride meets every part of the unit interval in every binade
        for k in 0..400_000 {
            let x = -950.0 + 1900.0 * (f64::from(k) * 0.618_033_988_749_894_9).fract();
            worst = worst.max((exp2(x) / x.exp2() - 1.0).abs());
        }
        for x in [0.5, -0.5, 0.5 + f64::EPSILON, 1e-300, -1e-17, 0.25, 949.5] {
            worst = worst.max((exp2(x) / f64::exp2(x) - 1.0).abs());
        }
        assert!(worst < 2e-14, "{worst:e}");
        assert!(worst > 1e-16, "compared with itself");
    }

    #[test]
    fn whole_powers_are_exact() {
        for x in -960..=960 {
            assert_eq!(exp2(f64::from(x)), f64::from(x).exp2());
        }
    }

    #[test]
    fn beyond_its_range_it_is_still_a_normal_number() {
        for x in [-961.0, -1074.0, -1e9, -1e300, f64::NEG_INFINITY, f64::NAN] {
            assert_eq!(exp2(x), f64::exp2(-MOST_EXPONENT), "2^{x}");
        }
        for x in [961.0, 1025.0, 1e9, 1e300, f64::INFINITY] {
            assert_eq!(exp2(x), f64::exp2(MOST_EXPONENT), "2^{x}");
        }
    }

    #[test]
    fn a_shift_changes_no_digit() {
        for shift in [-1e12, -1234.0, -1.0, 7.0, 100_000.0, 1e12] {
            for rest in [-0.5, -0.3, 0.125, 0.25, 0.375, 17.5, -200.625] {
                let mut block = [0.0; WIDTH];
                Lanes::splat(shift + rest).exp2(&Shift::by(shift)).store(&mut block);
                assert_eq!(block[0], exp2((shift + rest) - shift), "{shift} {rest}");
            }
        }
    }

    #[test]
    fn every_lane_is_its_own() {
        let (x, y) = ([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0], [8.0, -7.0, 6.0, -5.0, 4.0, -3.0, 2.0, -1.0]);
        let (a, b) = (Lanes::load(&x), Lanes::load(&y));
        let check = |found: Lanes, expected: fn(f64, f64) -> f64| {
            let mut block = [0.0; WIDTH];
            found.store(&mut block);
            for i in 0..WIDTH {
                assert_eq!(block[i], expected(x[i], y[i]), "lane {i}");
            }
        };
        check(a + b, |x, y| x + y);
        check(a - b, |x, y| x - y);
        check(a * b, |x, y| x * y);
        check(a / b, |x, y| x / y);
        check(a.sqrt(), |x, _| x.sqrt());
        check(a.at_least(b), f64::max);
        check(a.at_most(b), f64::min);
        assert_eq!(a.sum(), 36.0);
    }
}
