//! The endpoint of each axis given the states of all, at each arrival node: one scalar Gaussian.
//!
//! Where the endpoint names more than the position (a velocity, an acceleration on arrival), the density of those is taken
//! first and the position is conditioned on them, so what is left is a scalar Gaussian of the position still. Four arrival
//! nodes are worked on at a time, and axes that are alike have one covariance.

use crate::axes::{AxisTransition, MOST, States};
use crate::mixture::AXES;
use crate::small_gaussian::Matrix;
use crate::vectors::{Block, Lanes, WIDTH};

/// What the endpoint of one axis is, apart from the position's mean and variance, which each destination has of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisEndpoint {
    /// How many components the endpoint names, from the position on; at least one.
    pub length: usize,
    /// Their means; that of the position is not read.
    pub mean: [f64; MOST],
    /// Their covariance; that of the position is zero.
    pub covariance: Matrix<MOST>,
    /// Whether it differs from that of the first axis in the means alone.
    pub alike: bool,
}

/// Transitions of one axis over the times to go of all nodes, four nodes in a block.
///
/// Of each node, for each component `i` of the endpoint: row `i` of `F`, then `M_i`, then for each `j <= i` what makes up entry
/// `i, j` of the covariance, `Q_ij` and the factors of the entries of `P` up to the diagonal.
#[derive(Clone, Debug, Default)]
pub struct NodeTable {
    states: usize,
    length: usize,
    blocks: Vec<Block>,
}

/// Where entries up to the diagonal lie, row by row: one loop over them instead of two, whose lengths a compiler knows.
const ROW: [usize; triangle(MOST)] = [0, 1, 1, 2, 2, 2];
const COLUMN: [usize; triangle(MOST)] = [0, 0, 1, 0, 1, 2];

/// Entries up to the diagonal.
const fn triangle(n: usize) -> usize {
    n * (n + 1) / 2
}

/// Where the numbers of component `i` begin.
const fn offset(states: usize, i: usize) -> usize {
    i * (states + 1) + triangle(i) * (1 + triangle(states))
}

/// Numbers for each block of nodes.
const fn stride(states: usize, length: usize) -> usize {
    offset(states, length)
}

impl NodeTable {
    /// Fills the table for endpoints of up to `length` components, with the step of each of so many nodes; as far as there are
    /// steps.
    pub fn fill(&mut self, length: usize, count: usize, step: &dyn Fn(usize) -> Option<AxisTransition>) {
        for node in 0..count {
            let Some(AxisTransition { states, transition, offset, noise, .. }) = step(node) else { return };
            let stride = stride(states, length);
            if node == 0 {
                (self.states, self.length) = (states, length);
                self.blocks.clear();
                self.blocks.resize(count.div_ceil(WIDTH) * stride, [0.0; WIDTH]);
            }
            let lane = node % WIDTH;
            let start = node / WIDTH * stride;
            let mut place = self.blocks[start..start + stride].iter_mut();
            // and, until the next one comes, in all lanes after it: so no lane holds what is no node
            let mut put = |x: f64| {
                if let Some(block) = place.next() {
                    block[lane..].fill(x);
                }
            };
            for i in 0..length {
                transition[i][..states].iter().for_each(|&x| put(x));
                put(offset[i]);
                for j in 0..i + 1 {
                    put(noise[i][j]);
                    for m in 0..states {
                        for n in 0..m {
                            put(transition[i][m] * transition[j][n] + transition[i][n] * transition[j][m]);
                        }
                        put(transition[i][m] * transition[j][m]);
                    }
                }
            }
        }
    }

    /// The numbers of each block of nodes, for so many components of the endpoint.
    #[inline(always)]
    fn rows(&self, states: usize, length: usize) -> impl Iterator<Item = &[Block]> {
        // of known length, so that no index is checked
        let (used, each) = (stride(states, length), stride(states, self.length).max(1));
        self.blocks.chunks_exact(each).filter_map(move |rows| rows.get(..used))
    }

