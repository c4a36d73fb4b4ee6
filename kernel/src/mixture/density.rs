//! Sums of Gaussian densities whose axes are correlated: for places that share an endpoint's covariance, and for places each of
//! which has its own variances.
//!
//! Two densities have one mean: what is made of a place's offset from it, the products of its components, is made once for
//! both. A line is a plane in which every place and mean has the coordinate zero and every density the variance one.

use super::{AXES, HALF_LOG2_E, Places, Powers};
use crate::small_gaussian::Symmetric;
use crate::vectors::{Block, Lanes};

/// Two densities about one mean.
pub type Densities = ([f64; AXES], [Density; 2]);

/// A Gaussian density without its mean.
#[derive(Clone, Copy, Debug, Default)]
pub struct Density {
    /// With [`shared_sums`] its curvature, the precision times `-log2(e)/2` with what is not on the diagonal doubled; with
    /// [`own_sums`] its covariance, to whose variances every place adds its own: xx, xy, yy, xz, yz, zz.
    pub form: Symmetric,
    /// What multiplies the power: with [`shared_sums`] all of the normaliser, with [`own_sums`] all but the determinant.
    pub factor: f64,
}

/// The exponent, in base 2 and never above zero, and the factor before the power, of a density whose curvature all places share.
#[inline(always)]
fn shared<const D: usize>(density: &Density, products: &Symmetric<Lanes>, _: &[Lanes; AXES]) -> (Lanes, Lanes) {
    let term = |entry: usize| Lanes::splat(density.form[entry]) * products[entry];
    let plane = term(0) + term(1) + term(2);
    let exponent = if D > 2 { plane + (term(3) + term(4) + term(5)) } else { plane };
    (exponent, Lanes::splat(density.factor))
}

/// The same of a density to whose variances every place adds its own.
#[inline(always)]
fn own<const D: usize>(density: &Density, products: &Symmetric<Lanes>, own: &[Lanes; AXES]) -> (Lanes, Lanes) {
    let entry = |i: usize| Lanes::splat(density.form[i]);
    let [x, x_y, y, x_z, y_z, z] = *products;
    let (xx, xy, yy) = (entry(0) + own[0], entry(1), entry(2) + own[1]);
    let (square, determinant) = if D > 2 {
        let (xz, yz, zz) = (entry(3), entry(4), entry(5) + own[2]);
        // the adjugate's upper triangle
        let (a, b, c) = (yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
        let (e, f, g) = (xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy);
        let mixed = b * x_y + c * x_z + f * y_z;
        (a * x + e * y + g * z + (mixed + mixed), xx * a + xy * b + xz * c)
    } else {
        let mixed = xy * x_y;
        (yy * x - (mixed + mixed) + xx * y, xx * yy - xy * xy)
    };
    let inverse = Lanes::splat(1.0) / determinant;
    (Lanes::splat(-HALF_LOG2_E) * square * inverse, Lanes::splat(density.factor) * inverse.sqrt())
}

/// Writes `factor_i sum_n f_n 2^e_n(i)` for every place; exponents are cut at -960. `OWN` is whether the factor that `evaluate`
/// gives is another one at every place.
#[inline(always)]
fn sums<const D: usize, const OWN: bool>(
    densities: &[Densities],
    evaluate: impl Fn(&Density, &Symmetric<Lanes>, &[Lanes; AXES]) -> (Lanes, Lanes),
    places: &Places<'_>,
    factors: &[Block],
    powers: &mut Powers,
    into: &mut [Block],
) {
    let zero = Lanes::splat(0.0);
    for (i, (factor, into)) in factors.iter().zip(into).enumerate() {
        let at = |list: &[Block]| list.get(i).map_or(zero, Lanes::load);
        let [x, y, z] = places.coordinates.map(at);
        let variances = places.variances.map(at);
        let mut sum = zero;
        for densities in densities.chunks(powers.0.len()) {
            for ([one, other], (mean, [first, second])) in powers.0.iter_mut().zip(densities) {
                let [x, y] = [x - Lanes::splat(mean[0]), y - Lanes::splat(mean[1])];
                let mut products = [x * x, x * y, y * y, zero, zero, zero];
                if D > 2 {
                    let z = z - Lanes::splat(mean[2]);
                    (products[3], products[4], products[5]) = (x * z, y * z, z * z);
                }
                let (exponent, factor) = evaluate(first, &products, &variances);
                one.set::<OWN>(exponent.decay_root(), factor);
                let (exponent, factor) = evaluate(second, &products, &variances);
                other.set::<OWN>(exponent.decay_root(), factor);
            }
            for ([one, other], (_, [first, second])) in powers.0.iter().zip(densities) {
                sum = sum + one.factor::<OWN>(first.factor) * one.power(Lanes::decay_power);
                sum = sum + other.factor::<OWN>(second.factor) * other.power(Lanes::decay_power);
            }
        }
        (sum * Lanes::load(factor).scaled_decay()).store(into);
    }
}

/// Writes `factor_i sum_n f_n 2^e_n(i)` for every place, in so many dimensions, for places that share the covariance of their
/// endpoints. Exponents are cut at -960.
#[inline(never)]
pub fn shared_sums(
    dimensions: usize,
    densities: &[Densities],
    places: &Places<'_>,
    factors: &[Block],
    powers: &mut Powers,
    into: &mut [Block],
) {
    match dimensions {
        3 => sums::<3, false>(densities, shared::<3>, places, factors, powers, into),
        _ => sums::<2, false>(densities, shared::<2>, places, factors, powers, into),
    }
}

/// The same for places whose endpoints have variances of their own.
#[inline(never)]
pub fn own_sums(
    dimensions: usize,
    densities: &[Densities],
    places: &Places<'_>,
    factors: &[Block],
    powers: &mut Powers,
    into: &mut [Block],
) {
    match dimensions {
        3 => sums::<3, true>(densities, own::<3>, places, factors, powers, into),
        _ => sums::<2, true>(densities, own::<2>, places, factors, powers, into),
    }
}
