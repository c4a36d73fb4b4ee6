//! The probabilities of all destinations in one pass over flat arrays: [`super::Pointing::log_likelihoods`], exponentiated.
//!
//! ```text
//! p_i ~ prior_i near_i (N_i / S_i)^g B_i,  B_i = [(w + z_i + t^2)^2 (c + z_i) / ((w + z_i)^2 (c + z_i + t^2))]^weight
//! ```
//!
//! with `t` the angle between the way so far and the destination, `w` and `c` the squares of `wide` and `core`. `N_i` is a
//! sum of [`SharedDensity`] terms where destinations share the covariance of their endpoints, of [`Density`] terms where not.

use super::endpoint::Nodes;
use super::evidence::DirectionNow;
use super::from_start::FromStart;
use super::targets::{Class, Targets};
use super::{Space, Vector};
use whither_kernel::mixture::{Density, Places, SharedDensity, Sums};
use whither_kernel::vectors::{Block, Lanes, raise};

/// Where `log2 N_i / S_i` is below this, `N_i` may have been cut off.
const CERTAIN: f64 = -500.0;

/// The variance of a direction without information. None is larger, and the product of three of them is a number still.
const NO_DIRECTION: f64 = 1e100;

/// What is this many powers of two below the most probable does not matter.
const NOTHING: f64 = 60.0;

/// Room that is kept from step to step; what is in it is no part of any state.
#[derive(Clone, Debug, Default)]
pub struct Work {
    shared: Vec<SharedDensity>,
    densities: Vec<Density>,
    /// A buffer for the weights where the arrays have another order than the destinations.
    aside: Vec<Block>,
}

/// What all destinations have in common after an observation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Now<'a, S> {
    /// The endpoint densities.
    pub nodes: &'a Nodes<S>,
    /// The direction.
    pub direction: &'a DirectionNow<'a, S>,
    /// The start of the movement.
    pub start: &'a Vector,
    /// The power `g`.
    pub power: f64,
}

impl Work {
    /// Writes the probabilities among the destinations and returns the logarithm of what they sum to; none where numbers
    /// leave the range in which this holds.
    pub fn probabilities<S: Space>(
        &mut self,
        targets: &Targets,
        from_start: &FromStart,
        now: &Now<'_, S>,
        into: &mut Vec<f64>,
    ) -> Option<f64> {
        if !from_start.moderate {
            return None;
        }
        let Self { shared, densities, aside } = self;
        let weights = targets.layout().buffer(aside, into);
        let d = now.nodes.dimensions();
        let (mut most, mut doubtful) = (f64::MIN, f64::MIN);
        for class in targets.classes() {
            let (places, blocks) = (targets.places(&class.blocks), class.blocks.clone());
            let (over_start, weights) = (&from_start.over_start[blocks.clone()], &mut weights[blocks]);
            match &class.covariance {
                Some(covariance) => {
                    now.nodes.shared_densities(covariance, shared);
                    SharedDensity::weighted_sums(d, shared, &places, 0.0, over_start, weights);
                }
                None => {
                    now.nodes.densities(densities);
                    Density::weighted_sums(d, densities, &places, 0.0, over_start, weights);
                }
            }
            let (best, worst) = exponents(class, &places, now, weights);
            (most, doubtful) = (most.max(best), doubtful.max(worst));
        }
        let shift = most.round();
        let (total, certain) = (raise(weights, &from_start.priors, shift), doubtful < most - NOTHING);
        if !(certain && most.is_finite() && total > 1e-200 && total < 1e200) {
            return None;
        }
        targets.layout().scatter(aside, into);
        let over = 1.0 / total;
        into.iter_mut().for_each(|weight| *weight *= over);
        Some(total.ln() + shift * std::f64::consts::LN_2)
    }
}

