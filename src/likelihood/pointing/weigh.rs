//! The probabilities of all destinations in one pass over flat arrays: [`super::Pointing::log_likelihoods`], exponentiated.
//!
//! ```text
//! p_i ~ prior_i near_i (N_i / S_i)^g B_i,  B_i = [(w + z_i + t^2)^2 (c + z_i) / ((w + z_i)^2 (c + z_i + t^2))]^weight
//! ```
//!
//! with `t` the angle between the way so far and the destination, `w` and `c` the squares of `wide` and `core`. `N_i` is a
//! sum of [`Ellipsoid`] terms where destinations share the covariance of their endpoints, of [`Density`] terms where not.

use super::Vector;
use super::endpoint::Nodes;
use super::evidence::DirectionNow;
use super::targets::Targets;
use crate::math::lanes::{Block, Lanes, Shift, WIDTH};
use crate::math::mixture::{AXES, Density, Ellipsoid, weigh_in};

/// Where `log2 N_i / S_i` is below this, `N_i` may have been cut off.
const CERTAIN: f64 = -500.0;

/// What is this many powers of two below the most probable does not matter.
const NOTHING: f64 = 60.0;

/// Room that is kept from step to step; what is in it is no part of any state.
#[derive(Clone, Debug, Default)]
pub struct Work {
    ellipsoids: Vec<Ellipsoid>,
    densities: Vec<Density>,
    weights: Vec<Block>,
}

/// What all destinations have in common after an observation.
#[derive(Clone, Copy, Debug)]
pub struct Now<'a> {
    /// The endpoint densities.
    pub nodes: &'a Nodes,
    /// The direction.
    pub direction: &'a DirectionNow<'a>,
    /// The start of the movement.
    pub start: &'a Vector,
    /// The power `g`.
    pub power: f64,
}

impl Work {
    /// Writes the probabilities among the destinations and returns the logarithm of what they sum to; none where numbers
    /// leave the range in which this holds.
    pub fn probabilities(&mut self, targets: &Targets, now: &Now<'_>, into: &mut Vec<f64>) -> Option<f64> {
        if !targets.moderate {
            return None;
        }
        self.weights.resize(targets.priors.len(), [0.0; WIDTH]);
        let d = now.nodes.dimensions();
        for class in &targets.classes {
            let (places, blocks) = (targets.layout.places(&class.blocks, [0.0; AXES]), class.blocks.clone());
            let (over_start, weights) = (&targets.over_start[blocks.clone()], &mut self.weights[blocks]);
            match &class.covariance {
                Some(covariance) => {
                    now.nodes.ellipsoids(covariance, &mut self.ellipsoids);
                    weigh_in(d, &self.ellipsoids, &places, 0.0, over_start, weights);
                }
                None => {
                    now.nodes.densities(&mut self.densities);
                    weigh_in(d, &self.densities, &places, 0.0, over_start, weights);
                }
            }
        }
        let (most, doubtful) = self.exponents(targets, now);
        let shift = most.round();
        let (total, certain) = (self.raise(&targets.priors, shift), doubtful < most - NOTHING);
        if !(certain && most.is_finite() && total > 1e-200 && total < 1e200) {
            return None;
        }
        targets.layout.scatter(&self.weights, into);
        into.iter_mut().for_each(|weight| *weight /= total);
        Some(total.ln() + shift * std::f64::consts::LN_2)
    }

    /// Turns the sums `N_i / S_i` into the exponents of the likelihoods, and returns the largest, and the largest of those
    /// whose sums may have been cut off.
    #[inline(never)]
    fn exponents(&mut self, targets: &Targets, now: &Now<'_>) -> (f64, f64) {
        let s = Lanes::splat;
        let coordinates = targets.layout.coordinates();
        let (wide, core) = (s(now.direction.wide_squared()), s(now.direction.core_squared()));
        let (power, weight, way) = (s(now.power), s(now.direction.weight()), now.direction.unit());
        let (mut most, mut doubtful) = (s(f64::MIN), s(f64::MIN));
        let statics = targets.angular_variance.iter().zip(&targets.over_distance);
        for (i, (exponent, (variance, over_distance))) in self.weights.iter_mut().zip(statics).enumerate() {
            let over_distance = Lanes::load(over_distance);
            let [mut along, mut across] = [s(0.0); 2];
            // no loop over the axes: at the level for size it would stay one; an axis that there is not has no blocks
            let mut axis = |k: usize| {
                let Some(block) = coordinates[k].get(i) else { return };
                let unit = (Lanes::load(block) - s(now.start[k])) * over_distance;
                let (sum, difference) = (unit + s(way[k]), unit - s(way[k]));
                along = along + sum * sum;
                across = across + difference * difference;
            };
            axis(0);
            axis(1);
            axis(2);
            let (angle, variance) = (Lanes::squared_angle(along, across), Lanes::load(variance));
            let (wide, core) = (wide + variance, core + variance);
            let wider = (wide + angle) / wide;
            let seen = wider * wider * core / (core + angle);
            let ratio = Lanes::load(exponent).log2();
            let whole = power * ratio + weight * seen.log2();
            let sure = ((ratio - s(CERTAIN)).at_least(s(0.0))).at_most(s(1.0));
            most = whole.at_least(most);
            doubtful = (whole - sure * s(1e9)).at_least(doubtful);
            whole.store(exponent);
        }
        (most.most(), doubtful.most())
    }

    /// Turns exponents into weights, `prior_i 2^(exponent - shift)`, and returns their sum.
    #[inline(never)]
    fn raise(&mut self, priors: &[Block], shift: f64) -> f64 {
        let shift = Shift::by(shift);
        let mut total = Lanes::splat(0.0);
        for (weight, prior) in self.weights.iter_mut().zip(priors) {
            let raised = Lanes::load(weight).exp2(&shift) * Lanes::load(prior);
            raised.store(weight);
            total = total + raised;
        }
        total.sum()
    }
}
