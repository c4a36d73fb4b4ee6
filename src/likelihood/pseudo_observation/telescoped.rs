//! The telescoped form of Liang (11)'s product for all destinations at once: the filters, and the sums over nodes. [`super::dense`]
//! computes the same one pair at a time.

use super::candidate::{Candidate, Source, Tables};
use super::classes::{Class, Classes, IN_RANGE};
use super::coefficients::Work;
use super::conversion::{axes_of, coupled_of};
use super::coupled::Coupled;
use crate::engine::Observed;
use crate::error::Result;
use crate::likelihood::configuration::Configuration;
use crate::likelihood::filter_bank::{FilterBank, advance_filter};
use crate::math::gaussian::Gaussian;
use crate::math::kalman::Filter;
use crate::model::destination::Destinations;
use crate::value::{Node, Value};
use std::sync::Arc;
use whither_kernel::axes::MOST;
use whither_kernel::vectors::{Block, WIDTH, exponent, scale_above};

/// The filters of one movement so far, with everything that turns them into probabilities.
#[derive(Clone, Debug)]
pub(crate) struct Telescoped {
    candidates: Vec<Candidate>,
    classes: Arc<Classes>,
    /// `t_k - t_1`.
    elapsed: f64,
    /// `k`.
    observations: u64,
    /// Whether the first observation's evidence counts, as in [`FilterBank::first_counts`].
    first_counts: bool,
    /// An integer near the logarithm of the weights' sum, for the probabilities after this observation.
    shift: f64,
    /// The same as the probabilities, once computed, suggest it for the next observation.
    next_shift: f64,
    /// A buffer for the weights where the arrays have another order than the destinations.
    aside: Vec<Block>,
    work: Work,
}

/// Probabilities below this are zero, so that the shift does not matter.
const LEAST: f64 = 1.5e-241;

impl Telescoped {
    /// Filters with `p(x_1 | y_1)`, or with `p(x_1)` where the first observation's evidence counts, as [`FilterBank::begin`].
    pub fn begin(configuration: &Configuration, destinations: &Destinations, first: &Gaussian) -> Self {
        let filter = Filter::new(first, 1);
        let filters = vec![&filter; configuration.motion.candidates.len()];
        Self::new(configuration, destinations, first, &filters)
    }

