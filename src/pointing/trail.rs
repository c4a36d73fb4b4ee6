//! What a movement keeps for the case that its outcome becomes known: its states, thinned out as it goes on.

use super::Vector;
use super::course::{Course, Moment};
use super::space::Space;
use super::targets::Extent;
use crate::error::Result;
use crate::value::{Node, Value};

/// The most states that are kept: half as many to all of them, evenly spaced.
const MOST: usize = 32;

/// States of a movement from the second observation on, each so many observations after the one before.
#[derive(Clone, Debug)]
pub(crate) struct Trail {
    stride: u64,
    moments: Vec<Moment>,
}

/// The states of a movement until it was in a target for good.
pub(crate) struct Approach {
    /// All of them where it never was.
    pub moments: Vec<Moment>,
    /// How many observations there were, the first not counted.
    pub samples: f64,
    /// When it entered, in seconds since the first observation; minus infinity where it never did.
    pub entry: f64,
}

impl Trail {
    /// Of a movement after its first observation.
    #[must_use]
    pub fn new() -> Self {
        Self { stride: 1, moments: Vec::with_capacity(MOST) }
    }

    /// Keeps the state of the course, unless it lies between two that are kept. One at the same time replaces the last one.
    #[inline(never)]
    pub fn keep<S: Space>(&mut self, course: &Course<S>) {
        let Some(before) = course.observations.checked_sub(2) else { return };
        if !before.is_multiple_of(self.stride) {
            return;
        }
        let moment = course.moment();
        if self.moments.last().is_some_and(|last| last.observations() == moment.observations()) {
            self.moments.pop();
        }
        if self.moments.len() == MOST {
            (0..MOST / 2).for_each(|k| self.moments[k] = self.moments[2 * k]);
            self.moments.truncate(MOST / 2);
            self.stride *= 2;
        }
        self.moments.push(moment);
    }

    /// The approach of a movement that is at `last` now to a target in so many dimensions; none where it never was outside of it.
    #[must_use]
    pub fn approach(self, last: Moment, center: &Vector, extent: &Extent, dimensions: usize) -> Option<Approach> {
        let mut moments = self.moments;
        if moments.last().is_some_and(|moment| moment.observations() < last.observations()) {
            moments.push(last);
        }
        // the farthest along an axis, negative in it
        let beyond = |at: &Moment| {
            let along = |axis: usize| (at.position(axis) - center[axis]).abs() - 0.5 * extent.sides[axis];
            (0..dimensions).map(along).fold(f64::MIN, f64::max)
        };
        let left = moments.iter().rposition(|at| beyond(at) > 0.0)?;
        let before = moments[left];
        let (mut samples, mut entry) = (before.observations() - 1.0, f64::NEG_INFINITY);
        if let Some(inside) = moments.get(left + 1) {
            // evenly from the one to the other, at an observation
            let between = inside.observations() - before.observations();
            let observations = (between * beyond(&before) / (beyond(&before) - beyond(inside))).ceil();
            samples += observations;
            entry = before.elapsed() + observations / between * (inside.elapsed() - before.elapsed());
        }
        moments.truncate(left + 2);
        Some(Approach { moments, samples, entry })
    }

    /// What a snapshot keeps.
    #[must_use]
    pub fn save(&self) -> Value {
        let mut numbers = vec![self.stride as f64];
        self.moments.iter().for_each(|moment| numbers.extend_from_slice(&moment.0));
        Value::exact_numbers(&numbers)
    }

    /// The trail that [`Trail::save`] wrote.
    ///
    /// # Errors
    /// `wrong-type`.
    pub fn load(node: &Node<'_>) -> Result<Self> {
        let numbers = node.numbers(|item| item.exact())?;
        let (stride, moments) = numbers.split_first().unwrap_or((&1.0, &[]));
        Ok(Self {
            stride: *stride as u64,
            moments: moments.as_chunks().0.iter().map(|moment| Moment(*moment)).collect(),
        })
    }
}
