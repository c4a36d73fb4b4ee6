//! The Kalman filter of one axis, and the filters of all axes, of which those that are alike share all but their means.

use super::{Matrix, condition, triangularise};
use crate::mixture::AXES;
use std::ops::{Index, IndexMut};

/// One step of an axis: `x_k = F x_{k-1} + M + e`, `e ~ N(0, L L')`.
pub trait Step<const S: usize, const PAIR: usize> {
    /// How many components the axis has; a constant here makes all loops over them short.
    fn states(&self) -> usize;

    /// Replaces `x` by `F x + M`.
    fn mean(&self, x: &mut [f64; S]);

    /// Replaces `X`, of two columns for each component, by `F X`.
    fn root(&self, x: &mut [[f64; PAIR]; S]);

    /// `L`, a root of the noise.
    fn noise_root(&self) -> Matrix<S>;
}

/// The Kalman posterior of one axis of at most `S` components, over the pair (first state, state now), as
/// `math::kalman::Filter` of whither: Liang (8) and the usual correction. `PAIR` is twice `S`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisFilter<const S: usize, const PAIR: usize> {
    states: usize,
    /// The mean of the first state given all observations.
    pub first: [f64; S],
    /// The mean of the state now.
    pub now: [f64; S],
    /// The covariance of the state now.
    pub covariance: Matrix<S>,
    root: [[f64; PAIR]; PAIR],
}

/// What one observation does to an axis, whatever its value.
#[derive(Clone, Copy, Debug)]
struct Correction<const PAIR: usize> {
    /// Of the first state, then of the state now.
    gain: [f64; PAIR],
    /// The prediction error's variance.
    variance: f64,
}

impl<const S: usize, const PAIR: usize> AxisFilter<S, PAIR> {
    /// A filter of `states` components, with a root of the pair's covariance as [`AxisFilter::root`] returns it.
    pub fn new(states: usize, first: [f64; S], now: [f64; S], root: [[f64; PAIR]; PAIR]) -> Self {
        let mut filter = Self { states, first, now, covariance: [[0.0; S]; S], root };
        filter.square(states);
        filter
    }

    /// How many components the axis has.
    pub const fn states(&self) -> usize {
        self.states
    }

    /// A root of the pair's covariance, lower triangular: the rows of the first state, then those of the state now.
    pub const fn root(&self) -> &[[f64; PAIR]; PAIR] {
        &self.root
    }

    /// The covariance of the state now, from the root.
    #[inline(always)]
    fn square(&mut self, s: usize) {
        for i in 0..s {
            let row = &self.root[s + i];
            for j in 0..i + 1 {
                let (other, mut entry) = (&self.root[s + j], 0.0);
                for q in 0..s + j + 1 {
                    entry += row[q] * other[q];
                }
                self.covariance[i][j] = entry;
                self.covariance[j][i] = entry;
            }
        }
    }

    /// Liang (8), the mean.
    pub fn predict_mean(&mut self, step: &impl Step<S, PAIR>) {
        step.mean(&mut self.now);
    }

    /// Liang (8), the root of the covariance.
    fn predict_root(&mut self, step: &impl Step<S, PAIR>) {
        let (s, noise) = (step.states(), step.noise_root());
        let mut rows = [[0.0; PAIR]; S];
        for (row, now) in rows.iter_mut().zip(&self.root[s..2 * s]) {
            *row = *now;
        }
        step.root(&mut rows);
        for i in 0..s {
            self.root[s + i] = rows[i];
            // what the state now does not share with the first one, and the noise
            for q in 0..s {
                (rows[i][q], rows[i][s + q]) = (rows[i][s + q], noise[i][q]);
            }
        }
        triangularise(&mut rows, s, 2 * s);
        for i in 0..s {
            for q in 0..s {
                self.root[s + i][s + q] = rows[i][q];
            }
        }
    }

    /// The step, and the correction where the first component is observed with this variance, but for the means.
    fn advance_root(&mut self, step: &impl Step<S, PAIR>, variance: Option<f64>) -> Option<Correction<PAIR>> {
        self.predict_root(step);
        let s = step.states();
        let correction = variance.map(|variance| {
            let (gain, variance) = condition(&mut self.root, 2 * s, s, variance);
            Correction { gain, variance }
        });
        self.square(s);
        correction
    }

    /// Corrects the means of `s` components, and returns the prediction error.
    #[inline(always)]
    fn correct_mean(&mut self, s: usize, correction: &Correction<PAIR>, observed: f64) -> f64 {
        let error = observed - self.now[0];
        for i in 0..s {
            self.first[i] += correction.gain[i] * error;
            self.now[i] += correction.gain[s + i] * error;
        }
        error
    }
}