    /// For endpoints of how many components it was filled.
    #[must_use]
    pub const fn length(&self) -> usize {
        self.length
    }
}

/// Scalar Gaussians of the endpoint's position in each axis for four nodes, without the destination's own variance, and the
/// density of the rest of the endpoint.
#[derive(Clone, Copy, Debug)]
pub struct Position {
    /// The means.
    pub mean: [Block; AXES],
    /// The variances.
    pub variance: [Block; AXES],
    /// The rest's density is this, up to a constant ...
    pub root: Block,
    /// ... times `e` to minus half of this, its squared distance.
    pub square: Block,
}

impl Position {
    /// To be filled.
    pub const EMPTY: Self =
        Self { mean: [[0.0; WIDTH]; AXES], variance: [[0.0; WIDTH]; AXES], root: [0.0; WIDTH], square: [0.0; WIDTH] };
}

/// What the endpoints of one block of nodes have in common in all axes that differ in their means alone: the covariance, eliminated
/// from its last component to the second.
#[derive(Clone, Copy, Debug)]
pub struct Elimination {
    /// Row by row.
    gain: [Block; triangle(MOST)],
    inverse: [Block; MOST],
    /// Of the position, given the rest.
    variance: Block,
    /// The rest's density is the root of this, up to the power of its distance.
    density: Block,
}

impl Elimination {
    /// To be filled.
    pub const EMPTY: Self = Self {
        gain: [[0.0; WIDTH]; triangle(MOST)],
        inverse: [[0.0; WIDTH]; MOST],
        variance: [0.0; WIDTH],
        density: [0.0; WIDTH],
    };
}

/// A call with the numbers of components of the state and of the endpoint as constants, so that no loop over them is left.
macro_rules! with_constants {
    ($states:expr, $length:expr, |$s:ident, $l:ident| $call:expr) => {
        match ($states, $length) {
            (1, _) => with_constants!(1, 1, $s, $l, $call),
            (2, 1) => with_constants!(2, 1, $s, $l, $call),
            (2, _) => with_constants!(2, 2, $s, $l, $call),
            (_, 1) => with_constants!(3, 1, $s, $l, $call),
            (_, 2) => with_constants!(3, 2, $s, $l, $call),
            _ => with_constants!(3, 3, $s, $l, $call),
        }
    };
    ($states:literal, $length:literal, $s:ident, $l:ident, $call:expr) => {{
        const $s: usize = $states;
        const $l: usize = $length;
        $call
    }};
}

/// The positions at all nodes: `tables` holds the transitions from these states to them, that of the first axis where `same` has
/// it that an axis moves as that one; `alike` is which axes differ from the first one in their means alone. `room` is as long.
#[inline(never)]
pub fn predict(
    states: &States<'_>,
    (tables, same): (&[NodeTable; AXES], &[bool; AXES]),
    endpoints: &[AxisEndpoint; AXES],
    alike: &[bool; AXES],
    room: &mut [Elimination],
    into: &mut [Position],
) {
    let mut axis = 0;
    while axis < states.dimensions {
        let table = &tables[if same[axis] { 0 } else { axis }];
        let (components, length) = (table.states, endpoints[axis].length);
        // the one before may have left another covariance
        if axis == 0 || !(alike[axis] && alike[axis - 1]) {
            let (covariance, own) = (states.covariances[axis], &endpoints[axis].covariance);
            with_constants!(components, length, |S, L| eliminate(S, L, table, covariance, own, room));
        }
        // two axes that are alike share what is loaded
        let both = axis + 1 < states.dimensions && alike[axis] && alike[axis + 1];
        let from = Means { axis, states, endpoints };
        axis += match (components, length) {
            (2, 1) if both => from.positions::<2>(2, 1, table, room, into),
            (2, 2) if both => from.positions::<2>(2, 2, table, room, into),
            _ => with_constants!(components, length, |S, L| from.positions::<1>(S, L, table, room, into)),
        };
    }
}

