//! The default constants, for a pointer on a screen.
//!
//! Each was fitted on recorded mouse movements of 149 people, one setting for all; `docs/pointing.md` has what each is worth.
//! Lengths are px, times s, angles radians.

use super::entry_time::EntryTime;
use super::parameters::{Direction, PointingConstants, Power, Start, TimeToGo};

/// Deviation of an observation.
pub(crate) const OBSERVATION_NOISE: f64 = 0.5;

/// Noise scales of the movement to come: a steady one and one that turns.
const SCALES: [f64; 2] = [467.0, 4200.0];

/// All constants but the scales.
const CONSTANTS: PointingConstants = PointingConstants {
    filter_noise: 1100.0,
    speed_noise: 2.0,
    first_speed: [50.0; 3],
    scales: Vec::new(),
    along_noise: 3.0,
    across_noise: 1.0,
    time_to_go: TimeToGo { from: 0.04, to: 1.2, points: 7, median: 0.2, spread: 0.8, speed_exponent: -0.25 },
    // every distance from the start is equally likely
    start: Start { exponent: 1.0, core: 8.0, reach: 1500.0 },
    direction: Direction { power: 2.0, core: 0.16, wide: 0.6, distance: 60.0, time: 0.43 },
    // the first samples are worth less than the model takes them for
    power: Power { from: 0.3, to: 1.9, time: 0.21 },
    near: 1.5,
    // a pointer that rests from the first sample on may mean what it rests on
    rest_distance: 45.0,
    // calibrated with the true target taken out of half of the movements, at a prior of .2 and of .5
    none_gain: 2.1,
    none_offset: -0.67,
    none_share: 0.1,
    uniform: 0.015,
    remaining: Some(REMAINING),
};

/// The time to the entry: an absolute error of .12, .23, .15 s, and .83, .77, .83 within the interval.
pub(crate) const REMAINING: EntryTime =
    EntryTime { offset: 0.076, nodes: 0.443, near: -4.238, distance: 20.0, elapsed: 1.644, low: -1.087, high: 0.881 };

impl Default for PointingConstants {
    fn default() -> Self {
        Self { scales: SCALES.to_vec(), ..CONSTANTS }
    }
}
