//! The hot loops of whither, alone: vectors of four numbers, sums of exponentials of quadratics, the flat arrays that they are
//! over, and Gaussians of a few components or of any number.
//!
//! It changes with any release of whither and is not for use by itself. It is a package of its own because its WebAssembly
//! is compiled for speed, and everything else for size.

pub mod axes;
pub mod bearings;
pub mod constant_velocity;
pub mod coupled;
pub mod dense;
pub mod endpoints;
pub mod layout;
pub mod mixture;
pub mod pairs;
pub mod ratios;
pub mod small_gaussian;
pub mod van_loan;
pub mod vectors;
