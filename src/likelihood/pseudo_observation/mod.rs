//! `pseudoObservation` where the motion model does not know the destination, at the speed of the machine.
//!
//! The telescoped form of [`dense`] is the ratio of two Gaussian densities of the endpoint, so its
//! logarithm is a quadratic in the endpoint's mean whose coefficients depend on nothing but the node and the class of the
//! endpoint's covariance:
//!
//! ```text
//! p(D_i | y_1:k) ~ prior_i sum_n w_n N(a_i; m_n, V_n + S) / N(a_i; u_n, U_n + S)
//! ```
//!
//! | part | what |
//! |---|---|
//! | `candidate` | one noise candidate: a filter, by axis or whole |
//! | `separable` | the filters where axes do not mix |
//! | `axis_endpoint` | `m_n, V_n, u_n, U_n` there |
//! | `coupled` | both where they do |
//! | `classes` | the destinations in flat arrays |
//! | `coefficients` | the coefficients |
//! | `pruning` | what can add nothing, of very many destinations |
//! | `conversion` | from separate axes to the whole state and back |
//! | `math::kernel::mixture` | the sum |
//!
//! [`dense`] computes the same one pair at a time: the oracle, which a test compares this with.

pub(crate) mod axis_endpoint;
mod candidate;
pub(crate) mod classes;
pub(crate) mod coefficients;
mod conversion;
pub(crate) mod coupled;
pub mod dense;
pub(crate) mod pruning;
pub(crate) mod separable;

use super::Method;
use super::candidates::{Movement, advance_filter};
use super::plan::Plan;
use crate::error::Result;
use crate::math::gaussian::Gaussian;
use crate::math::kalman::{Filter, Measurement};
use crate::math::kernel::vectors::{Block, WIDTH};
use crate::model::destination::Destinations;
use crate::model::motion::MotionModels;
use candidate::{Candidate, Source, Tables};
use classes::{Class, Classes};
use coefficients::Work;
use conversion::{axes_of, coupled_of};
use coupled::Coupled;
use separable::MOST;
use std::sync::Arc;

/// A movement so far, with everything that turns it into probabilities.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use whither::{Gaussian, Scenario, likelihood::{plan::Plan, pseudo_observation::Telescoped}, scenario::Engine};
/// let scenario: Scenario = serde_json::from_str(r#"{
///     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
///     "arrival": { "type": "discrete", "times": [2], "weights": [1] },
///     "destinations": [{ "id": "there", "mean": [4], "covariance": [[3]] }]
/// }"#).unwrap();
/// let Engine::Papers { arrival, quadrature, .. } = &scenario.engine else { panic!() };
/// let plan = Plan::new(&scenario.destinations, arrival, quadrature, &[0.0]);
/// let first = Gaussian { mean: dvector![0.0], covariance: dmatrix![1.0] };
/// let mut movement = Telescoped::begin(&scenario.motion, &scenario.destinations, &plan, &first, true);
/// assert!(movement.is_separable() && movement.is_alive(1.9) && !movement.is_alive(2.1));
/// // one axis is seen, with the variance 1
/// assert!(movement.advance_separately(1.0, &[Some(3.0)], &[1.0; 3]));
/// assert_eq!(movement.observations(), 2);
/// ```
#[derive(Clone, Debug)]
pub struct Telescoped {
    candidates: Vec<Candidate>,
    classes: Arc<Classes>,
    /// `t_k - t_1`.
    elapsed: f64,
    /// `k`.
    observations: u64,
    /// Whether the first observation's evidence counts, as in [`Movement::first_counts`].
    first_counts: bool,
    /// A whole number near the logarithm of the weights' sum, for the probabilities as they stand.
    shift: f64,
    /// The same as the probabilities, once they were told, suggest it for the next observation.
    next_shift: f64,
    /// Room for the weights where destinations stand in another order than their own.
    aside: Vec<Block>,
    node_weights: Vec<Block>,
    work: Work,
}

/// The sum of the weights, as a power of two of the shift, must lie in here: then what is cut off at 960 is nothing beside it.
const IN_RANGE: std::ops::Range<f64> = 8.673_617_379_884_035e-19..1.152_921_504_606_847e18;

/// Probabilities below this are zero, so that the shift does not matter.
const LEAST: f64 = 1.5e-241;

impl Telescoped {
    /// A movement at its first observation, `first` being `p(x_1 | y_1)`. `separately` tells whether all that is observed
    /// concerns one axis at a time.
    #[must_use]
    pub fn begin(
        motion: &MotionModels,
        destinations: &Destinations,
        plan: &Plan,
        first: &Gaussian,
        separately: bool,
    ) -> Self {
        let filter = Filter::new(first, 1);
        Self::new(motion, destinations, plan, first, &vec![&filter; motion.candidates.len()], separately)
    }

