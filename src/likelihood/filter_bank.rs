//! One movement under every noise candidate: a bank of filters.
//!
//! Each candidate has its filter and its method's accumulators; their likelihoods are averaged by evidence (Bayesian model
//! averaging), `p(y_2:k | y_1, D_i, T) = sum_c w_c p(y_2:k | y_1, D_i, T, c)`.

use super::configuration::Configuration;
use super::plan::Plan;
use super::states::{StateQuery, States};
use super::{Likelihood, NodeOfGroup, Scene, Step};
use crate::error::{Code, Error, Result};
use crate::math::gaussian::Gaussian;
use crate::math::kalman::{Filter, Measurement, TimeUpdate};
use crate::math::log_sum_exp::log_sum_exp;
use crate::model::destination::Destinations;
use crate::model::motion::{MotionModel, Transition};
use crate::value::{Node, Value};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// The filter and the likelihoods under one noise candidate.
#[derive(Debug)]
pub(crate) struct Candidate {
    /// `ln w_c`.
    pub log_weight: f64,
    /// The motion model with this noise.
    pub model: Arc<dyn MotionModel>,
    /// Its Kalman posterior.
    pub filter: Filter,
    likelihood: Box<dyn Likelihood>,
}

impl Clone for Candidate {
    fn clone(&self) -> Self {
        Self {
            log_weight: self.log_weight,
            model: Arc::clone(&self.model),
            filter: self.filter.clone(),
            likelihood: self.likelihood.boxed(),
        }
    }
}

/// The filters of one movement so far.
#[derive(Clone, Debug)]
pub(crate) struct FilterBank {
    /// The arrival nodes.
    pub plan: Plan,
    /// `p(x_1 | y_1)`; `p(x_1)` where the first observation's evidence counts.
    pub first: Gaussian,
    /// Whether the first observation's evidence counts: likelihoods are of `y_1:k`, not of `y_2:k` given `y_1`.
    pub first_counts: bool,
    /// One for each noise candidate.
    pub candidates: Vec<Candidate>,
    /// `t_k - t_1`.
    pub elapsed: f64,
    /// `k`, the number of observations.
    pub observations: u64,
}

impl FilterBank {
    /// The filters with `p(x_1 | y_1)` at the first observation. Where its evidence counts, `first` is `p(x_1)`, and
    /// [`FilterBank::advance`] takes the first observation in, no time having passed: so `p(y_1 | D_i, T)` of Liang (5) counts.
    pub fn begin(configuration: &Configuration, destinations: &Destinations, first: Gaussian) -> Self {
        let Configuration { motion, method, first_counts, .. } = configuration;
        let columns = if motion.depends_on_destination() { destinations.len() } else { 1 };
        let candidates = motion.candidates.iter().map(|candidate| Candidate {
            log_weight: candidate.weight.ln(),
            model: Arc::clone(&candidate.model),
            filter: Filter::new(&first, columns),
            likelihood: method.likelihood(),
        });
        let mut bank = Self {
            plan: configuration.plan(destinations),
            candidates: candidates.collect(),
            first,
            first_counts: *first_counts,
            elapsed: 0.0,
            observations: u64::from(!first_counts),
        };
        bank.each_likelihood(destinations, |likelihood, scene| {
            likelihood.begin(scene);
            Ok(())
        })
        .unwrap_or_default();
        bank
    }

    /// Whether something has been observed that counts as evidence.
    fn has_evidence(&self) -> bool {
        self.observations > u64::from(!self.first_counts)
    }

