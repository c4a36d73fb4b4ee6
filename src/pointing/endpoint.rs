//! The endpoint density `N_i`: where the movement ends if it goes on, mixed over noise scales and times to go.
//!
//! With velocity `v`, speed `s`, unit vector `u = v / s`, scale `c` and time to go `R`, the endpoint of destination `i` is
//! Gaussian about `x + v R` with the covariance
//! ```text
//! P_pp + 2 R P_pv + R^2 P_vv + (c^2 + (across s)^2) R^3/3 I + (along^2 - across^2) R^3/3 v v' + S_i
//! ```
//! which is, in the frame of `u`, noise `c^2 + (along s)^2` along the way and `c^2 + (across s)^2` across it. For one
//! covariance `S_i` its logarithm is a quadratic in `a_i - x`.

use super::course::Course;
use super::parameters::{PointingConstants, TimeToGo};
use super::targets::Extent;
use super::{Space, Symmetric, Vector, dot, minus};
use crate::math::gaussian::LN_2_PI;
use crate::math::log_sum_exp::{log_sum_exp, share};
use std::ops::Range;
use whither_kernel::mixture::{Density, HALF_LOG2_E, SharedDensity};
use whither_kernel::small_gaussian::{inverse, times};
use whither_kernel::vectors::{Block, Lanes, Number, WIDTH};

/// One (scale, time to go).
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// The time to go `R`.
    pub time: f64,
    /// Spectral density of the noise across the way, and what is added to it along `v v'`.
    pub noise: [f64; 2],
    weight: f64,
    mean: Vector,
    covariance: Symmetric,
}

/// The pairs one at a time, for what is not computed for every destination after every observation.
#[derive(Clone, Debug)]
pub(crate) struct Pairs<S> {
    space: S,
    position: Vector,
    /// Scale by scale.
    pub list: Vec<Pair>,
}

/// The pairs of one scale with as many times to go as are worked on together.
#[derive(Clone, Copy, Debug, Default)]
struct Together {
    weight: Block,
    /// Where the movement would end.
    end: [Block; 3],
    covariance: Symmetric<Block>,
}

/// All pairs after an observation.
#[derive(Clone, Debug)]
pub(crate) struct Nodes<S> {
    space: S,
    position: Vector,
    velocity: Vector,
    /// How many times to go there are.
    points: usize,
    /// The times to go, in complete blocks, the last one filled up.
    times: Vec<f64>,
    /// Their logarithms over that of the median.
    log_times: Vec<f64>,
    /// One for each time to go, zero for what fills the last block up.
    ones: Vec<f64>,
    weights: Vec<f64>,
    /// That of each scale, as in [`Pair::noise`].
    noises: Vec<[f64; 2]>,
    /// Scale by scale.
    pairs: Vec<Together>,
}

impl<S: Space> Nodes<S> {
    /// The pairs after the latest observation.
    #[must_use]
    pub fn new(parameters: &PointingConstants, course: &Course<S>) -> Self {
        let TimeToGo { to, points, median, .. } = parameters.time_to_go;
        let mut times = parameters.time_to_go.nodes();
        let mut log_times: Vec<f64> = times.iter().map(|time| (time / median).ln()).collect();
        let mut ones = vec![1.0; points];
        let length = points.next_multiple_of(WIDTH);
        times.resize(length, to);
        log_times.resize(length, 0.0);
        ones.resize(length, 0.0);
        let pairs = vec![Together::default(); parameters.scales.len() * length / WIDTH];
        let (space, position, velocity) = (course.space(), course.position(), course.velocity());
        let (weights, noises) = (ones.clone(), vec![[0.0; 2]; parameters.scales.len()]);
        let mut nodes = Self { space, position, velocity, points, times, log_times, ones, weights, noises, pairs };
        nodes.refresh(parameters, course);
        nodes
    }

