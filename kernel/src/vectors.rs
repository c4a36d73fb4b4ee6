//! Four numbers at a time, and `2^x` of them.
//!
//! Natively these are plain loops over arrays, which the compiler turns into vector instructions. The WebAssembly is built
//! for size, where it does not, so there the instructions are named: all of them safe functions.

use std::ops::{Add, Div, Mul, Sub};

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod plain;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod simd128;

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
use plain::Vector;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
use simd128::Vector;

/// How many numbers there are in [`Lanes`]: two vectors of the WebAssembly. What four of them would
/// need at once no registers hold, and the code is twice as long; one would read the terms of a sum twice as often.
pub const WIDTH: usize = 4;

/// Four numbers in memory; flat arrays are lists of them.
pub type Block = [f64; WIDTH];

/// The exponents that [`Lanes::exp2`] takes as they are lie within this of the shift.
pub const MOST_EXPONENT: f64 = 960.0;

/// Four numbers that are worked on together.
#[derive(Clone, Copy, Debug)]
pub struct Lanes(Vector);

/// A [`Shift`] beyond this is taken as this; there exponents have no fraction left.
const MOST_SHIFT: f64 = 1e15;

/// The polynomial nearest to `2^(r/8)` for `|r| <= 1/2` in relative error, which is 9e-16 (exchange algorithm of Remez), has six
/// complex roots: it is `c` times the product of three `r^2 + a r + b`, each `[a, b]` here. As factors they take two
/// operations less than any other form with coefficients as large, and do not wait for one another.
const FACTORS: [[f64; 2]; 3] = [
    [54.523_375_587_965_97, 836.808_101_479_968_3],
    [33.284_579_818_344_23, 1_066.381_580_147_720_6],
    [-18.549_116_843_877_307, 1_907.245_558_101_922],
];

/// `c^8 2^LEADING`: what the eighth power of the product of [`FACTORS`] is to be multiplied by, so that `2^0` is 1.
const SCALE: f64 = 0.803_133_891_908_858_8;

/// The power of two in `1 / c^8`.
const LEADING: f64 = 245.0;

/// `1.5 * 2^52`: added to a number below `2^51`, it leaves the nearest integer in the last bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// The polynomial of degree 5 nearest to `2^(r/16)` for `|r| <= 1/2`, a relative 1e-14, with one pair of its complex roots about
/// an integer: with `u = r + 38` it is `c (u^2 + p) ((u + s)^2 + q) (u + t)`, and these are `p`, `s`, `q` and `t`.
const DECAY: [f64; 4] = [1_528.821_387_18, -43.612_337_481_758_914, 5_214.364_382_989_22, 12.260_150_410_731_754];

/// The integer.
const DECAY_CENTRE: f64 = 38.0;

/// `c^16`.
const DECAY_SCALE: f64 = 4.927_738_525_486_266e-143;

/// `log2(a / b) = s P(s^2)` with `s = (a - b) / (a + b)`, for `|s|` up to 0.2004, to a relative 2e-15.
const LOGARITHM: [f64; 7] = [
    2.885_390_081_777_931,
    0.961_796_693_915_014_1,
    0.577_078_020_713_516_1,
    0.412_197_934_592_665,
    0.320_644_725_470_141_4,
    0.260_654_531_661_402_8,
    0.251_164_398_589_836_6,
];

/// `x^2 = 4 sin^2(x/2) P(2 - 2 cos(x/2))` for angles up to pi, to a relative 7e-14.
const ANGLE: [f64; 18] = [
    0.999_999_999_999_929_5,
    0.333_333_333_356_154_1,
    0.094_444_443_220_696_06,
    0.025_396_851_318_677_822,
    0.006_666_378_093_635_075,
    0.001_728_738_977_134_835_8,
    0.000_434_929_630_689_802_6,
    0.000_140_110_505_470_373_47,
    -3.080_296_146_905_954e-5,
    0.000_105_128_760_769_880_09,
    -0.000_117_842_519_010_006_05,
    0.000_110_305_504_436_755_79,
    -7.520_094_085_034_908e-5,
    3.811_225_367_977_988_4e-5,
    -1.380_328_829_858_629e-5,
    3.412_470_792_126_06e-6,
    -5.162_450_773_931_302e-7,
    3.683_893_460_505_557_5e-8,
];

/// Added to the difference of the bits of two numbers, it makes its upper twelve bits the nearest integer to the difference of
/// their exponents, and 2048.
const NEAREST: u64 = (1 << 63) + (1 << 51);

