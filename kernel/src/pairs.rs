//! The pairs of noise scale and time to go of the pointing model, as densities of where a movement will end.
//!
//! With velocity `v`, noise `[across, along]` and time to go `R` the endpoint has the mean `x + v R` and the covariance
//! ```text
//! P_pp + 2 R P_pv + R^2 P_vv + (across I + along v v') R^3/3
//! ```
//! and that of its own, which is that of a class of places or of each place alone. On a line, a plane in which nothing lies beside
//! it, the second axis has the variance one.

use crate::mixture::{AXES, Densities, HALF_LOG2_E};
use crate::small_gaussian::{Symmetric, inverse};
use crate::vectors::{Block, Lanes, Number, WIDTH, raise};
use std::f64::consts::LN_2;

/// Determinants below this share of the product of the variances have lost too many digits.
const CONDITIONED: f64 = 1e-10;

/// A movement now.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// The position `x`.
    pub position: [f64; AXES],
    /// The velocity `v`.
    pub velocity: [f64; AXES],
    /// `P_pp`, `2 P_pv` and `P_vv` of each axis.
    pub variances: [[f64; 3]; AXES],
}

impl Motion {
    /// The covariance of where it is after `time`, without the endpoint's own.
    #[inline(always)]
    #[must_use]
    pub fn covariance<N: Number>(&self, [across, along]: &[f64; 2], time: N) -> Symmetric<N> {
        let cubed = time * time * time * N::of(1.0 / 3.0);
        let (even, along) = (N::of(*across) * cubed, N::of(*along) * cubed);
        let grown = |axis: usize| {
            let [pp, pv, vv] = self.variances[axis];
            N::of(pp) + time * (N::of(pv) + time * N::of(vv)) + even
        };
        let [x, y, z] = self.velocity;
        [
            grown(0) + along * N::of(x * x),
            along * N::of(x * y),
            grown(1) + along * N::of(y * y),
            along * N::of(x * z),
            along * N::of(y * z),
            grown(2) + along * N::of(z * z),
        ]
    }
}

/// The times to go with their weights, in complete blocks, the last one filled up.
#[derive(Clone, Debug)]
pub struct TimesToGo {
    points: usize,
    times: Vec<Block>,
    /// Their logarithms over that of the median.
    log_times: Vec<Block>,
    /// One for each, zero for what fills the last block up.
    ones: Vec<Block>,
    weights: Vec<Block>,
}

/// Numbers in blocks, the last one filled up.
fn blocks(numbers: impl ExactSizeIterator<Item = f64>, rest: f64) -> Vec<Block> {
    let mut blocks = vec![[rest; WIDTH]; numbers.len().div_ceil(WIDTH)];
    blocks.as_flattened_mut().iter_mut().zip(numbers).for_each(|(place, x)| *place = x);
    blocks
}

impl TimesToGo {
    /// These times; `median` is that of their prior at unit pace.
    #[must_use]
    pub fn new(times: &[f64], median: f64) -> Self {
        let ones = blocks(times.iter().map(|_| 1.0), 0.0);
        Self {
            points: times.len(),
            times: blocks(times.iter().copied(), 1.0),
            log_times: blocks(times.iter().map(|time| (time / median).ln()), 0.0),
            weights: ones.clone(),
            ones,
        }
    }

