//! The ratios of two densities: from the endpoint predicted from now and from the start to the terms of [`crate::mixture`].
//!
//! With `d = a - m`, `v = V + S`, `u = U + S` for one axis,
//!
//! ```text
//! ln N(a; m, v) / N(a; u_n, u) = -(1/v - 1/u) d^2 / 2 + d (m - u_n) / u + (m - u_n)^2 / 2u + ln(u / v) / 2
//! ```
//!
//! and the factor `sqrt(u / v)` stays a factor, so no logarithm is taken.

use crate::axes::{MOST, States};
use crate::endpoints::{AxisEndpoint, Elimination, NodeTable, Position, predict};
use crate::mixture::{AXES, Ball, Ellipsoid, HALF_LOG2_E, Own};
use crate::vectors::{Block, Lanes, WIDTH};

/// Where the mean of a node is further from the origin than this many bits of its density, the terms of a [`Ball`] cancel
/// too much, and the [`Ellipsoid`] is taken.
const MOST_BITS: f64 = 256.0;

/// What a source gives for one noise candidate.
#[derive(Clone, Copy, Debug)]
pub struct Prediction<'a> {
    /// The states now.
    pub now: States<'a>,
    /// The prediction from the start of the states at `start_tables`' origin.
    pub start: States<'a>,
    /// Transitions to the nodes from now, for each axis.
    pub tables: &'a [NodeTable; AXES],
    /// Transitions to the nodes from where `start` is.
    pub start_tables: &'a [NodeTable; AXES],
    /// Whether an axis has the transitions of the first one.
    pub same: &'a [bool; AXES],
    /// The endpoint of each axis.
    pub endpoints: &'a [AxisEndpoint; AXES],
    /// Prior probabilities of the nodes; zero for those that have passed.
    pub weights: &'a [Block],
    /// `w_c` of this candidate.
    pub weight: f64,
    /// What this candidate's exponents have over those of the first one.
    pub lead: f64,
}

/// The endpoint's position from now and from the start at all nodes, four in a block, candidate after candidate.
#[derive(Clone, Debug, Default)]
pub struct Ratios {
    now: Vec<Position>,
    start: Vec<Position>,
    /// The node's weight times what the rest of the endpoint gives; zero for nodes that have passed.
    factors: Vec<Block>,
    /// What is added to the exponents.
    constants: Vec<Block>,
    /// What `predict` needs.
    room: Vec<Elimination>,
    /// How many blocks are in use: what is beyond them is room.
    used: usize,
    /// Whether the axes of all have one variance.
    round: bool,
}

/// One lane of each axis.
#[inline(always)]
fn at(blocks: &[Block; AXES], lane: usize) -> [f64; AXES] {
    [blocks[0][lane], blocks[1][lane], blocks[2][lane]]
}

impl Ratios {
    /// Removes all.
    pub fn clear(&mut self) {
        self.used = 0;
        self.round = true;
    }

