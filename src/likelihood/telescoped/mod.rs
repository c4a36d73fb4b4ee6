//! `pseudoObservation` where the motion model does not know the destination, at the speed of the machine.
//!
//! The telescoped form of [`super::pseudo_observation`] is the ratio of two Gaussian densities of the endpoint, so its
//! logarithm is a quadratic in the endpoint's mean whose coefficients depend on nothing but the node and the class of the
//! endpoint's covariance:
//!
//! ```text
//! p(D_i | y_1:k) ~ prior_i sum_n w_n N(a_i; m_n, V_n + S) / N(a_i; u_n, U_n + S)
//! ```
//!
//! | part | what |
//! |---|---|
//! | `separable` | the filters, `m_n, V_n, u_n, U_n` where axes do not mix |
//! | `coupled` | the same where they do |
//! | `classes` | the destinations in flat arrays |
//! | `terms` | the coefficients |
//! | `math::mixture` | the sum |
//!
//! [`super::pseudo_observation`] says the same densely, one pair at a time; a test holds the two together.

pub(crate) mod classes;
pub(crate) mod coupled;
pub(crate) mod separable;
pub(crate) mod terms;

use super::Method;
use super::candidates::{Movement, advance_filter};
use super::plan::Plan;
use crate::error::Result;
use crate::math::gaussian::Gaussian;
use crate::math::kalman::{Filter, Measurement};
use crate::math::lanes::{Block, WIDTH};
use crate::math::mixture::AXES;
use crate::model::destination::Destinations;
use crate::model::motion::{Motion, MotionModel, Transition};
use classes::{Class, Classes, End, Nodes};
use coupled::Coupled;
use nalgebra::{DMatrix, DVector};
use separable::{Axes, AxisEnd, MOST, NodeTable};
use std::sync::Arc;
use terms::{Sight, Work};

/// The movement under one noise candidate.
#[derive(Clone, Debug)]
struct Candidate {
    model: Arc<dyn MotionModel>,
    /// `w_c`.
    weight: f64,
    source: Source,
    tables: Tables,
}

#[derive(Clone, Debug)]
enum Source {
    Separable(Box<Axes>),
    Coupled(Box<Coupled>),
}

/// Steps to the nodes, kept as long as they stay the same.
#[derive(Clone, Debug, Default)]
struct Tables {
    now: StepsTo,
    start: StepsTo,
}

#[derive(Clone, Debug, Default)]
struct StepsTo {
    /// Which nodes, and how much of their time had passed.
    of: Option<(usize, u64)>,
    axes: [NodeTable; MOST],
    whole: Vec<Transition>,
}

/// A movement so far, with everything that turns it into probabilities.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use whither::{Gaussian, Scenario, likelihood::{plan::Plan, telescoped::Telescoped}, scenario::Engine};
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
    /// A whole number near the logarithm of the weights' sum.
    shift: f64,
    weights: Vec<Block>,
    node_weights: Vec<Block>,
    node_weights_of: Option<usize>,
    work: Work,
}

/// The sum of the weights, as a power of two of the shift, must lie in here: then what is cut off at 960 is nothing beside it.
const IN_RANGE: std::ops::Range<f64> = 8.673_617_379_884_035e-19..1.152_921_504_606_847e18;

/// The exponent of a normal number.
const fn exponent_of(x: f64) -> f64 {
    ((x.to_bits() >> 52) & 0x7ff) as f64 - 1023.0
}

/// Probabilities below this are zero, so that the shift does not matter.
const LEAST: f64 = 1.5e-241;

impl Telescoped {
    /// A movement at its first observation, `first` being `p(x_1 | y_1)`. `separately` tells whether all that is observed
    /// concerns one axis at a time.
    #[must_use]
    pub fn begin(
        motion: &Motion,
        destinations: &Destinations,
        plan: &Plan,
        first: &Gaussian,
        separately: bool,
    ) -> Self {
        let filter = Filter::new(first, 1);
        Self::new(motion, destinations, plan, first, &vec![&filter; motion.candidates.len()], separately)
    }

