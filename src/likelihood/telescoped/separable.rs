//! Models whose axes do not mix: each axis is a small filter of its own, and its endpoint one scalar Gaussian.
//!
//! Where the endpoint names more than the position (a velocity, an acceleration on arrival), the density of those is taken
//! first and the position is conditioned on them, so what is left is a scalar Gaussian of the position still. Eight arrival
//! nodes are worked on at a time. Axes that are alike (one noise, one history of observation noise) share all that does not
//! depend on a mean.
//!
//! The loops are plain: built for size, closures and iterators would be calls.
#![allow(clippy::needless_range_loop, reason = "rows and columns of matrices read best by their indices")]

use crate::math::gaussian::VANISHING;
use crate::math::lanes::{Block, Lanes, WIDTH};
use crate::math::mixture::HALF_LOG2_E;
use crate::model::motion::{AxisTransition, MotionModel};

/// The most components of one axis: position, velocity, acceleration.
pub const MOST: usize = 3;

/// A matrix over the components of an axis.
pub type Matrix = [[f64; MOST]; MOST];

/// A Gaussian over the components of one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisState {
    /// The mean.
    pub mean: [f64; MOST],
    /// The covariance, symmetric.
    pub covariance: Matrix,
}

const PAIR: usize = 2 * MOST;

/// What one observation of one axis does: the gains for the state now and for the first one, and the prediction error's
/// variance.
#[derive(Clone, Copy, Debug)]
struct Correction {
    gain: [f64; MOST],
    first_gain: [f64; MOST],
    spread: f64,
}

/// The Kalman posterior of one axis over the pair (first observation, now), Liang (8) and the usual correction. The first
/// state rides along, and what is kept is a root of the covariance, as in [`crate::math::kalman`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisFilter {
    /// How many components the axis has.
    pub states: usize,
    /// The state now; its covariance is that of the root.
    pub now: AxisState,
    /// The first state, smoothed.
    pub first_mean: [f64; MOST],
    /// Lower triangular `L`, first the rows of the first state, then those of the state now: the covariance is `L L'`.
    pub root: [[f64; PAIR]; PAIR],
}

impl AxisState {
    /// Liang (8) for the mean.
    pub fn predict_mean(&mut self, step: &AxisTransition) {
        let (s, before) = (step.states.min(MOST), self.mean);
        for i in 0..s {
            let mut sum = step.offset[i];
            for j in 0..s {
                sum += step.transition[i][j] * before[j];
            }
            self.mean[i] = sum;
        }
    }

    /// Liang (8) for the covariance.
    pub fn predict_covariance(&mut self, step: &AxisTransition) {
        let (s, f, before) = (step.states.min(MOST), &step.transition, self.covariance);
        for i in 0..s {
            let product = row_times(&f[i], &before, s);
            for j in 0..i + 1 {
                let mut sum = step.noise[i][j];
                for m in 0..s {
                    sum += product[m] * f[j][m];
                }
                self.covariance[i][j] = sum;
                self.covariance[j][i] = sum;
            }
        }
    }

    fn same_covariance(&self, other: &Self) -> bool {
        let (a, b) = (&self.covariance, &other.covariance);
        let same = |i: usize, j: usize| a[i][j] == b[i][j];
        same(0, 0) && same(1, 0) && same(1, 1) && same(2, 0) && same(2, 1) && same(2, 2)
    }
}

/// A row times a symmetric matrix.
fn row_times(row: &[f64; MOST], matrix: &Matrix, s: usize) -> [f64; MOST] {
    let mut product = [0.0; MOST];
    for m in 0..s.min(MOST) {
        for j in 0..s.min(MOST) {
            product[m] += row[j] * matrix[m][j];
        }
    }
    product
}

impl AxisFilter {
    fn predict_covariances(&mut self, step: &AxisTransition) {
        let (s, before) = (self.states.min(MOST), self.root);
        let noise = root(&step.noise, s);
        // what the state now has of its own, and the noise beside it
        let mut own = [[0.0; PAIR]; MOST];
        for i in 0..s {
            for q in 0..2 * s {
                let mut moved = 0.0;
                for m in 0..s {
                    moved += step.transition[i][m] * before[s + m][q];
                }
                if q < s {
                    self.root[s + i][q] = moved;
                } else {
                    own[i][q - s] = moved;
                }
            }
            for q in 0..s {
                own[i][s + q] = noise[i][q];
            }
        }
        triangularise(&mut own, s);
        for i in 0..s {
            for q in 0..s {
                self.root[s + i][s + q] = own[i][q];
            }
        }
    }

