//! One step of the Kalman filter over the pair (first state, state now), by roots.

use super::{Conditioning, place, product, resize, root, squared_distance, triangularise};

/// `ln(2 pi)`.
pub const LN_2_PI: f64 = 1.837_877_066_409_345_6;

/// What a step changes, each column by column.
#[derive(Debug)]
pub struct Pair<'a> {
    /// How many components one state has.
    pub states: usize,
    /// Of the pair's covariance, lower triangular.
    pub root: &'a mut [f64],
    /// A column of the pair's means for each model of the mean.
    pub means: &'a mut [f64],
    /// `log p(y_2:k | y_1)` of each.
    pub log_evidence: &'a mut [f64],
}

/// Room for what a step is computed with, kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Room {
    conditioning: Conditioning,
    moved: Vec<f64>,
    room: Vec<f64>,
}

/// What is in it is no part of any state.
impl PartialEq for Room {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Pair<'_> {
    /// `x_k = F x_{k-1} + M + e`, `e ~ N(0, Q)`, with `M` a column for each of the means, or one for all.
    #[inline(never)]
    pub fn predict(&mut self, transition: &[f64], offsets: &[f64], noise: &[f64], room: &mut Room) {
        let (s, Room { moved, room, .. }) = (self.states, room);
        resize(moved, (3 * s * s).max(self.means.len()));
        // of the rows of the state now, those columns that the first state has too, the others, and those of the noise
        product((transition, s), (&self.root[s..], 1, 2 * s), &mut moved[..2 * s * s], s);
        root(noise, s, room, &mut moved[2 * s * s..3 * s * s]);
        triangularise(&mut moved[s * s..3 * s * s], s, room);
        place(&mut self.root[s..], 2 * s, &moved[..2 * s * s], s);
        let moved = &mut moved[..self.means.len() / 2];
        product((transition, s), (&self.means[s..], 1, 2 * s), moved, s);
        for (mean, offset) in moved.chunks_exact_mut(s).zip(offsets.chunks_exact(s).cycle()) {
            mean.iter_mut().zip(offset).for_each(|(mean, offset)| *mean += offset);
        }
        place(&mut self.means[s..], 2 * s, moved, s);
    }

    /// The correction with `y = G x + v`, `v ~ N(0, V)`, of one component at least; false, and nothing has changed, where the
    /// prediction error has no density.
    #[inline(never)]
    #[must_use]
    pub fn correct(&mut self, value: &[f64], matrix: &[f64], noise: &[f64], room: &mut Room) -> bool {
        let (s, m) = (self.states, value.len());
        let Room { conditioning, moved, .. } = room;
        if !conditioning.set(self.root, 2 * s, matrix, noise, m) {
            return false;
        }
        let log_factor = -conditioning.log_root() - 0.5 * m as f64 * LN_2_PI;
        let rows = 2 * s + m;
        resize(moved, m * self.log_evidence.len());
        product((matrix, m), (&self.means[s..], 1, 2 * s), moved, m);
        let each = self.means.chunks_exact_mut(2 * s).zip(moved.chunks_exact_mut(m));
        for ((mean, error), log_evidence) in each.zip(&mut *self.log_evidence) {
            error.iter_mut().zip(value).for_each(|(error, y)| *error = y - *error);
            for (column, error) in conditioning.array.chunks_exact(rows).zip(&*error) {
                mean.iter_mut().zip(&column[m..]).for_each(|(mean, gain)| *mean += gain * error);
            }
            *log_evidence += log_factor - 0.5 * squared_distance(&conditioning.array, rows, error);
        }
        for (to, (_, from)) in self.root.chunks_exact_mut(2 * s).zip(conditioning.columns().skip(m)) {
            to.copy_from_slice(from);
        }
        true
    }
}