/// Turns the sums `N_i / S_i` into the exponents of the likelihoods, and returns the largest, and the largest of those
/// whose sums may have been cut off.
#[inline(never)]
fn exponents<S: Space>(class: &Class, places: &Places<'_>, now: &Now<'_, S>, weights: &mut [Block]) -> (f64, f64) {
    let s = Lanes::splat;
    let (zero, one) = (s(0.0), s(1.0));
    let (wide, core) = (s(now.direction.wide_squared()), s(now.direction.core_squared()));
    let (power, weight, way) = (s(now.power), s(now.direction.weight()), now.direction.unit());
    let three = now.nodes.dimensions() > 2;
    let (mut most, mut doubtful) = (s(f64::MIN), s(f64::MIN));
    for (i, exponent) in weights.iter_mut().enumerate() {
        // no loops over the axes: at the level for size they would stay loops
        let (x, y) = (offset(places, 0, i, now.start), offset(places, 1, i, now.start));
        let third = if three { Some(offset(places, 2, i, now.start)) } else { None };
        let mut square = squared(x) + squared(y);
        if let Some(z) = third {
            square = square + squared(z);
        }
        let distance = square.at_least(s(f64::MIN_POSITIVE)).sqrt();
        // one division for both one over the distance and distance / (distance^2 + 1)
        let further = square + one;
        let over = one / (distance * further);
        let scale = further * over;
        let (x, y) = (x * scale, y * scale);
        let [xx, xy, yy, xz, yz, zz] = match &class.covariance {
            Some([xx, xy, yy, xz, yz, zz]) => [s(*xx), s(*xy), s(*yy), s(*xz), s(*yz), s(*zz)],
            None => [own(places, 0, i), zero, own(places, 1, i), zero, zero, own(places, 2, i)],
        };
        // the squared lengths of the sum of two unit vectors and of their difference
        let mut sum = squared(x + s(way[0])) + squared(y + s(way[1]));
        let mut difference = squared(x - s(way[0])) + squared(y - s(way[1]));
        // `(trace S - u'S u) / (d - 1)` along the unit vector `u`, multiplied out, so that nothing large is subtracted
        let (a, b, mixed) = (squared(x), squared(y), xy * x * y);
        let mut across = xx * b + yy * a - (mixed + mixed);
        if let Some(z) = third {
            let z = z * scale;
            sum = sum + squared(z + s(way[2]));
            difference = difference + squared(z - s(way[2]));
            let mixed = z * (xz * x + yz * y);
            across = s(0.5) * (across + (xx + yy) * squared(z) + zz * (a + b) - (mixed + mixed));
        }
        let angle = Lanes::squared_angle(sum, difference);
        // what is at the start itself lies in no direction
        let nowhere = (one - square * s(f64::MIN_POSITIVE.recip())).at_least(zero);
        let shrunk = square * over;
        let variance = across * shrunk * shrunk + nowhere * s(NO_DIRECTION);
        let (wide, core) = (wide + variance, core + variance);
        let wider = wide + angle;
        let evidence = (wider * wider * core) / (wide * wide * (core + angle));
        let ratio = Lanes::load(exponent).log2();
        let exponent_sum = power * ratio + weight * evidence.log2();
        let sure = ((ratio - s(CERTAIN)).at_least(zero)).at_most(one);
        most = exponent_sum.at_least(most);
        doubtful = (exponent_sum - sure * s(1e9)).at_least(doubtful);
        exponent_sum.store(exponent);
    }
    (most.most(), doubtful.most())
}

#[inline(always)]
fn squared(x: Lanes) -> Lanes {
    x * x
}

#[inline(always)]
fn offset(places: &Places<'_>, axis: usize, i: usize, start: &Vector) -> Lanes {
    match places.coordinates[axis].get(i) {
        Some(block) => Lanes::load(block) - Lanes::splat(start[axis]),
        None => Lanes::splat(0.0),
    }
}

#[inline(always)]
fn own(places: &Places<'_>, axis: usize, i: usize) -> Lanes {
    places.variances[axis].get(i).map_or(Lanes::splat(0.0), Lanes::load)
}