    fn new(
        motion: &Motion,
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
                Some(axes) => Source::Separable(Box::new(axes)),
                None => Source::Coupled(Box::new(Coupled { first: first.clone(), filter: (*filter).clone() })),
            },
            tables: Tables::default(),
        });
        Self {
            candidates: candidates.collect(),
            weights: vec![[0.0; WIDTH]; classes.priors.len()],
            classes,
            elapsed: 0.0,
            observations: 1,
            shift: 0.0,
            node_weights: Vec::new(),
            node_weights_of: None,
            work: Work::default(),
        }
    }

    /// From now on the axes are taken together. Every candidate is separable, or none is.
    pub fn couple(&mut self, destinations: &Destinations, plan: &Plan) {
        for candidate in &mut self.candidates {
            if let Source::Separable(axes) = &candidate.source {
                candidate.source = Source::Coupled(Box::new(coupled_of(axes)));
            }
        }
        self.replan(destinations, plan);
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
        self.candidates.iter().all(|candidate| matches!(candidate.source, Source::Separable(_)))
    }

    /// Takes in an observation whose noise is independent in each axis, `elapsed` seconds after the first one; none marks an
    /// axis that was not observed. It allocates nothing. False where the movement is not separable; nothing has changed then.
    pub fn advance_separately(&mut self, elapsed: f64, position: &[Option<f64>], variance: &[f64; MOST]) -> bool {
        if !self.is_separable() {
            return false;
        }
        for candidate in &mut self.candidates {
            if let Source::Separable(axes) = &mut candidate.source {
                axes.advance(candidate.model.as_ref(), elapsed - self.elapsed, position, variance);
            }
        }
        self.elapsed = elapsed;
        self.observations += 1;
        true
    }

    /// Takes in any observation, `elapsed` seconds after the first one, once [`Telescoped::couple`] has been called or where
    /// the movement never was separable.
    ///
    /// # Errors
    /// As [`Movement::advance`]; nothing has changed then.
    pub fn advance(&mut self, elapsed: f64, measurement: &Measurement) -> Result<()> {
        let step = elapsed - self.elapsed;
        let advanced = self.candidates.iter().map(|candidate| match &candidate.source {
            Source::Separable(_) => Ok(None),
            Source::Coupled(coupled) => {
                advance_filter(&coupled.filter, candidate.model.as_ref(), step, measurement).map(Some)
            }
        });
        let advanced = advanced.collect::<Result<Vec<_>>>()?;
        for (candidate, filter) in self.candidates.iter_mut().zip(advanced) {
            if let (Source::Coupled(coupled), Some(filter)) = (&mut candidate.source, filter) {
                coupled.filter = filter;
            }
        }
        self.elapsed = elapsed;
        self.observations += 1;
        Ok(())
    }

    /// The same movement with the dense engines, which answer everything else that is asked about it.
    #[must_use]
    pub fn movement(&self, motion: &Motion, destinations: &Destinations, plan: Plan) -> Option<Movement> {
        let (first, _) = self.candidates.first()?.whole();
        let mut movement = Movement::begin(motion, Method::PseudoObservation, destinations, plan, first);
        for (world, candidate) in movement.worlds.iter_mut().zip(&self.candidates) {
            world.filter = candidate.whole().1;
        }
        movement.elapsed = self.elapsed;
        movement.observations = self.observations;
        Some(movement)
    }

    /// A movement as it was when [`Telescoped::movement`] told it.
    #[must_use]
    pub fn resume(motion: &Motion, destinations: &Destinations, movement: &Movement, separately: bool) -> Self {
        let filters: Vec<&Filter> = movement.worlds.iter().map(|world| &world.filter).collect();
        let mut telescoped = Self::new(motion, destinations, &movement.plan, &movement.first, &filters, separately);
        telescoped.elapsed = movement.elapsed;
        telescoped.observations = movement.observations;
        telescoped
    }

    /// Other destinations, in mid-movement.
    pub fn replan(&mut self, destinations: &Destinations, plan: &Plan) {
        self.classes = Arc::new(Classes::new(destinations, plan, self.is_separable()));
        if self.is_separable() && !self.classes.separable {
            return self.couple(destinations, plan);
        }
        self.weights.clear();
        self.weights.resize(self.classes.priors.len(), [0.0; WIDTH]);
        self.node_weights_of = None;
        for candidate in &mut self.candidates {
            candidate.tables = Tables::default();
        }
    }

    /// Liang (3) and (6): the probabilities of the destinations, in their order, and that of none of them, whose prior is
    /// `none`. None where there is no likelihood that is a number above zero.
    pub fn probabilities(&mut self, none: f64, into: &mut Vec<f64>) -> Option<f64> {
        if self.observations < 2 {
            self.classes.scatter(&self.classes.priors, into);
            into.iter_mut().for_each(|p| *p *= 1.0 - none);
            return Some(none);
        }
        let mut total = self.weigh();
        if !IN_RANGE.contains(&total) {
            let mut logs = std::mem::take(&mut self.weights);
            self.log2_sums(&mut logs);
            let weighed = logs.as_flattened().iter().zip(self.classes.priors.as_flattened());
            let top = weighed.filter(|(_, prior)| **prior > 0.0).map(|(log, prior)| log + prior.log2());
            let top = top.fold(f64::NEG_INFINITY, f64::max);
            self.weights = logs;
            if !top.is_finite() {
                return None;
            }
            self.shift = top.round();
            total = self.weigh();
        }
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        let (scale, none) = self.against_none(none, total);
        let (scale, least) = (scale / total, LEAST * total);
        self.classes.scatter(&self.weights, into);
        for p in into.iter_mut() {
            *p = if *p > least { *p * scale } else { 0.0 };
        }
        let beyond = exponent_of(total);
        if beyond.abs() > 8.0 {
            self.shift += beyond;
        }
        Some(none)
    }

    /// `ln p(y_2:k | y_1, D_i)` for every destination, in their order.
    pub fn log_likelihoods(&mut self, into: &mut Vec<f64>) {
        let mut logs = vec![[0.0; WIDTH]; self.weights.len()];
        if self.observations > 1 {
            self.log2_sums(&mut logs);
        }
        self.classes.scatter(&logs, into);
        let evidence = self.candidates.first().map_or(0.0, Candidate::log_evidence);
        into.iter_mut().for_each(|log| *log = *log * std::f64::consts::LN_2 + evidence);
    }

    /// The shares of the destinations, whose weights sum to `total`, and of none of them, whose ratio of densities is one,
    /// under the same shift.
    fn against_none(&self, none: f64, total: f64) -> (f64, f64) {
        if none <= 0.0 {
            return (1.0, 0.0);
        }
        let each = self.candidates.iter().map(|candidate| candidate.weight * self.lead(candidate).exp2());
        let others = none / (1.0 - none) * each.sum::<f64>();
        let log = others.log2() - self.shift - total.log2();
        ((1.0 + log.exp2()).recip(), (1.0 + (-log).exp2()).recip())
    }

    /// What a candidate's evidence has over that of the first one, as a power of two.
    fn lead(&self, candidate: &Candidate) -> f64 {
        let first = self.candidates.first().map_or(0.0, Candidate::log_evidence);
        (candidate.log_evidence() - first) * std::f64::consts::LOG2_E
    }

    fn weigh(&mut self) -> f64 {
        let classes = Arc::clone(&self.classes);
        let origin = self.candidates.first().map_or([0.0; 3], Candidate::position);
        let mut total = 0.0;
        let mut seen = None;
        for class in &classes.classes {
            if seen != Some((class.nodes, class.end)) {
                self.see(&classes, class);
                seen = Some((class.nodes, class.end));
            }
            total += self.work.weigh(&classes, class, origin, self.shift, &mut self.weights);
        }
        total
    }

    fn log2_sums(&mut self, logs: &mut [Block]) {
        let classes = Arc::clone(&self.classes);
        let mut seen = None;
        for class in &classes.classes {
            if seen != Some((class.nodes, class.end)) {
                self.see(&classes, class);
                seen = Some((class.nodes, class.end));
            }
            self.work.log2_sums(&classes, class, logs);
        }
    }

    /// Prepares the terms of a class: what every candidate sees of its endpoint.
    fn see(&mut self, classes: &Classes, class: &Class) {
        let (Some(nodes), Some(end)) = (classes.nodes.get(class.nodes), classes.ends.get(class.end)) else { return };
        let elapsed = self.elapsed;
        if !nodes.from_now || self.node_weights_of != Some(class.nodes) {
            nodes.weights_ahead(elapsed, &mut self.node_weights);
            self.node_weights_of = Some(class.nodes);
        }
        self.work.clear();
        let evidence = self.candidates.first().map_or(0.0, Candidate::log_evidence);
        for candidate in &mut self.candidates {
            let lead = (candidate.log_evidence() - evidence) * std::f64::consts::LOG2_E;
            candidate.see(class.nodes, nodes, end, elapsed, &self.node_weights, lead, &mut self.work);
        }
    }
}

