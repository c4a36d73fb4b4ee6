//! `p(y_k | y_1:k-1, D_i, T)` as a Gaussian, by Algorithm 1, by Algorithm 2 and by the original bridging distributions, and the
//! Bhattacharyya distances between them.

use crate::movement::Movement;
use nalgebra::{DMatrix, DVector, Dyn, OMatrix};
use whither::Gaussian;
use whither::internals::Bridge;
use whither::internals::{Parts, condition, grid, parts, propagate};
use whither::{Predictor, Scenario};

/// The mean distances after each observation but the first, averaged over destinations and arrival times: original and
/// Algorithm 1, original and Algorithm 2, Algorithm 1 and Algorithm 2.
pub fn distances(scenario: &Scenario, movement: &Movement) -> Vec<[f64; 3]> {
    let Parts { motion, observation, destinations, arrival } = parts(scenario);
    let Some((arrival, quadrature)) = arrival else { return Vec::new() };
    let motion = motion.candidates[0].model.as_ref();
    let (s, count) = (motion.states(), destinations.len());
    let arrival = grid(arrival, quadrature, 0.0, 0.0);
    let first = first_posterior(scenario, movement);
    let noise = observation.noise().clone();
    let observation = DMatrix::from_fn(noise.nrows(), s, |i, j| f64::from(u8::from(i == j)));
    let extent = destinations.classes()[0].covariance();
    let end = |i: usize| DVector::from_vec(destinations.mean(i));
    let start_time = movement.observations[0].0;
    let mut state = first.clone();
    let mut bridged: Vec<Vec<Gaussian>> =
        arrival.times.iter().map(|_| (0..count).map(|i| stacked(&first, &end(i), &extent)).collect()).collect();
    let mut averages = Vec::new();
    for pair in movement.observations.windows(2) {
        let ((before, _), (time, position)) = (&pair[0], &pair[1]);
        let y = DVector::from_column_slice(position);
        let step = motion.transition(time - before);
        let predicted = Gaussian {
            mean: &step.transition * &state.mean + &step.offset,
            covariance: propagate(&step.transition, &state.covariance, &step.noise),
        };
        let (mut sums, mut weights) = ([0.0; 3], 0.0);
        for (n, (arrival_time, log_weight)) in arrival.times.iter().zip(&arrival.log_weights).enumerate() {
            let rest_time = arrival_time - (time - start_time);
            if rest_time <= 0.0 {
                continue;
            }
            let rest = motion.transition(rest_time);
            let total = motion.transition(rest_time + (time - before));
            let onward = Bridge::new(&step.transition, &step.noise, &rest.transition, &rest.noise, s)
                .expect("constant velocity moves every component");
            // (10): the prediction given the pseudo-observation
            let now = condition(&predicted.covariance, &rest.transition, &(&rest.noise + &extent))
                .expect("positive definite");
            // (12) and (13): the posterior before given it, then the step given it
            let earlier =
                condition(&state.covariance, &total.transition, &(&total.noise + &extent)).expect("positive definite");
            let later = condition(&step.noise, &rest.transition, &(&rest.noise + &extent)).expect("positive definite");
            let kept = DMatrix::identity(s, s) - &later.gain * &rest.transition;
            for (i, joint) in bridged[n].iter_mut().enumerate() {
                let a = end(i);
                let one = Gaussian {
                    mean: &predicted.mean + &now.gain * (&a - &rest.transition * &predicted.mean - &rest.offset),
                    covariance: now.covariance(),
                };
                let smoothed = &state.mean + &earlier.gain * (&a - &total.transition * &state.mean - &total.offset);
                let moved = &step.transition * smoothed + &step.offset;
                let two = Gaussian {
                    mean: &moved + &later.gain * (&a - &rest.transition * &moved - &rest.offset),
                    covariance: propagate(&(&kept * &step.transition), &earlier.covariance(), &later.covariance()),
                };
                *joint = advance(joint, &onward, &onward.offset(&step.offset, &rest.offset));
                let original = observed(&upper(joint, s), &observation, &noise);
                let (one, two) = (observed(&one, &observation, &noise), observed(&two, &observation, &noise));
                for (sum, pair) in sums.iter_mut().zip([(&original, &one), (&original, &two), (&one, &two)]) {
                    *sum += log_weight.exp() * bhattacharyya(pair.0, pair.1) / count as f64;
                }
                correct(joint, &observation, &noise, &y);
            }
            weights += log_weight.exp();
        }
        state = predicted;
        correct(&mut state, &observation, &noise, &y);
        if weights > 0.0 {
            averages.push(sums.map(|sum| sum / weights));
        }
    }
    averages
}

