//! Shake: what a moving car, or a tremor, adds to the position of a hand, with a frequency of its own.
//!
//! With `pointing.shake` above 0 the position that is observed is the hand's, which moves as in [`course`](super::course), and on each
//! axis a damped oscillator's, `ds = u dt`, `du = -(w^2 s + 2 z w u) dt + noise`, of stationary deviations `a` and `w a`. Neither the
//! amplitude nor the frequency is known: there is a filter for each of a few, and one without shake, and what follows averages over
//! them by evidence (Bayesian model averaging, as over the papers' noise candidates), with one mean and covariance. The evidence is
//! kept from movement to movement, since a road outlasts them.
//!
//! The evidence is that of Student's density, since hands do what no filter expects. It finds less shake, and a slower one, than there
//! is: the hand's noise, which is what predicts best, takes its part of it. So each candidate has two filters, one that is compared,
//! and one of more shake that predicts.

use super::Vector;
use super::parameters::PointingConstants;
use crate::engine::Lasting;
use crate::math::cosine::cosine;
use whither_kernel::mixture::AXES;

/// Amplitudes that are compared: deviations as shares of the largest amplitude.
const AMPLITUDES: [f64; 2] = [1.0 / 6.0, 0.5];

/// Frequencies that are compared, in Hz.
const FREQUENCIES: [f64; 3] = [2.2, 3.7, 6.5];

/// How many candidates there are, the first one without shake.
const CANDIDATES: usize = 1 + AMPLITUDES.len() * FREQUENCIES.len();

/// The first one's filter, those that are compared of the others, and those that predict.
const FILTERS: usize = 2 * CANDIDATES - 1;

/// By what the amplitude and the frequency of a filter exceed those of its candidate, and its share of critical damping, which is how
/// wide the band of frequencies is: of filters that are compared, and of those that predict.
const COMPARES: [f64; 3] = [1.0, 1.0, 0.3];
const PREDICTS: [f64; 3] = [1.5, 1.15, 0.2];

/// What the log weight of a candidate with shake is before anything is observed, against the one without.
const PRIOR: f64 = -3.0;

/// Log weights, against the largest, are at least this, so that a road may change.
const LEAST: f64 = -30.0;

/// Degrees of freedom of Student's density.
const FREEDOM: f64 = 5.0;

/// Observations that follow sooner, in seconds, count for less in proportion: shake is as smooth as a hand at that scale.
const INDEPENDENT: f64 = 0.016;

/// Position and velocity of the hand, then those of the oscillator.
const STATES: usize = 4;

type Square = [[f64; STATES]; STATES];

/// One filter's state of one axis: the mean, then the rows of the covariance.
type Axis = [[f64; STATES]; 1 + STATES];

/// The filters of all candidates after an observation.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Filters {
    /// Those of the candidates, against the largest.
    log_weights: [f64; CANDIDATES],
    axes: [[Axis; AXES]; FILTERS],
}

/// What follows the shake.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shake {
    now: Filters,
    /// Before the last observation.
    before: Filters,
}

/// Position and velocity of an axis, and their covariance.
pub type Estimate = ([f64; 2], [[f64; 2]; 2]);

/// One oscillator; nothing at deviation 0.
struct Oscillator {
    deviation: f64,
    /// In radians a second.
    rate: f64,
    damping: f64,
}

impl Oscillator {
    /// That of a filter.
    fn of(filter: usize, largest: f64) -> Self {
        let predicts = filter >= CANDIDATES;
        let Some(place) = filter.checked_sub(if predicts { CANDIDATES } else { 1 }) else {
            return Self { deviation: 0.0, rate: 1.0, damping: 0.0 };
        };
        let [larger, faster, damping] = if predicts { PREDICTS } else { COMPARES };
        Self {
            deviation: largest * larger * AMPLITUDES[place / FREQUENCIES.len()],
            rate: std::f64::consts::TAU * faster * FREQUENCIES[place % FREQUENCIES.len()],
            damping,
        }
    }

    /// The covariance of all states that it has for good, that of the hand being 0.
    fn stationary(&self) -> Square {
        let mut square = Square::default();
        square[2][2] = self.deviation * self.deviation;
        square[3][3] = self.rate * self.rate * square[2][2];
        square
    }