    fn new(
        motion: &MotionModels,
        destinations: &Destinations,
        plan: &Plan,
        first: &Gaussian,
        filters: &[&Filter],
        separately: bool,
    ) -> Self {
        let each = || motion.candidates.iter().zip(filters);
        let axes = each().map(|(candidate, filter)| axes_of(candidate.model.as_ref(), first, filter)).collect();
        let axes: Option<Vec<_>> = if separately { axes } else { None };
        let classes = Arc::new(Classes::new(destinations, plan, axes.is_some()));
        let mut axes = axes.filter(|_| classes.separable).unwrap_or_default().into_iter();
        let candidates = each().map(|(candidate, filter)| Candidate {
            model: Arc::clone(&candidate.model),
            weight: candidate.weight,
            source: match axes.next() {
                Some((first, now)) => Source::Separable { first, now },
                None => Source::Coupled(Box::new(Coupled { first: first.clone(), filter: (*filter).clone() })),
            },
            tables: Tables::default(),
        });
        Self {
            candidates: candidates.collect(),
            aside: Vec::new(),
            classes,
            elapsed: 0.0,
            observations: 1,
            first_counts: false,
            shift: 0.0,
            next_shift: 0.0,
            node_weights: Vec::new(),
            work: Work::default(),
        }
    }

    /// The movement as it is before its first observation, as [`Movement::before_first_observation`].
    #[must_use]
    pub fn before_first_observation(self) -> Self {
        Self { first_counts: true, observations: 0, ..self }
    }

    /// Whether something has been observed that counts as evidence.
    const fn has_evidence(&self) -> bool {
        self.observations > if self.first_counts { 0 } else { 1 }
    }

    /// From now on the axes are taken together. Every candidate is separable, or none is.
    pub fn couple(&mut self, destinations: &Destinations, plan: &Plan) {
        for candidate in &mut self.candidates {
            if let Source::Separable { first, now } = &candidate.source {
                candidate.source = Source::Coupled(Box::new(coupled_of(first, now)));
            }
        }
        self.place(destinations, plan);
    }

    /// `t_k - t_1`.
    #[must_use]
    pub const fn elapsed(&self) -> f64 {
        self.elapsed
    }

    /// `k`, the number of observations.
    #[must_use]
    pub const fn observations(&self) -> u64 {
        self.observations
    }

    /// Whether some node with weight lies after `elapsed`.
    #[must_use]
    pub fn is_alive(&self, elapsed: f64) -> bool {
        self.classes.nodes.iter().any(|nodes| nodes.is_alive(elapsed))
    }

    /// Whether an observation can be taken axis by axis.
    #[must_use]
    pub fn is_separable(&self) -> bool {
        self.candidates.iter().all(|candidate| matches!(candidate.source, Source::Separable { .. }))
    }

    /// Takes in an observation whose noise is independent in each axis, `elapsed` seconds after the first one; none marks an
    /// axis that was not observed. It allocates nothing. False where the movement is not separable; nothing has changed then.
    pub fn advance_separately(&mut self, elapsed: f64, position: &[Option<f64>], variance: &[f64; MOST]) -> bool {
        if !self.is_separable() {
            return false;
        }
        for candidate in &mut self.candidates {
            if let Source::Separable { now, .. } = &mut candidate.source {
                now.advance(candidate.model.as_ref(), elapsed - self.elapsed, position, variance);
            }
        }
        self.elapsed = elapsed;
        self.observations += 1;
        self.shift = self.next_shift;
        true
    }

    /// Takes in any observation, `elapsed` seconds after the first one, once [`Telescoped::couple`] has been called or where
    /// the movement never was separable.
    ///
    /// # Errors
    /// As [`Movement::advance`]; nothing has changed then.
    pub fn advance(&mut self, elapsed: f64, measurement: &Measurement) -> Result<()> {
        let step = elapsed - self.elapsed;
        let mut advanced = Vec::with_capacity(self.candidates.len());
        for candidate in &self.candidates {
            advanced.push(match &candidate.source {
                Source::Separable { .. } => None,
                Source::Coupled(coupled) => {
                    Some(advance_filter(&coupled.filter, candidate.model.as_ref(), step, measurement)?)
                }
            });
        }
        for (candidate, filter) in self.candidates.iter_mut().zip(advanced) {
            if let (Source::Coupled(coupled), Some(filter)) = (&mut candidate.source, filter) {
                coupled.filter = filter;
            }
        }
        self.elapsed = elapsed;
        self.observations += 1;
        self.shift = self.next_shift;
        Ok(())
    }

