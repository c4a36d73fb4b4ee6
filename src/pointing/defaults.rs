//! The default constants, for a pointer on a screen, and those of other devices.
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
    shake: 0.0,
    // calibrated with the true target taken out of half of the movements, at a prior of .2 and of .5
    none_gain: 2.1,
    none_offset: -0.67,
    none_share: 0.1,
    uniform: 0.015,
    unit: 1.0,
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

/// The places of other devices in the rows of [`OTHERS`].
pub(crate) const RAY: usize = 0;
pub(crate) const HAND: usize = 1;

/// The constants of a ray, in degrees, and of a hand in space, in mm; all in thousandths, which take half the bytes. The ray's were
/// fitted on recorded rays of 9 people, as azimuth and elevation and on a map alike, the hand's on movements of one person among the
/// targets of the recording and among others; `docs/rays-and-hands.md` has what they are worth.
const OTHERS: [[i32; 2]; 37] = [
    // filter
    [110_000, 393_000],
    [2_000, 1_070],
    [5_000, 25_000],
    // noise scales, along and across noise
    [106_000, 580_000],
    [206_000, 2_720_000],
    [4_200, 6_660],
    [2_160, 3_620],
    // time to go: from, to, median, spread, and the exponent of the speed: an arm that turns brakes evenly, the faster the longer
    [103, 61],
    [2_930, 878],
    [106, 704],
    [1_240, 798],
    [883, -789],
    // start: exponent, core, reach
    [2_000, 2_000],
    [1_180, 4_000],
    [150_000, 750_000],
    // direction: power, core, wide, distance, time
    [5_610, 2_720],
    [432, 146],
    [410, 1_320],
    [6_050, 29_400],
    [142, 839],
    // power: from, to, time
    [238, 1_260],
    [2_870, 4_720],
    [111, 46],
    // near, rest distance
    [656, 1_500],
    [2_000, 10_000],
    // none: gain, offset, share; calibrated with the true target taken out of half of the movements
    [5_500, 2_500],
    [-4_000, -5_000],
    [200, 300],
    // uniform share, unit
    [1, 5],
    [100, 500],
    // the time to the entry: offset, nodes, near, distance, elapsed, low, high
    [230, -216],
    [970, 447],
    [-240, -1_920],
    [2_000, 10_000],
    [2_400, 1_490],
    [-1_450, -1_100],
    [950, 1_180],
];

impl PointingConstants {
    /// The constants of a device at one of the places of [`OTHERS`].
    #[must_use]
    pub(crate) fn of(device: usize) -> Self {
        let mut numbers = [0.0; OTHERS.len()];
        numbers.iter_mut().zip(&OTHERS).for_each(|(number, row)| *number = f64::from(row[device]) / 1000.0);
        let [filter_noise, speed_noise, speed, steady, turning, along_noise, across_noise, others @ ..] = numbers;
        let [from, to, median, spread, speed_exponent, exponent, core, reach, others @ ..] = others;
        let time_to_go = TimeToGo { from, to, points: 7, median, spread, speed_exponent };
        let start = Start { exponent, core, reach };
        let [power, core, wide, distance, time, others @ ..] = others;
        let direction = Direction { power, core, wide, distance, time };
        let [from, to, time, near, rest_distance, none_gain, none_offset, none_share, uniform, unit, others @ ..] =
            others;
        let power = Power { from, to, time };
        let [offset, nodes, nearness, distance, elapsed, low, high] = others;
        Self {
            filter_noise,
            speed_noise,
            first_speed: [speed; 3],
            scales: vec![steady, turning],
            along_noise,
            across_noise,
            time_to_go,
            start,
            direction,
            power,
            near,
            rest_distance,
            shake: 0.0,
            none_gain,
            none_offset,
            none_share,
            uniform,
            unit,
            remaining: Some(EntryTime { offset, nodes, near: nearness, distance, elapsed, low, high }),
        }
    }
}