    /// A rotation for each column, from the position's own to the first, turns `[R^1/2, H L]` into `[S^1/2, 0]`; it turns the
    /// rows of `[0, L]` into those of `[K S^1/2, L+]` and leaves `L` triangular.
    fn correct_covariances(&mut self, variance: f64) -> Correction {
        let s = self.states.min(MOST);
        let mut deviation = variance.sqrt();
        let mut leaning = [0.0; PAIR];
        for q in (0..s + 1).rev() {
            let known = self.root[s][q];
            let total = (deviation * deviation + known * known).sqrt();
            let (cosine, sine) = (deviation / total, known / total);
            for p in q..2 * s {
                let (entry, lean) = (self.root[p][q], leaning[p]);
                self.root[p][q] = cosine * entry - sine * lean;
                leaning[p] = sine * entry + cosine * lean;
            }
            deviation = total;
        }
        let mut correction = Correction { gain: [0.0; MOST], first_gain: [0.0; MOST], spread: deviation * deviation };
        for i in 0..s {
            correction.gain[i] = leaning[s + i] / deviation;
            correction.first_gain[i] = leaning[i] / deviation;
        }
        correction
    }

    fn correct_means(&mut self, correction: &Correction, position: f64) -> f64 {
        let error = position - self.now.mean[0];
        for i in 0..self.states.min(MOST) {
            self.now.mean[i] += correction.gain[i] * error;
            self.first_mean[i] += correction.first_gain[i] * error;
        }
        error
    }

    /// The covariance of the state now, from the root.
    pub fn square(&mut self) {
        let s = self.states.min(MOST);
        for i in 0..s {
            for j in 0..i + 1 {
                let mut sum = 0.0;
                for q in 0..s + j + 1 {
                    sum += self.root[s + i][q] * self.root[s + j][q];
                }
                self.now.covariance[i][j] = sum;
                self.now.covariance[j][i] = sum;
            }
        }
    }

    fn share_covariances(&mut self, other: &Self) {
        self.now.covariance = other.now.covariance;
        self.root = other.root;
    }
}

/// A root of a positive semi-definite matrix, lower triangular.
fn root(p: &Matrix, s: usize) -> Matrix {
    let mut root = [[0.0; MOST]; MOST];
    for j in 0..s.min(MOST) {
        for i in j..s.min(MOST) {
            let mut left = p[i][j];
            for q in 0..j {
                left -= root[i][q] * root[j][q];
            }
            if i > j {
                root[i][j] = if root[j][j] > 0.0 { left / root[j][j] } else { 0.0 };
            } else if left > 4.0 * f64::EPSILON * p[j][j] {
                root[j][j] = left.sqrt();
            }
        }
    }
    root
}

/// As [`crate::math::gaussian::triangularise`], for `s` rows of `2 s`.
fn triangularise(rows: &mut [[f64; PAIR]; MOST], s: usize) {
    let s = s.min(MOST);
    for i in 0..s {
        let reflector = rows[i];
        let mut square = 0.0;
        for j in i..2 * s {
            square += reflector[j] * reflector[j];
            rows[i][j] = 0.0;
        }
        let (norm, pivot) = (square.sqrt(), reflector[i]);
        if norm < VANISHING {
            continue;
        }
        rows[i][i] = norm;
        let sign = if pivot > 0.0 { -1.0 } else { 1.0 };
        let first = pivot - sign * norm;
        let scale = 1.0 / (norm * (norm + pivot.abs()));
        for r in i + 1..s {
            let mut dot = rows[r][i] * first;
            for j in i + 1..2 * s {
                dot += rows[r][j] * reflector[j];
            }
            dot *= scale;
            rows[r][i] = (rows[r][i] - dot * first) * sign;
            for j in i + 1..2 * s {
                rows[r][j] -= dot * reflector[j];
            }
        }
    }
}

/// The filters of all axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// How many axes there are.
    pub dimensions: usize,
    /// Whether an axis moves as the first one does, offset included.
    pub alike: [bool; MOST],
    /// `p(x_1 | y_1)` in each axis.
    pub start: [AxisState; MOST],
    /// A filter for each axis, and unused ones up to `MOST`.
    pub filters: [AxisFilter; MOST],
    /// `ln p(y_2:k | y_1)`.
    pub log_evidence: f64,
}

impl Axes {
    /// Filters for a model, none where its axes mix. Means and covariances are zero.
    pub fn new(model: &dyn MotionModel) -> Option<Self> {
        let dimensions = model.dimensions();
        let mut axes = Self {
            dimensions,
            alike: [true; MOST],
            start: [AxisState::default(); MOST],
            filters: [AxisFilter::default(); MOST],
            log_evidence: 0.0,
        };
        for axis in 0..dimensions {
            axes.filters.get_mut(axis)?.states = model.axis(axis, 0.0)?.states;
            // a linear, time-invariant model that is the same over two steps is the same over all
            axes.alike[axis] = [0.37, 1.0].iter().all(|&step| model.axis(axis, step) == model.axis(0, step));
        }
        Some(axes)
    }

