//! What the start of a movement alone implies of each target, as flat arrays for the hot loop.

use super::course::Onset;
use super::parameters::PointingConstants;
use super::targets::Targets;
use super::{Vector, course::Course, space::Space};
use std::f64::consts::LOG2_E;
use whither_kernel::bearings::{Bearings, Origin};
use whither_kernel::start::StartDensity;
use whither_kernel::vectors::Block;

/// Numbers of each target, in the order of its layout.
#[derive(Clone, Debug)]
pub struct FromStart {
    /// The directions from the start.
    pub bearings: Bearings,
    /// `1 / S_i`, one over the start density.
    pub over_start: Vec<Block>,
    /// Prior probabilities times the factor `near`; zero where a block is filled up.
    pub priors: Vec<Block>,
    /// Whether no number is so large or small that products with it may leave their range.
    pub moderate: bool,
    /// How far the movement had begun when these were computed; none before.
    onset: Option<Onset>,
}

impl FromStart {
    /// Room for the numbers, which [`FromStart::update`] computes.
    #[must_use]
    pub fn of(targets: &Targets, dimensions: usize) -> Self {
        let blocks = targets.layout().blocks();
        let [over_start, priors] = [Vec::with_capacity(blocks), Vec::with_capacity(blocks)];
        let bearings = Bearings::with_capacity(dimensions, blocks);
        Self { bearings, over_start, priors, moderate: true, onset: None }
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
        let density = StartDensity {
            dimensions,
            start: *start,
            log_volume: log_volume * LOG2_E,
            core: parameters.start.core.powi(2) + onset.shortfall.powi(2),
            half_exponent: 0.5 * parameters.start.exponent,
            near: parameters.near.powi(2),
            share: onset.share,
        };
        let direction = &parameters.direction;
        let origin = Origin { start: *start, wide: direction.wide.powi(2), core: direction.core.powi(2) };
        let (priors, total) = (targets.priors(), targets.priors().iter().sum::<f64>());
        self.priors.clear();
        for block in targets.layout().members() {
            self.priors.push(block.map(|(i, present)| if present { priors[i] / total } else { 0.0 }));
        }
        self.over_start.resize(self.priors.len(), Block::default());
        let is_new = self.bearings.is_empty();
        self.moderate = true;
        for class in targets.classes() {
            let (places, covariance) = (targets.places(&class.blocks), class.covariance.as_ref());
            let (over_start, priors) =
                (&mut self.over_start[class.blocks.clone()], &mut self.priors[class.blocks.clone()]);
            self.moderate &= density.evaluate(&places, covariance, over_start, priors);
            if is_new {
                self.bearings.extend(dimensions, &places, covariance, &origin);
            }
        }
    }
}