    /// What becomes of the states in so many seconds.
    fn transition(&self, seconds: f64) -> Square {
        let (decay, own) = (self.damping * self.rate, self.rate * (1.0 - self.damping * self.damping).sqrt());
        let turns = own * seconds / std::f64::consts::TAU;
        let left = (-decay * seconds).exp();
        let wave = |turns: f64| left * cosine(turns - turns.floor());
        let (even, odd) = (wave(turns), wave(turns - 0.25));
        let aside = decay / own * odd;
        [
            [1.0, seconds, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, even + aside, odd / own],
            [0.0, 0.0, -self.rate * self.rate / own * odd, even - aside],
        ]
    }
}

/// The transpose of a product; done twice with a covariance, the covariance after the transition.
#[inline(never)]
fn transposed_product(transition: &Square, of: &Square) -> Square {
    let mut product = Square::default();
    for r in 0..STATES {
        for c in 0..STATES {
            for k in 0..STATES {
                product[c][r] += transition[r][k] * of[k][c];
            }
        }
    }
    product
}

/// Predicts, with white noise of this spectral density on the hand's velocity, and corrects; returns the prediction error and its
/// variance where it is observed.
#[inline(never)]
fn advance(
    axis: &mut Axis,
    (transition, stationary): (&Square, &Square),
    density: f64,
    observed: Option<f64>,
    variance: f64,
) -> Option<[f64; 2]> {
    let [old, known @ ..] = axis;
    let mut mean = [0.0; STATES];
    for r in 0..STATES {
        for c in 0..STATES {
            mean[r] += transition[r][c] * old[c];
            // what differs from the stationary covariance decays
            known[r][c] -= stationary[r][c];
        }
    }
    let once = transposed_product(transition, known);
    let mut covariance = transposed_product(transition, &once);
    let seconds = transition[0][1];
    let area = density * seconds * seconds / 2.0;
    covariance[0][0] += area * seconds / 1.5;
    covariance[0][1] += area;
    covariance[1][0] += area;
    covariance[1][1] += density * seconds;
    let mut gain = [0.0; STATES];
    for r in 0..STATES {
        for c in 0..STATES {
            covariance[r][c] += stationary[r][c];
        }
        // what is observed is the sum of both positions
        gain[r] = covariance[r][0] + covariance[r][2];
    }
    // digits may be lost where positions jump beyond all screens
    let spread = (gain[0] + gain[2]).max(0.0) + variance;
    let error = observed.map(|position| position - mean[0] - mean[2]);
    if let Some(error) = error {
        for r in 0..STATES {
            let share = gain[r] / spread;
            mean[r] += share * error;
            for c in 0..STATES {
                covariance[r][c] -= share * gain[c];
            }
        }
    }
    (*old, *known) = (mean, covariance);
    error.map(|error| [error, spread])
}

impl Shake {
    /// Begins at the first observation, of these variances.
    #[must_use]
    pub fn begin(constants: &PointingConstants, start: &Vector, variances: &Vector) -> Self {
        let mut log_weights = [PRIOR; CANDIDATES];
        log_weights[0] = 0.0;
        let mut axes = [[Axis::default(); AXES]; FILTERS];
        for (filter, axes) in axes.iter_mut().enumerate() {
            let stationary = Oscillator::of(filter, constants.shake).stationary();
            for (k, axis) in axes.iter_mut().enumerate() {
                let [mean, covariance @ ..] = axis;
                mean[0] = start[k];
                *covariance = stationary;
                covariance[0] = [variances[k] + stationary[2][2], 0.0, -stationary[2][2], 0.0];
                covariance[2][0] = -stationary[2][2];
                covariance[1][1] = constants.first_speed[k].powi(2);
            }
        }
        let now = Filters { log_weights, axes };
        Self { now, before: now }
    }

