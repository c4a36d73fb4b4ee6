//! The coefficients: from the endpoint seen from now and from the start to the terms of [`crate::math::mixture`].
//!
//! With `d = a - m`, `v = V + S`, `u = U + S` for one axis,
//!
//! ```text
//! ln N(a; m, v) / N(a; u_n, u) = -(1/v - 1/u) d^2 / 2 + d (m - u_n) / u + (m - u_n)^2 / 2u + ln(u / v) / 2
//! ```
//!
//! and the factor `sqrt(u / v)` stays a factor, so no logarithm is taken. Loops are plain, as in [`super::separable`].
#![allow(clippy::needless_range_loop, reason = "the axes of several arrays at once")]

use super::classes::{Class, Classes};
use super::separable::{Axes, AxisEnd, AxisState, MOST, NodeTable};
use crate::math::lanes::{Block, Lanes, WIDTH};
use crate::math::mixture::{AXES, Ball, Ellipsoid, HALF_LOG2_E, Own, Places, Term, log2_sums, weigh};

/// Where the mean of a node is further from the origin than this many bits of its density, the terms of a [`Ball`] cancel
/// too much, and the [`Ellipsoid`] is taken.
const MOST_BITS: f64 = 256.0;

const ZERO: Block = [0.0; WIDTH];

/// The endpoint's position in one axis for eight nodes, seen from now and from the start, without its own variance.
#[derive(Clone, Copy, Debug, Default)]
struct AxisBlock {
    mean: Block,
    variance: Block,
    start_mean: Block,
    start_variance: Block,
}

/// The same in all axes.
#[derive(Clone, Copy, Debug, Default)]
struct EndBlock {
    axes: [AxisBlock; AXES],
    /// The node's weight times what the rest of the endpoint gives; zero for nodes that have passed.
    factor: Block,
    /// What is added to the exponent.
    constant: Block,
}

/// Room that is kept from step to step; what is in it is no part of any state.
#[derive(Clone, Debug, Default)]
pub struct Work {
    ends: Vec<EndBlock>,
    /// How many of the ends are in use.
    count: usize,
    /// Whether the axes of all ends have one variance.
    round: bool,
    /// Coupled sources put their terms here.
    pub ellipsoids: Vec<Ellipsoid>,
    balls: Vec<Ball>,
    owns: Vec<Own>,
}

/// What a separable source gives for one noise candidate.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a> {
    /// The filters now.
    pub now: &'a Axes,
    /// What the start says of the state that `start_tables` begin with.
    pub start: &'a [AxisState; MOST],
    /// Transitions to the nodes from now, for each axis that is not as the first one.
    pub tables: &'a [NodeTable; MOST],
    /// Transitions to the nodes from where `start` is.
    pub start_tables: &'a [NodeTable; MOST],
    /// Prior probabilities of the nodes; zero for those that have passed.
    pub weights: &'a [Block],
    /// `w_c` of this candidate.
    pub weight: f64,
    /// What this candidate's exponents have over those of the first one.
    pub lead: f64,
}

impl Work {
    /// Forgets the ends and terms of another class.
    pub fn clear(&mut self) {
        self.count = 0;
        self.ellipsoids.clear();
        self.round = true;
    }