/// The bits of `2^52`, whose last ones hold an integer.
const TWO_52: u64 = 0x4330_0000_0000_0000;

/// `2^52`, and the 2048 of [`NEAREST`].
const BIAS: f64 = 4_503_599_627_370_496.0 + 2048.0;

/// A polynomial from its highest factors down, two at a time by Horner's rule in the square: one product more than one at
/// a time, and half as long a way, which processors feel. Written out: at the level for size a loop would stay a loop.
macro_rules! polynomial {
    ($x:expr, $factors:ident, $highest:literal $(+ $next:literal)?, $($odd:literal + $even:literal),+) => {{
        let (x, square, factor) = ($x, $x * $x, |i: usize| Self::splat($factors[i]));
        let sum = factor($highest);
        $(let sum = sum * x + factor($next);)?
        $(let sum = sum * square + (factor($odd) * x + factor($even));)+
        sum
    }};
}

impl Lanes {
    /// The same number four times.
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

    /// The sum of all four.
    #[inline(always)]
    #[must_use]
    pub fn sum(self) -> f64 {
        let mut block = [0.0; WIDTH];
        self.store(&mut block);
        block.iter().sum()
    }

    /// The largest of all four.
    #[inline(always)]
    #[must_use]
    pub fn most(self) -> f64 {
        let mut block = [0.0; WIDTH];
        self.store(&mut block);
        // `f64::max` is a call in WebAssembly
        block.into_iter().fold(f64::NEG_INFINITY, |most, x| if x > most { x } else { most })
    }

    /// `log2` of each, to an absolute 1e-15 where that is less than 4; of normal numbers above zero.
    #[inline(always)]
    #[must_use]
    pub fn log2(self) -> Self {
        Self::log2_ratio(self, Self::splat(1.0))
    }

    /// `log2(a / b)` of each, as accurately as [`Lanes::log2`]; of normal numbers above zero.
    #[inline(always)]
    #[must_use]
    pub fn log2_ratio(a: Self, b: Self) -> Self {
        let (minus, integer) = a.0.less_a_power(b.0);
        let (minus, integer) = (Self(minus), Self(integer));
        let s = (minus + b) / (minus - b);
        let square = s * s;
        integer + s * polynomial!(square, LOGARITHM, 6, 5 + 4, 3 + 2, 1 + 0)
    }

    /// The square of the angle between two unit vectors, from the squared lengths of their sum and their difference, which
    /// resolve small, right and large angles alike; to a relative 1e-13.
    ///
    /// They are `4 cos^2(x/2)` and `4 sin^2(x/2)`.
    #[inline(always)]
    #[must_use]
    pub fn squared_angle(sum: Self, difference: Self) -> Self {
        let short = Self::splat(2.0) - sum.sqrt();
        difference * polynomial!(short, ANGLE, 17 + 16, 15 + 14, 13 + 12, 11 + 10, 9 + 8, 7 + 6, 5 + 4, 3 + 2, 1 + 0)
    }

    /// `2^(x - shift)` of each to a relative 2e-14. Beyond [`MOST_EXPONENT`] on either side the result stays what it is there,
    /// and NaN counts as the least, so no result is subnormal, infinite or NaN.
    #[inline(always)]
    #[must_use]
    pub fn exp2(self, shift: &Shift) -> Self {
        self.unscaled_exp2(shift).scaled()
    }

    /// The same, yet to be [`Lanes::scaled`], for sums: which is done once for all of their terms.
    #[inline(always)]
    #[must_use]
    pub fn unscaled_exp2(self, shift: &Shift) -> Self {
        let (root, integer) = self.eighth_root(shift);
        Self::eighth_power(root, integer)
    }

    /// The first half of `2^(x - shift)`: a multiple of `2^(r/8)`, a polynomial, where `r` in `[-1/2, 1/2]` is what is left of `x` over
    /// an integer; and that integer. The shift is part of the integer, so it changes no digit.
    #[inline(always)]
    #[must_use]
    pub fn eighth_root(self, shift: &Shift) -> (Self, Self) {
        let (s, rounder) = (Self::splat, Self::splat(shift.rounder));
        let x = self.at_most(s(shift.most)).at_least(s(shift.least));
        let integer = x + rounder;
        let r = x - (integer - rounder);
        let factor = |i: usize| (r + s(FACTORS[i][0])) * r + s(FACTORS[i][1]);
        (factor(0) * factor(1) * factor(2), integer)
    }