/// What the positions in some axes, from `axis` on, depend on besides their covariance.
struct Means<'a> {
    axis: usize,
    states: &'a States<'a>,
    endpoints: &'a [AxisEndpoint; AXES],
}

impl Means<'_> {
    /// Writes the positions in `A` axes with this elimination, and returns `A`.
    #[inline(always)]
    fn positions<const A: usize>(
        &self,
        states: usize,
        length: usize,
        table: &NodeTable,
        room: &[Elimination],
        into: &mut [Position],
    ) -> usize {
        for ((rows, room), position) in table.rows(states, length).zip(room).zip(into) {
            let mut predicted = [[Lanes::splat(0.0); MOST]; A];
            for i in 0..length {
                let row = offset(states, i);
                for a in 0..A {
                    let mean = self.states.means[self.axis + a];
                    predicted[a][i] = Lanes::load(&rows[row + states]);
                    for j in 0..states {
                        predicted[a][i] = predicted[a][i] + Lanes::load(&rows[row + j]) * Lanes::splat(mean[j]);
                    }
                }
            }
            // of two axes that are alike the root of the density is that of one
            let density = Lanes::load(&room.density);
            let (mut root, mut square) = (if A == 2 { density } else { density.sqrt() }, Lanes::splat(0.0));
            if self.axis > 0 {
                root = root * Lanes::load(&position.root);
                square = Lanes::load(&position.square);
            }
            for r in (1..length).rev() {
                let mut sum = Lanes::splat(0.0);
                for a in 0..A {
                    let error = Lanes::splat(self.endpoints[self.axis + a].mean[r]) - predicted[a][r];
                    sum = if a == 0 { error * error } else { sum + error * error };
                    for i in 0..r {
                        predicted[a][i] = predicted[a][i] + Lanes::load(&room.gain[triangle(r) + i]) * error;
                    }
                }
                square = square + sum * Lanes::load(&room.inverse[r]);
            }
            root.store(&mut position.root);
            square.store(&mut position.square);
            for a in 0..A {
                predicted[a][0].store(&mut position.mean[self.axis + a]);
                position.variance[self.axis + a] = room.variance;
            }
        }
        A
    }
}

/// The covariances at all nodes, eliminated.
#[inline(always)]
fn eliminate(
    states: usize,
    length: usize,
    table: &NodeTable,
    before: &Matrix<MOST>,
    own: &Matrix<MOST>,
    into: &mut [Elimination],
) {
    let (zero, one) = (Lanes::splat(0.0), Lanes::splat(1.0));
    for (rows, into) in table.rows(states, length).zip(into) {
        let mut covariance = [zero; triangle(MOST)];
        for entry in 0..triangle(length) {
            let (i, j) = (ROW[entry], COLUMN[entry]);
            let place = offset(states, i) + states + 1 + j * (1 + triangle(states));
            let mut sum = Lanes::load(&rows[place]) + Lanes::splat(own[i][j]);
            for of in 0..triangle(states) {
                sum = sum + Lanes::load(&rows[place + 1 + of]) * Lanes::splat(before[ROW[of]][COLUMN[of]]);
            }
            covariance[entry] = sum;
        }
        let mut density = one;
        for r in (1..length).rev() {
            let row = triangle(r);
            let inverse = one / covariance[row + r];
            density = density * inverse;
            inverse.store(&mut into.inverse[r]);
            let mut gain = [zero; MOST];
            for i in 0..r {
                gain[i] = covariance[row + i] * inverse;
                gain[i].store(&mut into.gain[row + i]);
            }
            for entry in 0..row {
                let (i, j) = (ROW[entry], COLUMN[entry]);
                covariance[entry] = covariance[entry] - gain[i] * covariance[row + j];
            }
        }
        covariance[0].store(&mut into.variance);
        density.store(&mut into.density);
    }
}
