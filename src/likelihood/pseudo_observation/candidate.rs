//! The filters under one noise candidate, and its terms for a class of endpoints.

use super::classes::{ClassEndpoint, Nodes};
use super::coefficients::Work;
use super::conversion::coupled_of;
use super::coupled::{Coupled, Room};
use crate::model::motion::MotionModel;
use std::sync::Arc;
use whither_kernel::axes::{Axes, Start};
use whither_kernel::coupled::{self, Steps};
use whither_kernel::endpoints::{AxisEndpoint, NodeTable};
use whither_kernel::mixture::AXES;
use whither_kernel::ratios::Prediction;
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
    Separable { first: Start, now: Axes },
    Coupled(Box<Coupled>),
}

/// Steps to the nodes, kept as long as they stay the same, and room.
#[derive(Clone, Debug, Default)]
pub(super) struct Tables {
    pub now: StepsTo,
    pub start: StepsTo,
    /// Room for the state that the start predicts for now.
    predicted: Start,
    /// Room for the same where axes mix.
    room: Room,
}

#[derive(Clone, Debug, Default)]
pub(super) struct StepsTo {
    /// Which nodes, and how much of their time had passed.
    of: Option<(usize, u64)>,
    /// The nodes' prior probabilities, zero for those that had passed.
    pub weights: Vec<Block>,
    pub axes: [NodeTable; AXES],
    pub complete: Steps,
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

    /// Adds the terms of a class: its nodes and its endpoint.
    pub fn prepare(
        &mut self,
        number: usize,
        nodes: &Nodes,
        endpoint: &ClassEndpoint,
        elapsed: f64,
        lead: f64,
        work: &mut Work,
    ) {
        let model = self.model.as_ref();
        let Tables { now: to_now, start: to_start, predicted, room } = &mut self.tables;
        // nodes that count from now are as far from now as from where the start's prediction has come to by then
        let passed = if nodes.from_now { 0.0 } else { elapsed };
        match &self.source {
            Source::Separable { first, now } => {
                let Some(endpoints) = &endpoint.axes else { return };
                to_now.fill_axes(model, now, number, endpoints, nodes, passed);
                let (start, start_tables) = if nodes.from_now {
                    first.predict(&|axis| model.axis(axis, elapsed), predicted);
                    (&*predicted, &to_now.axes)
                } else {
                    to_start.fill_axes(model, now, number, endpoints, nodes, 0.0);
                    (first, &to_start.axes)
                };
                work.ratios.add(&Prediction {
                    now: now.states(),
                    start: start.states(),
                    tables: &to_now.axes,
                    start_tables,
                    same: &now.alike,
                    endpoints,
                    weights: &to_now.weights,
                    weight: self.weight,
                    lead,
                });
            }
            Source::Coupled(coupled) => {
                to_now.fill_complete(model, number, nodes, passed);
                let steps = if nodes.from_now {
                    &to_now.complete
                } else {
                    to_start.fill_complete(model, number, nodes, 0.0);
                    &to_start.complete
                };
                coupled.predict(model, nodes.from_now.then_some(elapsed), room);
                let (now, start) = ((&*room.now, &to_now.complete), (&*room.start, steps));
                let (weights, weight) = (&*to_now.weights, self.weight);
                coupled::Prediction { now, start, weights, weight, lead }.ellipsoids(
                    &endpoint.complete(),
                    &mut room.nodes,
                    &mut work.ellipsoids,
                );
            }
        }
    }
}

impl StepsTo {
    /// Whether these are the steps to these nodes already; if not, they are to be filled.
    fn is(&mut self, number: usize, nodes: &Nodes, passed: f64) -> bool {
        let of = Some((number, passed.to_bits()));
        if self.of == of {
            return true;
        }
        self.of = of;
        nodes.weights_ahead(passed, &mut self.weights);
        false
    }

    fn fill_axes(
        &mut self,
        model: &dyn MotionModel,
        axes: &Axes,
        number: usize,
        endpoints: &[AxisEndpoint; AXES],
        nodes: &Nodes,
        passed: f64,
    ) {
        let (d, components) = (axes.filters.dimensions(), axes.filters[0].states());
        let length = endpoints.iter().map(|endpoint| endpoint.length).max().unwrap_or(1).min(components);
        if self.is(number, nodes, passed) && self.axes[0].length() >= length {
            return;
        }
        for axis in (0..d).filter(|&axis| axis == 0 || !axes.alike[axis]) {
            let step = |node: usize| model.axis(axis, (nodes.times.get(node)? - passed).max(0.0));
            self.axes[axis].fill(length, nodes.times.len(), &step);
        }
    }

    fn fill_complete(&mut self, model: &dyn MotionModel, number: usize, nodes: &Nodes, passed: f64) {
        if self.is(number, nodes, passed) {
            return;
        }
        self.complete.clear(model.states());
        for time in &nodes.times {
            let step = model.transition((time - passed).max(0.0));
            self.complete.push(step.transition.as_slice(), step.offset.as_slice(), step.noise.as_slice());
        }
    }
}