    /// One observation, `step` seconds after the last: positions where observed, and their variances.
    pub fn advance(&mut self, model: &dyn MotionModel, step: f64, position: &[Option<f64>], variance: &[f64; MOST]) {
        let Some(leading) = model.axis(0, step) else { return };
        let (mut squares, mut spreads) = (0.0, 1.0);
        let before = self.filters[0].root;
        let mut first: Option<Correction> = None;
        for axis in 0..self.dimensions.min(MOST) {
            let observed = position.get(axis).copied().flatten();
            let (done, rest) = self.filters.split_at_mut(axis);
            let Some(filter) = rest.first_mut() else { return };
            // an axis that is as the first one in all but its mean takes everything else from there
            let twin = match done.first() {
                Some(other)
                    if self.alike[axis]
                        && observed.is_some() == first.is_some()
                        && variance[axis] == variance[0]
                        && filter.root == before =>
                {
                    Some(other)
                }
                _ => None,
            };
            let correction = if let Some(other) = twin {
                filter.now.predict_mean(&leading);
                filter.share_covariances(other);
                first
            } else {
                let own;
                let transition = if self.alike[axis] {
                    &leading
                } else {
                    own = model.axis(axis, step).unwrap_or_default();
                    &own
                };
                filter.now.predict_mean(transition);
                filter.predict_covariances(transition);
                let correction = observed.map(|_| filter.correct_covariances(variance[axis]));
                filter.square();
                correction
            };
            if let (Some(y), Some(correction)) = (observed, &correction) {
                let error = filter.correct_means(correction, y);
                squares += error * error / correction.spread;
                spreads *= std::f64::consts::TAU * correction.spread;
            }
            if axis == 0 {
                first = correction;
            }
        }
        self.log_evidence -= 0.5 * (squares + spreads.ln());
    }

    /// What the first observation says of the state `elapsed` after it.
    pub fn foresee(&self, model: &dyn MotionModel, elapsed: f64) -> [AxisState; MOST] {
        let mut states = self.start;
        let Some(leading) = model.axis(0, elapsed) else { return states };
        for axis in 0..self.dimensions.min(MOST) {
            let (done, rest) = states.split_at_mut(axis);
            let Some(state) = rest.first_mut() else { break };
            let own;
            let transition = if self.alike[axis] {
                &leading
            } else {
                own = model.axis(axis, elapsed).unwrap_or_default();
                &own
            };
            state.predict_mean(transition);
            match done.first() {
                Some(other) if self.alike[axis] && self.start[axis].same_covariance(&self.start[0]) => {
                    state.covariance = other.covariance;
                }
                _ => state.predict_covariance(transition),
            }
        }
        states
    }

    /// Whether an axis can share with the first one all that does not depend on a mean.
    pub fn shares(&self, axis: usize) -> bool {
        self.alike[axis]
            && self.filters[axis].now.same_covariance(&self.filters[0].now)
            && self.start[axis].same_covariance(&self.start[0])
    }
}

/// What the endpoint of one axis is, apart from the position's mean and variance, which each destination has of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisEnd {
    /// How many components the endpoint names, from the position on; at least one.
    pub length: usize,
    /// Their means; that of the position is not read.
    pub mean: [f64; MOST],
    /// Their covariance; that of the position is zero.
    pub covariance: Matrix,
}

/// Transitions of one axis over the times to go of all nodes, eight nodes in a block.
#[derive(Clone, Debug, Default)]
pub struct NodeTable {
    states: usize,
    length: usize,
    blocks: Vec<Block>,
}

impl NodeTable {
    /// Numbers for each block of nodes and each row: `F`, `M`, and `Q` up to the diagonal.
    const fn stride(states: usize, length: usize) -> usize {
        length * (states + 1) + length * (length + 1) / 2
    }

