//! The filters under one noise candidate, and its terms for a class of endpoints.

use super::axis_endpoint::{AxisEndpoint, NodeTable};
use super::classes::{ClassEndpoint, Nodes};
use super::coefficients::{Prediction, Work};
use super::conversion::coupled_of;
use super::coupled::{self, Coupled};
use super::separable::{Axes, MOST};
use crate::model::motion::{MotionModel, Transition};
use std::sync::Arc;
use whither_kernel::mixture::AXES;
use whither_kernel::vectors::Block;

/// The filters under one noise candidate.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub model: Arc<dyn MotionModel>,
    /// `w_c`.
    pub weight: f64,
    pub source: Source,
    pub tables: Tables,
}

#[derive(Clone, Debug)]
pub(super) enum Source {
    Separable { first: Axes, now: Axes },
    Coupled(Box<Coupled>),
}

/// Steps to the nodes, kept as long as they stay the same.
#[derive(Clone, Debug, Default)]
pub(super) struct Tables {
    pub now: StepsTo,
    pub start: StepsTo,
}

#[derive(Clone, Debug, Default)]
pub(super) struct StepsTo {
    /// Which nodes, and how much of their time had passed.
    pub of: Option<(usize, u64)>,
    pub axes: [NodeTable; MOST],
    pub complete: Vec<Transition>,
}

impl Candidate {
    pub fn log_evidence(&self) -> f64 {
        match &self.source {
            Source::Separable { now, .. } => now.log_evidence,
            Source::Coupled(coupled) => coupled.filter.evidence(0),
        }
    }

    /// The filter of the complete state.
    pub fn coupled(&self) -> Coupled {
        match &self.source {
            Source::Separable { first, now } => coupled_of(first, now),
            Source::Coupled(coupled) => Coupled::clone(coupled),
        }
    }

    /// The position now.
    pub fn position(&self) -> [f64; AXES] {
        match &self.source {
            Source::Separable { now, .. } => [now.filters[0].now[0], now.filters[1].now[0], now.filters[2].now[0]],
            Source::Coupled(coupled) => {
                let s = coupled.filter.states;
                std::array::from_fn(|k| if k < s { coupled.filter.means[(s + k, 0)] } else { 0.0 })
            }
        }
    }

    /// Adds the terms of a class: its nodes with their `weights`, and its endpoint.
    #[expect(clippy::too_many_arguments, reason = "one caller, which owns what is borrowed here")]
    pub fn prepare(
        &mut self,
        number: usize,
        nodes: &Nodes,
        endpoint: &ClassEndpoint,
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
            Source::Separable { first, now } => {
                let Some(axes) = &endpoint.axes else { return };
                to_now.fill_axes(model, now, number, axes, nodes, passed);
                let mut predicted;
                let (start, start_tables) = if nodes.from_now {
                    predicted = *first;
                    predicted.propagate(model, elapsed);
                    (&predicted, &to_now.axes)
                } else {
                    to_start.fill_axes(model, first, number, axes, nodes, 0.0);
                    (first, &to_start.axes)
                };
                let prediction =
                    Prediction { now, start, tables: &to_now.axes, start_tables, weights, weight: self.weight, lead };
                work.add_endpoints(&prediction, axes);
            }
            Source::Coupled(coupled) => {
                to_now.fill_complete(model, number, nodes, passed);
                let start = if nodes.from_now {
                    coupled.predict_first(model, elapsed)
                } else {
                    to_start.fill_complete(model, number, nodes, 0.0);
                    coupled.first.clone()
                };
                let start_steps = if nodes.from_now { &to_now.complete } else { &to_start.complete };
                let (now, mut room) = (coupled.now(), coupled::Room::default());
                let steps = to_now.complete.iter().zip(start_steps).zip(weights.as_flattened());
                for ((step, start_step), weight) in steps.filter(|(_, weight)| **weight > 0.0) {
                    let factor = self.weight * weight;
                    let d = model.dimensions();
                    let term =
                        coupled::ellipsoid((&now, step), (&start, start_step), endpoint, (factor, lead), d, &mut room);
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
        endpoints: &[AxisEndpoint; MOST],
        nodes: &Nodes,
        passed: f64,
    ) {
        let length = endpoints.iter().map(|endpoint| endpoint.length).max().unwrap_or(1);
        if self.is(number, passed) && self.axes[0].length() >= length {
            return;
        }
        for axis in (0..axes.filters.dimensions()).filter(|&axis| axis == 0 || !axes.alike[axis]) {
            let length = length.min(axes.filters[axis].states());
            self.axes[axis].fill(model, axis, length, nodes.times.iter().map(|time| time - passed));
        }
    }

    fn fill_complete(&mut self, model: &dyn MotionModel, number: usize, nodes: &Nodes, passed: f64) {
        if self.is(number, passed) {
            return;
        }
        self.complete.clear();
        self.complete.extend(nodes.times.iter().map(|time| model.transition((time - passed).max(0.0))));
    }
}
