//! Between the filters of separate axes and that of the joint state; every number is the same on both sides.

use super::coupled::Coupled;
use super::separable::{Axes, AxisFilter, axes_of_model};
use crate::math::gaussian::Gaussian;
use crate::math::kalman::Filter;
use crate::model::motion::MotionModel;
use nalgebra::{DMatrix, DVector};
use std::array::from_fn;
use whither_kernel::mixture::AXES;
use whither_kernel::small_gaussian::axis_filter::AxisFilters;

/// The filter of the joint state from those of separate axes.
pub fn coupled_of(first: &Axes, now: &Axes) -> Coupled {
    let (start, filter) = (joint(first), joint(now));
    let s = filter.states;
    let mut covariance = DMatrix::zeros(s, s);
    let d = first.filters.dimensions();
    for (axis, of) in first.filters.iter().enumerate() {
        for i in 0..of.states() {
            for j in 0..of.states() {
                covariance[(i * d + axis, j * d + axis)] = of.covariance[i][j];
            }
        }
    }
    let first = Gaussian { mean: start.means.column(0).rows(s, s).into_owned(), covariance };
    Coupled { first, filter }
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

/// The filter of one axis of so many states from that of the joint state.
fn axis_of(filter: &Filter, axis: usize, states: usize, d: usize) -> AxisFilter {
    let row = |i: usize| row_of(i, states, axis, d, filter.states);
    let mean = |i: usize, of: usize| if i < states { filter.means[(row(of + i), 0)] } else { 0.0 };
    let entry = |i: usize, j: usize| if i.max(j) < 2 * states { filter.root[(row(i), row(j))] } else { 0.0 };
    let root = from_fn(|i| from_fn(|j| entry(i, j)));
    AxisFilter::new(states, from_fn(|i| mean(i, 0)), from_fn(|i| mean(i, states)), root)
}

/// The filters of separate axes from those of the joint state; none where the model or the state mixes axes.
pub fn axes_of(model: &dyn MotionModel, first: &Gaussian, filter: &Filter) -> Option<(Axes, Axes)> {
    let (states, alike) = axes_of_model(model)?;
    let (d, s) = (model.dimensions(), filter.states);
    if !filter.root.iter().all(|x| x.is_finite()) {
        return None;
    }
    let mixes = |i: usize, j: usize| i % s % d != j % s % d && filter.root[(i, j)] != 0.0;
    if (0..2 * s).any(|i| (0..2 * s).any(|j| mixes(i, j))) {
        return None;
    }
    let beginning = Filter::new(first, 1);
    let mut start: [AxisFilter; AXES] = from_fn(|axis| axis_of(&beginning, axis, states[axis], d));
    for (axis, one) in start.iter_mut().enumerate() {
        for i in 0..one.states() {
            for j in 0..one.states() {
                one.covariance[i][j] = first.covariance[(i * d + axis, j * d + axis)];
            }
        }
    }
    let now = from_fn(|axis| axis_of(filter, axis, states[axis], d));
    let axes = |filters, log_evidence| Axes { filters: AxisFilters::new(d, filters, &alike), alike, log_evidence };
    Some((axes(start, 0.0), axes(now, *filter.log_evidence.first()?)))
}