    /// The same movement with the dense engines, which answer everything else that is asked about it.
    #[must_use]
    pub fn movement(&self, motion: &MotionModels, destinations: &Destinations, plan: Plan) -> Option<Movement> {
        let (first, _) = self.candidates.first()?.whole();
        let mut movement = Movement::begin(motion, Method::PseudoObservation, destinations, plan, first);
        for (world, candidate) in movement.worlds.iter_mut().zip(&self.candidates) {
            world.filter = candidate.whole().1;
        }
        movement.first_counts = self.first_counts;
        movement.elapsed = self.elapsed;
        movement.observations = self.observations;
        Some(movement)
    }

    /// A movement as it was when [`Telescoped::movement`] told it.
    #[must_use]
    pub fn resume(motion: &MotionModels, destinations: &Destinations, movement: &Movement, separately: bool) -> Self {
        let filters: Vec<&Filter> = movement.worlds.iter().map(|world| &world.filter).collect();
        let mut telescoped = Self::new(motion, destinations, &movement.plan, &movement.first, &filters, separately);
        telescoped.elapsed = movement.elapsed;
        telescoped.observations = movement.observations;
        telescoped.first_counts = movement.first_counts;
        telescoped
    }

    /// What the last bits of the probabilities depend on beside the movement, for a snapshot.
    #[must_use]
    pub const fn shifts(&self) -> [f64; 2] {
        [self.shift, self.next_shift]
    }

    /// Takes back what [`Telescoped::shifts`] gave.
    #[must_use]
    pub const fn with_shifts(mut self, [shift, next_shift]: [f64; 2]) -> Self {
        (self.shift, self.next_shift) = (shift, next_shift);
        self
    }

    /// Other destinations, in mid-movement. `separately` is as in [`Telescoped::begin`]: axes that had to be taken together
    /// for the destinations before may not have to for these.
    pub fn replan(&mut self, destinations: &Destinations, plan: &Plan, separately: bool) {
        if separately && !self.is_separable() {
            self.separate(destinations, plan);
        }
        self.place(destinations, plan);
    }

    /// From now on each axis on its own, if that can be.
    fn separate(&mut self, destinations: &Destinations, plan: &Plan) {
        let axes = self.candidates.iter().map(|candidate| match &candidate.source {
            Source::Coupled(coupled) => axes_of(candidate.model.as_ref(), &coupled.first, &coupled.filter),
            Source::Separable { first, now } => Some((*first, *now)),
        });
        let Some(axes) = axes.collect::<Option<Vec<_>>>() else { return };
        if !Classes::new(destinations, plan, true).separable {
            return;
        }
        for (candidate, (first, now)) in self.candidates.iter_mut().zip(axes) {
            candidate.source = Source::Separable { first, now };
        }
    }

    fn place(&mut self, destinations: &Destinations, plan: &Plan) {
        self.shift = self.next_shift;
        self.classes = Arc::new(Classes::new(destinations, plan, self.is_separable()));
        if self.is_separable() && !self.classes.separable {
            return self.couple(destinations, plan);
        }
        for candidate in &mut self.candidates {
            candidate.tables = Tables::default();
        }
    }

    /// Liang (3) and (6): the probabilities of the destinations, in their order, and that of none of them, whose prior is
    /// `none`. None where the priors stand: at the first observation, and where there is no likelihood that is a number above
    /// zero. `destinations` are those that the movement began with or was last told.
    pub fn probabilities(&mut self, destinations: &Destinations, none: f64, into: &mut Vec<f64>) -> Option<f64> {
        if !self.has_evidence() {
            return None;
        }
        let (classes, mut aside) = (Arc::clone(&self.classes), std::mem::take(&mut self.aside));
        let sum = self.sum(destinations, &classes, classes.layout.room(&mut aside, into));
        classes.layout.settle(&aside, into);
        self.aside = aside;
        let sum = sum?;
        // what it would be if the priors that were weighed summed to one
        let total = sum / classes.total;
        // against it "none", whose ratio of densities is one, under the same shift
        let (scale, none) = if none > 0.0 {
            let level = (none / (1.0 - none)).log2() + self.log2_level();
            let log = level - self.shift - total.log2();
            ((1.0 + exp2(log)).recip(), (1.0 + exp2(-log)).recip())
        } else {
            (1.0, 0.0)
        };
        let beyond = total.log2().round();
        self.next_shift = self.shift + if beyond.abs() > 8.0 { beyond } else { 0.0 };
        let (scale, least) = (scale / sum, LEAST * sum);
        into.iter_mut().for_each(|p| *p = if *p > least { *p * scale } else { 0.0 });
        Some(none)
    }