fn first_posterior(scenario: &Scenario, movement: &Movement) -> Gaussian {
    let mut predictor = Predictor::new(scenario);
    let (time, position) = &movement.observations[0];
    predictor.observe(*time, position).expect("it is legal");
    predictor.initial_state().expect("there is an observation")
}

/// `[x; x_T]`, independent of each other.
fn stacked(state: &Gaussian, end: &DVector<f64>, extent: &DMatrix<f64>) -> Gaussian {
    let s = end.len();
    let mut mean = state.mean.clone().resize_vertically(2 * s, 0.0);
    mean.rows_mut(s, s).copy_from(end);
    let mut covariance: OMatrix<f64, Dyn, Dyn> = state.covariance.clone().resize(2 * s, 2 * s, 0.0);
    covariance.view_mut((s, s), (s, s)).copy_from(extent);
    Gaussian { mean, covariance }
}

fn advance(joint: &Gaussian, bridge: &Bridge, offset: &DVector<f64>) -> Gaussian {
    let s = offset.len();
    let mut onward = DMatrix::identity(2 * s, 2 * s);
    onward.view_mut((0, 0), (s, s)).copy_from(&bridge.previous);
    onward.view_mut((0, s), (s, s)).copy_from(&bridge.destination);
    let noise = bridge.covariance.clone().resize(2 * s, 2 * s, 0.0);
    let mut mean = &onward * &joint.mean;
    mean.rows_mut(0, s).zip_apply(offset, |x, o| *x += o);
    Gaussian { mean, covariance: propagate(&onward, &joint.covariance, &noise) }
}

fn upper(joint: &Gaussian, s: usize) -> Gaussian {
    Gaussian {
        mean: joint.mean.rows(0, s).into_owned(),
        covariance: joint.covariance.view((0, 0), (s, s)).into_owned(),
    }
}

/// The density of an observation.
fn observed(state: &Gaussian, observation: &DMatrix<f64>, noise: &DMatrix<f64>) -> Gaussian {
    Gaussian { mean: observation * &state.mean, covariance: propagate(observation, &state.covariance, noise) }
}

fn correct(state: &mut Gaussian, observation: &DMatrix<f64>, noise: &DMatrix<f64>, y: &DVector<f64>) {
    let wide = observation.clone().resize_horizontally(state.mean.len(), 0.0);
    let conditioned = condition(&state.covariance, &wide, noise).expect("the noise is positive definite");
    let error = y - wide * &state.mean;
    state.mean += &conditioned.gain * error;
    state.covariance = conditioned.covariance();
}

/// `d' S^-1 d / 8 + ln(det S / sqrt(det S_1 det S_2)) / 2` with `S` the mean of both covariances.
fn bhattacharyya(one: &Gaussian, two: &Gaussian) -> f64 {
    let middle = (&one.covariance + &two.covariance) * 0.5;
    let difference = &one.mean - &two.mean;
    let inverse = middle.clone().try_inverse().expect("it is positive definite");
    let apart = (difference.transpose() * inverse * &difference)[0] / 8.0;
    let determinants = (one.covariance.determinant() * two.covariance.determinant()).sqrt();
    // rounding may leave the ratio of equal ones below one
    apart + 0.5 * (middle.determinant() / determinants).ln().abs()
}