impl Candidate {
    fn log_evidence(&self) -> f64 {
        match &self.source {
            Source::Separable(axes) => axes.log_evidence,
            Source::Coupled(coupled) => coupled.filter.evidence(0),
        }
    }

    /// `p(x_1 | y_1)` and the filter, of the whole state.
    fn whole(&self) -> (Gaussian, Filter) {
        match &self.source {
            Source::Separable(axes) => {
                let Coupled { first, filter } = coupled_of(axes);
                (first, filter)
            }
            Source::Coupled(coupled) => (coupled.first.clone(), coupled.filter.clone()),
        }
    }

    /// The position now.
    fn position(&self) -> [f64; AXES] {
        match &self.source {
            Source::Separable(axes) => std::array::from_fn(|k| axes.filters[k].now.mean[0]),
            Source::Coupled(coupled) => {
                let s = coupled.filter.states;
                std::array::from_fn(|k| if k < s { coupled.filter.means[(s + k, 0)] } else { 0.0 })
            }
        }
    }

    #[expect(clippy::too_many_arguments, reason = "one caller, which owns what is borrowed here")]
    fn see(
        &mut self,
        number: usize,
        nodes: &Nodes,
        end: &End,
        elapsed: f64,
        weights: &[Block],
        lead: f64,
        work: &mut Work,
    ) {
        let model = self.model.as_ref();
        let Tables { now: to_now, start: to_start } = &mut self.tables;
        // nodes that count from now are as far from now as from where the start's prediction has come to by then
        let passed = if nodes.from_now { 0.0 } else { elapsed };
        match &self.source {
            Source::Separable(now) => {
                let Some(ends) = &end.axes else { return };
                to_now.fill_axes(model, now, number, ends, nodes, passed);
                let foreseen;
                let (start, start_tables) = if nodes.from_now {
                    foreseen = now.foresee(model, elapsed);
                    (&foreseen, &to_now.axes)
                } else {
                    to_start.fill_axes(model, now, number, ends, nodes, 0.0);
                    (&now.start, &to_start.axes)
                };
                let weight = self.weight;
                work.see(&Sight { now, start, tables: &to_now.axes, start_tables, weights, weight, lead }, ends);
            }
            Source::Coupled(coupled) => {
                to_now.fill_whole(model, number, nodes, passed);
                let start = if nodes.from_now {
                    coupled.foresee(model, elapsed)
                } else {
                    to_start.fill_whole(model, number, nodes, 0.0);
                    coupled.first.clone()
                };
                let start_steps = if nodes.from_now { &to_now.whole } else { &to_start.whole };
                let now = coupled.now();
                let steps = to_now.whole.iter().zip(start_steps).zip(weights.as_flattened());
                for ((step, start_step), weight) in steps.filter(|(_, weight)| **weight > 0.0) {
                    let factor = self.weight * weight;
                    let d = model.dimensions();
                    let term = coupled::ellipsoid((&now, step), (&start, start_step), end, factor, lead, d);
                    work.ellipsoids.extend(term);
                }
            }
        }
    }
}

