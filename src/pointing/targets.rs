//! The destinations as flat arrays for the hot loop, by class, with what the start of the movement says of each.

use super::course::Onset;
use super::evidence::{log_near, log_start};
use super::parameters::Parameters;
use super::{Symmetric, Vector, minus, vector};
use crate::math::kernel::layout::{FEW, Layout};
use crate::math::kernel::vectors::{Block, WIDTH};
use crate::model::destination::{Destinations, Kind};
use crate::pointing::endpoint::symmetric;
use std::ops::Range;

/// Powers of `e` beyond this leave too little room for the rest of a product.
const MODERATE: f64 = 200.0;

/// Destinations that stand together.
#[derive(Clone, Debug)]
pub struct Class {
    /// The covariance of their endpoints; none where each has its own variances.
    pub covariance: Option<Symmetric>,
    /// Where they stand.
    pub blocks: Range<usize>,
}

/// All destinations.
#[derive(Clone, Debug, Default)]
pub struct Targets {
    /// By the covariance of the endpoint.
    pub classes: Vec<Class>,
    /// `1 / S_i`.
    pub over_start: Vec<Block>,
    /// Prior probabilities times the factor `near`; zero where a block is filled up.
    pub priors: Vec<Block>,
    /// Whether no number is so large or small that products with it may leave their range.
    pub moderate: bool,
    /// Where they stand.
    pub layout: Layout,
    /// How far the movement had begun when the start was last asked.
    onset: Option<Onset>,
}

impl Targets {
    /// Writes down the destinations as a movement from `start` sees them; `log_volume` is that of the start density.
    pub fn fill(&mut self, destinations: &Destinations, parameters: &Parameters, log_volume: f64, start: &Vector) {
        let d = destinations.dimensions();
        self.classes.clear();
        self.layout = Layout::default();
        let mut members: Vec<Vec<u32>> = vec![Vec::new(); destinations.kinds().len()];
        for i in 0..destinations.len() {
            members[destinations.kind_number(i)].push(i as u32);
        }
        let mut pool = Vec::new();
        let several = members.iter().filter(|members| !members.is_empty()).count() > 1;
        for (kind, members) in destinations.kinds().iter().zip(&members) {
            if several && members.len() < FEW && is_straight(kind, d) {
                pool.extend(members);
            } else {
                self.place(members, Some(symmetric(kind, d)));
            }
        }
        self.place(&pool, None);
        self.layout.finish(destinations.len(), destinations.coordinates(), &|i, axis| {
            destinations.kind(i).variance(axis, axis)
        });
        self.onset = None;
        self.begin(destinations, parameters, log_volume, start, Onset::BEGUN);
    }

    /// Writes down what the start says of each once the movement has begun so far, where that has changed.
    pub fn begin(
        &mut self,
        destinations: &Destinations,
        parameters: &Parameters,
        log_volume: f64,
        start: &Vector,
        onset: Onset,
    ) {
        if self.onset.replace(onset) == Some(onset) {
            return;
        }
        let d = destinations.dimensions();
        let total: f64 = destinations.priors().iter().sum();
        self.moderate = true;
        for list in [&mut self.over_start, &mut self.priors] {
            list.clear();
            list.reserve_exact(self.layout.blocks());
        }
        for block in self.layout.members() {
            let [mut over_start, mut priors] = [[0.0; WIDTH]; 2];
            for (lane, (i, stands)) in block.into_iter().enumerate() {
                let (kind, offset) = (destinations.kind(i), minus(&vector(&destinations.center(i)), start));
                let log_start = log_start(&parameters.start, &offset, &onset) - log_volume;
                let near = onset.share * log_near(parameters.near, &offset, kind, d);
                self.moderate &= log_start.abs() < MODERATE && near > -MODERATE;
                over_start[lane] = (-log_start).exp();
                if stands {
                    priors[lane] = destinations.priors()[i] / total * near.exp();
                }
            }
            self.over_start.push(over_start);
            self.priors.push(priors);
        }
    }

    fn place(&mut self, members: &[u32], covariance: Option<Symmetric>) {
        let blocks = self.layout.place(members, covariance.is_none());
        if !members.is_empty() {
            self.classes.push(Class { covariance, blocks });
        }
    }
}

/// Whether the axes of an endpoint are independent.
fn is_straight(kind: &Kind, dimensions: usize) -> bool {
    (0..dimensions).all(|i| (0..i).all(|j| kind.variance(i, j) == 0.0))
}
