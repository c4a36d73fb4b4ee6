//! Gaussian algebra, quadrature and the matrix exponential: everything that knows no motion model.

pub mod cosine;
pub mod decay;
pub mod gaussian;
pub mod kalman;
pub(crate) mod lanes;
pub mod log_sum_exp;
pub(crate) mod mixture;
pub mod order;
pub mod product;
pub mod quadrature;
pub mod random;
pub mod small_root;
pub mod van_loan;
