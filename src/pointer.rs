//! A scenario for pointers on a screen, mouse or touch, with defaults that were measured on recorded movements.

use crate::error::Result;
use crate::scenario::Scenario;
use crate::value::Value;

/// A target on the screen: an icon, a button, a link.
///
/// ```
/// use whither::pointer::{PointerOptions, PointerTarget, pointer_scenario};
/// let target = PointerTarget { id: "map".to_owned(), x: 700.0, y: 300.0, width: 96.0, height: 48.0 };
/// let scenario = pointer_scenario(&[target], PointerOptions::default()).unwrap();
/// assert_eq!(scenario.destinations.center(0), [700.0, 300.0]);
/// assert_eq!(scenario.destinations.class(0).covariance()[(1, 1)], 192.0); // 48^2 / 12
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PointerTarget {
    /// Its name, unique among the targets.
    pub id: String,
    /// The centre, in px.
    pub x: f64,
    /// The centre, in px.
    pub y: f64,
    /// The width, in px.
    pub width: f64,
    /// The height, in px.
    pub height: f64,
}

/// What an application may want to set.
///
/// ```
/// use whither::{Predictor, pointer::{PointerOptions, PointerTarget, pointer_scenario}};
/// let target = |id: &str, x| PointerTarget { id: id.to_owned(), x, y: 0.0, width: 90.0, height: 90.0 };
/// let targets = [target("radio", 0.0), target("map", 500.0)];
/// let mut predictor = Predictor::new(&pointer_scenario(&targets, PointerOptions { none: 0.5 }).unwrap());
/// assert_eq!((predictor.none(), predictor.probabilities()), (0.5, &[0.25, 0.25][..]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointerOptions {
    /// The prior probability that the pointer is going to none of the targets.
    pub none: f64,
}

impl Default for PointerOptions {
    fn default() -> Self {
        Self { none: 0.0 }
    }
}

// Each constant was fitted on recorded mouse movements of 149 people, one setting for all; docs/pointing.md has what each is worth.
// Lengths are px, times s, angles radians.

/// Deviation of an observation.
const OBSERVATION_NOISE: f64 = 0.5;
/// Deviation of the velocity at the first sample.
const FIRST_SPEED: f64 = 50.0;
/// The filter's noise at rest, px/s^1.5, and how it grows with the speed.
const FILTER_NOISE: [f64; 2] = [1100.0, 2.0];
/// Noise scales of the movement to come, px/s^1.5: a steady one and one that turns.
const SCALES: [f64; 2] = [467.0, 4200.0];
/// How the noise to come grows with the speed, along the way and across it.
const SPEED_NOISE: [f64; 2] = [3.0, 1.0];

/// The scenario for pointing at `targets`, pixels and seconds.
///
/// # Errors
/// Those of a scenario's destinations: `no-destinations`, `duplicate-id`, `not-finite`, `out-of-range`.
///
/// ```
/// use whither::{Predictor, pointer::{PointerOptions, PointerTarget, pointer_scenario}};
/// let target = |id: &str, x| PointerTarget { id: id.to_owned(), x, y: 300.0, width: 96.0, height: 96.0 };
/// let scenario = pointer_scenario(&[target("radio", 100.0), target("map", 700.0)], PointerOptions::default()).unwrap();
/// let mut predictor = Predictor::new(&scenario);
/// predictor.observe(0.0, &[400.0, 300.0]).unwrap();
/// predictor.observe(0.016, &[409.0, 300.0]).unwrap();
/// assert_eq!(predictor.best().unwrap().id, "map");
/// ```
pub fn pointer_scenario(targets: &[PointerTarget], options: PointerOptions) -> Result<Scenario> {
    let destinations = targets.iter().map(|target| {
        Value::map([
            ("id", Value::text(&target.id)),
            ("center", Value::numbers(&[target.x, target.y])),
            ("size", Value::numbers(&[target.width, target.height])),
        ])
    });
    Scenario::from_value(&Value::map([
        ("method", Value::text("pointing")),
        (
            "motion",
            Value::map([
                ("type", Value::text("constantVelocity")),
                ("dimensions", Value::Number(2.0)),
                ("noise", Value::Number(FILTER_NOISE[0])),
                ("speedNoise", Value::Number(FILTER_NOISE[1])),
            ]),
        ),
        ("observation", Value::map([("noise", Value::Number(OBSERVATION_NOISE))])),
        ("initial", Value::map([("velocity", Value::Number(FIRST_SPEED))])),
        ("pointing", pointing()),
        ("none", Value::Number(options.none)),
        ("destinations", Value::List(destinations.collect())),
    ]))
}

/// The key `pointing` of the scenario.
fn pointing() -> Value {
    let object = |entries: &[(&str, f64)]| {
        Value::Map(entries.iter().map(|&(key, number)| (key.to_owned(), Value::Number(number))).collect())
    };
    Value::map([
        ("noise", Value::numbers(&SCALES)),
        ("alongNoise", Value::Number(SPEED_NOISE[0])),
        ("acrossNoise", Value::Number(SPEED_NOISE[1])),
        // Seven times to go; a fast pointer arrives sooner.
        (
            "timeToGo",
            object(&[
                ("from", 0.04),
                ("to", 1.2),
                ("points", 7.0),
                ("median", 0.2),
                ("spread", 0.8),
                ("speedExponent", -0.25),
            ]),
        ),
        // Every distance from the start is equally likely.
        ("start", object(&[("exponent", 1.0), ("core", 8.0), ("reach", 1500.0)])),
        ("direction", object(&[("power", 2.0), ("core", 0.16), ("wide", 0.6), ("distance", 60.0), ("time", 0.43)])),
        // The first samples say less than the model believes.
        ("power", object(&[("from", 0.3), ("to", 1.9), ("time", 0.21)])),
        ("near", Value::Number(1.5)),
        // A pointer that rests from the first sample on may mean what it rests on.
        ("restDistance", Value::Number(45.0)),
        // Calibrated with the true target taken out of half of the movements, at a prior of .2 and of .5.
        ("noneGain", Value::Number(2.1)),
        ("noneOffset", Value::Number(-0.67)),
        ("noneShare", Value::Number(0.1)),
        ("uniform", Value::Number(0.015)),
        // The time to the entry: an absolute error of .12, .23, .15 s, and .83, .77, .83 within the 80% interval.
        (
            "remaining",
            object(&[
                ("offset", 0.076),
                ("nodes", 0.443),
                ("near", -4.238),
                ("distance", 20.0),
                ("elapsed", 1.644),
                ("low", -1.087),
                ("high", 0.881),
            ]),
        ),
    ])
}