    /// Adds the ends that one noise candidate sees.
    #[inline(never)]
    pub fn see(&mut self, sight: &Sight<'_>, ends: &[AxisEnd; MOST]) {
        let (now, d) = (sight.now, sight.now.dimensions.min(MOST));
        let mut alike = [true; MOST];
        for axis in 1..d {
            let same_end = ends[axis].length == ends[0].length && ends[axis].covariance == ends[0].covariance;
            alike[axis] = same_end && now.shares(axis);
            self.round &= alike[axis];
        }
        let lead = Lanes::splat(sight.lead);
        for (b, weights) in sight.weights.iter().enumerate() {
            if self.count == self.ends.len() {
                self.ends.push(EndBlock::default());
            }
            let Some(block) = self.ends.get_mut(self.count) else { return };
            self.count += 1;
            let (mut exponent, mut density, mut start_density) = (lead, Lanes::splat(1.0), Lanes::splat(1.0));
            for axis in 0..d {
                let table = if now.alike[axis] { 0 } else { axis };
                let (rows, start_rows) = (sight.tables[table].rows(b), sight.start_tables[table].rows(b));
                let (state, start, end) = (&now.filters[axis].now, &sight.start[axis], &ends[axis]);
                if end.length > 1 {
                    let (here, there) = (rows.ends(state, end), start_rows.ends(start, end));
                    let into = &mut block.axes[axis];
                    here.mean.store(&mut into.mean);
                    here.variance.store(&mut into.variance);
                    there.mean.store(&mut into.start_mean);
                    there.variance.store(&mut into.start_variance);
                    exponent = exponent + (here.exponent - there.exponent);
                    density = density * here.density;
                    start_density = start_density * there.density;
                    continue;
                }
                let [first, ..] = block.axes;
                let into = &mut block.axes[axis];
                rows.position(state).store(&mut into.mean);
                start_rows.position(start).store(&mut into.start_mean);
                if axis > 0 && alike[axis] {
                    into.variance = first.variance;
                    into.start_variance = first.start_variance;
                } else {
                    rows.variance(state).store(&mut into.variance);
                    start_rows.variance(start).store(&mut into.start_variance);
                }
            }
            let weight = Lanes::splat(sight.weight) * Lanes::load(weights);
            (weight * (density / start_density).sqrt()).store(&mut block.factor);
            exponent.store(&mut block.constant);
        }
    }

    /// Writes the weights of a class, `prior_i sum_n f_n 2^(e_n - shift)`, and returns their sum.
    #[inline(never)]
    pub fn weigh(
        &mut self,
        classes: &Classes,
        class: &Class,
        origin: [f64; AXES],
        shift: f64,
        weights: &mut [Block],
    ) -> f64 {
        let places = classes.places(class, origin);
        let priors = &classes.priors[class.blocks.clone()];
        let (d, weights) = (classes.dimensions, &mut weights[class.blocks.clone()]);
        match &class.size {
            None => {
                self.owns();
                weigh_in(d, &self.owns, &places, shift, priors, weights)
            }
            Some(size) => {
                if self.balls(d, size, &origin) {
                    weigh_in(d, &self.balls, &places, shift, priors, weights)
                } else {
                    self.ellipsoids(d, size);
                    weigh_in(d, &self.ellipsoids, &places, shift, priors, weights)
                }
            }
        }
    }

    /// Writes `log2` of the sums of a class, whatever their size.
    #[inline(never)]
    pub fn log2_sums(&mut self, classes: &Classes, class: &Class, logs: &mut [Block]) {
        let places = classes.places(class, [0.0; AXES]);
        let (d, logs) = (classes.dimensions, &mut logs[class.blocks.clone()]);
        match &class.size {
            None => {
                self.owns();
                log2_sums_in(d, &self.owns, &places, logs);
            }
            Some(size) => {
                self.ellipsoids(d, size);
                log2_sums_in(d, &self.ellipsoids, &places, logs);
            }
        }
    }

    fn owns(&mut self) {
        self.owns.clear();
        for block in self.ends.iter().take(self.count) {
            for lane in 0..WIDTH {
                if block.factor[lane] <= 0.0 {
                    continue;
                }
                let mut term = Own { constant: block.constant[lane], factor: block.factor[lane], ..Own::default() };
                for (axis, of) in block.axes.iter().enumerate() {
                    term.mean[axis] = of.mean[lane];
                    term.variance[axis] = of.variance[lane];
                    term.start_mean[axis] = of.start_mean[lane];
                    term.start_variance[axis] = of.start_variance[lane];
                }
                self.owns.push(term);
            }
        }
    }

