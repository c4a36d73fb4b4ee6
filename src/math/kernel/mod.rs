//! The hot loop, alone: vectors of four numbers, sums of exponentials of quadratics, and the flat arrays that they are over.

pub(crate) mod layout;
pub(crate) mod mixture;
pub(crate) mod vectors;
