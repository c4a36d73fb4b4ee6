//! The endpoint of one axis given its filter, at each arrival node: one scalar Gaussian.
//!
//! Where the endpoint names more than the position (a velocity, an acceleration on arrival), the density of those is taken
//! first and the position is conditioned on them, so what is left is a scalar Gaussian of the position still. Four arrival
//! nodes are worked on at a time.

use super::separable::{AxisFilter, MOST};
use crate::model::motion::MotionModel;
use whither_kernel::mixture::HALF_LOG2_E;
use whither_kernel::vectors::{Block, Lanes, WIDTH};

/// What the endpoint of one axis is, apart from the position's mean and variance, which each destination has of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisEndpoint {
    /// How many components the endpoint names, from the position on; at least one.
    pub length: usize,
    /// Their means; that of the position is not read.
    pub mean: [f64; MOST],
    /// Their covariance; that of the position is zero.
    pub covariance: [[f64; MOST]; MOST],
    /// Whether it differs from that of the first axis in the means alone.
    pub alike: bool,
}

/// Transitions of one axis over the times to go of all nodes, four nodes in a block.
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

    /// Fills the table for endpoints of up to `length` components. Times that are not above zero are left out.
    pub fn fill(
        &mut self,
        model: &dyn MotionModel,
        axis: usize,
        length: usize,
        times: impl ExactSizeIterator<Item = f64>,
    ) {
        let count = times.len();
        for (node, time) in times.enumerate() {
            let Some(step) = model.axis(axis, time.max(0.0)) else { return };
            let stride = Self::stride(step.states, length);
            if node == 0 {
                (self.states, self.length) = (step.states, length);
                self.blocks.clear();
                self.blocks.resize(count.div_ceil(WIDTH) * stride, [0.0; WIDTH]);
            }
            let lane = node % WIDTH;
            let start = node / WIDTH * stride;
            let mut place = self.blocks[start..start + stride].iter_mut();
            let mut put = |x: f64| {
                if let Some(block) = place.next() {
                    block[lane] = x;
                }
            };
            for i in 0..length {
                step.transition[i][..step.states].iter().for_each(|&x| put(x));
                put(step.offset[i]);
                step.noise[i][..=i].iter().for_each(|&x| put(x));
            }
        }
    }

    /// For endpoints of how many components it was filled.
    pub const fn length(&self) -> usize {
        self.length
    }
}

/// A scalar Gaussian of the endpoint's position for four nodes, and the density of the rest of the endpoint.
#[derive(Clone, Copy, Debug)]
pub struct AxisPosition {
    /// The position's mean.
    pub mean: Lanes,
    /// Its variance, without the destination's own.
    pub variance: Lanes,
    /// The rest's density is the root of this ...
    pub density: Lanes,
    /// ... times two to this, and a constant.
    pub exponent: Lanes,
}

/// What the endpoints of one block of nodes have in common for all axes that are alike: the covariance, eliminated from its last
/// component to the second.
#[derive(Clone, Copy, Debug)]
pub struct EndpointCovariance {
    /// The rows below the diagonal, one after the other.
    gain: [Lanes; MOST * (MOST - 1) / 2],
    inverse: [Lanes; MOST],
    variance: Lanes,
    density: Lanes,
}

impl EndpointCovariance {
    /// One to be filled.
    pub fn empty() -> Self {
        let zero = Lanes::splat(0.0);
        Self { gain: [zero; MOST * (MOST - 1) / 2], inverse: [zero; MOST], variance: zero, density: zero }
    }

    /// For block `b` of a table, the covariance now and the endpoint.
    #[inline(never)]
    pub fn fill(&mut self, table: &NodeTable, b: usize, filter: &AxisFilter, endpoint: &AxisEndpoint) {
        let (zero, one) = (Lanes::splat(0.0), Lanes::splat(1.0));
        let (s, length) = (table.states, endpoint.length);
        let rows = &table.blocks[b * NodeTable::stride(s, table.length)..];
        let mut variance = Lanes::load(&rows[s + 1]);
        for m in 0..s {
            variance = variance + plus(zero, rows, &filter.covariance[m], s) * Lanes::load(&rows[m]);
        }
        (self.density, self.variance) = (one, variance);
        // as a rule destinations name the position alone
        if length == 1 {
            return;
        }
        let mut covariance = [[zero; MOST]; MOST];
        covariance[0][0] = variance;
        // where the rows before begin
        let mut places = [0; MOST];
        let mut place = s + 2;
        for i in 1..length {
            places[i] = place;
            for j in 0..i + 1 {
                covariance[i][j] = Lanes::load(&rows[place + s + 1 + j]) + Lanes::splat(endpoint.covariance[i][j]);
            }
            for m in 0..s {
                let product = plus(zero, &rows[place..], &filter.covariance[m], s);
                for j in 0..i + 1 {
                    covariance[i][j] = covariance[i][j] + product * Lanes::load(&rows[places[j] + m]);
                }
            }
            place += s + 2 + i;
        }
        for r in (1..length).rev() {
            let inverse = one / covariance[r][r];
            self.inverse[r] = inverse;
            self.density = self.density * inverse;
            for i in 0..r {
                let gain = covariance[r][i] * inverse;
                self.gain[r * (r - 1) / 2 + i] = gain;
                for j in 0..i + 1 {
                    covariance[i][j] = covariance[i][j] - gain * covariance[r][j];
                }
            }
        }
        self.variance = covariance[0][0];
    }

    /// The endpoint's position in an axis with this covariance.
    #[inline(never)]
    pub fn position(&self, table: &NodeTable, b: usize, filter: &AxisFilter, endpoint: &AxisEndpoint) -> AxisPosition {
        let (s, length) = (table.states, endpoint.length);
        let rows = &table.blocks[b * NodeTable::stride(s, table.length)..];
        let first = plus(Lanes::load(&rows[s]), rows, &filter.now, s);
        let mut exponent = Lanes::splat(0.0);
        if length == 1 {
            return AxisPosition { mean: first, variance: self.variance, density: self.density, exponent };
        }
        let mut mean = [first; MOST];
        let mut place = s + 2;
        for i in 1..length {
            mean[i] = plus(Lanes::load(&rows[place + s]), &rows[place..], &filter.now, s);
            place += s + 2 + i;
        }
        for r in (1..length).rev() {
            let error = Lanes::splat(endpoint.mean[r]) - mean[r];
            exponent = exponent - Lanes::splat(HALF_LOG2_E) * (error * error * self.inverse[r]);
            for i in 0..r {
                mean[i] = mean[i] + self.gain[r * (r - 1) / 2 + i] * error;
            }
        }
        AxisPosition { mean: mean[0], variance: self.variance, density: self.density, exponent }
    }
}

/// The first `s` entries of a row times as many numbers, added to `sum`.
#[inline(always)]
fn plus<const N: usize>(mut sum: Lanes, row: &[Block], numbers: &[f64; N], s: usize) -> Lanes {
    for j in 0..s {
        sum = sum + Lanes::load(&row[j]) * Lanes::splat(numbers[j]);
    }
    sum
}