    /// Acts on every (group, node) pair that has not passed.
    pub(crate) fn each_node(&self, destinations: &Destinations, mut act: impl FnMut(&NodeOfGroup<'_>)) {
        let Some(candidate) = self.candidates.first() else { return };
        let scene = self.scene(candidate, destinations);
        scene.nodes_ahead(self.elapsed).for_each(|node| act(&node));
    }

    /// The states `later` seconds after `now` under noise candidate `c`, given `node` and each of `members`; the likelihoods
    /// are those of these filters.
    pub(crate) fn states(
        &self,
        now: &Self,
        destinations: &Destinations,
        c: usize,
        node: &NodeOfGroup<'_>,
        members: &[usize],
        later: f64,
    ) -> Option<States> {
        let (candidate, latest) = (self.candidates.get(c)?, now.candidates.get(c)?);
        let (evidence, now) = (self.scene(candidate, destinations), now.scene(latest, destinations));
        candidate.likelihood.states(&StateQuery { now, evidence, node, members, later })
    }

    fn scene<'a>(&'a self, candidate: &'a Candidate, destinations: &'a Destinations) -> Scene<'a> {
        Scene {
            motion: candidate.model.as_ref(),
            destinations,
            plan: &self.plan,
            first: &self.first,
            filter: &candidate.filter,
            elapsed: self.elapsed,
        }
    }

    fn each_likelihood(
        &mut self,
        destinations: &Destinations,
        mut act: impl FnMut(&mut dyn Likelihood, &Scene<'_>) -> Result<()>,
    ) -> Result<()> {
        for Candidate { model, filter, likelihood, .. } in &mut self.candidates {
            let scene = Scene {
                motion: model.as_ref(),
                destinations,
                plan: &self.plan,
                first: &self.first,
                filter,
                elapsed: self.elapsed,
            };
            act(likelihood.as_mut(), &scene)?;
        }
        Ok(())
    }

    /// Takes an observation in, `elapsed` seconds after the first one.
    ///
    /// # Errors
    /// `out-of-range` where the numbers grow beyond what can be computed with (a drift that explodes); nothing has changed
    /// then.
    pub fn advance(&mut self, destinations: &Destinations, elapsed: f64, measurement: &Measurement) -> Result<()> {
        let mut steps = Vec::with_capacity(self.candidates.len());
        for candidate in &self.candidates {
            let transition = candidate.model.transition(elapsed - self.elapsed);
            let mut predicted = candidate.filter.clone();
            predicted.predict(&TimeUpdate {
                transition: &transition.transition,
                offsets: &offsets(&transition, destinations, predicted.means.ncols()),
                noise: &transition.noise,
            });
            let corrected = correct(predicted.clone(), measurement)?;
            steps.push((transition, predicted, corrected));
        }
        let elapsed_before = std::mem::replace(&mut self.elapsed, elapsed);
        self.observations += 1;
        for (Candidate { model, filter, likelihood, .. }, (transition, predicted, corrected)) in
            self.candidates.iter_mut().zip(steps)
        {
            let before = std::mem::replace(filter, corrected);
            let scene =
                Scene { motion: model.as_ref(), destinations, plan: &self.plan, first: &self.first, filter, elapsed };
            let step =
                Step { before: &before, predicted: &predicted, transition: &transition, measurement, elapsed_before };
            likelihood.advance(&scene, &step);
        }
        Ok(())
    }

    /// For each noise candidate `ln w_c + log p(y_2:k, T_n | y_1, D_i, c)`, laid out as [`Plan::rows`] is.
    pub fn joint(&self, destinations: &Destinations) -> Vec<Vec<f64>> {
        let joint = |candidate: &Candidate| {
            let mut table = vec![0.0; self.plan.rows.last().copied().unwrap_or(0)];
            if self.has_evidence() {
                candidate.likelihood.log_likelihoods(&self.scene(candidate, destinations), &mut table);
            }
            for i in 0..self.plan.grid_of.len() {
                let row = &mut table[self.plan.rows[i]..self.plan.rows[i + 1]];
                for (value, log_prior) in row.iter_mut().zip(&self.plan.grid(i).log_weights) {
                    *value += candidate.log_weight + log_prior;
                    if value.is_nan() {
                        *value = f64::NEG_INFINITY;
                    }
                }
            }
            table
        };
        self.candidates.iter().map(joint).collect()
    }

    /// `log p(y_2:k | y_1)` where the object is going to none of them: the ratio of the telescoped form is one. A motion
    /// model that knows the destination is averaged over the destinations' centres by their priors.
    pub fn log_evidence_of_none(&self, priors: &[f64]) -> f64 {
        let total: f64 = priors.iter().sum();
        let mut terms = Vec::new();
        for candidate in &self.candidates {
            let evidence = &candidate.filter.log_evidence;
            if evidence.len() == 1 {
                terms.push(candidate.log_weight + evidence[0]);
            } else {
                let each = evidence.iter().zip(priors);
                terms.extend(each.map(|(evidence, prior)| candidate.log_weight + evidence + (prior / total).ln()));
            }
        }
        log_sum_exp(&terms)
    }

    /// Other destinations in mid-movement, where nothing is accumulated for each of them: `origin` holds which old one each
    /// new one was, where the motion model knows the destination.
    pub fn replan(&mut self, plan: Plan, origin: Option<&[usize]>) {
        self.plan = plan;
        let Some(origin) = origin else { return };
        for candidate in &mut self.candidates {
            let filter = &mut candidate.filter;
            filter.means = filter.means.select_columns(origin);
            filter.log_evidence = origin.iter().map(|&i| filter.log_evidence[i]).collect();
        }
    }

    /// What a snapshot keeps.
    pub fn save(&self) -> Value {
        let matrix = |m: &DMatrix<f64>| Value::exact_numbers(m.iter());
        let candidates = self.candidates.iter().map(|candidate| {
            Value::map([
                ("means", matrix(&candidate.filter.means)),
                ("root", matrix(&candidate.filter.root)),
                ("evidence", Value::exact_numbers(&candidate.filter.log_evidence)),
                ("accumulated", candidate.likelihood.save()),
            ])
        });
        Value::map([
            ("elapsed", Value::exact(self.elapsed)),
            ("observations", Value::Number(self.observations as f64)),
            ("firstMean", Value::exact_numbers(self.first.mean.iter())),
            ("firstCovariance", matrix(&self.first.covariance)),
            ("candidates", Value::List(candidates.collect())),
        ])
    }

    /// The filters that [`FilterBank::save`] wrote.
    ///
    /// # Errors
    /// Those of reading a value.
    pub fn load(node: &Node<'_>, configuration: &Configuration, destinations: &Destinations) -> Result<Self> {
        let fields = node.fields(&["elapsed", "observations", "firstMean", "firstCovariance", "candidates"])?;
        let s = configuration.motion.states();
        let first = Gaussian {
            mean: DVector::from_vec(fields.required("firstMean")?.exact_numbers(s)?),
            covariance: DMatrix::from_vec(s, s, fields.required("firstCovariance")?.exact_numbers(s * s)?),
        };
        let mut bank = Self::begin(configuration, destinations, first);
        bank.elapsed = fields.required("elapsed")?.exact()?;
        bank.observations = fields.positive("observations")? as u64;
        let list = fields.required("candidates")?;
        let items: Vec<Node<'_>> = list.items()?.collect();
        for (candidate, item) in bank.candidates.iter_mut().zip(&items) {
            let fields = item.fields(&["means", "root", "evidence", "accumulated"])?;
            let (columns, rows) = (candidate.filter.means.ncols(), 2 * s);
            let means = fields.required("means")?.exact_numbers(rows * columns)?;
            candidate.filter.means = DMatrix::from_vec(rows, columns, means);
            let root = fields.required("root")?.exact_numbers(rows * rows)?;
            candidate.filter.root = DMatrix::from_vec(rows, rows, root);
            candidate.filter.log_evidence = fields.required("evidence")?.exact_numbers(columns)?;
        }
        let mut saved_items = items.iter();
        bank.each_likelihood(destinations, |likelihood, scene| {
            match saved_items.next().and_then(|item| item.get("accumulated")) {
                Some(saved) => likelihood.load(scene, &saved),
                None => Ok(()),
            }
        })?;
        Ok(bank)
    }
}