impl StepsTo {
    fn is(&mut self, number: usize, passed: f64) -> bool {
        let of = Some((number, passed.to_bits()));
        std::mem::replace(&mut self.of, of) == of
    }

    fn fill_axes(
        &mut self,
        model: &dyn MotionModel,
        axes: &Axes,
        number: usize,
        ends: &[AxisEnd; MOST],
        nodes: &Nodes,
        passed: f64,
    ) {
        let length = ends.iter().map(|end| end.length).max().unwrap_or(1);
        if self.is(number, passed) && self.axes[0].length() >= length {
            return;
        }
        for axis in (0..axes.dimensions).filter(|&axis| axis == 0 || !axes.alike[axis]) {
            let length = length.min(axes.filters[axis].states);
            self.axes[axis].fill(model, axis, length, &nodes.times, passed);
        }
    }

    fn fill_whole(&mut self, model: &dyn MotionModel, number: usize, nodes: &Nodes, passed: f64) {
        if self.is(number, passed) {
            return;
        }
        self.whole.clear();
        self.whole.extend(nodes.times.iter().map(|time| model.transition((time - passed).max(0.0))));
    }
}

/// The filter of the whole state from those of separate axes.
fn coupled_of(axes: &Axes) -> Coupled {
    let d = axes.dimensions;
    let s = axes.filters.iter().take(d).map(|filter| filter.states).sum();
    let mut first = Gaussian { mean: DVector::zeros(s), covariance: DMatrix::zeros(s, s) };
    let mut filter = Filter::new(&first, 1);
    filter.log_evidence = vec![axes.log_evidence];
    for (axis, (of, start)) in axes.filters.iter().zip(&axes.start).enumerate().take(d) {
        let n = of.states;
        for i in 0..n {
            let row = i * d + axis;
            filter.means[(row, 0)] = of.first_mean[i];
            filter.means[(s + row, 0)] = of.now.mean[i];
            first.mean[row] = start.mean[i];
            for j in 0..n {
                first.covariance[(row, j * d + axis)] = start.covariance[i][j];
            }
        }
        for i in 0..2 * n {
            for j in 0..2 * n {
                filter.root[(row_of(i, n, axis, d, s), row_of(j, n, axis, d, s))] = of.root[i][j];
            }
        }
    }
    Coupled { first, filter }
}