    /// The second half: three squarings, and the integer added to the bits of the exponent. Yet to be [`Lanes::scaled`], which is done
    /// once for all terms of a sum.
    #[inline(always)]
    #[must_use]
    pub fn eighth_power(root: Self, integer: Self) -> Self {
        let p = root * root;
        let p = p * p;
        let p = p * p;
        Self(p.0.add_to_exponent(integer.0))
    }

    /// The first half of `2^x`, of numbers that are not above zero, to a relative 2e-13: as [`Lanes::eighth_root`], with a
    /// multiple of `2^(r/16)` and five operations less. One of the polynomial's centres is an integer, so that rounding subtracts it.
    #[inline(always)]
    #[must_use]
    pub fn decay_root(self) -> (Self, Self) {
        let s = Self::splat;
        let x = self.at_least(s(-MOST_EXPONENT));
        let integer = x + s(ROUNDER);
        let r = x - (integer - s(ROUNDER + DECAY_CENTRE));
        let [first, apart, second, root] = DECAY;
        let other = r + s(apart);
        ((r * r + s(first)) * (other * other + s(second)) * (r + s(root)), integer)
    }

    /// The second half, yet to be [`Lanes::scaled_decay`].
    #[inline(always)]
    #[must_use]
    pub fn decay_power(root: Self, integer: Self) -> Self {
        Self::eighth_power(root * root, integer)
    }

    /// What [`Lanes::decay_power`] returns, or a sum of such, as powers of two.
    #[inline(always)]
    #[must_use]
    pub fn scaled_decay(self) -> Self {
        self * Self::splat(DECAY_SCALE)
    }

    /// What [`Lanes::eighth_power`] returns, or a sum of such, as powers of two.
    #[inline(always)]
    #[must_use]
    pub fn scaled(self) -> Self {
        self * Self::splat(SCALE)
    }
}

/// The largest integer not above `log2(x)`, of a normal number above zero.
#[must_use]
pub const fn exponent(x: f64) -> f64 {
    (x.to_bits() >> 52) as f64 - 1023.0
}

/// Multiplies the numbers above `least`; the others become zero.
#[inline(never)]
pub fn scale_above(numbers: &mut [f64], least: f64, factor: f64) {
    for x in numbers {
        *x = if *x > least { *x * factor } else { 0.0 };
    }
}

/// Multiplies numbers by `factor`, and adds `even` to those with a weight above zero.
#[inline(never)]
pub fn mix(numbers: &mut [f64], factor: f64, weights: &[f64], even: f64) {
    for (x, weight) in numbers.iter_mut().zip(weights) {
        *x = factor * *x + if *weight > 0.0 { even } else { 0.0 };
    }
}

/// Turns exponents into `factor 2^(exponent - shift)`, those beyond the factors into the power alone, and returns the sum; as
/// [`Lanes::exp2`], with the integer nearest to `shift`.
#[inline(never)]
pub fn raise(exponents: &mut [Block], factors: &[Block], shift: f64) -> f64 {
    let shift = Shift::by(shift);
    let mut total = Lanes::splat(0.0);
    for (i, exponent) in exponents.iter_mut().enumerate() {
        let factor = factors.get(i).unwrap_or(&[1.0; WIDTH]);
        let raised = Lanes::load(exponent).exp2(&shift) * Lanes::load(factor);
        raised.store(exponent);
        total = total + raised;
    }
    total.sum()
}

/// What one number and [`Lanes`] of them have in common.
pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> {
    /// The same number in every place.
    fn of(x: f64) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn of(x: f64) -> Self {
        x
    }
}

impl Number for Lanes {
    #[inline(always)]
    fn of(x: f64) -> Self {
        Self::splat(x)
    }
}

/// An integer that [`Lanes::exp2`] takes off every exponent.
#[derive(Clone, Copy, Debug)]
pub struct Shift {
    /// `1.5 * 2^52 - shift - LEADING`: added to a number below `2^51`, the nearest integer, shifted, is in the last bits.
    rounder: f64,
    least: f64,
    most: f64,
}

