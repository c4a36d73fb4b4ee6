//! Gaussian algebra, quadrature and the matrix exponential: everything that knows no motion model.

pub mod cosine;
pub mod decay;
pub mod gaussian;
pub mod grouped;
pub mod kalman;
pub mod log_sum_exp;
pub mod quadrature;
pub mod radix_sort;
pub mod random;
pub mod van_loan;

#[cfg(test)]
mod tests;
