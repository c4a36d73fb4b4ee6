//! Gaussian algebra, quadrature and the matrix exponential: everything that knows no motion model.

pub mod decay;
pub mod gaussian;
pub mod kalman;
pub mod lanes;
pub mod log_sum_exp;
pub mod mixture;
pub mod quadrature;
pub mod random;
pub mod van_loan;