    /// The pairs after one more observation.
    pub fn refresh(&mut self, parameters: &PointingConstants, course: &Course<S>) {
        let s = Lanes::splat;
        let speed = course.speed();
        (self.position, self.velocity) = (course.position(), course.velocity());
        let (times, weights) = (blocks(&self.times), self.weights.as_chunks_mut().0);
        parameters.time_to_go.weights(blocks(&self.log_times), blocks(&self.ones), speed, weights);
        let each = 1.0 / parameters.scales.len() as f64;
        let (along, across) = (parameters.along_noise.powi(2), parameters.across_noise.powi(2));
        let mut pairs = self.pairs.iter_mut();
        for (scale, noise) in parameters.scales.iter().zip(&mut self.noises) {
            *noise = [scale * scale + across * speed * speed, along - across];
            for ((times, weights), pairs) in times.iter().zip(&*weights).zip(pairs.by_ref()) {
                let time = Lanes::load(times);
                (Lanes::load(weights) * s(each)).store(&mut pairs.weight);
                let [xx, xy, yy, xz, yz, zz] = spread(noise, &self.velocity, time * time * time * s(1.0 / 3.0));
                let ([a, b, c, d, e, f], [x, y, z]) = (&mut pairs.covariance, &mut pairs.end);
                let end = |axis: usize| s(self.position[axis]) + time * s(self.velocity[axis]);
                (xx + grown(course, 0, time)).store(a);
                xy.store(b);
                (yy + grown(course, 1, time)).store(c);
                end(0).store(x);
                end(1).store(y);
                if self.space.dimensions() > 2 {
                    xz.store(d);
                    yz.store(e);
                    (zz + grown(course, 2, time)).store(f);
                    end(2).store(z);
                }
            }
        }
    }

    /// Dimensions.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.space.dimensions()
    }

    /// The pairs, scale by scale.
    #[must_use]
    pub fn pairs(&self) -> Pairs<S> {
        let mut list = Vec::with_capacity(self.noises.len() * self.points);
        for (noise, pairs) in self.noises.iter().zip(self.pairs.chunks(self.times.len().max(WIDTH) / WIDTH)) {
            for node in 0..self.points {
                let (lane, time) = (node % WIDTH, self.times.get(node).copied().unwrap_or_default());
                let Some(Together { weight, covariance, .. }) = pairs.get(node / WIDTH) else { break };
                let ([x, y, z], [a, b, c, d, e, f]) = (self.velocity, covariance);
                list.push(Pair {
                    time,
                    noise: *noise,
                    weight: weight[lane],
                    mean: [x * time, y * time, z * time],
                    covariance: [a[lane], b[lane], c[lane], d[lane], e[lane], f[lane]],
                });
            }
        }
        Pairs { space: self.space, position: self.position, list }
    }

    /// The pairs as terms of a sum, for destinations whose endpoints have one covariance.
    pub fn shared_densities(&self, own: &Symmetric, into: &mut Vec<SharedDensity>) {
        let s = Lanes::splat;
        let (half, full, normaliser) = (s(-HALF_LOG2_E), s(-2.0 * HALF_LOG2_E), s(normaliser(self.dimensions())));
        into.resize(self.noises.len() * self.points, SharedDensity::default());
        let mut terms = into.iter_mut();
        for (pairs, lanes) in self.together() {
            let covariance = sum(&loaded(&pairs.covariance), &splat(own));
            let ([xx, xy, yy, xz, yz, zz], determinant) = inverse(&covariance, self.dimensions());
            let [mut a, mut b, mut c, mut d, mut e, mut f, mut factor] = [[0.0; WIDTH]; 7];
            (half * xx).store(&mut a);
            (full * xy).store(&mut b);
            (half * yy).store(&mut c);
            (full * xz).store(&mut d);
            (full * yz).store(&mut e);
            (half * zz).store(&mut f);
            (Lanes::load(&pairs.weight) * normaliser / determinant.sqrt()).store(&mut factor);
            let [x, y, z] = &pairs.end;
            // no array maps: at the level for size each entry would be a call
            for (lane, term) in lanes.zip(terms.by_ref()) {
                let curvature = [a[lane], b[lane], c[lane], d[lane], e[lane], f[lane]];
                *term = SharedDensity { mean: [x[lane], y[lane], z[lane]], curvature, factor: factor[lane] };
            }
        }
    }

    /// The pairs as terms of a sum, for destinations whose endpoints have each its own variances.
    pub fn densities(&self, into: &mut Vec<Density>) {
        let normaliser = normaliser(self.dimensions());
        into.resize(self.noises.len() * self.points, Density::default());
        let mut terms = into.iter_mut();
        for (pairs, lanes) in self.together() {
            let ([xx, xy, yy, xz, yz, zz], [x, y, z]) = (&pairs.covariance, &pairs.end);
            for (lane, term) in lanes.zip(terms.by_ref()) {
                *term = Density {
                    mean: [x[lane], y[lane], z[lane]],
                    variance: [xx[lane], yy[lane], zz[lane]],
                    covariance: [xy[lane], xz[lane], yz[lane]],
                    factor: pairs.weight[lane] * normaliser,
                };
            }
        }
    }

    /// What is worked on together, each with the lanes that hold a pair.
    fn together(&self) -> impl Iterator<Item = (&Together, Range<usize>)> {
        let each = self.times.len().max(WIDTH) / WIDTH;
        let filled = move |i: usize| self.points.saturating_sub(i % each * WIDTH).min(WIDTH);
        self.pairs.iter().enumerate().map(move |(i, pairs)| (pairs, 0..filled(i)))
    }
}

