//! The probabilities of all destinations in one pass over flat arrays: [`super::Pointing::log_likelihoods`], exponentiated.
//!
//! ```text
//! p_i ~ prior_i near_i (N_i / S_i)^g B_i,  B_i = [(w + z_i + t^2)^2 (c + z_i) / ((w + z_i)^2 (c + z_i + t^2))]^weight
//! ```
//!
//! with `t` the angle between the way so far and the destination, `w` and `c` the squares of `wide` and `core`. `N_i` is a
//! sum of densities, [`shared_sums`] where destinations share the covariance of their endpoints, [`own_sums`] where not.

use super::Space;
use super::endpoint::Nodes;
use super::from_start::FromStart;
use super::targets::Targets;
use whither_kernel::bearings::{Way, exponents, numbers};
use whither_kernel::mixture::{Densities, Powers, own_sums, shared_sums};
use whither_kernel::vectors::{Block, raise};

/// What is this many powers of two below the most probable does not matter.
const NOTHING: f64 = 60.0;

/// What weights sum to, times a power of `e`.
#[derive(Clone, Copy, Debug)]
pub struct Total {
    /// The sum.
    pub total: f64,
    /// The exponent of the power.
    pub log_scale: f64,
}

/// Room that is kept from step to step; what is in it is no part of any state.
#[derive(Debug, Default)]
pub struct Work {
    densities: Vec<Densities>,
    /// A buffer for the weights where the arrays have another order than the destinations.
    aside: Vec<Block>,
    powers: Powers,
}

/// None yet: another movement makes its own.
impl Clone for Work {
    fn clone(&self) -> Self {
        Self::default()
    }
}

/// What all destinations have in common after an observation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Now<'a, S> {
    /// The endpoint densities.
    pub nodes: &'a Nodes<S>,
    /// The direction, and the power `g`.
    pub way: &'a Way,
}

impl Work {
    /// Writes weights of the destinations, which are to be divided by their sum, and returns that; none where numbers leave the
    /// range in which this holds.
    pub fn weights<S: Space>(
        &mut self,
        targets: &Targets,
        from_start: &FromStart,
        now: &Now<'_, S>,
        into: &mut Vec<f64>,
    ) -> Option<Total> {
        if !from_start.moderate {
            return None;
        }
        let Self { densities, aside, powers } = self;
        let weights = targets.layout().buffer(aside, into);
        let d = now.nodes.dimensions();
        let (mut most, mut doubtful) = (f64::MIN, f64::MIN);
        for class in targets.classes() {
            let (places, blocks) = (targets.places(&class.blocks), class.blocks.clone());
            let (over_start, weights) = (&from_start.over_start[blocks.clone()], &mut weights[blocks.clone()]);
            if !now.nodes.densities(class.covariance.as_ref(), densities) {
                return None;
            }
            match &class.covariance {
                Some(_) => shared_sums(d, densities, &places, over_start, powers, weights),
                None => own_sums(d, densities, &places, over_start, powers, weights),
            }
            let (best, worst) = exponents(d, &from_start.bearings[blocks.start * numbers(d)..], now.way, weights);
            (most, doubtful) = (most.max(best), doubtful.max(worst));
        }
        let shift = most.round_ties_even();
        let (total, certain) = (raise(weights, &from_start.priors, shift), doubtful < most - NOTHING);
        if !(certain && most.is_finite() && total > 1e-200 && total < 1e200) {
            return None;
        }
        targets.layout().scatter(aside, into);
        Some(Total { total, log_scale: shift * std::f64::consts::LN_2 })
    }
}
