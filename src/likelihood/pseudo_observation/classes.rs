//! The destinations as flat arrays, by class: those that share their arrival nodes and the covariance of their endpoint.

use super::pruning::{BoundingBox, MANY, arrange, bounding_boxes};
use crate::likelihood::configuration::Configuration;
use crate::likelihood::plan::Plan;
use crate::math::quadrature::Quadrature;
use crate::math::radix_sort::radix_sort;
use crate::model::arrival::Arrival;
use crate::model::destination::Destinations;
use fnv::FnvHashMap;
use nalgebra::DMatrix;
use std::array::from_fn;
use std::ops::Range;
use std::sync::{Arc, OnceLock};
use whither_kernel::axes::MOST;
use whither_kernel::coupled::Endpoint;
use whither_kernel::endpoints::AxisEndpoint;
use whither_kernel::layout::{FEW, Layout};
use whither_kernel::mixture::AXES;
use whither_kernel::vectors::{Block, WIDTH};

/// The sum of the weights, as a power of two of the shift, must lie in here: then what is cut off at 960 is negligible.
pub const IN_RANGE: Range<f64> = 8.673_617_379_884_035e-19..1.152_921_504_606_847e18;

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
    fn new(rest: Vec<f64>, mut covariance: DMatrix<f64>, d: usize, separable: bool) -> Self {
        if !separable {
            return Self { rest, covariance, axes: None };
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
        for i in 0..d {
            covariance[(i, i)] = 0.0;
        }
        Self { rest, covariance, axes: Some(axes) }
    }

    /// The endpoint where axes mix.
    pub fn complete(&self) -> Endpoint<'_> {
        let dimensions = self.covariance.nrows() - self.rest.len();
        Endpoint { dimensions, rest: &self.rest, covariance: self.covariance.as_slice() }
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

/// Destinations of one size, endpoint and nodes.
struct Draft {
    /// Which nodes and endpoint, a number of its own for each pair of them.
    family: usize,
    nodes: usize,
    endpoint: usize,
    size: [f64; MOST],
    /// The destinations, as places in a list of all.
    members: Range<usize>,
}

/// The classes for all movements among the same destinations, of joint axes and of separate ones, each made for the first movement
/// that needs them.
type KeptClasses = [OnceLock<ClassesFor>; 2];

/// Classes, with what they depend on besides the destinations.
#[derive(Debug)]
struct ClassesFor {
    arrival: Arrival,
    quadrature: Quadrature,
    classes: Arc<Classes>,
}

impl Classes {
    /// The classes for a movement among `destinations`, which are kept with them unless the nodes depend on where it begins.
    /// `separable` as in [`Classes::new`].
    pub fn of(destinations: &Destinations, configuration: &Configuration, separable: bool) -> Arc<Self> {
        let Configuration { arrival, quadrature, .. } = configuration;
        let [joint, separate] = &*destinations.kept(KeptClasses::default);
        let place = if separable { separate } else { joint };
        let holds = |kept: &&ClassesFor| kept.arrival == *arrival && kept.quadrature == *quadrature;
        if let Some(kept) = place.get().filter(holds) {
            return Arc::clone(&kept.classes);
        }
        let plan = configuration.plan(destinations);
        let classes = Arc::new(Self::new(destinations, &plan, separable));
        if !plan.depends_on_start {
            let (arrival, quadrature) = (arrival.clone(), quadrature.clone());
            // without effect where those for another scenario are kept
            let _ = place.set(ClassesFor { arrival, quadrature, classes: Arc::clone(&classes) });
        }
        classes
    }

    /// The classes of `destinations` with the nodes of `plan`. `separable` is whether axes are to be taken separately, which
    /// they cannot be where some endpoint mixes them.
    fn new(destinations: &Destinations, plan: &Plan, separable: bool) -> Self {
        let d = destinations.dimensions();
        let nodes = plan.grids.iter().enumerate().map(|(grid, nodes)| Nodes {
            times: nodes.times.clone(),
            weights: nodes.log_weights.iter().map(|w| w.exp()).collect(),
            from_now: plan.is_horizon(grid),
            possible: plan.is_possible(grid),
        });
        let mut classes = Self {
            dimensions: d,
            separable: separable && !destinations.classes().iter().any(|class| class.mixes_axes(d)),
            nodes: nodes.collect(),
            endpoints: Vec::new(),
            classes: Vec::new(),
            priors: Vec::new(),
            total: destinations.priors().iter().sum(),
            layout: Layout::default(),
        };
        let mut order = plan.members.members().to_vec();
        let drafts = classes.drafts(destinations, plan, &mut order);
        let mut families: Vec<(u64, u32)> = drafts.iter().map(|draft| draft.family as u64).zip(0..).collect();
        radix_sort(&mut families);
        for family in families.chunk_by(|one, other| one.0 == other.0) {
            let many = classes.separable && family.len() > 1;
            let mut pool = Vec::new();
            for draft in family.iter().map(|(_, draft)| &drafts[*draft as usize]) {
                let members = &mut order[draft.members.clone()];
                if many && members.len() < FEW {
                    pool.extend_from_slice(members);
                } else {
                    if classes.separable && members.len() >= MANY {
                        arrange(destinations, members);
                    }
                    classes.place(members, draft, Some(draft.size));
                }
            }
            if let Some((_, draft)) = family.first() {
                classes.place(&pool, &drafts[*draft as usize], None);
            }
        }
        let coordinate = |i: usize, axis: usize| destinations.position(i)[axis];
        let variance = |i: usize, axis| destinations.class(i).variance(axis, axis);
        classes.layout.finish((destinations.len(), d), &coordinate, &variance);
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

    /// Those of one size, endpoint and nodes together; `order` has the members of the plan, and afterwards theirs.
    fn drafts(&mut self, destinations: &Destinations, plan: &Plan, order: &mut [u32]) -> Vec<Draft> {
        let (mut endpoints, mut families) = (Numbers::default(), Numbers::default());
        let mut drafts: Vec<Draft> = Vec::with_capacity(plan.groups.len());
        let mut class_before = None;
        for (g, group) in plan.groups.iter().enumerate() {
            let class = &destinations.classes()[group.class];
            let mut start = plan.members.range(g).start;
            let members = &mut order[plan.members.range(g)];
            // a box has its centre alone
            let is_box = class.size().is_some();
            if !is_box {
                bring_together(destinations, members);
            }
            for part in members.chunk_by(|&i, &j| is_box || rest_bits(destinations, i).eq(rest_bits(destinations, j))) {
                // most are like the one before, which is sooner compared than looked up
                let is_resized = self.separable && class_before.is_some_and(|before| class.is_resized(before));
                let endpoint = match drafts.last() {
                    Some(before) if is_resized => before.endpoint,
                    _ => self.endpoint(destinations, part[0] as usize, &mut endpoints),
                };
                let family = match drafts.last() {
                    Some(before) if (before.nodes, before.endpoint) == (group.grid, endpoint) => before.family,
                    _ => number(vec![group.grid as u64, endpoint as u64], &mut families),
                };
                let size = from_fn(|k| if k < self.dimensions { class.variance(k, k) } else { 0.0 });
                let end = start + part.len();
                drafts.push(Draft { family, nodes: group.grid, endpoint, size, members: start..end });
                (class_before, start) = (Some(class), end);
            }
        }
        drafts
    }

    /// The number of the endpoint of destination `i`, by all its numbers, bit by bit.
    fn endpoint(&mut self, destinations: &Destinations, i: usize, known: &mut Numbers) -> usize {
        let class = destinations.class(i);
        let mut rest = destinations.rest(i).to_vec();
        rest.resize(class.length() - self.dimensions, 0.0);
        let endpoint = ClassEndpoint::new(rest, class.covariance(), self.dimensions, self.separable);
        let number = number(endpoint.key(), known);
        if number == self.endpoints.len() {
            if number == 0 {
                // mostly there is no other, and a list begins with room for four
                self.endpoints.reserve_exact(1);
            }
            self.endpoints.push(endpoint);
        }
        number
    }

    fn place(&mut self, members: &[u32], draft: &Draft, size: Option<[f64; MOST]>) {
        let blocks = self.layout.place(members, size.is_none());
        if !members.is_empty() {
            let Draft { nodes, endpoint, .. } = *draft;
            self.classes.push(Class { nodes, endpoint, size, blocks, boxes: Vec::new() });
        }
    }
}

fn rest_bits(destinations: &Destinations, i: u32) -> impl Iterator<Item = u64> {
    destinations.rest(i as usize).iter().map(|x| x.to_bits())
}

/// Puts those together whose endpoints have the same mean after the position, in the order of the first of each.
fn bring_together(destinations: &Destinations, members: &mut [u32]) {
    let mut known = Numbers::default();
    let number = |&i: &u32| (number(rest_bits(destinations, i).collect(), &mut known) as u64, i);
    let mut numbered: Vec<(u64, u32)> = members.iter().map(number).collect();
    radix_sort(&mut numbered);
    members.iter_mut().zip(numbered).for_each(|(member, (_, i))| *member = i);
}

/// The numbers of keys, in the order in which they came.
type Numbers = FnvHashMap<Vec<u64>, usize>;

fn number(key: Vec<u64>, known: &mut Numbers) -> usize {
    let count = known.len();
    *known.entry(key).or_insert(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scenario;
    use crate::likelihood::Method;
    use crate::scenario::Setup;
    use serde_json::{Value as Json, json};

    fn scenario(arrival: &Json) -> Scenario {
        let place =
            |i: usize| json!({ "id": format!("d{i}"), "center": [100 * i], "size": 10 + i % 2, "prior": 1 + i });
        let json = json!({
            "motion": { "type": "constantVelocity", "dimensions": 1, "noise": 90 }, "observation": { "noise": 1 },
            "arrival": arrival, "quadrature": { "points": 3 }, "destinations": (0..20).map(place).collect::<Vec<_>>(),
        });
        serde_json::from_value(json).unwrap()
    }

    fn configuration(scenario: &Scenario, start: f64) -> Configuration {
        let Setup::Papers { arrival, quadrature, .. } = &scenario.setup else { panic!() };
        Configuration {
            motion: scenario.motion.clone(),
            method: Method::PseudoObservation,
            arrival: arrival.clone(),
            quadrature: quadrature.clone(),
            observes_position: true,
            first_counts: false,
            start: vec![start],
        }
    }

    #[test]
    fn what_no_movement_changes_is_made_once() {
        let scenario = scenario(&json!({ "type": "uniform", "from": 1, "to": 2 }));
        let (here, there) = (configuration(&scenario, 0.0), configuration(&scenario, 500.0));
        let destinations = &*scenario.destinations;
        let separate = Classes::of(destinations, &here, true);
        let joint = Classes::of(destinations, &here, false);
        assert!(separate.separable && !joint.separable);
        assert!(Arc::ptr_eq(&separate, &Classes::of(destinations, &there, true)));
        assert!(Arc::ptr_eq(&joint, &Classes::of(destinations, &there, false)));
        let learnt = destinations.clone().with_priors(vec![0.5; 20]);
        let others = Classes::of(&learnt, &here, true);
        assert_ne!(others.priors, separate.priors);
        assert!(Arc::ptr_eq(&separate, &Classes::of(destinations, &here, true)));
    }

    #[test]
    fn the_nodes_of_another_scenario_or_start_are_its_own() {
        let uniform = scenario(&json!({ "type": "uniform", "from": 1, "to": 2 }));
        let destinations = &*uniform.destinations;
        let times =
            |configuration: &Configuration| Classes::of(destinations, configuration, true).nodes[0].times.clone();
        assert_eq!(times(&configuration(&uniform, 0.0)), [1.0, 1.5, 2.0]);
        let later = scenario(&json!({ "type": "horizon", "from": 3, "to": 5 }));
        assert_eq!(times(&configuration(&later, 0.0)), [3.0, 4.0, 5.0]);
        let fitts = scenario(&json!({ "type": "fitts", "intercept": 0.2, "slope": 0.1, "spread": 0.3 }));
        let median = |start: f64| times(&configuration(&fitts, start))[1];
        assert!((median(0.0) - 0.2).abs() < 1e-12, "no distance, no difficulty");
        assert!((median(70.0) - 0.5).abs() < 1e-12, "three bits");
        assert_eq!(times(&configuration(&uniform, 0.0)), [1.0, 1.5, 2.0]);
    }
}
