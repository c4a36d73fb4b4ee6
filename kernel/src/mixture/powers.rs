//! Terms half evaluated: a sum over terms in two loops.

use crate::vectors::{Block, Lanes};

/// How many pairs of terms are evaluated before their powers are summed up.
const TOGETHER: usize = 4;

/// Room for terms at one block of places between the two halves of a sum, which is kept from step to step.
///
/// The exponents and polynomials of all terms come first, then what makes powers of them and adds them up. In one loop a processor
/// seems to wait for each term's chain of operations, since those that do not depend on it lie too far ahead: that takes 5 to 10% longer
/// with 10 000 places.
#[derive(Clone, Debug, Default)]
pub struct Powers(pub(super) [[Power; 2]; TOGETHER]);

/// One term at one block of places.
#[derive(Clone, Copy, Debug, Default)]
pub struct Power {
    root: Block,
    integer: Block,
    /// Where it is not the same everywhere.
    factor: Block,
}

impl Power {
    #[inline(always)]
    pub fn set<const OWN: bool>(&mut self, (root, integer): (Lanes, Lanes), factor: Lanes) {
        root.store(&mut self.root);
        integer.store(&mut self.integer);
        if OWN {
            factor.store(&mut self.factor);
        }
    }

    #[inline(always)]
    pub fn factor<const OWN: bool>(&self, everywhere: f64) -> Lanes {
        if OWN { Lanes::load(&self.factor) } else { Lanes::splat(everywhere) }
    }

    #[inline(always)]
    pub fn power(&self, of: impl Fn(Lanes, Lanes) -> Lanes) -> Lanes {
        of(Lanes::load(&self.root), Lanes::load(&self.integer))
    }
}
