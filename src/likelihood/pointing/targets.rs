//! The destinations as flat arrays for the hot loop, by class, with what the start of the movement says of each.

use super::evidence::{angular_variance, log_near, log_start};
use super::parameters::Parameters;
use super::{Symmetric, Vector, dot, minus, vector};
use crate::likelihood::pointing::endpoint::symmetric;
use crate::math::lanes::{Block, WIDTH};
use crate::math::mixture::{AXES, Places};
use crate::model::destination::Destinations;
use nalgebra::DMatrix;
use std::ops::Range;

/// In [`Targets::order`], a place that only fills a block up.
const NOBODY: u32 = u32::MAX;

/// The variance of a direction that says nothing.
const NO_DIRECTION: f64 = 1e100;

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
    /// The variance of the direction in which a destination is seen from the start.
    pub angular_variance: Vec<Block>,
    /// One over the distance from the start; zero at the start itself.
    pub over_distance: Vec<Block>,
    /// Prior probabilities times the factor `near`; zero where a block is filled up.
    pub priors: Vec<Block>,
    /// Whether no number is so large or small that products with it may leave their range.
    pub moderate: bool,
    coordinates: [Vec<Block>; AXES],
    variances: [Vec<Block>; AXES],
    order: Vec<u32>,
    count: usize,
}

impl Targets {
    /// Writes down the destinations as a movement from `start` sees them.
    pub fn fill(&mut self, destinations: &Destinations, parameters: &Parameters, start: &Vector) {
        let d = destinations.dimensions();
        self.clear();
        self.count = destinations.len();
        let mut members: Vec<Vec<u32>> = vec![Vec::new(); destinations.kinds().len()];
        for (i, &kind) in (0..).zip(destinations.kind_of()) {
            members[kind as usize].push(i);
        }
        let mut pool = Vec::new();
        let several = members.iter().filter(|members| !members.is_empty()).count() > 1;
        for (kind, members) in destinations.kinds().iter().zip(&members) {
            if several && members.len() < WIDTH && is_straight(&kind.covariance, d) {
                pool.extend(members);
            } else {
                self.place(destinations, members, Some(symmetric(&kind.covariance, d)));
            }
        }
        self.place(destinations, &pool, None);
        self.see(destinations, parameters, start);
    }

    fn clear(&mut self) {
        self.classes.clear();
        self.order.clear();
        self.coordinates.iter_mut().chain(&mut self.variances).for_each(Vec::clear);
        let (starts, directions) = (&mut self.over_start, &mut self.angular_variance);
        [starts, directions, &mut self.over_distance, &mut self.priors].into_iter().for_each(Vec::clear);
    }

    fn place(&mut self, destinations: &Destinations, members: &[u32], covariance: Option<Symmetric>) {
        let begin = self.order.len() / WIDTH;
        for chunk in members.chunks(WIDTH) {
            // a block is filled up with its first destination, at no weight
            let member = |lane: usize| chunk.get(lane).map_or(chunk[0] as usize, |&i| i as usize);
            for axis in 0..destinations.dimensions() {
                self.coordinates[axis].push(std::array::from_fn(|lane| destinations.center(member(lane))[axis]));
                if covariance.is_none() {
                    let variance = |lane: usize| destinations.kind(member(lane)).covariance[(axis, axis)];
                    self.variances[axis].push(std::array::from_fn(variance));
                }
            }
            self.order.extend((0..WIDTH).map(|lane| chunk.get(lane).map_or(NOBODY, |&i| i)));
        }
        if !members.is_empty() {
            self.classes.push(Class { covariance, blocks: begin..self.order.len() / WIDTH });
        }
    }

    /// What the start says of each.
    fn see(&mut self, destinations: &Destinations, parameters: &Parameters, start: &Vector) {
        let d = destinations.dimensions();
        let log_volume = parameters.start.log_volume(d);
        let total: f64 = destinations.priors().iter().sum();
        self.moderate = true;
        for block in self.order.chunks(WIDTH) {
            let [mut over_start, mut directions, mut over_distance, mut priors] = [[0.0; WIDTH]; 4];
            for (lane, &member) in block.iter().enumerate() {
                let i = if member == NOBODY { block[0] } else { member } as usize;
                let (kind, offset) = (destinations.kind(i), minus(&vector(destinations.center(i)), start));
                let log_start = log_start(&parameters.start, &offset) - log_volume;
                let near = log_near(parameters.near, &offset, kind, d);
                let distance = dot(&offset, &offset).sqrt();
                self.moderate &= log_start.abs() < MODERATE && near > -MODERATE && distance < NO_DIRECTION;
                over_start[lane] = (-log_start).exp();
                (directions[lane], over_distance[lane]) = if distance > 0.0 {
                    (angular_variance(&offset, &kind.covariance, d), 1.0 / distance)
                } else {
                    (NO_DIRECTION, 0.0)
                };
                if member != NOBODY {
                    priors[lane] = destinations.priors()[i] / total * near.exp();
                }
            }
            self.over_start.push(over_start);
            self.angular_variance.push(directions);
            self.over_distance.push(over_distance);
            self.priors.push(priors);
        }
    }

    /// The places of a class.
    pub fn places(&self, class: &Class) -> Places<'_> {
        // those with variances of their own stand last
        let begin = self.order.len() / WIDTH - self.variances[0].len();
        let blocks = |list: &'_ Vec<Block>, shift: usize| match list.is_empty() {
            true => 0..0,
            false => class.blocks.start - shift..class.blocks.end - shift,
        };
        let own = class.covariance.is_none();
        Places {
            coordinates: std::array::from_fn(|k| &self.coordinates[k][blocks(&self.coordinates[k], 0)]),
            variances: std::array::from_fn(|k| {
                &self.variances[k][if own { blocks(&self.variances[k], begin) } else { 0..0 }]
            }),
            origin: [0.0; AXES],
        }
    }

    /// The coordinates of all, a list for each axis.
    pub fn coordinates(&self) -> [&[Block]; AXES] {
        self.coordinates.each_ref().map(Vec::as_slice)
    }

    /// Takes what stands in the order of the arrays, times `scale`, to the order of the destinations.
    pub fn scatter(&self, from: &[Block], scale: f64, into: &mut Vec<f64>) {
        into.clear();
        into.resize(self.count, 0.0);
        for (x, &i) in from.as_flattened().iter().zip(&self.order) {
            if let Some(place) = into.get_mut(i as usize) {
                *place = x * scale;
            }
        }
    }
}

/// Whether the axes of an endpoint are independent.
fn is_straight(covariance: &DMatrix<f64>, dimensions: usize) -> bool {
    (0..dimensions).all(|i| (0..i).all(|j| covariance[(i, j)] == 0.0))
}
