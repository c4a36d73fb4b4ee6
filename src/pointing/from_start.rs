//! What the start of a movement alone implies of each target, as flat arrays for the hot loop.

use super::course::{Course, Onset};
use super::evidence::{angular_variance, log_near, log_start};
use super::parameters::{Direction, PointingConstants};
use super::targets::Targets;
use super::{Space, Vector, dot, minus};
use whither_kernel::bearings;
use whither_kernel::mixture::AXES;
use whither_kernel::vectors::{Block, WIDTH};

/// Powers of `e` beyond this leave too little room for the rest of a product.
const MODERATE: f64 = 200.0;

/// The variance of a direction without information. The square of none is infinite.
const NO_DIRECTION: f64 = 1e100;

/// Numbers of each target, in the order of its layout.
#[derive(Clone, Debug)]
pub struct FromStart {
    /// The directions from the start, as [`bearings::exponents`] reads them.
    pub bearings: Vec<Block>,
    /// `1 / S_i`, one over the start density.
    pub over_start: Vec<Block>,
    /// Prior probabilities times the factor `near`; zero where a block is filled up.
    pub priors: Vec<Block>,
    /// Whether no number is so large or small that products with it may leave their range.
    pub moderate: bool,
    /// How many targets are possible at all, at least one.
    pub possible: usize,
    /// How far the movement had begun when these were computed; none before.
    onset: Option<Onset>,
}

impl FromStart {
    /// Room for the numbers, which [`FromStart::update`] computes.
    #[must_use]
    pub fn of(targets: &Targets, dimensions: usize) -> Self {
        let blocks = targets.layout().blocks();
        let [over_start, priors] = [Vec::with_capacity(blocks), Vec::with_capacity(blocks)];
        let bearings = Vec::with_capacity(blocks * bearings::numbers(dimensions));
        let possible = targets.priors().iter().filter(|prior| **prior > 0.0).count().max(1);
        Self { bearings, over_start, priors, moderate: true, possible, onset: None }
    }

    /// Another start: all is to be computed again.
    pub fn forget(&mut self) {
        self.onset = None;
        self.bearings.clear();
    }

    /// Computes the numbers for a movement that has begun so far, where that has changed; `log_volume` is that of the start density.
    #[inline(always)]
    pub fn update<S: Space>(
        &mut self,
        targets: &Targets,
        parameters: &PointingConstants,
        log_volume: f64,
        course: &Course<S>,
        onset: Onset,
    ) {
        if self.onset.replace(onset) != Some(onset) {
            self.compute(targets, parameters, log_volume, (course.dimensions(), &course.start), onset);
        }
    }

    #[inline(never)]
    fn compute(
        &mut self,
        targets: &Targets,
        parameters: &PointingConstants,
        log_volume: f64,
        (dimensions, start): (usize, &Vector),
        onset: Onset,
    ) {
        let total: f64 = targets.priors().iter().sum();
        let is_new = self.bearings.is_empty();
        self.moderate = true;
        self.over_start.clear();
        self.priors.clear();
        for block in targets.layout().members() {
            let [mut over_start, mut priors] = [[0.0; WIDTH]; 2];
            for (lane, (i, present)) in block.into_iter().enumerate() {
                let offset = minus(&targets.center(i), start);
                let log_start = log_start(&parameters.start, &offset, &onset) - log_volume;
                let near = onset.share * log_near(parameters.near, &offset, targets.extent(i), dimensions);
                self.moderate &= log_start.abs() < MODERATE && near > -MODERATE;
                over_start[lane] = (-log_start).exp();
                if present {
                    priors[lane] = targets.priors()[i] / total * near.exp();
                }
            }
            self.over_start.push(over_start);
            self.priors.push(priors);
            if is_new {
                self.add_bearings(targets, &parameters.direction, (dimensions, start), block);
            }
        }
    }

    /// Adds the directions of a block of targets.
    fn add_bearings(
        &mut self,
        targets: &Targets,
        direction: &Direction,
        (dimensions, start): (usize, &Vector),
        block: [(usize, bool); WIDTH],
    ) {
        let count = bearings::numbers(dimensions);
        let mut numbers = [[0.0; WIDTH]; 5];
        for (lane, (i, _)) in block.into_iter().enumerate() {
            let offset = minus(&targets.center(i), start);
            let square = dot(&offset, &offset);
            // what is at the start itself lies in no direction
            let variance = if square < f64::MIN_POSITIVE {
                NO_DIRECTION
            } else {
                let over = 1.0 / square.sqrt();
                (0..AXES).for_each(|axis| numbers[axis][lane] = offset[axis] * over);
                angular_variance(&offset, targets.extent(i), dimensions)
            };
            let wide = direction.wide.powi(2) + variance;
            (numbers[count - 2][lane], numbers[count - 1][lane]) =
                (wide, wide * wide / (direction.core.powi(2) + variance));
        }
        self.bearings.extend_from_slice(&numbers[..count]);
    }
}