/// Where a row of an axis's root stands in that of the whole state; both have the first state first.
fn row_of(i: usize, states: usize, axis: usize, d: usize, s: usize) -> usize {
    if i < states { i * d + axis } else { s + (i - states) * d + axis }
}

/// The filters of separate axes from that of the whole state; none where the model or the state mixes axes.
fn axes_of(model: &dyn MotionModel, first: &Gaussian, filter: &Filter) -> Option<Axes> {
    let mut axes = Axes::new(model)?;
    let (d, s) = (axes.dimensions, filter.states);
    let mixes = |i: usize, j: usize| i % s % d != j % s % d && filter.root[(i, j)] != 0.0;
    if !filter.root.iter().all(|x| x.is_finite()) || (0..2 * s).any(|i| (0..2 * s).any(|j| mixes(i, j))) {
        return None;
    }
    for (axis, (of, start)) in axes.filters.iter_mut().zip(&mut axes.start).enumerate().take(d) {
        let n = of.states;
        for i in 0..n {
            let row = i * d + axis;
            of.first_mean[i] = filter.means[(row, 0)];
            of.now.mean[i] = filter.means[(s + row, 0)];
            start.mean[i] = first.mean[row];
            for j in 0..n {
                start.covariance[i][j] = first.covariance[(row, j * d + axis)];
            }
        }
        for i in 0..2 * n {
            for j in 0..2 * n {
                of.root[i][j] = filter.root[(row_of(i, n, axis, d, s), row_of(j, n, axis, d, s))];
            }
        }
        of.square();
    }
    axes.log_evidence = *filter.log_evidence.first()?;
    Some(axes)
}
