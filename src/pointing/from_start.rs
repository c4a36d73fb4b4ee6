//! What the start of a movement alone implies of each target, as flat arrays for the hot loop.

use super::course::{Course, Onset};
use super::evidence::{angular_variance, log_start, near};
use super::parameters::PointingConstants;
use super::targets::Targets;
use super::{Space, Vector, dot, minus};
use whither_kernel::bearings;
use whither_kernel::mixture::AXES;
use whither_kernel::vectors::{Block, WIDTH, raise};

/// Powers of `e` beyond this leave too little room for the rest of a product.
const MODERATE: f64 = 200.0;

/// `e^-MODERATE`.
const LEAST: f64 = 1.383_896_526_736_737_5e-87;

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
        confidence: f64,
    ) {
        if self.onset.replace(onset) != Some(onset) {
            self.compute(targets, parameters, log_volume, (course.dimensions(), &course.start), onset);
            self.temper(confidence);
        }
    }

    /// Raises the priors to the confidence.
    #[inline(never)]
    fn temper(&mut self, confidence: f64) {
        if confidence != 1.0 {
            self.priors.as_flattened_mut().iter_mut().for_each(|prior| *prior = (confidence * prior.ln()).exp());
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
                let near = near(parameters, &offset, targets.extent(i), dimensions);
                // a movement that has begun takes neither a logarithm nor a power
                let near = if onset.share == 1.0 { near } else { (onset.share * near.ln()).exp() };
                self.moderate &= log_start.abs() < MODERATE && near > LEAST;
                over_start[lane] = -std::f64::consts::LOG2_E * log_start;
                if present {
                    priors[lane] = targets.priors()[i] / total * near;
                }
            }
            self.over_start.push(over_start);
            self.priors.push(priors);
            if is_new {
                self.add_bearings(targets, parameters, (dimensions, start), block);
            }
        }
        raise(&mut self.over_start, &[], 0.0);
    }

    /// Adds the directions of a block of targets.
    fn add_bearings(
        &mut self,
        targets: &Targets,
        PointingConstants { direction, unit, .. }: &PointingConstants,
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
                angular_variance(*unit, &offset, targets.extent(i), dimensions)
            };
            let wide = direction.wide.powi(2) + variance;
            (numbers[count - 2][lane], numbers[count - 1][lane]) =
                (wide, wide * wide / (direction.core.powi(2) + variance));
        }
        self.bearings.extend_from_slice(&numbers[..count]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::targets::{Extent, Target};
    use super::*;

    const START: Vector = [300.0, 200.0, 100.0];

    const HALFWAY: Onset = Onset { shortfall: 12.0, share: 0.4 };

    /// The extent of a box, with a covariance of `xy` between its first two axes.
    fn extent(sides: Vector, xy: f64, d: usize) -> Extent {
        let variance = |axis: usize| if axis < d { sides[axis] * sides[axis] / 12.0 } else { 0.0 };
        Extent::new([variance(0), xy, variance(1), 0.0, 0.4 * xy, variance(2)], sides, d)
    }

    /// Targets of so many sizes in turn, the first of them at the start.
    fn targets(d: usize, extents: Vec<Extent>) -> Targets {
        let sizes = extents.len();
        let list: Vec<_> = (0..23)
            .map(|i| {
                let angle = f64::from(i);
                let way = [37.0 * angle * angle.cos(), 23.0 * angle * angle.sin(), 11.0 * angle];
                let center = [0, 1, 2].map(|axis| if axis < d { START[axis] + way[axis] } else { 0.0 });
                Target { center, extent: i as usize % sizes, prior: angle.rem_euclid(4.0) }
            })
            .collect();
        Targets::new(d, extents, list.into_iter())
    }

    fn close(found: f64, expected: f64, what: &str) {
        assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{what}: {found} {expected}");
    }

    fn agrees(d: usize, targets: &Targets, onset: Onset) {
        let start = &[0, 1, 2].map(|axis| if axis < d { START[axis] } else { 0.0 });
        let (parameters, log_volume, count) = (PointingConstants::default(), 3.5, bearings::numbers(d));
        let mut found = FromStart::of(targets, d);
        found.compute(targets, &parameters, log_volume, (d, start), onset);
        assert!(found.moderate);
        let total: f64 = targets.priors().iter().sum();
        for (block, members) in targets.layout().members().enumerate() {
            for (lane, (i, is_member)) in members.into_iter().enumerate() {
                let (offset, extent) = (minus(&targets.center(i), start), targets.extent(i));
                let log_start = log_start(&parameters.start, &offset, &onset);
                close(found.over_start[block][lane], (log_volume - log_start).exp(), "over_start");
                let near = near(&parameters, &offset, extent, d).powf(onset.share);
                let prior = if is_member { targets.priors()[i] / total * near } else { 0.0 };
                close(found.priors[block][lane], prior, "prior");
                let numbers: Vec<f64> =
                    found.bearings[block * count..][..count].iter().map(|block| block[lane]).collect();
                let square = dot(&offset, &offset);
                let variance =
                    if square > 0.0 { angular_variance(parameters.unit, &offset, extent, d) } else { NO_DIRECTION };
                let [wide, core] = [parameters.direction.wide, parameters.direction.core].map(|angle| angle * angle);
                for (axis, component) in numbers[..count - 2].iter().enumerate() {
                    close(*component, if square > 0.0 { offset[axis] / square.sqrt() } else { 0.0 }, "component");
                }
                close(numbers[count - 2], wide + variance, "wide");
                close(numbers[count - 1], (wide + variance).powi(2) / (core + variance), "over");
            }
        }
    }

    #[test]
    fn it_is_the_evidence_of_each_target_alone() {
        for d in 1..=3 {
            let own = (0..23).map(|i| extent([40.0 + f64::from(i), 90.0 - f64::from(i), 20.0], 0.0, d)).collect();
            let correlated = if d > 1 { 150.0 } else { 0.0 };
            let few = vec![extent([80.0, 30.0, 50.0], 0.0, d), extent([60.0, 60.0, 60.0], correlated, d)];
            for extents in [own, few] {
                for onset in [Onset::BEGUN, HALFWAY] {
                    agrees(d, &targets(d, extents.clone()), onset);
                }
            }
        }
    }

    #[test]
    fn what_leaves_no_room_for_products_is_noticed() {
        let of = |sides, volume| {
            let targets = targets(2, vec![extent(sides, 0.0, 2)]);
            let mut found = FromStart::of(&targets, 2);
            found.compute(&targets, &PointingConstants::default(), volume, (2, &START), Onset::BEGUN);
            found.moderate
        };
        assert!(of([80.0, 80.0, 0.0], 0.0));
        assert!(!of([80.0, 80.0, 0.0], 300.0) && !of([80.0, 80.0, 0.0], -300.0));
        assert!(!of([1e45, 1e45, 0.0], 0.0));
    }
}