    /// Takes in one more observation, so many seconds after the last one; with `again` in the place of the last one.
    pub fn advance(
        &mut self,
        constants: &PointingConstants,
        seconds: f64,
        (position, variances): (&[Option<f64>; AXES], &Vector),
        again: bool,
    ) {
        if again {
            self.now = self.before;
        } else {
            self.before = self.now;
        }
        let share = (seconds / INDEPENDENT).min(1.0);
        for (filter, axes) in self.now.axes.iter_mut().enumerate() {
            let square: f64 = axes.iter().map(|[mean, ..]| mean[1] * mean[1]).sum();
            let density = constants.filter_noise.powi(2) + constants.speed_noise.powi(2) * square;
            let oscillator = Oscillator::of(filter, constants.shake);
            let step = (&oscillator.transition(seconds), &oscillator.stationary());
            for (k, axis) in axes.iter_mut().enumerate() {
                let advanced = advance(axis, step, density, position[k], variances[k]);
                if let (Some([error, spread]), Some(weight)) = (advanced, self.now.log_weights.get_mut(filter)) {
                    let far = (1.0 + error * error / spread / FREEDOM).ln();
                    *weight -= 0.5 * share * (spread.ln() + (FREEDOM + 1.0) * far);
                }
            }
        }
        let log_weights = &mut self.now.log_weights;
        let largest = log_weights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        log_weights.iter_mut().for_each(|weight| *weight = (*weight - largest).max(LEAST));
    }

    /// The log weights of the candidates: what [`Shake::carry`] begins the next movement with.
    #[must_use]
    pub const fn evidence(&self) -> Lasting {
        self.now.log_weights
    }

    /// Begins with the evidence of an earlier movement, if there was one.
    pub fn carry(&mut self, evidence: &Lasting) {
        if *evidence != Lasting::default() {
            self.now.log_weights = *evidence;
            self.before.log_weights = *evidence;
        }
    }

    /// The hand on an axis, over all candidates.
    #[must_use]
    pub fn estimate(&self, axis: usize) -> Estimate {
        let (mut total, mut mean, mut covariance) = (0.0, [0.0; 2], [[0.0; 2]; 2]);
        for (candidate, log_weight) in self.now.log_weights.iter().enumerate() {
            let filter = if candidate == 0 { 0 } else { candidate + CANDIDATES - 1 };
            let [of_mean, of_covariance @ ..] = &self.now.axes[filter][axis];
            let weight = log_weight.exp();
            total += weight;
            // each part widens the covariance by its distance from the mean, so nothing is subtracted
            let share = weight / total;
            let offset = [of_mean[0] - mean[0], of_mean[1] - mean[1]];
            for r in 0..2 {
                mean[r] += share * offset[r];
                for c in 0..2 {
                    let own = of_covariance[r][c] + (1.0 - share) * offset[r] * offset[c];
                    covariance[r][c] += share * (own - covariance[r][c]);
                }
            }
        }
        (mean, covariance)
    }

    /// All numbers, for a snapshot.
    #[must_use]
    pub fn save(&self) -> Vec<f64> {
        let mut numbers = Vec::with_capacity(NUMBERS);
        for Filters { log_weights, axes } in [&self.now, &self.before] {
            numbers.extend_from_slice(log_weights);
            numbers.extend_from_slice(axes.as_flattened().as_flattened().as_flattened());
        }
        numbers
    }

    /// What [`Shake::save`] gave.
    #[must_use]
    pub fn load(numbers: &[f64]) -> Self {
        let load = |numbers: &[f64]| {
            let mut filters = Filters { log_weights: [0.0; CANDIDATES], axes: [[Axis::default(); AXES]; FILTERS] };
            let (log_weights, axes) = numbers.split_at(CANDIDATES);
            filters.log_weights.copy_from_slice(log_weights);
            filters.axes.as_flattened_mut().as_flattened_mut().as_flattened_mut().copy_from_slice(axes);
            filters
        };
        let (now, before) = numbers.split_at(NUMBERS / 2);
        Self { now: load(now), before: load(before) }
    }
}

/// How many numbers [`Shake::save`] gives.
pub const NUMBERS: usize = 2 * (CANDIDATES + FILTERS * AXES * STATES * (1 + STATES));

#[cfg(test)]
mod tests {
    use super::super::course::Course;
    use super::super::space::AnySpace;
    use super::*;

    const NOISE: Vector = [0.25, 0.25, 0.0];

    fn constants(shake: f64) -> PointingConstants {
        PointingConstants { shake, ..PointingConstants::default() }
    }

    #[test]
    fn two_steps_are_one_of_twice_the_length() {
        for filter in [1, FILTERS - 1] {
            let oscillator = Oscillator::of(filter, 20.0);
            let [half, whole] = [0.011, 0.022].map(|seconds| oscillator.transition(seconds));
            for r in 0..STATES {
                for c in 0..STATES {
                    let twice: f64 = (0..STATES).map(|k| half[r][k] * half[k][c]).sum();
                    assert!((twice - whole[r][c]).abs() < 1e-12 * (1.0 + twice.abs()), "{filter}: {r}, {c}");
                }
            }
        }
    }

