//! The series of `whither_kernel::van_loan` for an equation.

use nalgebra::DMatrix;
use whither_kernel::van_loan::Series;

/// `1 / (k + 1)!` vanishes against one at the last of them.
const TERMS: usize = 19;

/// The equation with the drift `A` and the diffusion `W`, both `s` by `s`, `W` symmetric.
#[must_use]
#[inline(never)]
pub fn series(drift: &DMatrix<f64>, diffusion: &DMatrix<f64>) -> Series {
    let largest = drift.row_iter().map(|row| row.iter().map(|a| a.abs()).sum()).fold(0.0, f64::max);
    let rate = if largest > 0.0 { largest } else { 1.0 };
    let unit = drift / rate;
    let states = drift.nrows();
    let (mut power, mut driven) = (DMatrix::identity(states, states), diffusion.clone());
    let mut series = Series { states, rate, integral: Vec::new(), change: Vec::new(), noise: Vec::new() };
    for k in 0..TERMS {
        // powers of a drift that only integrates end
        if k > 0 && power.iter().chain(&driven).all(|x| *x == 0.0) {
            break;
        }
        let divisor = (k + 2) as f64;
        let next = &unit * &power;
        series.integral.extend(&power);
        series.change.extend(&next);
        power = next / divisor;
        let next = &unit * &driven;
        series.noise.extend(&driven);
        driven = (&next + next.transpose()) / divisor;
    }
    series
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn white_acceleration_has_the_noise_of_its_integrals() {
        let equation = series(&dmatrix![0.0, 1.0; 0.0, 0.0], &dmatrix![0.0, 0.0; 0.0, 1.0]);
        assert_eq!(equation.noise.len(), 3 * 4, "it ends with the drift's square");
        let noise = DMatrix::from_vec(2, 2, equation.step_without_integral(3.0).noise);
        // h^3 / 3, h^2 / 2 and h
        assert!((noise - dmatrix![9.0, 4.5; 4.5, 3.0]).amax() < 1e-14);
    }

    #[test]
    fn decay_halves_after_ln_2() {
        // the integrals of exp(-u) and its square are 1 - 1/2 and (1 - 1/4) / 2
        let step = series(&dmatrix![-1.0], &dmatrix![1.0]).step(2f64.ln());
        for (found, expected) in [(step.transition, 0.5), (step.integral, 0.5), (step.noise, 0.375)] {
            assert!((found[0] - expected).abs() < 1e-14);
        }
    }
}