    /// Writes the weights, and returns their sum.
    fn sum(&mut self, destinations: &Destinations, classes: &Classes, weights: &mut [Block]) -> Option<f64> {
        let mut sum = self.weigh(destinations, classes, weights);
        if !IN_RANGE.contains(&(sum / classes.total)) {
            self.log2_sums(destinations, classes, weights);
            let weighed = weights.as_flattened().iter().zip(classes.priors(destinations).as_flattened());
            let top = weighed.filter(|(_, prior)| **prior > 0.0).map(|(log, prior)| log + prior.log2());
            let top = top.fold(f64::NEG_INFINITY, f64::max) - classes.total.log2();
            if !top.is_finite() {
                return None;
            }
            self.shift = top.round();
            sum = self.weigh(destinations, classes, weights);
        }
        (sum > 0.0 && sum.is_finite()).then_some(sum)
    }

    /// `ln p(y_2:k | y_1, D_i)` for every destination, in their order; `destinations` as in [`Telescoped::probabilities`].
    pub fn log_likelihoods(&mut self, destinations: &Destinations, into: &mut Vec<f64>) {
        let (classes, mut aside) = (Arc::clone(&self.classes), std::mem::take(&mut self.aside));
        let logs = classes.layout.room(&mut aside, into);
        logs.fill([0.0; WIDTH]);
        if self.has_evidence() {
            self.log2_sums(destinations, &classes, logs);
        }
        classes.layout.settle(&aside, into);
        self.aside = aside;
        let evidence = self.candidates.first().map_or(0.0, Candidate::log_evidence);
        for log in into {
            let whole = *log * std::f64::consts::LN_2 + evidence;
            // beyond what numbers can tell, nothing is known
            *log = if whole < f64::INFINITY { whole } else { f64::NEG_INFINITY };
        }
    }

    /// The sum of the candidates' weights times what their evidence has over that of the first one, as a power of two.
    fn log2_level(&self) -> f64 {
        let top = self.candidates.iter().map(|candidate| self.lead(candidate)).fold(f64::NEG_INFINITY, f64::max);
        let each = self.candidates.iter().map(|candidate| candidate.weight * exp2(self.lead(candidate) - top));
        top + each.sum::<f64>().log2()
    }

    /// What a candidate's evidence has over that of the first one, as a power of two.
    fn lead(&self, candidate: &Candidate) -> f64 {
        let first = self.candidates.first().map_or(0.0, Candidate::log_evidence);
        (candidate.log_evidence() - first) * std::f64::consts::LOG2_E
    }

    fn weigh(&mut self, destinations: &Destinations, classes: &Classes, weights: &mut [Block]) -> f64 {
        let origin = self.candidates.first().map_or([0.0; 3], Candidate::position);
        let mut total = 0.0;
        let mut seen = None;
        for class in &classes.classes {
            if seen != Some((class.nodes, class.end)) {
                self.see(classes, class);
                seen = Some((class.nodes, class.end));
            }
            total += self.work.weigh(destinations, classes, class, origin, self.shift, weights);
        }
        total
    }

    fn log2_sums(&mut self, destinations: &Destinations, classes: &Classes, logs: &mut [Block]) {
        let mut seen = None;
        for class in &classes.classes {
            if seen != Some((class.nodes, class.end)) {
                self.see(classes, class);
                seen = Some((class.nodes, class.end));
            }
            self.work.log2_sums(destinations, classes, class, logs);
        }
    }

    /// Prepares the terms of a class: what every candidate sees of its endpoint.
    fn see(&mut self, classes: &Classes, class: &Class) {
        let (Some(nodes), Some(end)) = (classes.nodes.get(class.nodes), classes.ends.get(class.end)) else { return };
        let elapsed = self.elapsed;
        nodes.weights_ahead(elapsed, &mut self.node_weights);
        self.work.clear();
        let evidence = self.candidates.first().map_or(0.0, Candidate::log_evidence);
        for candidate in &mut self.candidates {
            let lead = (candidate.log_evidence() - evidence) * std::f64::consts::LOG2_E;
            candidate.see(class.nodes, nodes, end, elapsed, &self.node_weights, lead, &mut self.work);
        }
    }
}

/// `2^x`. The standard library's has a table of 4 kB.
fn exp2(x: f64) -> f64 {
    (x * std::f64::consts::LN_2).exp()
}