    #[test]
    fn what_is_not_observed_comes_to_shake_as_it_does_for_good() {
        let oscillator = Oscillator::of(FILTERS - 1, 20.0);
        let stationary = oscillator.stationary();
        let mut axis = Axis::default();
        for _ in 0..2000 {
            advance(&mut axis, (&oscillator.transition(0.016), &stationary), 0.0, None, 0.25);
        }
        for r in 2..STATES {
            for c in 2..STATES {
                let [found, expected] = [axis[1 + r][c], stationary[r][c]];
                assert!((found - expected).abs() < 1e-9 * stationary[3][3], "{found} for {expected}");
            }
        }
    }

    /// Samples of a hand at 600 px/s, shaken by a sinusoid, 60 times a second.
    fn samples(amplitude: f64, frequency: f64) -> impl Iterator<Item = (f64, [f64; 2])> {
        (0..40).map(move |k| {
            let time = f64::from(k) / 60.0;
            let shake = amplitude * (std::f64::consts::TAU * frequency * time).sin();
            (time, [600.0 * time + shake, 100.0 - shake])
        })
    }

    fn course(shake: f64, amplitude: f64, frequency: f64) -> Course<AnySpace> {
        let constants = constants(shake);
        let mut course = Course::begin(AnySpace(2), &constants, &[0.0, 100.0], &NOISE[..2]);
        for (time, [x, y]) in samples(amplitude, frequency).skip(1) {
            course.advance(&constants, time, &[Some(x), Some(y)], &NOISE[..2]);
        }
        course
    }

    #[test]
    fn where_nothing_shakes_the_hand_is_as_it_is_without() {
        let [plain, expected] = [0.0, 20.0].map(|shake| course(shake, 0.0, 1.0));
        for axis in 0..2 {
            for (one, other) in plain.axes[axis].now.iter().zip(expected.axes[axis].now) {
                assert!((one - other).abs() < 3.0, "{one} and {other}");
            }
            let [one, other] = [&plain, &expected].map(|course| course.axes[axis].covariance[1][1]);
            assert!((one / other - 1.0).abs() < 0.05, "{one} and {other}");
        }
        let lasting = expected.lasting();
        assert!(lasting[1..].iter().all(|weight| *weight < -2.5) && lasting[0] == 0.0, "{lasting:?}");
    }

    #[test]
    fn the_candidate_without_shake_is_the_filter_of_every_pointer() {
        let constants = constants(20.0);
        let mut shake = Shake::begin(&constants, &[0.0, 100.0, 0.0], &NOISE);
        let plain = course(0.0, 10.0, 5.0);
        for (_, [x, y]) in samples(10.0, 5.0).skip(1) {
            shake.advance(&constants, 1.0 / 60.0, (&[Some(x), Some(y), None], &NOISE), false);
        }
        for axis in 0..2 {
            let [mean, covariance @ ..] = shake.now.axes[0][axis];
            let [[pp, pv], [_, vv]] = plain.axes[axis].covariance;
            let expected = [plain.axes[axis].now[0], plain.axes[axis].now[1], pp, pv, vv];
            let found = [mean[0], mean[1], covariance[0][0], covariance[0][1], covariance[1][1]];
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-8 * (1.0 + expected.abs()), "{found} for {expected}");
            }
        }
    }

    #[test]
    fn what_shakes_is_distinguished_from_the_hand_by_its_frequency_and_its_amplitude() {
        for (frequency, place) in [(3.7, 1), (7.0, 2)] {
            let shaken = course(20.0, 20.0, frequency);
            let lasting = shaken.lasting();
            let best = (0..CANDIDATES).max_by(|&a, &b| lasting[a].total_cmp(&lasting[b]));
            assert!(best.is_some_and(|best| best > 0 && (best - 1) % 3 == place), "{frequency} Hz: {lasting:?}");
            let off = |course: &Course<AnySpace>| (course.axes[0].now[1] - 600.0).hypot(course.axes[1].now[1]);
            let [followed, plain] = [off(&shaken), off(&course(0.0, 20.0, frequency))];
            assert!(followed < 0.6 * plain, "{frequency} Hz: {followed} for {plain}");
        }
    }
}