impl AxisFilter<2, 4> {
    /// At rest at a place, with these deviations of position and velocity: the first state, which is the state now.
    pub fn begin(position: f64, [deviation, speed]: [f64; 2]) -> Self {
        let state = [position, 0.0];
        let covariance = [[deviation * deviation, 0.0], [0.0, speed * speed]];
        let [one, other] = [[deviation, 0.0, 0.0, 0.0], [0.0, speed, 0.0, 0.0]];
        Self { states: 2, first: state, now: state, covariance, root: [one, other, one, other] }
    }

    /// Replaces the state now by one that another filter has of it, independent of the first state as far as this one knows.
    pub fn replace_now(&mut self, now: [f64; 2], covariance: Matrix<2>) {
        let [[position, both], [_, velocity]] = covariance;
        let deviation = position.max(f64::MIN_POSITIVE).sqrt();
        let shared = both / deviation;
        self.root[2] = [0.0, 0.0, deviation, 0.0];
        self.root[3] = [0.0, 0.0, shared, (velocity - shared * shared).max(0.0).sqrt()];
        (self.now, self.covariance) = (now, covariance);
    }
}

/// The filters of the axes of one movement. An axis that moves as the first one does, began with its covariance and has been
/// observed alike since is its twin: all but the means is computed once for both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisFilters<const S: usize, const PAIR: usize> {
    dimensions: usize,
    filters: [AxisFilter<S, PAIR>; AXES],
    twins: [bool; AXES],
}

impl<const S: usize, const PAIR: usize> AxisFilters<S, PAIR> {
    /// The filters of so many axes, those beyond them unused; `alike` is whether each moves as the first one does.
    pub fn new(dimensions: usize, filters: [AxisFilter<S, PAIR>; AXES], alike: &[bool; AXES]) -> Self {
        let [first, ..] = &filters;
        let same = |one: &AxisFilter<S, PAIR>| {
            one.states == first.states && one.root == first.root && one.covariance == first.covariance
        };
        let twins = std::array::from_fn(|axis| alike[axis] && same(&filters[axis]));
        Self { dimensions, filters, twins }
    }

    /// How many axes there are.
    pub const fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// Whether an axis is a twin of the first one, which is its own.
    pub const fn is_twin(&self, axis: usize) -> bool {
        self.twins[axis]
    }

    /// The filters of the axes that there are.
    pub fn iter(&self) -> impl Iterator<Item = &AxisFilter<S, PAIR>> {
        self.filters.iter().take(self.dimensions)
    }

    /// One observation after the step that `step` gives for an axis: positions where observed, and their variances. `innovation`
    /// gets the prediction error of each and its variance. Where there is no step, the axes stay as they are.
    pub fn advance<T: Step<S, PAIR>>(
        &mut self,
        step: impl Fn(usize) -> Option<T>,
        position: &[Option<f64>],
        variance: &[f64; AXES],
        mut innovation: impl FnMut(f64, f64),
    ) {
        let Some(shared) = step(0) else { return };
        let mut leading = None;
        for axis in 0..self.dimensions {
            let observed = position.get(axis).copied().flatten();
            let (first, others) = self.filters.split_at_mut(axis.max(1));
            let alike = self.twins[axis] && observed.is_some() == leading.is_some() && variance[axis] == variance[0];
            let correction = if axis == 0 {
                first[0].predict_mean(&shared);
                leading = first[0].advance_root(&shared, observed.map(|_| variance[0]));
                leading
            } else if alike {
                others[0].predict_mean(&shared);
                others[0].covariance = first[0].covariance;
                // row by row: copied at once it would be a call out of the WebAssembly
                let both = 2 * shared.states();
                for (row, of) in others[0].root.iter_mut().zip(&first[0].root).take(both) {
                    row[..both].copy_from_slice(&of[..both]);
                }
                leading
            } else {
                self.twins[axis] = false;
                let Some(own) = step(axis) else { return };
                others[0].predict_mean(&own);
                others[0].advance_root(&own, observed.map(|_| variance[axis]))
            };
            if let (Some(observed), Some(correction)) = (observed, &correction) {
                let error = self.filters[axis].correct_mean(shared.states(), correction, observed);
                innovation(error, correction.variance);
            }
        }
    }
}

impl<const S: usize, const PAIR: usize> Index<usize> for AxisFilters<S, PAIR> {
    type Output = AxisFilter<S, PAIR>;

    // without it the level for size makes each access a call
    #[inline(always)]
    fn index(&self, axis: usize) -> &Self::Output {
        &self.filters[axis]
    }
}

impl<const S: usize, const PAIR: usize> IndexMut<usize> for AxisFilters<S, PAIR> {
    #[inline(always)]
    fn index_mut(&mut self, axis: usize) -> &mut Self::Output {
        &mut self.filters[axis]
    }
}
