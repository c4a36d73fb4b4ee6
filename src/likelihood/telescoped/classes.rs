//! The destinations as flat arrays, by class: those that share their arrival nodes and the covariance of their endpoint.

use super::separable::{AxisEnd, MOST};
use crate::likelihood::plan::Plan;
use crate::math::lanes::{Block, WIDTH};
use crate::math::mixture::{AXES, Places};
use crate::model::destination::Destinations;
use nalgebra::DMatrix;
use std::collections::HashMap;
use std::ops::Range;

/// Arrival nodes of a class.
#[derive(Clone, Debug)]
pub struct Nodes {
    /// `T - t_1`, or the time to go.
    pub times: Vec<f64>,
    /// Their prior probabilities.
    pub weights: Vec<f64>,
    /// Whether the times count from now.
    pub from_now: bool,
}

impl Nodes {
    /// Whether some node with weight lies after `elapsed`.
    pub fn is_alive(&self, elapsed: f64) -> bool {
        let mut nodes = self.times.iter().zip(&self.weights);
        nodes.any(|(&time, &weight)| weight > 0.0 && (self.from_now || time > elapsed))
    }

    /// The weights in blocks, zero for the nodes that have passed at `elapsed`.
    pub fn weights_ahead(&self, elapsed: f64, into: &mut Vec<Block>) {
        into.clear();
        let ahead = |time: f64, weight: f64| if self.from_now || time - elapsed > 0.0 { weight } else { 0.0 };
        for (times, weights) in self.times.chunks(WIDTH).zip(self.weights.chunks(WIDTH)) {
            let of = |lane: usize| Some(ahead(*times.get(lane)?, *weights.get(lane)?));
            into.push(std::array::from_fn(|lane| of(lane).unwrap_or(0.0)));
        }
    }
}

/// The endpoint of a class, apart from the position's mean.
#[derive(Clone, Debug, PartialEq)]
pub struct End {
    /// The means of the components after the position.
    pub rest: Vec<f64>,
    /// The covariance `S_i`; where axes are separate without the position's own variances, which each class, or each
    /// destination, adds.
    pub covariance: DMatrix<f64>,
    /// The same for each axis, where axes are separate.
    pub axes: Option<[AxisEnd; MOST]>,
}

impl End {
    fn new(mean: &[f64], covariance: &DMatrix<f64>, d: usize, separable: bool) -> Self {
        if !separable {
            return Self { rest: mean[d..].to_vec(), covariance: covariance.clone(), axes: None };
        }
        let length = mean.len();
        let mut axes = [AxisEnd::default(); MOST];
        for (axis, end) in axes.iter_mut().enumerate().take(d) {
            for i in (axis..length).step_by(d) {
                end.length += 1;
                if i >= d {
                    end.mean[i / d] = mean[i];
                }
                for j in (axis..length).step_by(d) {
                    if i >= d || j >= d {
                        end.covariance[i / d][j / d] = covariance[(i, j)];
                    }
                }
            }
        }
        let mut covariance = covariance.clone();
        for i in 0..d {
            covariance[(i, i)] = 0.0;
        }
        Self { rest: mean[d..].to_vec(), covariance, axes: Some(axes) }
    }

    fn key(&self) -> Vec<u64> {
        let numbers = self.rest.iter().chain(self.covariance.iter());
        std::iter::once(self.covariance.nrows() as u64).chain(numbers.map(|x| x.to_bits())).collect()
    }
}

/// Destinations that stand together in the arrays.
#[derive(Clone, Debug)]
pub struct Class {
    /// Which nodes.
    pub nodes: usize,
    /// Which endpoint.
    pub end: usize,
    /// The position's variances in each axis where all have the same; none where each has its own.
    pub size: Option<[f64; MOST]>,
    /// Where they are.
    pub blocks: Range<usize>,
}

/// All destinations.
#[derive(Clone, Debug)]
pub struct Classes {
    /// Dimensions.
    pub dimensions: usize,
    /// Whether axes are taken separately.
    pub separable: bool,
    /// The arrival nodes.
    pub nodes: Vec<Nodes>,
    /// The endpoints.
    pub ends: Vec<End>,
    /// The classes; those that share nodes and endpoint follow one another.
    pub classes: Vec<Class>,
    /// Prior probabilities, which sum to one; zero where a block is filled up.
    pub priors: Vec<Block>,
    /// Which destination stands where; none where they stand in their own order.
    pub order: Option<Vec<u32>>,
    /// How many there are.
    pub count: usize,
    coordinates: [Vec<Block>; AXES],
    variances: [Vec<Block>; AXES],
}

/// In [`Classes::order`], a place that only fills a block up.
const NOBODY: u32 = u32::MAX;

struct Draft {
    size: [f64; MOST],
    members: Vec<u32>,
}