    fn new(configuration: &Configuration, destinations: &Destinations, first: &Gaussian, filters: &[&Filter]) -> Self {
        let each = || configuration.motion.candidates.iter().zip(filters);
        let axes = each().map(|(candidate, filter)| axes_of(candidate.model.as_ref(), first, filter)).collect();
        let axes: Option<Vec<_>> = if configuration.observes_position { axes } else { None };
        let classes = Classes::of(destinations, configuration, axes.is_some());
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
            observations: u64::from(!configuration.first_counts),
            first_counts: configuration.first_counts,
            shift: 0.0,
            next_shift: 0.0,
            work: Work::default(),
        }
    }

    /// Whether something has been observed that counts as evidence.
    fn has_evidence(&self) -> bool {
        self.observations > u64::from(!self.first_counts)
    }

    /// `t_k - t_1`.
    pub const fn elapsed(&self) -> f64 {
        self.elapsed
    }

    /// `k`, the number of observations.
    pub const fn observations(&self) -> u64 {
        self.observations
    }

    /// Whether some node with weight lies after `elapsed`.
    pub fn is_alive(&self, elapsed: f64) -> bool {
        self.classes.nodes.iter().any(|nodes| nodes.is_alive(elapsed))
    }

    /// Whether an observation can be taken axis by axis.
    pub fn is_separable(&self) -> bool {
        self.candidates.iter().all(|candidate| matches!(candidate.source, Source::Separable { .. }))
    }

    /// Takes in an observation, which allocates nothing as long as axes are separate.
    ///
    /// # Errors
    /// As [`FilterBank::advance`]; nothing has changed then.
    pub fn advance(
        &mut self,
        configuration: &Configuration,
        destinations: &Destinations,
        observed: &Observed<'_>,
    ) -> Result<()> {
        let step = observed.elapsed - self.elapsed;
        if let Some(variances) = variances(observed).filter(|_| self.is_separable()) {
            for candidate in &mut self.candidates {
                if let Source::Separable { now, .. } = &mut candidate.source {
                    let model = candidate.model.as_ref();
                    now.advance(&|axis| model.axis(axis, step), observed.position, &variances);
                }
            }
        } else {
            if self.is_separable() {
                self.couple(configuration, destinations);
            }
            let measurement = observed.measurement()?;
            let advance = |candidate: &Candidate| match &candidate.source {
                Source::Separable { .. } => Ok(None),
                Source::Coupled(coupled) => {
                    advance_filter(&coupled.filter, candidate.model.as_ref(), step, &measurement).map(Some)
                }
            };
            let advanced = self.candidates.iter().map(advance).collect::<Result<Vec<_>>>()?;
            for (candidate, filter) in self.candidates.iter_mut().zip(advanced) {
                if let (Source::Coupled(coupled), Some(filter)) = (&mut candidate.source, filter) {
                    coupled.filter = filter;
                }
            }
        }
        self.elapsed = observed.elapsed;
        self.observations += 1;
        self.shift = self.next_shift;
        Ok(())
    }

    /// The same filters densely, for everything but likelihoods.
    pub fn dense(&self, configuration: &Configuration, destinations: &Destinations) -> Option<FilterBank> {
        let first = self.candidates.first()?.coupled().first;
        let mut bank = FilterBank::begin(configuration, destinations, first);
        for (to, candidate) in bank.candidates.iter_mut().zip(&self.candidates) {
            to.filter = candidate.coupled().filter;
        }
        bank.elapsed = self.elapsed;
        bank.observations = self.observations;
        Some(bank)
    }

    /// What a snapshot keeps: the filters densely, and what the last bits of the probabilities depend on besides.
    pub fn save(&self, configuration: &Configuration, destinations: &Destinations) -> Value {
        let filters = self.dense(configuration, destinations).map_or(Value::Null, |bank| bank.save());
        Value::map([("filters", filters), ("shifts", Value::exact_numbers(&[self.shift, self.next_shift]))])
    }

    /// The filters that [`Telescoped::save`] wrote.
    ///
    /// # Errors
    /// Those of reading a value.
    pub fn load(node: &Node<'_>, configuration: &Configuration, destinations: &Destinations) -> Result<Self> {
        let fields = node.fields(&["filters", "shifts"])?;
        let bank = FilterBank::load(&fields.required("filters")?, configuration, destinations)?;
        let shifts = fields.required("shifts")?.exact_numbers(2)?;
        let filters: Vec<&Filter> = bank.candidates.iter().map(|candidate| &candidate.filter).collect();
        Ok(Self {
            elapsed: bank.elapsed,
            observations: bank.observations,
            shift: shifts[0],
            next_shift: shifts[1],
            ..Self::new(configuration, destinations, &bank.first, &filters)
        })
    }

    /// Other destinations, in mid-movement: axes that had to be taken together for those before may not have to for these.
    pub fn replan(&mut self, configuration: &Configuration, destinations: &Destinations) {
        if configuration.observes_position && !self.is_separable() {
            self.separate(configuration, destinations);
        }
        self.place(configuration, destinations);
    }

    /// From now on the axes are taken together. Every candidate is separable, or none is.
    fn couple(&mut self, configuration: &Configuration, destinations: &Destinations) {
        for candidate in &mut self.candidates {
            if let Source::Separable { first, now } = &candidate.source {
                candidate.source = Source::Coupled(Box::new(coupled_of(first, now)));
            }
        }
        self.place(configuration, destinations);
    }

    /// From now on each axis on its own, if that can be.
    fn separate(&mut self, configuration: &Configuration, destinations: &Destinations) {
        let axes = self.candidates.iter().map(|candidate| match &candidate.source {
            Source::Coupled(coupled) => axes_of(candidate.model.as_ref(), &coupled.first, &coupled.filter),
            Source::Separable { first, now } => Some((*first, *now)),
        });
        let Some(axes) = axes.collect::<Option<Vec<_>>>() else { return };
        if !Classes::of(destinations, configuration, true).separable {
            return;
        }
        for (candidate, (first, now)) in self.candidates.iter_mut().zip(axes) {
            candidate.source = Source::Separable { first, now };
        }
    }

    fn place(&mut self, configuration: &Configuration, destinations: &Destinations) {
        self.shift = self.next_shift;
        self.classes = Classes::of(destinations, configuration, self.is_separable());
        if self.is_separable() && !self.classes.separable {
            return self.couple(configuration, destinations);
        }
        for candidate in &mut self.candidates {
            candidate.tables = Tables::default();
        }
    }

    /// Liang (3) and (6): the probabilities of the destinations, in their order, and that of none of them, whose prior is
    /// `none`. None where the priors remain: at the first observation, and where there is no likelihood that is a number above
    /// zero.
    pub fn probabilities(&mut self, none: f64, into: &mut Vec<f64>) -> Option<f64> {
        if !self.has_evidence() {
            return None;
        }
        let (classes, mut aside) = (Arc::clone(&self.classes), std::mem::take(&mut self.aside));
        let sum = self.sum(&classes, classes.layout.buffer(&mut aside, into));
        classes.layout.scatter(&aside, into);
        self.aside = aside;
        let sum = sum?;
        // as if the priors summed to one
        let total = sum / classes.total;
        // against it "none", whose ratio of densities is one, under the same shift
        let (scale, none) = if none > 0.0 {
            let level = (none / (1.0 - none)).log2() + self.log2_level();
            let log = level - self.shift - total.log2();
            ((1.0 + exp2(log)).recip(), (1.0 + exp2(-log)).recip())
        } else {
            (1.0, 0.0)
        };
        let beyond = exponent(total);
        self.next_shift = self.shift + if beyond.abs() > 8.0 { beyond } else { 0.0 };
        scale_above(into, LEAST * sum, scale / sum);
        Some(none)
    }

    /// Writes the weights, under another shift where the present one leads out of range, and returns their sum.
    fn sum(&mut self, classes: &Classes, weights: &mut [Block]) -> Option<f64> {
        let mut sum = self.weights(classes, weights);
        if !IN_RANGE.contains(&(sum / classes.total)) {
            self.log2_sums(classes, weights);
            let logs = weights.as_flattened().iter().zip(classes.priors.as_flattened());
            let top = logs.filter(|(_, prior)| **prior > 0.0).map(|(log, prior)| log + prior.log2());
            let top = top.fold(f64::NEG_INFINITY, f64::max) - classes.total.log2();
            if !top.is_finite() {
                return None;
            }
            self.shift = top.round_ties_even();
            sum = self.weights(classes, weights);
        }
        (sum > 0.0 && sum.is_finite()).then_some(sum)
    }

    /// `ln p(y_2:k | y_1, D_i)` for every destination, in their order.
    pub fn log_likelihoods(&mut self, into: &mut Vec<f64>) {
        let (classes, mut aside) = (Arc::clone(&self.classes), std::mem::take(&mut self.aside));
        let logs = classes.layout.buffer(&mut aside, into);
        logs.fill([0.0; WIDTH]);
        if self.has_evidence() {
            self.log2_sums(&classes, logs);
        }
        classes.layout.scatter(&aside, into);
        self.aside = aside;
        let evidence = self.candidates.first().map_or(0.0, Candidate::log_evidence);
        for log in into {
            let sum = *log * std::f64::consts::LN_2 + evidence;
            // beyond the range of numbers, nothing is known
            *log = if sum < f64::INFINITY { sum } else { f64::NEG_INFINITY };
        }
    }

    /// The logarithm to base 2 of the candidates' mean evidence over that of the first one.
    fn log2_level(&self) -> f64 {
        let top = self.candidates.iter().map(|candidate| self.lead(candidate)).fold(f64::NEG_INFINITY, f64::max);
        let each = self.candidates.iter().map(|candidate| candidate.weight * exp2(self.lead(candidate) - top));
        top + each.sum::<f64>().log2()
    }

    /// The logarithm to base 2 of a candidate's evidence over that of the first one.
    fn lead(&self, candidate: &Candidate) -> f64 {
        let first = self.candidates.first().map_or(0.0, Candidate::log_evidence);
        (candidate.log_evidence() - first) * std::f64::consts::LOG2_E
    }

    /// Writes the weights under the present shift, and returns their sum.
    fn weights(&mut self, classes: &Classes, weights: &mut [Block]) -> f64 {
        let origin = self.candidates.first().map_or([0.0; 3], Candidate::position);
        let mut total = 0.0;
        let mut prepared = None;
        for class in &classes.classes {
            if prepared != Some((class.nodes, class.endpoint)) {
                self.prepare(classes, class);
                prepared = Some((class.nodes, class.endpoint));
            }
            total += self.work.weighted_sums(classes, class, origin, self.shift, weights);
        }
        total
    }

    fn log2_sums(&mut self, classes: &Classes, logs: &mut [Block]) {
        let mut prepared = None;
        for class in &classes.classes {
            if prepared != Some((class.nodes, class.endpoint)) {
                self.prepare(classes, class);
                prepared = Some((class.nodes, class.endpoint));
            }
            self.work.log2_sums(classes, class, logs);
        }
    }

    /// Computes the terms of a class under every candidate.
    fn prepare(&mut self, classes: &Classes, class: &Class) {
        let (Some(nodes), Some(endpoint)) = (classes.nodes.get(class.nodes), classes.endpoints.get(class.endpoint))
        else {
            return;
        };
        let elapsed = self.elapsed;
        self.work.clear();
        let evidence = self.candidates.first().map_or(0.0, Candidate::log_evidence);
        for candidate in &mut self.candidates {
            let lead = (candidate.log_evidence() - evidence) * std::f64::consts::LOG2_E;
            candidate.prepare(class.nodes, nodes, endpoint, elapsed, lead, &mut self.work);
        }
    }
}

/// `2^x`. The standard library's has a table of 4 kB.
fn exp2(x: f64) -> f64 {
    (x * std::f64::consts::LN_2).exp()
}

/// The variances in each axis, where the noise of each that was observed is its own.
fn variances(observed: &Observed<'_>) -> Option<[f64; MOST]> {
    let (noise, n) = (observed.noise.as_slice(), observed.noise.nrows());
    if n > MOST {
        return None;
    }
    let is_observed = |i: usize| observed.position.get(i).is_some_and(Option::is_some);
    let mut variances = [0.0; MOST];
    for i in 0..n {
        variances[i] = noise[i * n + i];
        for j in 0..i {
            if noise[i * n + j] != 0.0 && is_observed(i) && is_observed(j) {
                return None;
            }
        }
    }
    Some(variances)
}
