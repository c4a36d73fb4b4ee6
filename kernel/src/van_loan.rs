//! A linear stochastic differential equation over a step: the integrals of Van Loan, "Computing integrals involving the
//! matrix exponential", IEEE Transactions on Automatic Control 23 (1978) 395-404.
//!
//! ```text
//! dx = (A x + b) dt + dw, E[dw dw'] = W dt
//! F(h) = exp(A h)    I(h) = int_0^h exp(A u) du  (so M = I b)    Q(h) = int_0^h exp(A u) W exp(A' u) du
//! ```
//!
//! Van Loan reads all three off one exponential of a block matrix; its corner `exp(-A h)` overflows for long steps, and
//! scaling and squaring of all of it loses small entries against large ones. Here the series of the same blocks is summed
//! for a step of at most half of `1 / |A|`, which keeps the relative accuracy of every entry, and the step is doubled:
//! ```text
//! F - 1 = E:  E(2h) = 2 E + E E        I(2h) = 2 I + E I        Q(2h) = Q + F Q F'
//! ```
//! Carrying `F - 1` instead of `F` keeps modes that are slow against `|A|`.

use crate::dense::{multiply, multiply_transposed, symmetrise};

/// The series of one equation, ready for any step. Matrices are flat, column by column.
#[derive(Clone, Debug)]
pub struct Series {
    /// `s`.
    pub states: usize,
    /// `|A|`, the largest sum of a row's absolute values (1 where `A` is zero); time is measured in `1 / |A|`.
    pub rate: f64,
    /// `A^k / (k + 1)!` with `A` in units of `rate`: the coefficients of `I`.
    pub integral: Vec<f64>,
    /// `A^(k+1) / (k + 1)!`: those of `F - 1`.
    pub change: Vec<f64>,
    /// `W_k / (k + 1)!`, `W_0 = W`, `W_(k+1) = A W_k + W_k A'`: those of `Q`.
    pub noise: Vec<f64>,
}

/// What an equation is over one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// `F`.
    pub transition: Vec<f64>,
    /// `I`, the integral of `F` over the step; empty where it was not asked for.
    pub integral: Vec<f64>,
    /// `Q`, symmetric.
    pub noise: Vec<f64>,
}

impl Series {
    /// What it is over a step, `step >= 0`.
    #[must_use]
    pub fn step(&self, step: f64) -> Step {
        self.over(step, true)
    }

    /// The same for an equation without a constant term, which has no use for the integral.
    #[must_use]
    pub fn step_without_integral(&self, step: f64) -> Step {
        self.over(step, false)
    }

    #[inline(never)]
    fn over(&self, step: f64, with_integral: bool) -> Step {
        let (s, time) = (self.states, self.rate * step);
        let doublings = if time > 0.5 { (2.0 * time).log2().ceil().min(1100.0) as i32 } else { 0 };
        let short = time * 0.5f64.powi(doublings);
        let mut change = sum(&self.change, short, 1.0, s);
        let mut noise = sum(&self.noise, short, self.rate, s);
        let mut integral = if with_integral { sum(&self.integral, short, self.rate, s) } else { Vec::new() };
        let (mut grown, mut product) = (change.clone(), change.clone());
        for _ in 0..doublings {
            // Q + (1 + E) Q (1 + E)'
            multiply(&change, s, &noise, s, &mut grown);
            multiply_transposed(&grown, s, &change, s, &mut product);
            for j in 0..s {
                for i in 0..s {
                    let place = i + j * s;
                    noise[place] = 2.0 * noise[place] + grown[place] + grown[j + i * s] + product[place];
                }
            }
            if with_integral {
                multiply(&change, s, &integral, s, &mut product);
                integral.iter_mut().zip(&product).for_each(|(x, product)| *x = 2.0 * *x + product);
            }
            multiply(&change, s, &change, s, &mut product);
            change.iter_mut().zip(&product).for_each(|(x, product)| *x = 2.0 * *x + product);
        }
        symmetrise(&mut noise, s);
        change.iter_mut().step_by(s + 1).for_each(|x| *x += 1.0);
        Step { transition: change, integral, noise }
    }
}

/// `sum_k c_k t^(k+1)` over the rate.
fn sum(coefficients: &[f64], time: f64, rate: f64, states: usize) -> Vec<f64> {
    let mut sum = vec![0.0; states * states];
    for coefficient in coefficients.chunks_exact(states * states).rev() {
        sum.iter_mut().zip(coefficient).for_each(|(sum, x)| *sum = (*sum + x) * time);
    }
    sum.iter_mut().for_each(|x| *x /= rate);
    sum
}
