//! Gaussian algebra, quadrature and the matrix exponential: everything that knows no motion model.

pub mod gaussian;
pub mod kalman;
pub mod lanes;
pub mod log_sum_exp;
pub mod quadrature;
