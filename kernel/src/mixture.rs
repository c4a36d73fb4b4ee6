//! The hot loop, Liang (11) telescoped and summed by (6): at many places at once, sums of exponentials of quadratics.
//!
//! ```text
//! w_i = prior_i sum_n f_n 2^(quadratic_n(a_i) - shift)
//! ```
//!
//! The ratio of two Gaussian densities of an endpoint is such a term, and a sum over arrival nodes (and noise candidates) is
//! such a sum, for all destinations whose endpoints have one covariance ([`Ball`], [`Ellipsoid`]) or each its own ([`Own`]).
//! Places lie in flat arrays of [`Block`]s, a list for each axis.
//!
//! The shift is an integer that goes into the exponent's bits, so it changes no digit of any weight: whichever shift
//! leads to a sum in range leads to the same probabilities, to the bit.

mod density;
mod powers;
mod terms;

pub use density::{Densities, Density, own_sums, shared_sums};
pub use powers::Powers;
pub use terms::{Ball, Ellipsoid, Own};

use super::vectors::{Block, Lanes, Shift, WIDTH};

/// Half of `log2(e)`: a density's exponent in base 2 is this times the squared distance.
pub const HALF_LOG2_E: f64 = 0.5 * std::f64::consts::LOG2_E;

/// The most axes. Terms have room for as many, and hold zeros beyond the axes that there are.
pub const AXES: usize = 3;

/// Where the terms are evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Places<'a> {
    /// Coordinates, a list for each axis; those of axes that there are not are empty.
    pub coordinates: [&'a [Block]; AXES],
    /// Variances of the endpoint in each axis, beyond those of the terms; for [`Own`] terms only, else empty.
    pub variances: [&'a [Block]; AXES],
    /// What [`Ball`] terms are expanded about.
    pub origin: [f64; AXES],
}

impl Places<'_> {
    /// The same where there are two axes or more; a line twice, as a plane. Terms on a line, whose numbers beyond it are zero, have
    /// the same values there.
    #[inline(always)]
    fn in_the_plane(&self) -> Self {
        let mut places = *self;
        if places.coordinates[1].is_empty() {
            (places.coordinates[1], places.variances[1]) = (places.coordinates[0], places.variances[0]);
        }
        places
    }
}

/// One term, `factor * 2^exponent` at every place, over `D` axes: two or three.
pub trait Term<const D: usize>: Copy {
    /// What is the same for every term at one block of places.
    type Place: Copy;

    /// The places of block `i`; none beyond the end.
    fn place(places: &Places<'_>, i: usize) -> Option<Self::Place>;

    /// What is a factor before the power at every place.
    fn factor(&self) -> f64;

    /// The exponent, in base 2, and all of the factor before the power.
    fn exponent_and_factor(&self, place: &Self::Place) -> (Lanes, Lanes);
}

// closures would stay calls at the level for size
#[inline(always)]
fn at(list: &[Block], i: usize) -> Option<Lanes> {
    Some(Lanes::load(list.get(i)?))
}

/// Writes `prior_i sum_n f_n 2^(e_n(i) - shift)` for every place, and returns their sum over all of them. Exponents are cut at
/// 960 on either side of the shift, an integer. `OWN` is whether a term's factor is another one at every place.
#[inline(never)]
fn weighted_sums<const D: usize, const OWN: bool, T: Term<D>>(
    terms: &[T],
    places: &Places<'_>,
    shift: f64,
    priors: &[Block],
    powers: &mut Powers,
    weights: &mut [Block],
) -> f64 {
    let shift = Shift::by(shift);
    let mut total = Lanes::splat(0.0);
    for (i, (prior, weight)) in priors.iter().zip(weights).enumerate() {
        let Some(place) = T::place(places, i) else { break };
        let mut sum = Lanes::splat(0.0);
        for terms in terms.chunks(2 * powers.0.len()) {
            for (power, term) in powers.0.as_flattened_mut().iter_mut().zip(terms) {
                let (exponent, factor) = term.exponent_and_factor(&place);
                power.set::<OWN>(exponent.eighth_root(&shift), factor);
            }
            for (power, term) in powers.0.as_flattened().iter().zip(terms) {
                sum = sum + power.factor::<OWN>(term.factor()) * power.power(Lanes::eighth_power);
            }
        }
        let weighted = sum * Lanes::load(prior).scaled();
        weighted.store(weight);
        total = total + weighted;
    }
    total.sum()
}

/// The exponent and the factor of term `n` at block `i`; none beyond the last block.
type At<'a> = dyn Fn(usize, usize) -> Option<(Lanes, Lanes)> + 'a;

fn term_at<const D: usize, T: Term<D>>(terms: &[T], places: &Places<'_>, n: usize, i: usize) -> Option<(Lanes, Lanes)> {
    Some(terms.get(n)?.exponent_and_factor(&T::place(places, i)?))
}

#[inline(never)]
fn term_in<T: Term<2> + Term<3>>(
    dimensions: usize,
    terms: &[T],
    places: &Places<'_>,
    (n, i): (usize, usize),
) -> Option<(Lanes, Lanes)> {
    if dimensions == 3 { term_at::<3, T>(terms, places, n, i) } else { term_at::<2, T>(terms, places, n, i) }
}

/// Writes `log2 sum_n f_n 2^e_n(i)` for every place, whatever the size of the exponents.
#[inline(never)]
fn log2_sums(terms: usize, at: &At<'_>, logs: &mut [Block]) {
    if terms == 0 {
        return logs.fill([f64::NEG_INFINITY; WIDTH]);
    }
    let none = Shift::by(0.0);
    for (i, log) in logs.iter_mut().enumerate() {
        let Some((mut top, _)) = at(0, i) else { return };
        for n in 1..terms {
            let Some((exponent, _)) = at(n, i) else { return };
            top = exponent.at_least(top);
        }
        let mut sum = Lanes::splat(0.0);
        for n in 0..terms {
            let Some((exponent, factor)) = at(n, i) else { return };
            sum = sum + factor * (exponent - top).unscaled_exp2(&none);
        }
        let mut tops = [0.0; WIDTH];
        top.store(&mut tops);
        sum.scaled().store(log);
        log.iter_mut().zip(tops).for_each(|(log, top)| *log = top + log.log2());
    }
}

/// Terms of one form, and their sums. Each form has functions of its own: what is generic would be compiled where it is called, at
/// the level for size.
pub trait Sums: Sized {
    /// Writes `prior_i sum_n f_n 2^(e_n(i) - shift)` for every place, in so many dimensions, and returns their sum over all of
    /// them. Exponents are cut at 960 on either side of the shift, an integer.
    fn weighted_sums(
        dimensions: usize,
        terms: &[Self],
        places: &Places<'_>,
        shift: f64,
        priors: &[Block],
        powers: &mut Powers,
        weights: &mut [Block],
    ) -> f64;

