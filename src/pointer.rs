//! A scenario for pointers on a screen, mouse or touch, with defaults that were measured on recorded movements.

use crate::error::Result;
use crate::scenario::Scenario;
use crate::value::Value;

/// A target on the screen: an icon, a button, a link.
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

/// Process noise of the constant-velocity model, px/s^1.5.
const NOISE: f64 = 3000.0;
/// Deviation of the velocity at the first sample, px/s.
const FIRST_SPEED: f64 = 200.0;
/// Deviation of the velocity on arrival, px/s.
const END_VELOCITY: f64 = 200.0;
/// Deviation of an observation, px.
const OBSERVATION_NOISE: f64 = 1.5;
/// The times to go that are tried, s.
const HORIZON: [f64; 2] = [0.05, 0.5];

/// The scenario for pointing at `targets`, pixels and seconds.
///
/// # Errors
/// Those of a scenario's destinations: `no-destinations`, `duplicate-id`, `not-finite`, `out-of-range`.
///
/// ```
/// use whither::{Predictor, pointer::{PointerOptions, PointerTarget, pointer_scenario}};
/// let target = |id: &str, x| PointerTarget { id: id.to_owned(), x, y: 300.0, width: 96.0, height: 96.0 };
/// let scenario = pointer_scenario(&[target("radio", 100.0), target("map", 700.0)], PointerOptions::default()).unwrap();
/// let mut predictor = Predictor::new(&scenario).unwrap();
/// predictor.observe(0.0, &[400.0, 300.0]).unwrap();
/// predictor.observe(0.016, &[409.0, 300.0]).unwrap();
/// assert_eq!(predictor.best().unwrap().id, "map");
/// ```
pub fn pointer_scenario(targets: &[PointerTarget], options: PointerOptions) -> Result<Scenario> {
    let number = Value::Number;
    let destinations = targets.iter().map(|target| {
        Value::map([
            ("id", Value::text(&target.id)),
            ("center", Value::numbers(&[target.x, target.y])),
            ("size", Value::numbers(&[target.width, target.height])),
            ("endVelocity", number(END_VELOCITY)),
        ])
    });
    Scenario::from_value(&Value::map([
        (
            "motion",
            Value::map([
                ("type", Value::text("constantVelocity")),
                ("dimensions", number(2.0)),
                ("noise", number(NOISE)),
            ]),
        ),
        ("observation", Value::map([("noise", number(OBSERVATION_NOISE))])),
        ("initial", Value::map([("velocity", number(FIRST_SPEED))])),
        (
            "arrival",
            Value::map([("type", Value::text("horizon")), ("from", number(HORIZON[0])), ("to", number(HORIZON[1]))]),
        ),
        ("none", number(options.none)),
        ("destinations", Value::List(destinations.collect())),
    ]))
}
