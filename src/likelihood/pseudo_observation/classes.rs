//! The destinations as flat arrays, by class: those that share their arrival nodes and the covariance of their endpoint.

use super::pruning::{BoundingBox, MANY, arrange, bounding_boxes};
use crate::likelihood::plan::Plan;
use crate::model::destination::Destinations;
use fnv::FnvHashMap;
use nalgebra::DMatrix;
use std::ops::Range;
use whither_kernel::axes::MOST;
use whither_kernel::endpoints::AxisEndpoint;
use whither_kernel::layout::{FEW, Layout};
use whither_kernel::mixture::AXES;
use whither_kernel::vectors::{Block, WIDTH};

/// The sum of the weights, as a power of two of the shift, must lie in here: then what is cut off at 960 is negligible.
pub const IN_RANGE: std::ops::Range<f64> = 8.673_617_379_884_035e-19..1.152_921_504_606_847e18;

/// Arrival nodes of a class.
#[derive(Clone, Debug)]
pub struct Nodes {
    /// `T - t_1`, or the time to go.
    pub times: Vec<f64>,
    /// Their prior probabilities.
    pub weights: Vec<f64>,
    /// Whether the times count from now.
    pub from_now: bool,
    /// Whether some destination that has them has a prior above zero.
    pub possible: bool,
}

impl Nodes {
    /// Whether some node with weight, of a destination with one, lies after `elapsed`.
    pub fn is_alive(&self, elapsed: f64) -> bool {
        let mut nodes = self.times.iter().zip(&self.weights);
        self.possible && nodes.any(|(&time, &weight)| weight > 0.0 && (self.from_now || time > elapsed))
    }

    /// The weights in blocks, zero for the nodes that have passed at `elapsed`.
    pub fn weights_ahead(&self, elapsed: f64, into: &mut Vec<Block>) {
        into.clear();
        into.resize(self.times.len().div_ceil(WIDTH), [0.0; WIDTH]);
        let places = into.as_flattened_mut().iter_mut();
        for ((place, time), weight) in places.zip(&self.times).zip(&self.weights) {
            if self.from_now || time - elapsed > 0.0 {
                *place = *weight;
            }
        }
    }
}

/// The endpoint of a class, apart from the position's mean.
#[derive(Clone, Debug, PartialEq)]
pub struct ClassEndpoint {
    /// The means of the components after the position.
    pub rest: Vec<f64>,
    /// The covariance `S_i`; where axes are separate without the position's own variances, which each class, or each
    /// destination, adds.
    pub covariance: DMatrix<f64>,
    /// The same for each axis, where axes are separate.
    pub axes: Option<[AxisEndpoint; MOST]>,
}

impl ClassEndpoint {
    fn new(rest: &[f64], covariance: &DMatrix<f64>, d: usize, separable: bool) -> Self {
        if !separable {
            return Self { rest: rest.to_vec(), covariance: covariance.clone(), axes: None };
        }
        let length = d + rest.len();
        let mut axes = [AxisEndpoint::default(); MOST];
        for (axis, endpoint) in axes.iter_mut().enumerate().take(d) {
            for i in (axis..length).step_by(d) {
                endpoint.length += 1;
                if i >= d {
                    endpoint.mean[i / d] = rest[i - d];
                }
                for j in (axis..length).step_by(d) {
                    if i >= d || j >= d {
                        endpoint.covariance[i / d][j / d] = covariance[(i, j)];
                    }
                }
            }
        }
        for k in 0..d {
            axes[k].alike = axes[k].length == axes[0].length && axes[k].covariance == axes[0].covariance;
        }
        let mut covariance = covariance.clone();
        for i in 0..d {
            covariance[(i, i)] = 0.0;
        }
        Self { rest: rest.to_vec(), covariance, axes: Some(axes) }
    }

    fn key(&self) -> Vec<u64> {
        let numbers = self.rest.iter().chain(self.covariance.iter());
        std::iter::once(self.covariance.nrows() as u64).chain(numbers.map(|x| x.to_bits())).collect()
    }
}