impl Classes {
    /// The classes of `destinations` with the nodes of `plan`. `separable` is whether axes are to be taken separately, which
    /// they cannot be where some endpoint mixes them.
    pub fn new(destinations: &Destinations, plan: &Plan, separable: bool) -> Self {
        let d = destinations.dimensions();
        let mixes = |covariance: &DMatrix<f64>| {
            let n = covariance.nrows();
            (0..n).any(|i| (0..i).any(|j| i % d != j % d && covariance[(i, j)] != 0.0))
        };
        let nodes = plan.grids.iter().enumerate().map(|(grid, nodes)| Nodes {
            times: nodes.times.clone(),
            weights: nodes.log_weights.iter().map(|w| w.exp()).collect(),
            from_now: plan.is_horizon(grid),
        });
        let mut classes = Self {
            dimensions: d,
            separable: separable && !destinations.kinds().iter().any(|kind| mixes(&kind.covariance)),
            nodes: nodes.collect(),
            ends: Vec::new(),
            classes: Vec::new(),
            priors: Vec::new(),
            order: None,
            count: destinations.len(),
            coordinates: Default::default(),
            variances: Default::default(),
        };
        let mut order = Vec::new();
        for ((nodes, end), drafts) in classes.drafts(destinations, plan) {
            let many = classes.separable && drafts.len() > 1;
            let mut pool: Vec<([f64; MOST], u32)> = Vec::new();
            for draft in drafts {
                if many && draft.members.len() < WIDTH {
                    pool.extend(draft.members.iter().map(|&i| (draft.size, i)));
                } else {
                    let members: Vec<_> = draft.members.iter().map(|&i| (draft.size, i)).collect();
                    classes.place(destinations, &members, &mut order, (nodes, end, Some(draft.size)));
                }
            }
            classes.place(destinations, &pool, &mut order, (nodes, end, None));
        }
        if classes.classes.iter().all(|class| class.size.is_some()) {
            classes.variances = Default::default();
        }
        let in_order = order.iter().take(destinations.len()).zip(0..).all(|(&i, place)| i == place);
        classes.order = (!in_order).then_some(order);
        let total: f64 = destinations.priors().iter().sum();
        classes.priors.as_flattened_mut().iter_mut().for_each(|prior| *prior /= total);
        classes
    }

    /// By nodes and endpoint, those of one size together.
    fn drafts(&mut self, destinations: &Destinations, plan: &Plan) -> Vec<((usize, usize), Vec<Draft>)> {
        let mut known_ends: HashMap<Vec<u64>, usize> = HashMap::new();
        let mut known: HashMap<(usize, usize), usize> = HashMap::new();
        let mut all: Vec<((usize, usize), Vec<Draft>)> = Vec::new();
        for group in &plan.groups {
            let covariance = &destinations.kinds()[group.kind].covariance;
            let mut members: Vec<(usize, Draft)> = Vec::new();
            let mut here: HashMap<Vec<u64>, usize> = HashMap::new();
            for &i in &group.members {
                let mean = destinations.mean(i as usize);
                let rest: Vec<u64> = mean[self.dimensions..].iter().map(|x| x.to_bits()).collect();
                let draft = *here.entry(rest).or_insert_with(|| {
                    let end = End::new(mean, covariance, self.dimensions, self.separable);
                    let number = *known_ends.entry(end.key()).or_insert_with(|| {
                        self.ends.push(end);
                        self.ends.len() - 1
                    });
                    let size = std::array::from_fn(|k| if k < self.dimensions { covariance[(k, k)] } else { 0.0 });
                    members.push((number, Draft { size, members: Vec::new() }));
                    members.len() - 1
                });
                members[draft].1.members.push(i);
            }
            for (end, draft) in members {
                let place = *known.entry((group.grid, end)).or_insert_with(|| {
                    all.push(((group.grid, end), Vec::new()));
                    all.len() - 1
                });
                all[place].1.push(draft);
            }
        }
        all
    }

    fn place(
        &mut self,
        destinations: &Destinations,
        members: &[([f64; MOST], u32)],
        order: &mut Vec<u32>,
        (nodes, end, size): (usize, usize, Option<[f64; MOST]>),
    ) {
        let start = self.priors.len();
        for chunk in members.chunks(WIDTH) {
            // a block is filled up with its first destination, at no weight
            let member = |lane: usize| chunk.get(lane).unwrap_or(&chunk[0]);
            for axis in 0..self.dimensions {
                let centre = |lane: usize| destinations.center(member(lane).1 as usize)[axis];
                self.coordinates[axis].push(std::array::from_fn(centre));
                self.variances[axis].push(std::array::from_fn(|lane| member(lane).0[axis]));
            }
            let prior = |lane: usize| chunk.get(lane).map_or(0.0, |&(_, i)| destinations.priors()[i as usize]);
            self.priors.push(std::array::from_fn(prior));
            order.extend((0..WIDTH).map(|lane| chunk.get(lane).map_or(NOBODY, |&(_, i)| i)));
        }
        if !members.is_empty() {
            self.classes.push(Class { nodes, end, size, blocks: start..self.priors.len() });
        }
    }

    /// The places of a class.
    pub fn places(&self, class: &Class, origin: [f64; AXES]) -> Places<'_> {
        let (coordinates, variances) = (cut(&self.coordinates, class), cut(&self.variances, class));
        Places { coordinates, variances, origin }
    }

    /// Takes what stands in the order of the arrays to the order of the destinations.
    pub fn scatter(&self, from: &[Block], into: &mut Vec<f64>) {
        into.resize(self.count, 0.0);
        match &self.order {
            None => into.copy_from_slice(&from.as_flattened()[..self.count]),
            Some(order) => {
                for (x, &i) in from.as_flattened().iter().zip(order) {
                    if let Some(place) = into.get_mut(i as usize) {
                        *place = *x;
                    }
                }
            }
        }
    }
}

/// The blocks of a class; none of the axes that there are not.
fn cut<'a>(lists: &'a [Vec<Block>; AXES], class: &Class) -> [&'a [Block]; AXES] {
    let of = |axis: usize| lists[axis].get(class.blocks.clone()).unwrap_or(&[]);
    [of(0), of(1), of(2)]
}
