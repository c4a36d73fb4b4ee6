//! The constants of the pointing model, as a scenario states them.

use super::Vector;
use super::entry_time::EntryTime;
use crate::error::{Code, Error, Result};
use nalgebra::DMatrix;

/// The constants of the pointing model. Lengths are in the unit of the positions, times in seconds, angles in radians; the default is
/// for a mouse on a screen, in px, fitted on recorded movements of 149 people.
///
/// ```
/// use whither::PointingConstants;
/// let mut touch = PointingConstants::default();
/// touch.time_to_go.median *= 1.2; // fingers are slower
/// touch.rest_distance = 0.0;
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PointingConstants {
    /// Filter: root of the noise's spectral density at rest (`motion.noise`).
    pub(crate) filter_noise: f64,
    /// Filter: how that root grows with the speed (`motion.speedNoise`).
    pub(crate) speed_noise: f64,
    /// Filter: deviation of the velocity at the first observation (`initial.velocity`).
    pub(crate) first_speed: Vector,
    /// Endpoint density: roots of the spectral density of the movement still to come, one for each scale, equally likely.
    pub scales: Vec<f64>,
    /// Endpoint density: growth of that root with the speed, along the velocity.
    pub along_noise: f64,
    /// Endpoint density: the same, across it.
    pub across_noise: f64,
    /// Endpoint density: the time to go.
    pub time_to_go: TimeToGo,
    /// The endpoint given the start alone.
    pub start: Start,
    /// The direction from the start.
    pub direction: Direction,
    /// The power of the ratio of endpoint and start density.
    pub power: Power,
    /// Distance from the start, in target sizes, below which a destination is unlikely.
    pub near: f64,
    /// Distance from the start within which a pointer comes to count as resting there, the longer the more (`Course::onset`), so
    /// that the evidence of the start fades: `near` in proportion, the start density by a core that grows with the distance that is missing.
    /// 0: never.
    pub rest_distance: f64,
    /// The largest amplitude of shake that is expected, in units of length; with 0, which is the default, none is.
    pub shake: f64,
    /// What a destination has to gain before it counts against "none".
    pub none_gain: f64,
    /// What is added to the log weight of "none" once the pointer moves.
    pub none_offset: f64,
    /// Share of the probability of "none" that stays at its prior, whatever is observed.
    pub none_share: f64,
    /// Share of the probability that all destinations have evenly.
    pub uniform: f64,
    /// The length that the formulas take for a px: the median of the time to go holds at 950 of them a second, and what lies at the start
    /// itself counts as one of them away. Only a scenario in another unit of length has to state it.
    pub unit: f64,
    /// The time to the entry into the target, where it differs from the nodes' mean.
    pub remaining: Option<EntryTime>,
}

/// A discrete prior on the time to go, log-normal about a median that follows the speed.
///
/// ```
/// use whither::{PointingConstants, pointing_constants::TimeToGo};
/// let mouse = PointingConstants::default().time_to_go;
/// let touch = TimeToGo { median: 1.2 * mouse.median, ..mouse }; // fingers are slower
/// assert!(touch.from < touch.median && touch.median < touch.to);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TimeToGo {
    /// The first node.
    pub from: f64,
    /// The last node.
    pub to: f64,
    /// How many nodes, evenly spaced in the logarithm.
    pub points: usize,
    /// The median at 950 units of length a second, where `(speed + 50 unit) / (1000 unit)` is one.
    pub median: f64,
    /// The deviation of the logarithm.
    pub spread: f64,
    /// The median goes with `((speed + 50 unit) / (1000 unit))^speedExponent`.
    pub speed_exponent: f64,
}

/// Density of the endpoint given the start: `(distance^2 + core^2)^(-exponent/2)` within `reach`.
///
/// ```
/// use whither::{PointingConstants, pointing_constants::Start};
/// let mouse = PointingConstants::default().start;
/// let desk = Start { reach: 2.0 * mouse.reach, ..mouse }; // two screens side by side
/// assert!(desk.core < desk.reach);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// How fast it falls; `d - 1` makes every distance equally likely.
    pub exponent: f64,
    /// Where it flattens.
    pub core: f64,
    /// Where it ends.
    pub reach: f64,
}