    /// Fills the table for endpoints of up to `length` components, with the nodes' times less `passed`; nodes that have
    /// passed are as those that are reached now.
    pub fn fill(&mut self, model: &dyn MotionModel, axis: usize, length: usize, times: &[f64], passed: f64) {
        for (node, time) in times.iter().enumerate() {
            let Some(step) = model.axis(axis, (time - passed).max(0.0)) else { return };
            let stride = Self::stride(step.states, length);
            if node == 0 {
                (self.states, self.length) = (step.states, length);
                self.blocks.clear();
                self.blocks.resize(times.len().div_ceil(WIDTH) * stride, [0.0; WIDTH]);
            }
            let (block, lane) = (node / WIDTH, node % WIDTH);
            let Some(rows) = self.blocks.get_mut(block * stride..(block + 1) * stride) else { return };
            let mut place = 0;
            for i in 0..length.min(MOST) {
                for j in 0..step.states.min(MOST) {
                    rows[place][lane] = step.transition[i][j];
                    place += 1;
                }
                rows[place][lane] = step.offset[i];
                place += 1;
                for j in 0..i + 1 {
                    rows[place][lane] = step.noise[i][j];
                    place += 1;
                }
            }
        }
    }

    /// For endpoints of how many components it was filled.
    pub const fn length(&self) -> usize {
        self.length
    }

    /// The rows of block `b`.
    pub fn rows(&self, b: usize) -> Rows<'_> {
        let stride = Self::stride(self.states, self.length);
        Rows { states: self.states.min(MOST), rows: self.blocks.get(b * stride..).unwrap_or(&[]) }
    }
}

/// One block of nodes of a [`NodeTable`].
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a> {
    states: usize,
    rows: &'a [Block],
}

/// The endpoint of an axis for eight nodes: a Gaussian of the position, and the density of the rest.
#[derive(Clone, Copy, Debug)]
pub struct Ends {
    /// The position's mean, given the rest.
    pub mean: Lanes,
    /// Its variance, without the destination's own.
    pub variance: Lanes,
    /// The root of this is a factor of the rest's density; one where there is no rest.
    pub density: Lanes,
    /// What the rest adds to the exponent.
    pub exponent: Lanes,
}

impl Rows<'_> {
    #[inline(always)]
    fn at(&self, place: usize) -> Lanes {
        self.rows.get(place).map_or(Lanes::splat(0.0), Lanes::load)
    }

    /// Where the row of component `i` begins: each is longer by one than the one before.
    const fn start(&self, i: usize) -> usize {
        i * (self.states + 1) + i * (i + 1) / 2
    }

    /// Entry `(i, j)`, `j <= i`, of the predicted covariance, without the endpoint's own.
    #[inline(always)]
    fn covariance(&self, i: usize, j: usize, state: &AxisState) -> Lanes {
        let (row, other) = (self.start(i), self.start(j));
        let mut sum = self.at(row + self.states + 1 + j);
        for m in 0..self.states {
            let mut product = Lanes::splat(0.0);
            for k in 0..self.states {
                product = product + self.at(row + k) * Lanes::splat(state.covariance[m][k]);
            }
            sum = sum + product * self.at(other + m);
        }
        sum
    }

    /// The predicted mean of component `i`.
    #[inline(always)]
    fn mean(&self, i: usize, state: &AxisState) -> Lanes {
        let row = self.start(i);
        let mut sum = self.at(row + self.states);
        for k in 0..self.states {
            sum = sum + self.at(row + k) * Lanes::splat(state.mean[k]);
        }
        sum
    }

    /// The position's mean.
    #[inline(never)]
    pub fn position(&self, state: &AxisState) -> Lanes {
        self.mean(0, state)
    }

    /// The position's variance.
    #[inline(never)]
    pub fn variance(&self, state: &AxisState) -> Lanes {
        self.covariance(0, 0, state)
    }

    /// The ends where the endpoint names more than the position: the rest is eliminated from its last component to its first.
    #[inline(never)]
    pub fn ends(&self, state: &AxisState, end: &AxisEnd) -> Ends {
        let (zero, length) = (Lanes::splat(0.0), end.length.min(MOST));
        let mut covariance = [[zero; MOST]; MOST];
        let mut mean = [zero; MOST];
        for i in 0..length {
            mean[i] = self.mean(i, state);
            for j in 0..i + 1 {
                covariance[i][j] = self.covariance(i, j, state) + Lanes::splat(end.covariance[i][j]);
            }
        }
        let (mut density, mut exponent) = (Lanes::splat(1.0), zero);
        for r in (1..length).rev() {
            let inverse = Lanes::splat(1.0) / covariance[r][r];
            let error = Lanes::splat(end.mean[r]) - mean[r];
            density = density * inverse;
            exponent = exponent - Lanes::splat(HALF_LOG2_E) * (error * error * inverse);
            for i in 0..r {
                let gain = covariance[r][i] * inverse;
                mean[i] = mean[i] + gain * error;
                for j in 0..i + 1 {
                    covariance[i][j] = covariance[i][j] - gain * covariance[r][j];
                }
            }
        }
        Ends { mean: mean[0], variance: covariance[0][0], density, exponent }
    }
}