    /// The times.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times.as_flattened()[..self.points]
    }

    /// Their weights, which sum to one.
    #[must_use]
    pub fn weights(&self) -> &[f64] {
        &self.weights.as_flattened()[..self.points]
    }

    /// Log-normal weights about the median times `pace^exponent`, with this deviation of the logarithm.
    #[inline(never)]
    pub fn set_weights(&mut self, pace: f64, exponent: f64, deviation: f64) {
        let s = Lanes::splat;
        let (middle, over) = (s(exponent * LN_2) * s(pace).log2(), s(1.0 / deviation));
        let mut top = s(f64::MIN);
        for (weight, log) in self.weights.iter_mut().zip(&self.log_times) {
            let apart = (Lanes::load(log) - middle) * over;
            let density = s(-HALF_LOG2_E) * apart * apart;
            density.store(weight);
            top = density.at_least(top);
        }
        let over = s(1.0 / raise(&mut self.weights, &self.ones, top.most()));
        for weight in &mut self.weights {
            (Lanes::load(weight) * over).store(weight);
        }
    }

    /// The pairs with these noises as densities, of which `into` has room for two for each time and two noises: where `own` is the covariance that the endpoints of all places share, for
    /// [`crate::mixture::shared_sums`], else for [`crate::mixture::own_sums`]. Returns whether all digits of their determinants are
    /// right.
    #[inline(never)]
    pub fn densities(
        &self,
        dimensions: usize,
        motion: &Motion,
        noises: &[[f64; 2]],
        own: Option<&Symmetric>,
        into: &mut [Densities],
    ) -> bool {
        match dimensions {
            3 => self.write::<3>(3, motion, noises, own, into),
            d => self.write::<2>(d, motion, noises, own, into),
        }
    }

    #[inline(always)]
    fn write<const D: usize>(
        &self,
        dimensions: usize,
        motion: &Motion,
        noises: &[[f64; 2]],
        own: Option<&Symmetric>,
        into: &mut [Densities],
    ) -> bool {
        let s = Lanes::splat;
        let mut least = s(1.0);
        let each = normaliser(dimensions) / noises.len() as f64;
        // an odd one out has another of no weight beside it
        let without_weight = noises.last().filter(|_| !noises.len().is_multiple_of(2)).map(|noise| (noise, 0.0));
        let all = noises.iter().map(|noise| (noise, each)).chain(without_weight);
        for (scale, (noise, each)) in all.enumerate() {
            let of_two = into.iter_mut().skip(scale / 2 * self.points).take(self.points);
            let mut places = of_two.zip(self.times());
            for (times, weights) in self.times.iter().zip(&self.weights) {
                let mut columns = [Block::default(); 7];
                let mut covariance = motion.covariance(noise, Lanes::load(times));
                if let Some(own) = own {
                    covariance.iter_mut().zip(own).for_each(|(entry, own)| *entry = *entry + s(*own));
                }
                if dimensions < 2 {
                    (covariance[1], covariance[2]) = (s(0.0), s(1.0));
                }
                let (precision, determinant) = inverse(&covariance, D);
                least = (determinant / diagonal::<D>(&covariance)).at_most(least);
                let weight = Lanes::load(weights) * s(each);
                if own.is_some() {
                    for (entry, (column, number)) in columns.iter_mut().zip(precision).enumerate() {
                        let doubled = if matches!(entry, 0 | 2 | 5) { 1.0 } else { 2.0 };
                        (s(-HALF_LOG2_E * doubled) * number).store(column);
                    }
                    (weight / determinant.sqrt()).store(&mut columns[6]);
                } else {
                    columns.iter_mut().zip(covariance).for_each(|(column, number)| number.store(column));
                    weight.store(&mut columns[6]);
                }
                for (lane, ((mean, densities), time)) in places.by_ref().take(WIDTH).enumerate() {
                    for axis in 0..D {
                        mean[axis] = motion.position[axis] + time * motion.velocity[axis];
                    }
                    let density = &mut densities[scale % 2];
                    for entry in 0..if D > 2 { 6 } else { 3 } {
                        density.form[entry] = columns[entry][lane];
                    }
                    density.factor = columns[6][lane];
                }
            }
        }
        least_of(least) > CONDITIONED
    }
}

/// The product of the variances.
#[inline(always)]
fn diagonal<const D: usize>([xx, _, yy, _, _, zz]: &Symmetric<Lanes>) -> Lanes {
    match D {
        3 => *xx * *yy * *zz,
        _ => *xx * *yy,
    }
}

/// The least of all four, no number where one of them is none.
fn least_of(lanes: Lanes) -> f64 {
    let mut block = Block::default();
    lanes.store(&mut block);
    block.into_iter().fold(f64::INFINITY, |least, x| if x < least || x.is_nan() { x } else { least })
}

/// `(2 pi)^(-d/2)`.
fn normaliser(dimensions: usize) -> f64 {
    const ONE: f64 = 0.398_942_280_401_432_7;
    match dimensions {
        1 => ONE,
        2 => ONE * ONE,
        _ => ONE * ONE * ONE,
    }
}