/// The variance of the position in one axis, some time from now, but for the noise until then.
#[inline(always)]
fn grown<S: Space>(course: &Course<S>, axis: usize, time: Lanes) -> Lanes {
    let [[pp, pv], [_, vv]] = course.axes[axis].covariance;
    Lanes::splat(pp) + time * (Lanes::splat(pv + pv) + time * Lanes::splat(vv))
}

fn blocks(list: &[f64]) -> &[Block] {
    list.as_chunks().0
}

#[inline(always)]
fn loaded([a, b, c, d, e, f]: &Symmetric<Block>) -> Symmetric<Lanes> {
    [Lanes::load(a), Lanes::load(b), Lanes::load(c), Lanes::load(d), Lanes::load(e), Lanes::load(f)]
}

#[inline(always)]
fn splat([a, b, c, d, e, f]: &Symmetric) -> Symmetric<Lanes> {
    let s = Lanes::splat;
    [s(*a), s(*b), s(*c), s(*d), s(*e), s(*f)]
}

impl<S: Space> Pairs<S> {
    /// `ln N_i` of a destination at `center` whose endpoint has this covariance.
    #[must_use]
    pub fn log_density(&self, center: &Vector, extent: &Extent) -> f64 {
        log_sum_exp(&self.log_terms(center, extent))
    }

    /// `p(c, R_n | D_i)`, in the order of the pairs; their priors where `N_i` is zero or no number.
    #[must_use]
    pub fn weights(&self, center: &Vector, extent: &Extent) -> Vec<f64> {
        let mut terms = self.log_terms(center, extent);
        if share(&mut terms).is_none() {
            terms.iter_mut().zip(&self.list).for_each(|(term, pair)| *term = pair.weight);
        }
        terms
    }

    /// The logarithms of the pairs' densities, weights included.
    fn log_terms(&self, center: &Vector, extent: &Extent) -> Vec<f64> {
        let d = self.space.dimensions();
        let offset = minus(center, &self.position);
        let each = self.list.iter().map(|pair| {
            let (precision, determinant) = inverse(&sum(&pair.covariance, &extent.covariance), d);
            let error = minus(&offset, &pair.mean);
            let square = dot(&error, &times(&precision, &error));
            pair.weight.ln() - 0.5 * (square + determinant.ln() + d as f64 * LN_2_PI)
        });
        each.collect()
    }
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

#[inline(always)]
fn sum<N: Number>(a: &Symmetric<N>, b: &Symmetric<N>) -> Symmetric<N> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]]
}

/// `(noise[0] I + noise[1] v v') factor`: the noise of a movement, wider along the velocity than across it.
#[inline(always)]
#[must_use]
pub fn spread<N: Number>(noise: &[f64; 2], velocity: &Vector, factor: N) -> Symmetric<N> {
    let [x, y, z] = *velocity;
    let (even, along) = (N::of(noise[0]) * factor, N::of(noise[1]) * factor);
    let (xx, yy, zz) = (along * N::of(x * x), along * N::of(y * y), along * N::of(z * z));
    [even + xx, along * N::of(x * y), even + yy, along * N::of(x * z), along * N::of(y * z), even + zz]
}
