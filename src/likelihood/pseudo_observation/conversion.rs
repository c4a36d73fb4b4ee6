//! Between the filters of separate axes and that of the joint state; every number is the same on both sides.

use super::coupled::Coupled;
use super::separable::axes_of_model;
use crate::math::gaussian::Gaussian;
use crate::math::kalman::Filter;
use crate::model::motion::MotionModel;
use nalgebra::{DMatrix, DVector};
use std::array::from_fn;
use whither_kernel::axes::{Axes, AxisFilter, Start};
use whither_kernel::mixture::AXES;
use whither_kernel::small_gaussian::axis_filter::AxisFilters;

/// The filter of the joint state from those of separate axes.
pub fn coupled_of(first: &Start, now: &Axes) -> Coupled {
    let filter = joint(now);
    let (s, d) = (filter.states, first.dimensions);
    let mut joined = Gaussian { mean: DVector::zeros(s), covariance: DMatrix::zeros(s, s) };
    for axis in 0..d {
        for i in 0..first.components {
            joined.mean[i * d + axis] = first.means[axis][i];
            for j in 0..first.components {
                joined.covariance[(i * d + axis, j * d + axis)] = first.covariances[axis][i][j];
            }
        }
    }
    Coupled { first: joined, filter }
}

fn joint(axes: &Axes) -> Filter {
    let d = axes.filters.dimensions();
    let s = axes.filters.iter().map(AxisFilter::states).sum();
    let zero = Gaussian { mean: DVector::zeros(s), covariance: DMatrix::zeros(s, s) };
    let mut filter = Filter::new(&zero, 1);
    filter.log_evidence = vec![axes.log_evidence];
    for (axis, of) in axes.filters.iter().enumerate() {
        let n = of.states();
        for (i, mean) in of.first[..n].iter().chain(&of.now[..n]).enumerate() {
            filter.means[(row_of(i, n, axis, d, s), 0)] = *mean;
        }
        for (i, row) in of.root().iter().enumerate().take(2 * n) {
            for (j, entry) in row.iter().enumerate().take(2 * n) {
                filter.root[(row_of(i, n, axis, d, s), row_of(j, n, axis, d, s))] = *entry;
            }
        }
    }
    filter
}

/// Which component of the joint pair is component `i` of an axis's; both have the first state first.
fn row_of(i: usize, states: usize, axis: usize, d: usize, s: usize) -> usize {
    if i < states { i * d + axis } else { s + (i - states) * d + axis }
}

/// The filter of one axis of so many components from that of the joint state; empty where there is no such axis.
fn axis_of(filter: &Filter, axis: usize, components: usize, d: usize) -> AxisFilter {
    let states = if axis < d { components } else { 0 };
    let row = |i: usize| row_of(i, states, axis, d, filter.states);
    let mean = |i: usize, of: usize| if i < states { filter.means[(row(of + i), 0)] } else { 0.0 };
    let entry = |i: usize, j: usize| if i.max(j) < 2 * states { filter.root[(row(i), row(j))] } else { 0.0 };
    let root = from_fn(|i| from_fn(|j| entry(i, j)));
    AxisFilter::new(states, from_fn(|i| mean(i, 0)), from_fn(|i| mean(i, states)), root)
}

/// The filters of separate axes from those of the joint state, and the posterior of the first observation; none where the model or
/// the state mixes axes.
pub fn axes_of(model: &dyn MotionModel, first: &Gaussian, filter: &Filter) -> Option<(Start, Axes)> {
    let (components, alike) = axes_of_model(model)?;
    let (d, s) = (model.dimensions(), filter.states);
    if !filter.root.iter().all(|x| x.is_finite()) {
        return None;
    }
    let mixes = |i: usize, j: usize| i % s % d != j % s % d && filter.root[(i, j)] != 0.0;
    if (0..2 * s).any(|i| (0..2 * s).any(|j| mixes(i, j))) {
        return None;
    }
    let (is_there, row) = (|axis: usize, i: usize| axis < d && i < components, |axis: usize, i: usize| i * d + axis);
    let mean = |axis, i| if is_there(axis, i) { first.mean[row(axis, i)] } else { 0.0 };
    let covariance = |axis, i: usize, j| {
        if is_there(axis, i.max(j)) { first.covariance[(row(axis, i), row(axis, j))] } else { 0.0 }
    };
    let covariances: [_; AXES] = from_fn(|axis| from_fn(|i| from_fn(|j| covariance(axis, i, j))));
    let start = Start {
        dimensions: d,
        components,
        means: from_fn(|axis| from_fn(|i| mean(axis, i))),
        covariances,
        twins: from_fn(|axis| alike[axis] && covariances[axis] == covariances[0]),
    };
    let filters = AxisFilters::new(d, from_fn(|axis| axis_of(filter, axis, components, d)), &alike);
    Some((start, Axes { filters, alike, log_evidence: *filter.log_evidence.first()? }))
}
