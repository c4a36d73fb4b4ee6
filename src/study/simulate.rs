//! Simulated movements: gestures of a hand towards a target, by a seed.

use super::track::{Sample, Target, Track};
pub use crate::math::random::Random;

/// How a simulated hand moves: minimum jerk with a bow, a tremor and Fitts's time.
///
/// ```
/// use whither::study::{simulate::{Hand, Random}, track::Target};
/// let target = Target { center: vec![280.0, 0.0], size: vec![40.0, 40.0] };
/// let track = Hand::default().reach(&mut Random::new(1), [0.0, 0.0], &[target], 0);
/// // 0.25 + 0.15 log2(280 / 40 + 1), give or take where in the target it aims
/// assert!((track.samples.last().unwrap().time - 0.7).abs() < 0.02);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hand {
    /// Seconds between samples.
    pub interval: f64,
    /// Fitts's law: the time to the nearest target, and seconds for each doubling of distance over size.
    pub fitts: [f64; 2],
    /// Deviation of the bow, a share of the distance.
    pub bow: f64,
    /// Deviation of a sample.
    pub tremor: f64,
}

impl Default for Hand {
    fn default() -> Self {
        Self { interval: 1.0 / 60.0, fitts: [0.25, 0.15], bow: 0.04, tremor: 0.6 }
    }
}

impl Hand {
    /// A movement in the plane from `start` to the target numbered `target`.
    #[must_use]
    pub fn reach(&self, random: &mut Random, start: [f64; 2], targets: &[Target], target: usize) -> Track {
        let goal = &targets[target];
        let to: [f64; 2] = std::array::from_fn(|j| goal.center[j] - start[j] + 0.15 * goal.size[j] * random.normal());
        let far = f64::hypot(to[0], to[1]);
        let size = goal.size[0].min(goal.size[1]);
        let duration = self.fitts[0] + self.fitts[1] * (far / size + 1.0).log2();
        let bow = self.bow * random.normal();
        let count = (duration / self.interval).ceil() as usize;
        let samples = (0..=count).map(|k| {
            let time = (k as f64 * self.interval).min(duration);
            let u = time / duration;
            let way = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
            let aside = bow * (std::f64::consts::PI * way).sin();
            let position = vec![
                start[0] + way * to[0] - aside * to[1] + self.tremor * random.normal(),
                start[1] + way * to[1] + aside * to[0] + self.tremor * random.normal(),
            ];
            Sample { time, position, missing: vec![] }
        });
        Track { id: String::new(), user: String::new(), targets: targets.to_vec(), target, samples: samples.collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reach_ends_in_its_target_after_fitts_time() {
        let target = |x: f64| Target { center: vec![x, 0.0], size: vec![40.0, 40.0] };
        let targets = [target(280.0), target(-280.0)];
        let mut random = Random::new(3);
        let mut inside = 0;
        for _ in 0..100 {
            let track = Hand::default().reach(&mut random, [0.0, 0.0], &targets, 1);
            let last = &track.samples[track.samples.len() - 1];
            // 0.25 + 0.15 log2(280 / 40 + 1) = 0.7, give or take where in the target it aims
            assert!((last.time - 0.7).abs() < 0.02, "{}", last.time);
            inside += usize::from(targets[1].contains(&last.position));
        }
        assert!(inside > 95, "{inside} of 100");
    }
}
