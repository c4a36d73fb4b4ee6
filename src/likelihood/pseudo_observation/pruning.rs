//! Many destinations, spread over a map: what lies where nothing can add anything is left out.
//!
//! Destinations that lie together follow one another in the arrays, 64 in a part with a bounding box. On a box each quadratic of
//! the sum has its largest value where its slope vanishes or at an edge, axis by axis, which bounds the sum of the part's
//! weights. A part whose bound is negligible against the sum is not evaluated, and its probabilities are zero: all that is left
//! out is less than 1e-14 of the sum.

use crate::math::radix_sort::radix_sort;
use crate::model::destination::Destinations;
use std::ops::Range;
use whither_kernel::mixture::{AXES, Ball, Ellipsoid, Places};
use whither_kernel::vectors::{Block, WIDTH};

/// Fewer destinations than this are sooner evaluated than sorted.
pub const MANY: usize = 4096;

/// How many blocks a bounding box has.
const BLOCKS: usize = 16;

/// All that is left out together lies this many powers of two below the sum.
const NOTHING: f64 = 47.0;

/// Destinations that lie together.
#[derive(Clone, Debug)]
pub struct BoundingBox {
    blocks: Range<usize>,
    /// The least and the largest coordinate in each axis.
    edges: [(f64, f64); AXES],
    /// `log2` of the sum of their prior weights.
    log_prior: f64,
}

fn edges(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for x in numbers {
        // without the library's rules for what is no number, which take a call in WebAssembly
        low = if x < low { x } else { low };
        high = if x > high { x } else { high };
    }
    (low, high)
}

/// The order of many destinations: along a curve that fills the space, the bits of their coordinates in turns.
pub fn arrange(destinations: &Destinations, members: &mut [u32]) {
    let d = destinations.dimensions();
    // the bits of each byte, as far apart as a bit of every axis takes
    let apart = |byte: u64| (0..8).map(|bit| (byte >> bit & 1) << (bit * d)).sum();
    let apart: Vec<u64> = (0..256).map(apart).collect();
    let mut places: Vec<(u64, u32)> = members.iter().map(|&i| (0, i)).collect();
    for axis in 0..d {
        let center = |i: u32| destinations.position(i as usize)[axis];
        let (low, high) = edges(members.iter().map(|&i| center(i)));
        let scale = high - low;
        for (place, i) in &mut places {
            let share = ((center(*i) - low) / scale * 65_535.0) as usize;
            *place |= (apart[share % 256] | apart[share / 256] << (8 * d)) << axis;
        }
    }
    radix_sort(&mut places);
    members.iter_mut().zip(places).for_each(|(member, (_, i))| *member = i);
}

/// The bounding boxes of destinations in these blocks, with their places and prior weights; none where they are few.
pub fn bounding_boxes(places: &Places<'_>, all: &Range<usize>, priors: &[Block]) -> Vec<BoundingBox> {
    let bounding_box = |start: usize| {
        let blocks = start..all.len().min(start + BLOCKS);
        let log_prior = priors[blocks.clone()].as_flattened().iter().sum::<f64>().log2();
        let part = places.coordinates.map(|list| list.get(blocks.clone()).unwrap_or_default().as_flattened());
        let edges = part.map(|numbers| edges(numbers.iter().copied()));
        BoundingBox { blocks: all.start + blocks.start..all.start + blocks.end, edges, log_prior }
    };
    if all.len() * WIDTH < MANY { Vec::new() } else { (0..all.len()).step_by(BLOCKS).map(bounding_box).collect() }
}

/// The largest exponent of a term in a bounding box, where axes are not correlated; its factor does not count.
fn most(term: &Ellipsoid, bounding_box: &BoundingBox, dimensions: usize) -> f64 {
    let mut most = term.constant;
    for axis in 0..dimensions {
        let (low, high) =
            (bounding_box.edges[axis].0 - term.center[axis], bounding_box.edges[axis].1 - term.center[axis]);
        let (curvature, slope) = (term.curvature[axis][axis], term.slope[axis]);
        let top = -0.5 * slope / curvature;
        most += if curvature < 0.0 && low < top && top < high {
            0.5 * slope * top
        } else {
            (low * (slope + curvature * low)).max(high * (slope + curvature * high))
        };
    }
    most
}

/// Room that is kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Bounds {
    terms: Vec<Ellipsoid>,
    each: Vec<f64>,
}

impl Bounds {
    /// The terms of the sum, about this origin.
    pub fn set_balls(&mut self, balls: &[Ball], origin: [f64; AXES]) {
        self.terms.clear();
        for ball in balls {
            let a = ball.curvature;
            let curvature = [[a, 0.0, 0.0], [0.0, a, 0.0], [0.0, 0.0, a]];
            let constant = ball.constant + ball.factor.log2();
            self.terms.push(Ellipsoid { center: origin, curvature, slope: ball.slope, constant, factor: 1.0 });
        }
    }

    /// The terms of the sum.
    pub fn set_ellipsoids(&mut self, ellipsoids: &[Ellipsoid]) {
        self.terms.clear();
        let scaled = |e: &Ellipsoid| Ellipsoid { constant: e.constant + e.factor.log2(), factor: 1.0, ..*e };
        self.terms.extend(ellipsoids.iter().map(scaled));
    }

    /// The sum over the boxes, of which `sum` gives one; those that add nothing are left out.
    pub fn sum(
        &mut self,
        boxes: &[BoundingBox],
        d: usize,
        shift: f64,
        mut sum: impl FnMut(&Range<usize>) -> f64,
    ) -> f64 {
        self.each.clear();
        let mut best = (f64::NEG_INFINITY, 0..0);
        for bounding_box in boxes {
            let mut bound = f64::NEG_INFINITY;
            for term in &self.terms {
                bound = bound.max(most(term, bounding_box, d) + bounding_box.log_prior);
            }
            self.each.push(bound);
            if bound > best.0 {
                best = (bound, bounding_box.blocks.clone());
            }
        }
        // the sum is at least what the best box gives; all the others may be as large as their bounds
        let least = sum(&best.1).log2() + shift - ((boxes.len() * self.terms.len()) as f64).log2() - NOTHING;
        let mut total = 0.0;
        for (bounding_box, bound) in boxes.iter().zip(&self.each) {
            if !(*bound < least) {
                total += sum(&bounding_box.blocks);
            }
        }
        total
    }
}