/// One step of a filter whose motion model does not know the destination.
///
/// # Errors
/// As [`FilterBank::advance`].
pub(crate) fn advance_filter(
    filter: &Filter,
    model: &dyn MotionModel,
    step: f64,
    measurement: &Measurement,
) -> Result<Filter> {
    let transition = model.transition(step);
    let offsets = DMatrix::from_column_slice(transition.offset.len(), 1, transition.offset.as_slice());
    let mut filter = filter.clone();
    let (transition, noise) = (&transition.transition, &transition.noise);
    filter.predict(&TimeUpdate { transition, offsets: &offsets, noise });
    correct(filter, measurement)
}

fn correct(mut filter: Filter, measurement: &Measurement) -> Result<Filter> {
    if filter.correct(measurement) && filter.is_finite() {
        return Ok(filter);
    }
    let message = "leads to a state that is not finite: the motion model explodes over this time";
    Err(Error::new(Code::OutOfRange, "time", message))
}

/// `M(h)` for every column of means.
fn offsets(transition: &Transition, destinations: &Destinations, columns: usize) -> DMatrix<f64> {
    if transition.destination_gain.is_none() {
        return DMatrix::from_column_slice(transition.offset.len(), 1, transition.offset.as_slice());
    }
    let each: Vec<DVector<f64>> = (0..columns).map(|i| transition.constant(destinations.center(i))).collect();
    DMatrix::from_columns(&each)
}
