//! The probabilities of all destinations in one pass over flat arrays: [`super::Pointing::log_likelihoods`], exponentiated.
//!
//! ```text
//! p_i ~ prior_i near_i (N_i / S_i)^g B_i,  B_i = [(w + z_i + t^2)^2 (c + z_i) / ((w + z_i)^2 (c + z_i + t^2))]^weight
//! ```
//!
//! with `t` the angle between the way so far and the destination, `w` and `c` the squares of `wide` and `core`. `N_i` is a
//! sum of [`SharedDensity`] terms where destinations share the covariance of their endpoints, of [`Density`] terms where not.

use super::Vector;
use super::endpoint::Nodes;
use super::evidence::DirectionNow;
use super::targets::Targets;
use crate::math::lanes::{Block, Lanes, raise};
use crate::math::mixture::{AXES, Density, SharedDensity, weigh_in};
use crate::model::destination::Destinations;

/// Where `log2 N_i / S_i` is below this, `N_i` may have been cut off.
const CERTAIN: f64 = -500.0;

/// What is this many powers of two below the most probable does not matter.
const NOTHING: f64 = 60.0;

/// Room that is kept from step to step; what is in it is no part of any state.
#[derive(Clone, Debug, Default)]
pub struct Work {
    shared: Vec<SharedDensity>,
    densities: Vec<Density>,
    /// Room for the weights where destinations stand in another order than their own.
    aside: Vec<Block>,
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
    pub fn probabilities(
        &mut self,
        destinations: &Destinations,
        targets: &Targets,
        now: &Now<'_>,
        into: &mut Vec<f64>,
    ) -> Option<f64> {
        if !targets.moderate {
            return None;
        }
        let Self { shared, densities, aside } = self;
        let weights = targets.layout.room(aside, into);
        let d = now.nodes.dimensions();
        for class in &targets.classes {
            let (places, blocks) =
                (targets.layout.places(destinations, &class.blocks, [0.0; AXES]), class.blocks.clone());
            let (over_start, weights) = (&targets.over_start[blocks.clone()], &mut weights[blocks]);
            match &class.covariance {
                Some(covariance) => {
                    now.nodes.shared_densities(covariance, shared);
                    weigh_in(d, shared, &places, 0.0, over_start, weights);
                }
                None => {
                    now.nodes.densities(densities);
                    weigh_in(d, densities, &places, 0.0, over_start, weights);
                }
            }
        }
        let (most, doubtful) = exponents(destinations, targets, now, weights);
        let shift = most.round();
        let (total, certain) = (raise(weights, &targets.priors, shift), doubtful < most - NOTHING);
        if !(certain && most.is_finite() && total > 1e-200 && total < 1e200) {
            return None;
        }
        targets.layout.settle(aside, into);
        let over = 1.0 / total;
        into.iter_mut().for_each(|weight| *weight *= over);
        Some(total.ln() + shift * std::f64::consts::LN_2)
    }
}

/// In one axis, the squares of the sum and of the difference of the unit vectors to the destinations and along the way;
/// an axis that there is not has no block.
#[inline(always)]
fn apart((block, start, way): (Option<&Block>, f64, f64), over_distance: Lanes) -> (Lanes, Lanes) {
    let Some(block) = block else { return (Lanes::splat(0.0), Lanes::splat(0.0)) };
    let unit = (Lanes::load(block) - Lanes::splat(start)) * over_distance;
    let (sum, difference) = (unit + Lanes::splat(way), unit - Lanes::splat(way));
    (sum * sum, difference * difference)
}

/// Turns the sums `N_i / S_i` into the exponents of the likelihoods, and returns the largest, and the largest of those
/// whose sums may have been cut off.
#[inline(never)]
fn exponents(destinations: &Destinations, targets: &Targets, now: &Now<'_>, weights: &mut [Block]) -> (f64, f64) {
    let s = Lanes::splat;
    let coordinates = targets.layout.coordinates(destinations);
    let (wide, core) = (s(now.direction.wide_squared()), s(now.direction.core_squared()));
    let (power, weight, way) = (s(now.power), s(now.direction.weight()), now.direction.unit());
    let (mut most, mut doubtful) = (s(f64::MIN), s(f64::MIN));
    let statics = targets.angular_variance.iter().zip(&targets.over_distance);
    for (i, (exponent, (variance, over_distance))) in weights.iter_mut().zip(statics).enumerate() {
        let over_distance = Lanes::load(over_distance);
        // no loop over the axes: at the level for size it would stay one
        let [x, y, z] = [
            (coordinates[0].get(i), now.start[0], way[0]),
            (coordinates[1].get(i), now.start[1], way[1]),
            (coordinates[2].get(i), now.start[2], way[2]),
        ];
        let ((a, b), (c, d), (e, f)) = (apart(x, over_distance), apart(y, over_distance), apart(z, over_distance));
        let (angle, variance) = (Lanes::squared_angle(a + c + e, b + d + f), Lanes::load(variance));
        let (wide, core) = (wide + variance, core + variance);
        let wider = wide + angle;
        let seen = (wider * wider * core) / (wide * wide * (core + angle));
        let ratio = Lanes::load(exponent).log2();
        let whole = power * ratio + weight * seen.log2();
        let sure = ((ratio - s(CERTAIN)).at_least(s(0.0))).at_most(s(1.0));
        most = whole.at_least(most);
        doubtful = (whole - sure * s(1e9)).at_least(doubtful);
        whole.store(exponent);
    }
    (most.most(), doubtful.most())
}