    /// The terms as balls; false where they would cancel or are none.
    fn balls(&mut self, dimensions: usize, size: &[f64; MOST], origin: &[f64; AXES]) -> bool {
        let d = dimensions.min(AXES);
        self.balls.clear();
        if self.count == 0 || !self.round {
            return false;
        }
        for axis in 1..d {
            if size[axis] != size[0] {
                return false;
            }
        }
        let (half, own) = (Lanes::splat(HALF_LOG2_E), Lanes::splat(size[0]));
        let [mut curvature, mut constant, mut factors, mut bits] = [ZERO; 4];
        let mut slope = [ZERO; AXES];
        for block in self.ends.iter().take(self.count) {
            let v = Lanes::load(&block.axes[0].variance) + own;
            let u = Lanes::load(&block.axes[0].start_variance) + own;
            let over = Lanes::splat(1.0) / (v * u);
            let (over_v, over_u) = (over * u, over * v);
            let (mut squares, mut start_squares) = (Lanes::splat(0.0), Lanes::splat(0.0));
            for axis in 0..d {
                let p = Lanes::load(&block.axes[axis].mean) - Lanes::splat(origin[axis]);
                let g = Lanes::load(&block.axes[axis].start_mean) - Lanes::splat(origin[axis]);
                let (from_p, from_g) = (p * over_v, g * over_u);
                ((half + half) * (from_p - from_g)).store(&mut slope[axis]);
                squares = squares + p * from_p;
                start_squares = start_squares + g * from_g;
            }
            let ratio = u * over_v;
            let factor = match d {
                1 => ratio.sqrt(),
                2 => ratio,
                _ => ratio * ratio.sqrt(),
            };
            (half * (v - u) * over).store(&mut curvature);
            (Lanes::load(&block.constant) + half * (start_squares - squares)).store(&mut constant);
            (Lanes::load(&block.factor) * factor).store(&mut factors);
            (half * squares.at_least(start_squares)).store(&mut bits);
            for lane in 0..WIDTH {
                if factors[lane] <= 0.0 {
                    continue;
                }
                if bits[lane] > MOST_BITS {
                    return false;
                }
                self.balls.push(Ball {
                    curvature: curvature[lane],
                    slope: [slope[0][lane], slope[1][lane], slope[2][lane]],
                    constant: constant[lane],
                    factor: factors[lane],
                });
            }
        }
        true
    }

    /// The terms as ellipsoids; those of a coupled source are there already.
    fn ellipsoids(&mut self, dimensions: usize, size: &[f64; MOST]) {
        if self.count == 0 {
            return;
        }
        let d = dimensions.min(AXES);
        self.ellipsoids.clear();
        let half = Lanes::splat(HALF_LOG2_E);
        let [mut slope, mut curvature] = [[ZERO; AXES]; 2];
        let [mut constants, mut factors] = [ZERO; 2];
        for block in self.ends.iter().take(self.count) {
            let mut ratio = Lanes::splat(1.0);
            let mut constant = Lanes::load(&block.constant);
            for axis in 0..d {
                let of = &block.axes[axis];
                let v = Lanes::load(&of.variance) + Lanes::splat(size[axis]);
                let u = Lanes::load(&of.start_variance) + Lanes::splat(size[axis]);
                let over = Lanes::splat(1.0) / (v * u);
                let apart = Lanes::load(&of.mean) - Lanes::load(&of.start_mean);
                let lean = half * apart * (over * v);
                (lean + lean).store(&mut slope[axis]);
                (half * (v - u) * over).store(&mut curvature[axis]);
                constant = constant + lean * apart;
                ratio = ratio * (u * (over * u));
            }
            constant.store(&mut constants);
            (Lanes::load(&block.factor) * ratio.sqrt()).store(&mut factors);
            for lane in 0..WIDTH {
                if factors[lane] <= 0.0 {
                    continue;
                }
                let mut term = Ellipsoid { constant: constants[lane], factor: factors[lane], ..Ellipsoid::default() };
                for axis in 0..d {
                    term.center[axis] = block.axes[axis].mean[lane];
                    term.curvature[axis][axis] = curvature[axis][lane];
                    term.slope[axis] = slope[axis][lane];
                }
                self.ellipsoids.push(term);
            }
        }
    }
}

fn weigh_in<T: Term<1> + Term<2> + Term<3>>(
    dimensions: usize,
    terms: &[T],
    places: &Places<'_>,
    shift: f64,
    priors: &[Block],
    weights: &mut [Block],
) -> f64 {
    match dimensions {
        1 => weigh::<1, T>(terms, places, shift, priors, weights),
        2 => weigh::<2, T>(terms, places, shift, priors, weights),
        _ => weigh::<3, T>(terms, places, shift, priors, weights),
    }
}

fn log2_sums_in<T: Term<1> + Term<2> + Term<3>>(
    dimensions: usize,
    terms: &[T],
    places: &Places<'_>,
    logs: &mut [Block],
) {
    match dimensions {
        1 => log2_sums::<1, T>(terms, places, logs),
        2 => log2_sums::<2, T>(terms, places, logs),
        _ => log2_sums::<3, T>(terms, places, logs),
    }
}
