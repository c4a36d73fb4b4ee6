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

use super::gaussian::symmetrise;
use nalgebra::DMatrix;

/// `1 / (k + 1)!` vanishes against one at the last of them.
const TERMS: usize = 19;

/// The series of one equation, ready for any step.
#[derive(Clone, Debug)]
pub struct VanLoan {
    /// `|A|`, the largest sum of a row's absolute values (1 where `A` is zero); time is measured in `1 / |A|`.
    rate: f64,
    /// `A^k / (k + 1)!` with `A` in units of `rate`: the coefficients of `I`.
    integral: Vec<DMatrix<f64>>,
    /// `A^(k+1) / (k + 1)!`: those of `F - 1`.
    change: Vec<DMatrix<f64>>,
    /// `W_k / (k + 1)!`, `W_0 = W`, `W_(k+1) = A W_k + W_k A'`: those of `Q`.
    noise: Vec<DMatrix<f64>>,
}

/// What an equation is over one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// `F`.
    pub transition: DMatrix<f64>,
    /// `I`, the integral of `F` over the step.
    pub integral: DMatrix<f64>,
    /// `Q`, symmetric.
    pub noise: DMatrix<f64>,
}

impl VanLoan {
    /// The equation with the drift `A` and the diffusion `W`, both `s` by `s`, `W` symmetric.
    #[must_use]
    #[inline(never)]
    pub fn new(drift: &DMatrix<f64>, diffusion: &DMatrix<f64>) -> Self {
        let largest = drift.row_iter().map(|row| row.iter().map(|a| a.abs()).sum()).fold(0.0, f64::max);
        let rate = if largest > 0.0 { largest } else { 1.0 };
        let unit = drift / rate;
        let states = drift.nrows();
        let (mut power, mut driven) = (DMatrix::identity(states, states), diffusion.clone());
        let mut series = Self { rate, integral: Vec::new(), change: Vec::new(), noise: Vec::new() };
        for k in 0..TERMS {
            let divisor = (k + 2) as f64;
            let next = &unit * &power;
            series.integral.push(power);
            series.change.push(next.clone());
            power = next / divisor;
            let next = &unit * &driven;
            series.noise.push(driven);
            driven = (&next + next.transpose()) / divisor;
        }
        series
    }

    /// What it is over a step, `step >= 0`.
    #[must_use]
    pub fn step(&self, step: f64) -> Step {
        self.over(step, true)
    }

    /// The same for an equation without a constant term: the integral, which it has no use for, is zero.
    #[must_use]
    pub fn step_without_integral(&self, step: f64) -> Step {
        self.over(step, false)
    }

    #[inline(never)]
    fn over(&self, step: f64, with_integral: bool) -> Step {
        let time = self.rate * step;
        let doublings = if time > 0.5 { (2.0 * time).log2().ceil().min(1100.0) as i32 } else { 0 };
        let short = time * 0.5f64.powi(doublings);
        let mut change = sum(&self.change, short);
        let mut integral = DMatrix::zeros(change.nrows(), change.nrows());
        if with_integral {
            integral = sum(&self.integral, short) / self.rate;
        }
        let mut noise = sum(&self.noise, short) / self.rate;
        let (mut grown, mut product) = (change.clone(), change.clone());
        for _ in 0..doublings {
            // Q + (1 + E) Q (1 + E)'
            change.mul_to(&noise, &mut grown);
            grown.mul_to(&change.transpose(), &mut product);
            noise *= 2.0;
            noise += &grown;
            noise += grown.transpose();
            noise += &product;
            if with_integral {
                change.mul_to(&integral, &mut product);
                integral *= 2.0;
                integral += &product;
            }
            change.mul_to(&change, &mut product);
            change *= 2.0;
            change += &product;
        }
        symmetrise(&mut noise);
        for i in 0..change.nrows() {
            change[(i, i)] += 1.0;
        }
        Step { transition: change, integral, noise }
    }
}

/// `sum_k c_k t^(k+1)`.
fn sum(coefficients: &[DMatrix<f64>], time: f64) -> DMatrix<f64> {
    let states = coefficients.first().map_or(0, DMatrix::nrows);
    coefficients.iter().rev().fold(DMatrix::zeros(states, states), |mut sum, coefficient| {
        sum += coefficient;
        sum *= time;
        sum
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn white_acceleration_has_the_noise_of_its_integrals() {
        let equation = VanLoan::new(&dmatrix![0.0, 1.0; 0.0, 0.0], &dmatrix![0.0, 0.0; 0.0, 1.0]);
        // h^3 / 3, h^2 / 2 and h
        assert!((equation.step(3.0).noise - dmatrix![9.0, 4.5; 4.5, 3.0]).amax() < 1e-14);
    }

    #[test]
    fn decay_halves_after_ln_2() {
        // the integrals of exp(-u) and its square are 1 - 1/2 and (1 - 1/4) / 2
        let step = VanLoan::new(&dmatrix![-1.0], &dmatrix![1.0]).step(2f64.ln());
        for (found, expected) in [(step.transition, 0.5), (step.integral, 0.5), (step.noise, 0.375)] {
            assert!((found[0] - expected).abs() < 1e-14);
        }
    }
}
