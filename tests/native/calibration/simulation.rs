//! Tracks drawn from the very model that the predictor assumes, and how far its probabilities are from how often it is right.

use nalgebra::{Cholesky, DMatrix, DVector};
use serde_json::json;
use whither::Gaussian;
use whither::internals::Bridge;
use whither::internals::Endpoint;
use whither::internals::MotionModel;
use whither::internals::condition;
use whither::internals::{Parts, parts};
use whither::study::simulate::Random;
use whither::{Predictor, Scenario};

/// A scenario with a prior of everything: four destinations, constant velocity in the plane.
pub fn scenario(method: &str) -> Scenario {
    let value = json!({
        "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 1 },
        "observation": { "noise": 0.5 },
        "initial": {
            "mean": [0, 0, 1, 0],
            "covariance": [[4, 0, 0, 0], [0, 4, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
        },
        "arrival": { "type": "discrete", "times": [6, 8, 10], "weights": [1, 2, 1] },
        "method": method,
        "destinations": [
            { "id": "a", "center": [10, 0], "size": 5, "prior": 4 },
            { "id": "b", "center": [8, 8], "size": 5, "prior": 3 },
            { "id": "c", "mean": [0, 10], "covariance": [[3, 1], [1, 3]], "prior": 2 },
            { "id": "d", "center": [-8, -2], "size": [5, 9], "endVelocity": 2, "prior": 1 }
        ]
    });
    serde_json::from_value(value).expect("a scenario")
}

/// How the endpoint comes about, which is what the two families of methods differ in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Family {
    /// `x_T` goes with the Markov model, and what is known of it is a pseudo-observation.
    PseudoObservation,
    /// `x_T` is independent of `x_1`.
    Independent,
}

/// A track: which destination, and the observations.
pub struct Track {
    /// The destination.
    pub destination: usize,
    /// Times and positions.
    pub observations: Vec<(f64, [f64; 2])>,
}

fn categorical(random: &mut Random, weights: impl Iterator<Item = f64> + Clone) -> usize {
    let mut left = random.uniform() * weights.clone().sum::<f64>();
    for (i, weight) in weights.clone().enumerate() {
        left -= weight;
        if left < 0.0 {
            return i;
        }
    }
    weights.count() - 1
}

fn drawn(random: &mut Random, mean: &DVector<f64>, covariance: &DMatrix<f64>) -> DVector<f64> {
    let n = mean.len();
    // what is left of no freedom is rounding
    let root = Cholesky::new(covariance + DMatrix::identity(n, n) * 1e-12).expect("a covariance").l();
    mean + root * DVector::from_fn(n, |_, _| random.normal())
}

/// One track with this many observations, all before the arrival.
pub fn track(scenario: &Scenario, family: Family, count: usize, random: &mut Random) -> Track {
    let Parts { motion, observation, destinations, arrival } = parts(scenario);
    let (arrival, quadrature) = arrival.expect("a method of the papers");
    let destination = categorical(random, destinations.priors().iter().copied());
    let grid = whither::internals::grid(arrival, quadrature, 0.0, 1.0);
    let arrives = grid.times[categorical(random, grid.log_weights.iter().map(|log| log.exp()))];
    let motion = motion.candidates[0].model.as_ref();
    let noise = observation.noise();

    let before = Gaussian {
        mean: DVector::from_column_slice(&[0.0, 0.0, 1.0, 0.0]),
        covariance: DMatrix::from_diagonal(&DVector::from_column_slice(&[4.0, 4.0, 1.0, 1.0])),
    };
    let matrix = DMatrix::identity(2, 4);
    let observe = |state: &DVector<f64>, random: &mut Random| drawn(random, &(&matrix * state), noise);
    let first = drawn(random, &before.mean, &before.covariance);
    let first_observed = observe(&first, random);
    let (mean, spread) = (destinations.mean(destination), &destinations.class(destination).covariance());
    let target = DVector::from_vec(mean);
    let (mut state, end) = match family {
        Family::Independent => (first, drawn(random, &target, spread)),
        Family::PseudoObservation => {
            // x_1 given y_1 and the pseudo-observation, then x_T given x_1 and the pseudo-observation
            let given = condition(&before.covariance, &matrix, noise).expect("a density");
            let mean = &before.mean + &given.gain * (&first_observed - &matrix * &before.mean);
            let way = Endpoint::after(motion, arrives, target.len());
            let pseudo = condition(&given.covariance(), &way.matrix, &(&way.noise + spread)).expect("a density");
            let mean = &mean + &pseudo.gain * (&target - &way.matrix * &mean);
            let state = drawn(random, &mean, &pseudo.covariance());
            let identity = DMatrix::identity(target.len(), target.len());
            let end = condition(&way.noise, &identity, spread).expect("a density");
            let ahead = &way.matrix * &state;
            let mean = &ahead + &end.gain * (&target - &ahead);
            (state, drawn(random, &mean, &end.covariance()))
        }
    };
    let mut observations = vec![(0.0, [first_observed[0], first_observed[1]])];
    let step = 5.0 / count as f64;
    for k in 1..count {
        let time = step * k as f64;
        state = bridged(motion, &state, &end, step, arrives - time, random);
        let y = observe(&state, random);
        observations.push((time, [y[0], y[1]]));
    }
    Track { destination, observations }
}

/// One step towards a known endpoint.
fn bridged(
    motion: &dyn MotionModel,
    state: &DVector<f64>,
    end: &DVector<f64>,
    step: f64,
    rest: f64,
    random: &mut Random,
) -> DVector<f64> {
    let (h, r) = (motion.transition(step), motion.transition(rest));
    let bridge = Bridge::new(&h.transition, &h.noise, &r.transition, &r.noise, end.len()).expect("a bridge");
    drawn(random, &(&bridge.previous * state + &bridge.destination * end), &bridge.covariance)
}

/// A bin of a reliability table.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bin {
    /// How many probabilities were in it.
    pub count: f64,
    /// Their sum.
    pub predicted: f64,
    /// How many of them were of the true destination.
    pub right: f64,
    /// The variance of that number, if they are right.
    pub variance: f64,
}

impl Bin {
    /// How far it is from what it should be, in standard deviations.
    pub fn deviations(&self) -> f64 {
        if self.variance > 0.0 { (self.right - self.predicted) / self.variance.sqrt() } else { 0.0 }
    }
}

/// The reliability of every probability after the last of `count` observations, over many tracks: ten bins.
pub fn reliability(method: &str, family: Family, tracks: usize, count: usize, seed: u64) -> [Bin; 10] {
    let scenario = scenario(method);
    let mut random = Random::new(seed);
    let mut bins = [Bin::default(); 10];
    for _ in 0..tracks {
        let track = track(&scenario, family, count, &mut random);
        let mut predictor = Predictor::new(&scenario);
        for (time, position) in &track.observations {
            predictor.observe(*time, position).expect("an observation");
        }
        for (i, &p) in predictor.probabilities().iter().enumerate() {
            let bin = &mut bins[((p * 10.0) as usize).min(9)];
            bin.count += 1.0;
            bin.predicted += p;
            bin.right += f64::from(u8::from(i == track.destination));
            bin.variance += p * (1.0 - p);
        }
    }
    bins
}