    /// Writes `log2 sum_n f_n 2^e_n(i)` for every place, in so many dimensions, whatever the size of the exponents.
    fn log2_sums(dimensions: usize, terms: &[Self], places: &Places<'_>, logs: &mut [Block]);
}

macro_rules! sums {
    ($($term:ident $own:literal),*) => {$(
        impl Sums for $term {
            #[inline(never)]
            fn weighted_sums(
                dimensions: usize,
                terms: &[Self],
                places: &Places<'_>,
                shift: f64,
                priors: &[Block],
                powers: &mut Powers,
                weights: &mut [Block],
            ) -> f64 {
                if dimensions == 3 {
                    weighted_sums::<3, $own, Self>(terms, places, shift, priors, powers, weights)
                } else {
                    weighted_sums::<2, $own, Self>(terms, &places.in_the_plane(), shift, priors, powers, weights)
                }
            }

            #[inline(never)]
            fn log2_sums(dimensions: usize, terms: &[Self], places: &Places<'_>, logs: &mut [Block]) {
                let places = &places.in_the_plane();
                log2_sums(terms.len(), &|n, i| term_in(dimensions, terms, places, (n, i)), logs);
            }
        }
    )*};
}

sums!(Ellipsoid false, Own true);

impl Ball {
    /// As [`Sums::weighted_sums`], in the plane.
    #[inline(never)]
    pub fn weighted_sums(
        terms: &[Self],
        places: &Places<'_>,
        shift: f64,
        priors: &[Block],
        powers: &mut Powers,
        weights: &mut [Block],
    ) -> f64 {
        weighted_sums::<2, false, Self>(terms, places, shift, priors, powers, weights)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places on a line, three blocks of them.
    fn line(step: f64) -> Vec<Block> {
        (0..3).map(|b| std::array::from_fn(|l| step * (b * WIDTH + l) as f64 - 5.0)).collect()
    }

    fn gaussian(x: f64, mean: f64, variance: f64) -> f64 {
        (-0.5 * (x - mean) * (x - mean) / variance).exp() / (std::f64::consts::TAU * variance).sqrt()
    }

    /// What lies beyond the axes that there are must not matter.
    const fn padded(of: [f64; 2]) -> [f64; AXES] {
        [of[0], of[1], f64::NAN]
    }

    /// `N(a; m, v) / N(a; u, w)` for two axes in each of the three forms.
    struct Ratio {
        m: [f64; 2],
        u: [f64; 2],
        v: f64,
        w: f64,
    }

    impl Ratio {
        fn at(&self, a: [f64; 2]) -> f64 {
            (0..2).map(|k| gaussian(a[k], self.m[k], self.v) / gaussian(a[k], self.u[k], self.w)).product()
        }

        fn ball(&self, origin: [f64; AXES]) -> Ball {
            let h = HALF_LOG2_E;
            let (p, g) = ([0, 1].map(|k| self.m[k] - origin[k]), [0, 1].map(|k| self.u[k] - origin[k]));
            let square = |x: [f64; 2]| x[0] * x[0] + x[1] * x[1];
            Ball {
                curvature: h * (1.0 / self.w - 1.0 / self.v),
                slope: padded([0, 1].map(|k| 2.0 * h * (p[k] / self.v - g[k] / self.w))),
                constant: h * (square(g) / self.w - square(p) / self.v),
                factor: self.w / self.v,
            }
        }

        fn ellipsoid(&self) -> Ellipsoid {
            let h = HALF_LOG2_E;
            let a = h * (1.0 / self.w - 1.0 / self.v);
            let apart = [0, 1].map(|k| self.m[k] - self.u[k]);
            Ellipsoid {
                center: padded(self.m),
                curvature: [padded([a, 0.0]), padded([0.0, a]), [f64::NAN; AXES]],
                slope: padded(apart.map(|x| 2.0 * h * x / self.w)),
                constant: h * (apart[0] * apart[0] + apart[1] * apart[1]) / self.w,
                factor: self.w / self.v,
            }
        }

        fn own(&self, own: f64) -> Own {
            Own {
                mean: padded(self.m),
                variance: padded([self.v - own; 2]),
                start_mean: padded(self.u),
                start_variance: padded([self.w - own; 2]),
                constant: 0.0,
                factor: 1.0,
            }
        }
    }

    const RATIOS: [Ratio; 3] = [
        Ratio { m: [1.0, 2.0], u: [-3.0, 0.5], v: 4.0, w: 30.0 },
        Ratio { m: [8.0, -2.0], u: [-3.5, 0.5], v: 9.0, w: 50.0 },
        Ratio { m: [20.0, -8.0], u: [-4.0, 0.5], v: 25.0, w: 90.0 },
    ];

    #[test]
    fn each_form_of_a_ratio_of_densities_gives_the_sum_over_them() {
        let (x, y, s) = (line(1.5), line(-0.7), vec![[2.5; WIDTH]; 3]);
        let origin = [0.3, -0.2, f64::NAN];
        let places = Places { coordinates: [x.as_slice(), &y, &[]], variances: [s.as_slice(), &s, &[]], origin };
        let priors = vec![[0.25; WIDTH]; 3];
        let expect = |found: &[Block], total: f64, what: &str| {
            let mut sum = 0.0;
            for (i, found) in found.as_flattened().iter().enumerate() {
                let a = [x.as_flattened()[i], y.as_flattened()[i]];
                let expected = 0.25 * RATIOS.iter().map(|r| r.at(a)).sum::<f64>();
                assert!((found / expected - 1.0).abs() < 1e-12, "{what} at {a:?}: {found:e} {expected:e}");
                sum += expected;
            }
            assert!((total / sum - 1.0).abs() < 1e-13, "{what}");
        };
        let (mut powers, mut weights) = (Powers::default(), vec![[0.0; WIDTH]; 3]);
        let total = weighted_sums::<2, false, _>(
            &RATIOS.each_ref().map(|r| r.ball(origin)),
            &places,
            0.0,
            &priors,
            &mut powers,
            &mut weights,
        );
        expect(&weights, total, "ball");
        let ellipsoids = RATIOS.each_ref().map(Ratio::ellipsoid);
        let total = weighted_sums::<2, false, _>(&ellipsoids, &places, 0.0, &priors, &mut powers, &mut weights);
        expect(&weights, total, "ellipsoid");
        let total = weighted_sums::<2, true, _>(
            &RATIOS.each_ref().map(|r| r.own(2.5)),
            &places,
            0.0,
            &priors,
            &mut powers,
            &mut weights,
        );
        expect(&weights, total, "own");
        let mut logs = vec![[0.0; WIDTH]; 3];
        Ellipsoid::log2_sums(2, &RATIOS.each_ref().map(Ratio::ellipsoid), &places, &mut logs);
        for (log, weight) in logs.as_flattened().iter().zip(weights.as_flattened()) {
            assert!((log - (weight / 0.25).log2()).abs() < 1e-12);
        }
    }

    #[test]
    fn a_correlated_quadratic_in_three_dimensions() {
        let term = Ellipsoid {
            center: [1.0, -1.0, 2.0],
            curvature: [[-0.5, 0.25, -0.125], [0.0, -1.0, 0.5], [0.0, 0.0, -2.0]],
            slope: [0.5, 0.0, -1.0],
            constant: 3.0,
            factor: 0.5,
        };
        let ones = [[2.0; WIDTH]];
        let places = Places { coordinates: [&ones[..]; AXES], variances: [&[]; AXES], origin: [0.0; AXES] };
        let mut weights = [[0.0; WIDTH]];
        // d = (1, 3, 0): -0.5 + 0.25 * 3 + 0.5 - 9 + 3
        let total =
            Ellipsoid::weighted_sums(3, &[term], &places, 0.0, &[[1.0; WIDTH]], &mut Powers::default(), &mut weights);
        let expected = 0.5 * (-5.25f64).exp2();
        assert!(
            (weights[0][WIDTH - 1] / expected - 1.0).abs() < 1e-14
                && (total / (WIDTH as f64 * expected) - 1.0).abs() < 1e-14
        );
    }

    #[test]
    fn the_shift_changes_no_digit_of_any_weight() {
        let (x, y) = (line(1.5), line(-0.7));
        let places = Places { coordinates: [x.as_slice(), &y, &[]], variances: [&[]; AXES], origin: [0.0; AXES] };
        let terms = RATIOS.each_ref().map(Ratio::ellipsoid);
        let priors = vec![[1.0; WIDTH]; 3];
        let mut powers = Powers::default();
        let (mut plain, mut shifted) = (vec![[0.0; WIDTH]; 3], vec![[0.0; WIDTH]; 3]);
        let total = weighted_sums::<2, false, _>(&terms, &places, 0.0, &priors, &mut powers, &mut plain);
        for shift in [-50.0, 13.0, 400.0] {
            let other = weighted_sums::<2, false, _>(&terms, &places, shift, &priors, &mut powers, &mut shifted);
            assert_eq!(other * shift.exp2(), total);
            for (a, b) in plain.as_flattened().iter().zip(shifted.as_flattened()) {
                assert_eq!(*a, b * shift.exp2());
            }
        }
    }

    #[test]
    fn more_terms_than_there_is_room_for_are_all_summed_up() {
        let x = line(0.5);
        let places = Places { coordinates: [x.as_slice(), &[], &[]], variances: [&[]; AXES], origin: [0.0; AXES] };
        for count in [1, 7, 8, 9, 21] {
            // powers of two, whose sum no digit of which is lost
            let terms: Vec<_> =
                (0..count).map(|n| Ellipsoid { factor: (n as f64).exp2(), ..Ellipsoid::default() }).collect();
            let (mut powers, mut weights) = (Powers::default(), vec![[0.0; WIDTH]; 3]);
            Ellipsoid::weighted_sums(1, &terms, &places, 0.0, &[[1.0; WIDTH]; 3], &mut powers, &mut weights);
            let expected = (count as f64).exp2() - 1.0;
            assert!(weights.as_flattened().iter().all(|w| (w / expected - 1.0).abs() < 1e-14), "{count} terms");
        }
    }

    #[test]
    fn logs_neither_overflow_nor_vanish() {
        let curvature = [[-1.0, 0.0, 0.0], [0.0; AXES], [0.0; AXES]];
        let term = |constant| Ellipsoid { curvature, constant, factor: 2.0, ..Ellipsoid::default() };
        let x = [[0.0, 1.0, 1e3, 1e6]];
        let places = Places { coordinates: [&x[..], &[], &[]], variances: [&[]; AXES], origin: [0.0; AXES] };
        let mut logs = [[0.0; WIDTH]];
        Ellipsoid::log2_sums(1, &[term(5e5), term(5e5), term(-7e5)], &places, &mut logs);
        assert_eq!(logs[0], [500_002.0, 500_001.0, -499_998.0, 500_002.0 - 1e12]);
    }

    #[test]
    fn without_terms_nothing_is_possible_anywhere() {
        let x = line(1.5);
        let places = Places { coordinates: [x.as_slice(), &[], &[]], variances: [&[]; AXES], origin: [0.0; AXES] };
        let (mut logs, mut weights) = (vec![[7.0; WIDTH]; 3], vec![[7.0; WIDTH]; 3]);
        Ellipsoid::log2_sums(1, &[], &places, &mut logs);
        assert_eq!(logs, [[f64::NEG_INFINITY; WIDTH]; 3]);
        let total =
            Ellipsoid::weighted_sums(1, &[], &places, 0.0, &[[1.0; WIDTH]; 3], &mut Powers::default(), &mut weights);
        assert_eq!((total, weights), (0.0, vec![[0.0; WIDTH]; 3]));
    }
}
