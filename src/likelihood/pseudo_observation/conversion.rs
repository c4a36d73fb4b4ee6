//! Between the filters of separate axes and that of the complete state; every number is the same on both sides.

use super::coupled::Coupled;
use super::separable::{Axes, AxisFilter, MOST};
use crate::math::gaussian::Gaussian;
use crate::math::kalman::Filter;
use crate::model::motion::MotionModel;
use nalgebra::{DMatrix, DVector};

/// The filter of the complete state from those of separate axes.
pub fn coupled_of(first: &Axes, now: &Axes) -> Coupled {
    let (start, filter) = (complete(first), complete(now));
    let s = filter.states;
    let mut covariance = DMatrix::zeros(s, s);
    let d = first.dimensions;
    for (axis, of) in first.filters.iter().enumerate().take(d) {
        for i in 0..of.states() {
            for j in 0..of.states() {
                covariance[(i * d + axis, j * d + axis)] = of.covariance[i][j];
            }
        }
    }
    let first = Gaussian { mean: start.means.column(0).rows(s, s).into_owned(), covariance };
    Coupled { first, filter }
}

fn complete(axes: &Axes) -> Filter {
    let d = axes.dimensions;
    let s = axes.filters.iter().take(d).map(AxisFilter::states).sum();
    let zero = Gaussian { mean: DVector::zeros(s), covariance: DMatrix::zeros(s, s) };
    let mut filter = Filter::new(&zero, 1);
    filter.log_evidence = vec![axes.log_evidence];
    for (axis, of) in axes.filters.iter().enumerate().take(d) {
        for (from, to) in places(of.states(), axis, d, s) {
            filter.means[(to, 0)] = of.mean[from];
        }
        let n = of.states();
        for (i, row) in of.root.iter().enumerate().take(2 * n) {
            for (j, entry) in row.iter().enumerate().take(2 * n) {
                filter.root[(row_of(i, n, axis, d, s), row_of(j, n, axis, d, s))] = *entry;
            }
        }
    }
    filter
}

/// The places of an axis's components, in its own filter and in that of the complete state, whose first half is the first state.
fn places(states: usize, axis: usize, d: usize, s: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..states).flat_map(move |i| [(i, s + i * d + axis), (MOST + i, i * d + axis)])
}

/// The place of a row of an axis's root in that of the complete state; both have the first state first.
fn row_of(i: usize, states: usize, axis: usize, d: usize, s: usize) -> usize {
    if i < states { i * d + axis } else { s + (i - states) * d + axis }
}

/// The filters of separate axes from those of the complete state; none where the model or the state mixes axes.
pub fn axes_of(model: &dyn MotionModel, first: &Gaussian, filter: &Filter) -> Option<(Axes, Axes)> {
    let mut now = Axes::new(model)?;
    let (d, s) = (now.dimensions, filter.states);
    if !filter.root.iter().all(|x| x.is_finite()) {
        return None;
    }
    let mixes = |i: usize, j: usize| i % s % d != j % s % d && filter.root[(i, j)] != 0.0;
    if (0..2 * s).any(|i| (0..2 * s).any(|j| mixes(i, j))) {
        return None;
    }
    let mut start = now;
    let beginning = Filter::new(first, 1);
    for axis in 0..d {
        let states = now.filters[axis].states();
        for (to, from) in places(states, axis, d, s) {
            now.filters[axis].mean[to] = filter.means[(from, 0)];
            start.filters[axis].mean[to] = first.mean[from % s];
        }
        for (axes, of) in [(&mut now, filter), (&mut start, &beginning)] {
            for i in 0..2 * states {
                for j in 0..2 * states {
                    let entry = of.root[(row_of(i, states, axis, d, s), row_of(j, states, axis, d, s))];
                    axes.filters[axis].root[i][j] = entry;
                }
            }
            axes.filters[axis].square();
        }
        for i in 0..states {
            for j in 0..states {
                start.filters[axis].covariance[i][j] = first.covariance[(i * d + axis, j * d + axis)];
            }
        }
    }
    now.log_evidence = *filter.log_evidence.first()?;
    now.find_twins();
    start.find_twins();
    Some((start, now))
}