impl Shift {
    /// A shift by the integer nearest to `x`.
    #[must_use]
    pub fn by(x: f64) -> Self {
        let shift = x.round_ties_even().clamp(-MOST_SHIFT, MOST_SHIFT);
        Self { rounder: ROUNDER - LEADING - shift, least: shift - MOST_EXPONENT, most: shift + MOST_EXPONENT }
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

    fn one(f: impl Fn(Lanes) -> Lanes, x: f64) -> f64 {
        let mut block = [0.0; WIDTH];
        f(Lanes::splat(x)).store(&mut block);
        block[0]
    }

    #[test]
    fn logarithms_are_those_of_the_library() {
        let mut worst = 0.0f64;
        for k in 0..200_000 {
            let x = (-700.0 + 1400.0 * (f64::from(k) * 0.618_033_988_749_894_9).fract()).exp2();
            for x in [x, 1.0 + 1e-3 * x.fract(), std::f64::consts::SQRT_2 - 1e-9 * x.fract()] {
                worst = worst.max((one(Lanes::log2, x) - x.log2()).abs() / (1.0 + x.log2().abs()));
            }
        }
        assert!(worst < 1e-15 && worst > 0.0, "{worst:e}");
        assert_eq!([0.25, 1.0, 8.0].map(|x| one(Lanes::log2, x)), [-2.0, 0.0, 3.0]);
        assert!(one(Lanes::log2, 0.0) < -1000.0, "finite, and far down");
    }

    #[test]
    fn logarithms_of_ratios_are_those_of_the_library() {
        let mut worst = 0.0f64;
        for k in 0..200_000 {
            let [a, b] = [0.618_033_988_749_894_9, 0.754_877_666_246_692_7].map(|step| (f64::from(k) * step).fract());
            let (x, y) = (1.0 + a, 1.0 + b);
            let scaled = (x * (-400.0 + 800.0 * b).round().exp2(), y * (-400.0 + 800.0 * a).round().exp2());
            for (x, y) in [(x, y), scaled] {
                let (found, parts) = (one(|x| Lanes::log2_ratio(x, Lanes::splat(y)), x), [x.log2(), y.log2()]);
                let scale = 1.0 + parts[0].abs() + parts[1].abs();
                worst = worst.max((found - (parts[0] - parts[1])).abs() / scale);
            }
        }
        assert!(worst < 1e-15 && worst > 0.0, "{worst:e}");
    }

    #[test]
    fn squared_angles_are_those_of_the_library() {
        let mut worst = 0.0f64;
        for k in 1..=100_000 {
            let angle = std::f64::consts::PI * f64::from(k) / 100_000.0;
            let (x, y) = (angle.cos(), angle.sin());
            let [sum, difference] = [(1.0 + x).powi(2) + y * y, (1.0 - x).powi(2) + y * y];
            let found = one(|sum| Lanes::squared_angle(sum, Lanes::splat(difference)), sum);
            worst = worst.max((found / (angle * angle) - 1.0).abs());
        }
        assert!(worst < 1e-13 && worst > 0.0, "{worst:e}");
    }

    #[test]
    fn integer_powers_are_exact() {
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
    fn exponents_are_those_of_the_bits() {
        assert_eq!([1.0, 1.999, 2.0, 0.75, 3e-200].map(exponent), [0.0, 0.0, 1.0, -1.0, -663.0]);
    }

    #[test]
    fn only_what_is_above_the_least_is_scaled() {
        let mut numbers = [1.0, 0.5, 0.25, 0.125, 2.0];
        scale_above(&mut numbers, 0.25, 4.0);
        assert_eq!(numbers, [4.0, 2.0, 0.0, 0.0, 8.0]);
    }

    #[test]
    fn only_what_has_a_weight_is_mixed_with_the_even_share() {
        let mut numbers = [1.0, 0.5, 0.25];
        mix(&mut numbers, 2.0, &[1.0, 0.0, 1e-9], 0.125);
        assert_eq!(numbers, [2.125, 1.0, 0.625]);
    }

    #[test]
    fn decaying_powers_of_two_are_within_2e_13() {
        let power = |x: Lanes| {
            let (root, integer) = x.decay_root();
            Lanes::decay_power(root, integer).scaled_decay()
        };
        let decay = |x: f64| one(power, x);
        let mut worst = 0.0f64;
        for k in 0..400_000 {
            let x = -950.0 * (f64::from(k) * 0.618_033_988_749_894_9).fract();
            worst = worst.max((decay(x) / x.exp2() - 1.0).abs());
        }
        assert!(worst < 2e-13 && worst > 1e-15, "{worst:e}");
        for x in [-960.5, -1e9, f64::NEG_INFINITY, f64::NAN] {
            assert_eq!(decay(x), decay(-MOST_EXPONENT), "2^{x}");
        }
    }

    #[test]
    fn every_lane_is_its_own() {
        let (x, y) = ([1.0, 2.0, 3.0, 4.0], [4.0, -3.0, 2.0, -1.0]);
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
        assert_eq!((a.sum(), b.most()), (10.0, 4.0));
    }
}
