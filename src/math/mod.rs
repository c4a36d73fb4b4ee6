//! Gaussian algebra, quadrature and the matrix exponential: everything that knows no motion model.

pub mod gaussian;
pub mod quadrature;
