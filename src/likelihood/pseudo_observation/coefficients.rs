//! The terms of a class of destinations, and their sums over all of them.

use super::classes::{Class, Classes};
use super::pruning::Bounds;
use std::ops::Range;
use whither_kernel::mixture::{AXES, Ball, Ellipsoid, Own, Powers, Sums};
use whither_kernel::ratios::Ratios;
use whither_kernel::vectors::{Block, WIDTH};

/// Room that is kept from step to step; what is in it is no part of any state.
#[derive(Clone, Debug, Default)]
pub struct Work {
    /// What separable sources give.
    pub ratios: Ratios,
    /// Coupled sources put their terms here.
    pub ellipsoids: Vec<Ellipsoid>,
    balls: Vec<Ball>,
    owns: Vec<Own>,
    bounds: Bounds,
    powers: Powers,
}

impl Work {
    /// Removes the endpoints and terms of another class.
    pub fn clear(&mut self) {
        self.ratios.clear();
        self.ellipsoids.clear();
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
        let Self { ratios, owns, balls, ellipsoids, bounds, powers } = self;
        let round = class.size.is_some_and(|size| ratios.balls(d, &size, &origin, balls));
        match class.size {
            None => ratios.owns(owns),
            // those of a coupled source are there already
            Some(size) if !round && !ratios.is_empty() => ratios.ellipsoids(d, &size, ellipsoids),
            Some(_) => {}
        }
        let boxes = &class.boxes;
        if !boxes.is_empty() {
            if round {
                bounds.set_balls(balls, origin);
            } else {
                bounds.set_ellipsoids(ellipsoids);
            }
            weights[class.blocks.clone()].fill([0.0; WIDTH]);
        }
        let mut part = |blocks: &Range<usize>| {
            let places = classes.layout.places(blocks, origin);
            let (priors, weights) = (&classes.priors[blocks.clone()], &mut weights[blocks.clone()]);
            match class.size {
                None => Own::weighted_sums(d, owns, &places, shift, priors, powers, weights),
                Some(_) if round => Ball::weighted_sums(balls, &places, shift, priors, powers, weights),
                Some(_) => Ellipsoid::weighted_sums(d, ellipsoids, &places, shift, priors, powers, weights),
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
                self.ratios.owns(&mut self.owns);
                Own::log2_sums(d, &self.owns, &places, logs);
            }
            Some(size) => {
                if !self.ratios.is_empty() {
                    self.ratios.ellipsoids(d, &size, &mut self.ellipsoids);
                }
                Ellipsoid::log2_sums(d, &self.ellipsoids, &places, logs);
            }
        }
    }
}