/// The angle at the start between where the pointer is and where a destination is.
///
/// ```
/// use whither::{PointingConstants, pointing_constants::Direction};
/// let mut constants = PointingConstants::default();
/// constants.direction = Direction { power: 0.0, ..constants.direction }; // ignored
/// assert_eq!(constants.direction.power, 0.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Direction {
    /// Weight.
    pub power: f64,
    /// Angle below which nothing is gained any more.
    pub core: f64,
    /// Angle beyond which nothing is lost any more.
    pub wide: f64,
    /// Distance from the start at which the weight is a half, at rest.
    pub distance: f64,
    /// How that distance grows with the speed.
    pub time: f64,
}

/// A power that grows from `from` to `to` with the time constant `time`.
///
/// ```
/// use whither::{PointingConstants, pointing_constants::Power};
/// let mut constants = PointingConstants::default();
/// constants.power = Power { from: 1.0, to: 1.0, time: 1.0 }; // the ratio of the densities as it is
/// assert_ne!(constants, PointingConstants::default());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Power {
    /// At the first observation.
    pub from: f64,
    /// In the long run.
    pub to: f64,
    /// Time constant.
    pub time: f64,
}

impl Power {
    /// The power after `elapsed` seconds.
    #[must_use]
    pub(crate) fn after(&self, elapsed: f64) -> f64 {
        self.to - (self.to - self.from) * (-elapsed / self.time).exp()
    }
}

/// The variances of the axes, which the pointing model takes one by one; zero for those beyond the dimensions.
///
/// # Errors
/// `out-of-range` where the axes are correlated.
pub fn axis_variances(noise: &DMatrix<f64>, path: &str) -> Result<[f64; 3]> {
    let correlated = (0..noise.nrows()).any(|r| (0..r).any(|c| noise[(r, c)] != 0.0));
    if correlated {
        let message = "must have no correlation between axes with the method \"pointing\"";
        return Err(Error::new(Code::OutOfRange, path, message));
    }
    Ok(std::array::from_fn(|axis| noise.get((axis, axis)).copied().unwrap_or(0.0)))
}

impl TimeToGo {
    /// The nodes.
    #[must_use]
    pub(crate) fn nodes(&self) -> Vec<f64> {
        let (from, to) = (self.from.ln(), self.to.ln());
        let last = self.points - 1;
        (0..self.points).map(|n| (from + (to - from) * n as f64 / last as f64).exp()).collect()
    }
}

impl Start {
    /// `ln` of the integral of `(r^2 + core^2)^(-exponent/2)` over the ball of radius `reach`.
    #[must_use]
    pub(crate) fn log_volume(&self, dimensions: usize) -> f64 {
        // r = core sinh(u) makes the integrand smooth on every scale; Simpson's rule on it.
        const INTERVALS: usize = 512;
        let surface = match dimensions {
            1 => 2.0,
            2 => 2.0 * std::f64::consts::PI,
            _ => 4.0 * std::f64::consts::PI,
        };
        let ratio = self.reach / self.core;
        let end = (ratio + (ratio * ratio + 1.0).sqrt()).ln();
        let width = end / INTERVALS as f64;
        let integrand = |u: f64| {
            // sinh and cosh by hand: the library's are a kilobyte
            let (grown, shrunk) = (self.core * u.exp(), self.core * (-u).exp());
            let (radius, length) = (0.5 * (grown - shrunk), 0.5 * (grown + shrunk));
            radius.powi(dimensions as i32 - 1) * ((1.0 - self.exponent) * length.ln()).exp()
        };
        let inner: f64 = (1..INTERVALS).map(|k| if k % 2 == 1 { 4.0 } else { 2.0 } * integrand(k as f64 * width)).sum();
        (surface * width / 3.0 * (integrand(0.0) + inner + integrand(end))).ln()
    }
}
