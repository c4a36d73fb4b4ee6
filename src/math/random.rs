//! Seeded random numbers, the same on every platform.

use super::cosine::cosine;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

/// A stream of random numbers that its seed fixes.
///
/// ```
/// use whither::study::simulate::Random;
/// assert_eq!(Random::new(7).uniform(), Random::new(7).uniform());
/// assert_ne!(Random::new(7).normal(), Random::new(8).normal());
/// ```
#[derive(Clone, Debug)]
pub struct Random {
    generator: Xoshiro256PlusPlus,
}

impl Random {
    /// The stream of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { generator: Xoshiro256PlusPlus::seed_from_u64(seed) }
    }

    /// Evenly from the open interval `(0, 1)`: the centres of `2^52` cells, so that its logarithm is finite.
    pub fn uniform(&mut self) -> f64 {
        const CELL: f64 = 1.0 / (1u64 << 52) as f64;
        ((self.generator.next_u64() >> 12) as f64 + 0.5) * CELL
    }

    /// From the standard normal density, by Box and Muller (1958).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        radius * cosine(self.uniform())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_draws_have_the_moments_of_the_normal_density() {
        let mut random = Random::new(1);
        let draws: Vec<f64> = (0..200_000).map(|_| random.normal()).collect();
        let moment = |power: i32| draws.iter().map(|z| z.powi(power)).sum::<f64>() / draws.len() as f64;
        // 0, 1, 0, 3, each within about five standard errors
        for (power, expected, tolerance) in [(1, 0.0, 0.012), (2, 1.0, 0.016), (3, 0.0, 0.045), (4, 3.0, 0.11)] {
            assert!((moment(power) - expected).abs() < tolerance, "moment {power} is {}", moment(power));
        }
    }

    #[test]
    fn uniform_draws_stay_inside_the_interval_and_fill_it_evenly() {
        let mut random = Random::new(2);
        let mut tenths = [0; 10];
        for _ in 0..100_000 {
            let x = random.uniform();
            assert!(x > 0.0 && x < 1.0);
            tenths[(x * 10.0) as usize] += 1;
        }
        assert!(tenths.iter().all(|&count| (9_500..10_500).contains(&count)), "{tenths:?}");
    }
}
