//! The coefficients: from the endpoint predicted from now and from the start to the terms of [`whither_kernel::mixture`].
//!
//! With `d = a - m`, `v = V + S`, `u = U + S` for one axis,
//!
//! ```text
//! ln N(a; m, v) / N(a; u_n, u) = -(1/v - 1/u) d^2 / 2 + d (m - u_n) / u + (m - u_n)^2 / 2u + ln(u / v) / 2
//! ```
//!
//! and the factor `sqrt(u / v)` stays a factor, so no logarithm is taken.

use super::axis_endpoint::{AxisEndpoint, EndpointCovariance, NodeTable};
use super::classes::{Class, Classes};
use super::pruning::Bounds;
use super::separable::{Axes, MOST};
use std::ops::Range;
use whither_kernel::mixture::{AXES, Ball, Ellipsoid, HALF_LOG2_E, Own, Sums};
use whither_kernel::vectors::{Block, Lanes, WIDTH};

/// Where the mean of a node is further from the origin than this many bits of its density, the terms of a [`Ball`] cancel
/// too much, and the [`Ellipsoid`] is taken.
const MOST_BITS: f64 = 256.0;

/// The endpoint's position for four nodes, predicted from now and from the start, without its own variance.
#[derive(Clone, Copy, Debug)]
struct EndpointBlock {
    mean: [Block; AXES],
    variance: [Block; AXES],
    start_mean: [Block; AXES],
    start_variance: [Block; AXES],
    /// The node's weight times what the rest of the endpoint gives; zero for nodes that have passed.
    factor: Block,
    /// What is added to the exponent.
    constant: Block,
}

const ZERO: Block = [0.0; WIDTH];

const EMPTY: EndpointBlock = EndpointBlock {
    mean: [ZERO; AXES],
    variance: [ZERO; AXES],
    start_mean: [ZERO; AXES],
    start_variance: [ZERO; AXES],
    factor: ZERO,
    constant: ZERO,
};

/// One lane of each axis. The maps of arrays stay calls for each element at the level for size, and so do closures.
#[inline(always)]
fn at(blocks: &[Block; AXES], lane: usize) -> [f64; AXES] {
    [blocks[0][lane], blocks[1][lane], blocks[2][lane]]
}

/// Room that is kept from step to step; what is in it is no part of any state.
#[derive(Clone, Debug, Default)]
pub struct Work {
    endpoints: Vec<EndpointBlock>,
    /// Whether the axes of all endpoints have one variance.
    round: bool,
    /// Coupled sources put their terms here.
    pub ellipsoids: Vec<Ellipsoid>,
    balls: Vec<Ball>,
    owns: Vec<Own>,
    bounds: Bounds,
}