    /// Whether there are any.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.used == 0
    }

    /// Adds those of one noise candidate.
    #[inline(never)]
    pub fn add(&mut self, prediction: &Prediction<'_>) {
        let Prediction { now, start, same, endpoints, .. } = prediction;
        let mut alike = [true; AXES];
        for axis in 1..now.dimensions {
            alike[axis] = now.twins[axis] && start.twins[axis] && endpoints[axis].alike;
            self.round &= alike[axis];
        }
        let all = self.used..self.used + prediction.weights.len();
        if self.now.len() < all.end {
            for list in [&mut self.now, &mut self.start] {
                list.resize(all.end, Position::EMPTY);
            }
            for list in [&mut self.factors, &mut self.constants] {
                list.resize(all.end, [0.0; WIDTH]);
            }
        }
        self.used = all.end;
        if self.room.len() < prediction.weights.len() {
            self.room.resize(prediction.weights.len(), Elimination::EMPTY);
        }
        predict(now, (prediction.tables, same), endpoints, &alike, &mut self.room, &mut self.now[all.clone()]);
        predict(
            start,
            (prediction.start_tables, same),
            endpoints,
            &alike,
            &mut self.room,
            &mut self.start[all.clone()],
        );
        let (weight, lead) = (Lanes::splat(prediction.weight), Lanes::splat(prediction.lead));
        let half = Lanes::splat(HALF_LOG2_E);
        let positions = self.now[all.clone()].iter().zip(&self.start[all.clone()]);
        let places = self.factors[all.clone()].iter_mut().zip(&mut self.constants[all]);
        for (((now, start), (factor, constant)), weights) in positions.zip(places).zip(prediction.weights) {
            (weight * Lanes::load(weights) * Lanes::load(&now.root) / Lanes::load(&start.root)).store(factor);
            (lead + half * (Lanes::load(&start.square) - Lanes::load(&now.square))).store(constant);
        }
    }

    /// What is in use, block by block.
    #[inline(always)]
    fn blocks(&self) -> impl Iterator<Item = (&Position, &Position, &Block, &Block)> {
        let Self { now, start, factors, constants, used, .. } = self;
        let positions = now.iter().zip(start).take(*used);
        positions
            .zip(factors.iter().zip(constants))
            .map(|((now, start), (factor, constant))| (now, start, factor, constant))
    }

    /// The terms as balls about `origin`, for places with variances `size`; false where they would cancel, not in the plane, or
    /// where there are none.
    #[inline(never)]
    pub fn balls(&self, dimensions: usize, size: &[f64; MOST], origin: &[f64; AXES], into: &mut Vec<Ball>) -> bool {
        if dimensions != 2 || self.is_empty() || !self.round || size[..dimensions].iter().any(|s| *s != size[0]) {
            return false;
        }
        let (half, one, size) = (Lanes::splat(HALF_LOG2_E), Lanes::splat(1.0), Lanes::splat(size[0]));
        let (mut most, mut count) = (Lanes::splat(0.0), 0);
        into.resize(WIDTH * self.used, Ball::default());
        for (now, start, factor, constant) in self.blocks() {
            let v = Lanes::load(&now.variance[0]) + size;
            let u = Lanes::load(&start.variance[0]) + size;
            // one division for both
            let over = one / (v * u);
            let (over_v, over_u) = (u * over, v * over);
            let mut slope = [[0.0; WIDTH]; AXES];
            let (mut squares, mut start_squares) = (Lanes::splat(0.0), Lanes::splat(0.0));
            for axis in 0..2 {
                let p = Lanes::load(&now.mean[axis]) - Lanes::splat(origin[axis]);
                let g = Lanes::load(&start.mean[axis]) - Lanes::splat(origin[axis]);
                let (from_p, from_g) = (p * over_v, g * over_u);
                ((half + half) * (from_p - from_g)).store(&mut slope[axis]);
                squares = squares + p * from_p;
                start_squares = start_squares + g * from_g;
            }
            let ratio = u * over_v;
            let [mut curvature, mut constants, mut factors] = [[0.0; WIDTH]; 3];
            (half * (v - u) * over).store(&mut curvature);
            (Lanes::load(constant) + half * (start_squares - squares)).store(&mut constants);
            (Lanes::load(factor) * ratio).store(&mut factors);
            most = squares.at_least(start_squares).at_least(most);
            // a term without a factor is written over by the next one
            for lane in 0..WIDTH {
                let Some(term) = into.get_mut(count) else { break };
                *term = Ball {
                    curvature: curvature[lane],
                    slope: at(&slope, lane),
                    constant: constants[lane],
                    factor: factors[lane],
                };
                count += usize::from(factor[lane] > 0.0);
            }
        }
        into.truncate(count);
        HALF_LOG2_E * most.most() <= MOST_BITS
    }

    /// The terms as ellipsoids, for places with variances `size`.
    #[inline(never)]
    pub fn ellipsoids(&self, dimensions: usize, size: &[f64; MOST], into: &mut Vec<Ellipsoid>) {
        into.clear();
        let half = Lanes::splat(HALF_LOG2_E);
        for (now, start, factor, constant) in self.blocks() {
            let [mut slope, mut curvature] = [[[0.0; WIDTH]; AXES]; 2];
            let mut ratio = Lanes::splat(1.0);
            let mut sum = Lanes::load(constant);
            for axis in 0..dimensions {
                let v = Lanes::load(&now.variance[axis]) + Lanes::splat(size[axis]);
                let u = Lanes::load(&start.variance[axis]) + Lanes::splat(size[axis]);
                let (over_v, over_u) = (Lanes::splat(1.0) / v, Lanes::splat(1.0) / u);
                let apart = Lanes::load(&now.mean[axis]) - Lanes::load(&start.mean[axis]);
                let lean = half * apart * over_u;
                (lean + lean).store(&mut slope[axis]);
                (half * (v - u) * over_v * over_u).store(&mut curvature[axis]);
                sum = sum + lean * apart;
                ratio = ratio * (u * over_v);
            }
            let [mut constants, mut factors] = [[0.0; WIDTH]; 2];
            sum.store(&mut constants);
            (Lanes::load(factor) * ratio.sqrt()).store(&mut factors);
            for lane in 0..WIDTH {
                if factor[lane] > 0.0 {
                    let [xx, yy, zz] = at(&curvature, lane);
                    into.push(Ellipsoid {
                        center: at(&now.mean, lane),
                        curvature: [[xx, 0.0, 0.0], [0.0, yy, 0.0], [0.0, 0.0, zz]],
                        slope: at(&slope, lane),
                        constant: constants[lane],
                        factor: factors[lane],
                    });
                }
            }
        }
    }

    /// The terms for places each of which has its own variances.
    #[inline(never)]
    pub fn owns(&self, into: &mut Vec<Own>) {
        into.clear();
        for (now, start, factor, constant) in self.blocks() {
            for lane in 0..WIDTH {
                if factor[lane] > 0.0 {
                    into.push(Own {
                        mean: at(&now.mean, lane),
                        variance: at(&now.variance, lane),
                        start_mean: at(&start.mean, lane),
                        start_variance: at(&start.variance, lane),
                        constant: constant[lane],
                        factor: factor[lane],
                    });
                }
            }
        }
    }
}
