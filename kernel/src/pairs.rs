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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mixture::{Places, Powers, own_sums, shared_sums};

    /// `N(x; mean, covariance)` over the first `d` axes.
    fn density(d: usize, offset: &[f64; AXES], covariance: &Symmetric) -> f64 {
        let (precision, determinant) = inverse(covariance, d);
        let moved = crate::small_gaussian::times(&precision, offset);
        let square: f64 = (0..d).map(|axis| offset[axis] * moved[axis]).sum();
        (-0.5 * square).exp() / (std::f64::consts::TAU.powi(d as i32) * determinant).sqrt()
    }

    #[test]
    fn sums_are_those_of_the_densities_one_at_a_time() {
        let mut times = TimesToGo::new(&[0.05, 0.1, 0.2, 0.4, 0.8], 0.2);
        times.set_weights(1.3, -0.25, 0.8);
        assert!((times.weights().iter().sum::<f64>() - 1.0).abs() < 1e-14);
        let axis = |list: [f64; 4]| vec![list];
        let lists = [axis([1.0, 20.0, -50.0, 300.0]), axis([5.0, -9.0, 80.0, 40.0]), axis([2.0, 0.0, 7.0, -90.0])];
        let variances = [axis([4.0, 9.0, 16.0, 100.0]), axis([5.0, 30.0, 2.0, 50.0]), axis([9.0, 8.0, 7.0, 60.0])];
        for d in 1..=3 {
            // what lies beyond the dimensions is zero or not there
            let of = |x: [f64; AXES]| std::array::from_fn(|axis| if axis < d { x[axis] } else { 0.0 });
            let motion = Motion {
                position: of([3.0, 4.0, 5.0]),
                velocity: of([200.0, -100.0, 60.0]),
                variances: std::array::from_fn(|axis| if axis < d { [1.0, 40.0, 900.0] } else { [0.0; 3] }),
            };
            let slice =
                |lists: &'_ [Vec<Block>; AXES], axis: usize| if axis < d { lists[axis].clone() } else { Vec::new() };
            let coordinates: [Vec<Block>; AXES] = std::array::from_fn(|axis| slice(&lists, axis));
            let own: [Vec<Block>; AXES] = std::array::from_fn(|axis| slice(&variances, axis));
            let places = Places {
                coordinates: coordinates.each_ref().map(Vec::as_slice),
                variances: own.each_ref().map(Vec::as_slice),
                origin: [0.0; AXES],
            };
            let shared = [30.0, 5.0, 20.0, 2.0, -3.0, 10.0];
            for noises in [&[[1e4, 8.0]][..], &[[1e4, 8.0], [1e6, 8.0]], &[[1e4, 8.0], [1e5, 2.0], [1e6, 0.0]]] {
                let mut room = vec![Densities::default(); 5 * noises.len().div_ceil(2)];
                for covariance in [Some(&shared), None] {
                    let mut sums = [[0.0; WIDTH]];
                    assert!(times.densities(d, &motion, noises, covariance, &mut room));
                    if covariance.is_some() {
                        shared_sums(d, &room, &places, &[[2.0; WIDTH]], &mut Powers::default(), &mut sums);
                    } else {
                        own_sums(d, &room, &places, &[[2.0; WIDTH]], &mut Powers::default(), &mut sums);
                    }
                    for lane in 0..WIDTH {
                        let mut expected = 0.0;
                        for noise in noises {
                            for (&time, weight) in times.times().iter().zip(times.weights()) {
                                let mut grown = motion.covariance(noise, time);
                                for entry in 0..6 {
                                    let variance = [0, 9, 1, 9, 9, 2][entry];
                                    grown[entry] += match covariance {
                                        Some(shared) => shared[entry],
                                        None => variances.get(variance).map_or(0.0, |list| list[0][lane]),
                                    };
                                }
                                let offset = std::array::from_fn(|axis| {
                                    if axis < d {
                                        lists[axis][0][lane] - motion.position[axis] - time * motion.velocity[axis]
                                    } else {
                                        0.0
                                    }
                                });
                                expected += 2.0 * weight / noises.len() as f64 * density(d, &offset, &grown);
                            }
                        }
                        let found = sums[0][lane];
                        assert!((found / expected - 1.0).abs() < 1e-12, "{d} {lane}: {found:e} {expected:e}");
                    }
                }
            }
        }
    }

    #[test]
    fn determinants_without_their_digits_are_reported() {
        let times = TimesToGo::new(&[0.1], 0.1);
        let motion = Motion { position: [0.0; 3], velocity: [1e9, 1e9, 0.0], variances: [[1.0, 0.0, 0.0]; 3] };
        let mut room = [Densities::default()];
        assert!(!times.densities(2, &motion, &[[0.0, 1.0]], Some(&[0.0; 6]), &mut room));
        assert!(times.densities(2, &motion, &[[1e18, 1.0]], Some(&[0.0; 6]), &mut room));
    }
}
