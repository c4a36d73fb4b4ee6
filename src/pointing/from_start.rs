//! What the start of a movement alone implies of each target, as flat arrays for the hot loop.

use super::Vector;
use super::course::Onset;
use super::evidence::{log_near, log_start};
use super::minus;
use super::parameters::PointingConstants;
use super::targets::Targets;
use whither_kernel::vectors::{Block, WIDTH};

/// Powers of `e` beyond this leave too little room for the rest of a product.
const MODERATE: f64 = 200.0;

/// One number of each target, in the order of its layout.
#[derive(Clone, Debug)]
pub struct FromStart {
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
    pub fn of(targets: &Targets) -> Self {
        let blocks = targets.layout().blocks();
        let [over_start, priors] = [Vec::with_capacity(blocks), Vec::with_capacity(blocks)];
        Self { over_start, priors, moderate: true, onset: None }
    }

    /// Another start: all is to be computed again.
    pub fn forget(&mut self) {
        self.onset = None;
    }

    /// Computes the numbers for a movement from `start` that has begun so far, where that has changed; `log_volume` is that of
    /// the start density.
    pub fn update(
        &mut self,
        targets: &Targets,
        parameters: &PointingConstants,
        dimensions: usize,
        log_volume: f64,
        start: &Vector,
        onset: Onset,
    ) {
        if self.onset.replace(onset) == Some(onset) {
            return;
        }
        let total: f64 = targets.priors().iter().sum();
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
        }
    }
}