/// What a separable source gives for one noise candidate.
#[derive(Clone, Copy, Debug)]
pub struct Prediction<'a> {
    /// The filters now.
    pub now: &'a Axes,
    /// The prediction from the start of the state at `start_tables`' origin.
    pub start: &'a Axes,
    /// Transitions to the nodes from now, for each axis.
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
    /// Removes the endpoints and terms of another class.
    pub fn clear(&mut self) {
        self.endpoints.clear();
        self.ellipsoids.clear();
        self.round = true;
    }

    /// Adds the endpoints of one noise candidate.
    #[inline(never)]
    pub fn add_endpoints(&mut self, prediction: &Prediction<'_>, axes: &[AxisEndpoint; MOST]) {
        let (now, start) = (prediction.now, prediction.start);
        let mut alike = [true; MOST];
        for k in 1..now.filters.dimensions() {
            alike[k] = now.filters.is_twin(k) && start.filters.is_twin(k) && axes[k].alike;
            self.round &= alike[k];
        }
        let [mut first, mut first_start, mut own, mut own_start] = [EndpointCovariance::empty(); 4];
        for (b, weights) in prediction.weights.iter().enumerate() {
            self.endpoints.push(EMPTY);
            let Some(endpoints) = self.endpoints.last_mut() else { return };
            let mut exponent = Lanes::splat(prediction.lead);
            let mut density = Lanes::splat(1.0);
            let mut start_density = Lanes::splat(1.0);
            for axis in 0..now.filters.dimensions() {
                let of = if now.alike[axis] { 0 } else { axis };
                let (table, start_table) = (&prediction.tables[of], &prediction.start_tables[of]);
                let (filter, start_filter, endpoint) = (&now.filters[axis], &start.filters[axis], &axes[axis]);
                let (covariance, start_covariance) =
                    if alike[axis] { (&mut first, &mut first_start) } else { (&mut own, &mut own_start) };
                if axis == 0 || !alike[axis] {
                    covariance.fill(table, b, filter, endpoint);
                    start_covariance.fill(start_table, b, start_filter, endpoint);
                }
                let there = covariance.position(table, b, filter, endpoint);
                let from_start = start_covariance.position(start_table, b, start_filter, endpoint);
                there.mean.store(&mut endpoints.mean[axis]);
                there.variance.store(&mut endpoints.variance[axis]);
                from_start.mean.store(&mut endpoints.start_mean[axis]);
                from_start.variance.store(&mut endpoints.start_variance[axis]);
                exponent = exponent + (there.exponent - from_start.exponent);
                density = density * there.density;
                start_density = start_density * from_start.density;
            }
            (Lanes::splat(prediction.weight) * Lanes::load(weights) * (density / start_density).sqrt())
                .store(&mut endpoints.factor);
            exponent.store(&mut endpoints.constant);
        }
    }

    /// Writes the weights of a class, `prior_i sum_n f_n 2^(e_n - shift)`, and returns their sum.
    #[inline(never)]
    pub fn weighted_sums(
        &mut self,
        classes: &Classes,
        class: &Class,
        origin: [f64; AXES],
        shift: f64,
        weights: &mut [Block],
    ) -> f64 {
        let d = classes.dimensions;
        let round = class.size.is_some_and(|size| self.balls(d, &size, &origin));
        match class.size {
            None => self.owns(),
            Some(size) if !round => self.ellipsoids(d, &size),
            Some(_) => {}
        }
        let Self { owns, balls, ellipsoids, bounds, .. } = self;
        let boxes = &class.boxes;
        if !boxes.is_empty() {
            if round {
                bounds.set_balls(balls, origin);
            } else {
                bounds.set_ellipsoids(ellipsoids);
            }
            weights[class.blocks.clone()].fill(ZERO);
        }
        let mut part = |blocks: &Range<usize>| {
            let places = classes.layout.places(blocks, origin);
            let (priors, weights) = (&classes.priors[blocks.clone()], &mut weights[blocks.clone()]);
            match class.size {
                None => Own::weighted_sums(d, owns, &places, shift, priors, weights),
                Some(_) if round => Ball::weighted_sums(d, balls, &places, shift, priors, weights),
                Some(_) => Ellipsoid::weighted_sums(d, ellipsoids, &places, shift, priors, weights),
            }
        };
        if boxes.is_empty() { part(&class.blocks) } else { bounds.sum(boxes, d, shift, part) }
    }

    /// Writes `log2` of the sums of a class, whatever their size.
    #[inline(never)]
    pub fn log2_sums(&mut self, classes: &Classes, class: &Class, logs: &mut [Block]) {
        let places = classes.layout.places(&class.blocks, [0.0; AXES]);
        let (d, logs) = (classes.dimensions, &mut logs[class.blocks.clone()]);
        match class.size {
            None => {
                self.owns();
                Own::log2_sums(d, &self.owns, &places, logs);
            }
            Some(size) => {
                self.ellipsoids(d, &size);
                Ellipsoid::log2_sums(d, &self.ellipsoids, &places, logs);
            }
        }
    }

    fn owns(&mut self) {
        self.owns.clear();
        for endpoints in &self.endpoints {
            for lane in 0..WIDTH {
                if endpoints.factor[lane] > 0.0 {
                    self.owns.push(Own {
                        mean: at(&endpoints.mean, lane),
                        variance: at(&endpoints.variance, lane),
                        start_mean: at(&endpoints.start_mean, lane),
                        start_variance: at(&endpoints.start_variance, lane),
                        constant: endpoints.constant[lane],
                        factor: endpoints.factor[lane],
                    });
                }
            }
        }
    }

    /// The terms as balls; false where they would cancel or are none.
    fn balls(&mut self, dimensions: usize, size: &[f64; MOST], origin: &[f64; AXES]) -> bool {
        self.balls.clear();
        if self.endpoints.is_empty() || !self.round || size[..dimensions].iter().any(|s| *s != size[0]) {
            return false;
        }
        let half = Lanes::splat(HALF_LOG2_E);
        for endpoints in &self.endpoints {
            let v = Lanes::load(&endpoints.variance[0]) + Lanes::splat(size[0]);
            let u = Lanes::load(&endpoints.start_variance[0]) + Lanes::splat(size[0]);
            let (over_v, over_u) = (Lanes::splat(1.0) / v, Lanes::splat(1.0) / u);
            let mut slope = [ZERO; AXES];
            let (mut squares, mut start_squares) = (Lanes::splat(0.0), Lanes::splat(0.0));
            for axis in 0..dimensions {
                let p = Lanes::load(&endpoints.mean[axis]) - Lanes::splat(origin[axis]);
                let g = Lanes::load(&endpoints.start_mean[axis]) - Lanes::splat(origin[axis]);
                let (from_p, from_g) = (p * over_v, g * over_u);
                ((half + half) * (from_p - from_g)).store(&mut slope[axis]);
                squares = squares + p * from_p;
                start_squares = start_squares + g * from_g;
            }
            let ratio = u * over_v;
            let factor = match dimensions {
                1 => ratio.sqrt(),
                2 => ratio,
                _ => ratio * ratio.sqrt(),
            };
            let [mut curvature, mut constant, mut factors, mut bits] = [ZERO; 4];
            (half * (v - u) * over_v * over_u).store(&mut curvature);
            (Lanes::load(&endpoints.constant) + half * (start_squares - squares)).store(&mut constant);
            (Lanes::load(&endpoints.factor) * factor).store(&mut factors);
            (half * squares.at_least(start_squares)).store(&mut bits);
            for lane in 0..WIDTH {
                if endpoints.factor[lane] > 0.0 {
                    if bits[lane] > MOST_BITS {
                        return false;
                    }
                    self.balls.push(Ball {
                        curvature: curvature[lane],
                        slope: at(&slope, lane),
                        constant: constant[lane],
                        factor: factors[lane],
                    });
                }
            }
        }
        true
    }

    /// The terms as ellipsoids; those of a coupled source are there already.
    fn ellipsoids(&mut self, dimensions: usize, size: &[f64; MOST]) {
        if self.endpoints.is_empty() {
            return;
        }
        self.ellipsoids.clear();
        let half = Lanes::splat(HALF_LOG2_E);
        for endpoints in &self.endpoints {
            let [mut slope, mut curvature] = [[ZERO; AXES]; 2];
            let mut ratio = Lanes::splat(1.0);
            let mut constant = Lanes::load(&endpoints.constant);
            for axis in 0..dimensions {
                let v = Lanes::load(&endpoints.variance[axis]) + Lanes::splat(size[axis]);
                let u = Lanes::load(&endpoints.start_variance[axis]) + Lanes::splat(size[axis]);
                let (over_v, over_u) = (Lanes::splat(1.0) / v, Lanes::splat(1.0) / u);
                let apart = Lanes::load(&endpoints.mean[axis]) - Lanes::load(&endpoints.start_mean[axis]);
                let lean = half * apart * over_u;
                (lean + lean).store(&mut slope[axis]);
                (half * (v - u) * over_v * over_u).store(&mut curvature[axis]);
                constant = constant + lean * apart;
                ratio = ratio * (u * over_v);
            }
            let [mut constants, mut factors] = [ZERO; 2];
            constant.store(&mut constants);
            (Lanes::load(&endpoints.factor) * ratio.sqrt()).store(&mut factors);
            for lane in 0..WIDTH {
                if endpoints.factor[lane] > 0.0 {
                    let [xx, yy, zz] = at(&curvature, lane);
                    self.ellipsoids.push(Ellipsoid {
                        center: at(&endpoints.mean, lane),
                        curvature: [[xx, 0.0, 0.0], [0.0, yy, 0.0], [0.0, 0.0, zz]],
                        slope: at(&slope, lane),
                        constant: constants[lane],
                        factor: factors[lane],
                    });
                }
            }
        }
    }
}