/// Destinations that follow one another in the arrays.
#[derive(Clone, Debug)]
pub struct Class {
    /// Which nodes.
    pub nodes: usize,
    /// Which endpoint.
    pub endpoint: usize,
    /// The position's variances in each axis where all have the same; none where each has its own.
    pub size: Option<[f64; MOST]>,
    /// Where they are.
    pub blocks: Range<usize>,
    /// The same in parts that lie together, where they are many.
    pub boxes: Vec<BoundingBox>,
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
    pub endpoints: Vec<ClassEndpoint>,
    /// The classes; those that share nodes and endpoint follow one another.
    pub classes: Vec<Class>,
    /// Prior weights, zero in padding.
    pub priors: Vec<Block>,
    /// What the prior weights sum to.
    pub total: f64,
    /// The order of the destinations in the arrays, and their places.
    pub layout: Layout,
}

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
            possible: plan.is_possible(grid),
        });
        let mut classes = Self {
            dimensions: d,
            separable: separable && !destinations.classes().iter().any(|class| mixes(&class.covariance())),
            nodes: nodes.collect(),
            endpoints: Vec::new(),
            classes: Vec::new(),
            priors: Vec::new(),
            total: destinations.priors().iter().sum(),
            layout: Layout::default(),
        };
        for ((nodes, endpoint), drafts) in classes.drafts(destinations, plan) {
            let many = classes.separable && drafts.len() > 1;
            let mut pool = Vec::new();
            for mut draft in drafts {
                if many && draft.members.len() < FEW {
                    pool.extend(draft.members);
                } else {
                    if classes.separable && draft.members.len() >= MANY {
                        arrange(destinations, &mut draft.members);
                    }
                    classes.place(&draft.members, (nodes, endpoint, Some(draft.size)));
                }
            }
            classes.place(&pool, (nodes, endpoint, None));
        }
        classes.layout.finish((destinations.len(), d), &|i, axis| destinations.center(i)[axis], &|i, axis| {
            destinations.class(i).variance(axis, axis)
        });
        classes.gather_priors(destinations);
        if classes.separable {
            let mut all = std::mem::take(&mut classes.classes);
            for class in all.iter_mut().filter(|class| class.size.is_some()) {
                let places = classes.layout.places(&class.blocks, [0.0; AXES]);
                class.boxes = bounding_boxes(&places, &class.blocks, &classes.priors[class.blocks.clone()]);
            }
            classes.classes = all;
        }
        classes
    }

    /// Gathers the prior weights, normalised unless they are in the order of the destinations and leave room for the rest of a
    /// product as they are.
    fn gather_priors(&mut self, destinations: &Destinations) {
        let total = if self.layout.keeps_order() && IN_RANGE.contains(&self.total) {
            1.0
        } else {
            std::mem::replace(&mut self.total, 1.0)
        };
        let priors = destinations.priors();
        self.priors = self.layout.gather(&|i, is_member| if is_member { priors[i] / total } else { 0.0 });
    }

    /// By nodes and endpoint, those of one size together.
    fn drafts(&mut self, destinations: &Destinations, plan: &Plan) -> Vec<((usize, usize), Vec<Draft>)> {
        let (mut known_endpoints, mut known) = (FnvHashMap::default(), FnvHashMap::default());
        let mut all: Vec<((usize, usize), Vec<Draft>)> = Vec::new();
        for group in &plan.groups {
            let covariance = &destinations.classes()[group.class].covariance();
            let mut members: Vec<(usize, Draft)> = Vec::new();
            let mut here = FnvHashMap::default();
            for &i in &group.members {
                let rest = destinations.rest(i as usize);
                let key: Vec<u64> = rest.iter().map(|x| x.to_bits()).collect();
                let draft = *here.entry(key).or_insert(members.len());
                if draft == members.len() {
                    let endpoint = ClassEndpoint::new(&rest, covariance, self.dimensions, self.separable);
                    let number = *known_endpoints.entry(endpoint.key()).or_insert(self.endpoints.len());
                    if number == self.endpoints.len() {
                        self.endpoints.push(endpoint);
                    }
                    let size = std::array::from_fn(|k| if k < self.dimensions { covariance[(k, k)] } else { 0.0 });
                    members.push((number, Draft { size, members: Vec::new() }));
                }
                members[draft].1.members.push(i);
            }
            for (endpoint, draft) in members {
                let place = *known.entry((group.grid, endpoint)).or_insert(all.len());
                if place == all.len() {
                    all.push(((group.grid, endpoint), Vec::new()));
                }
                all[place].1.push(draft);
            }
        }
        all
    }

    fn place(&mut self, members: &[u32], (nodes, endpoint, size): (usize, usize, Option<[f64; MOST]>)) {
        let blocks = self.layout.place(members, size.is_none());
        if !members.is_empty() {
            self.classes.push(Class { nodes, endpoint, size, blocks, boxes: Vec::new() });
        }
    }
}
