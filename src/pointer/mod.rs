//! Scenarios for what people point with, with constants that were measured on recorded movements: here pointers on a screen, mouse or
//! touch.

pub(crate) mod device;
pub mod hand;
pub mod ray;

use crate::error::Result;
use crate::model::destination::Destination;
use crate::scenario::Scenario;
use device::{Choices, POINTER};

/// A target on the screen: an icon, a button, a link.
///
/// ```
/// use whither::PointerTarget;
/// let map = PointerTarget { id: "map".to_owned(), x: 700.0, y: 300.0, width: 96.0, height: 48.0 };
/// assert_eq!(map.clone(), map);
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
/// use whither::{PointerOptions, PointerTarget, Predictor, pointer_scenario};
/// let target = |id: &str, x| PointerTarget { id: id.to_owned(), x, y: 0.0, width: 90.0, height: 90.0 };
/// let targets = [target("radio", 0.0), target("map", 500.0)];
/// let mut predictor = Predictor::new(&pointer_scenario(&targets, PointerOptions { none: 0.5, ..PointerOptions::default() }).unwrap());
/// assert_eq!((predictor.none(), predictor.probabilities()), (0.5, &[0.25, 0.25][..]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointerOptions {
    /// The prior probability that the pointer is going to none of the targets.
    pub none: f64,
    /// The largest amplitude, in px, by which a moving car or a tremor is expected to shake the pointer: how much it does, and how fast,
    /// is followed. 0, which is the default, expects none and costs nothing.
    pub shake: f64,
}

impl Default for PointerOptions {
    fn default() -> Self {
        Self { none: 0.0, shake: 0.0 }
    }
}

/// The scenario for pointing at `targets`, pixels and seconds.
///
/// # Errors
/// Those of a scenario's destinations: `no-destinations`, `duplicate-id`, `not-finite`, `out-of-range`.
///
/// ```
/// use whither::{PointerOptions, PointerTarget, Predictor, pointer_scenario};
/// let target = |id: &str, x| PointerTarget { id: id.to_owned(), x, y: 300.0, width: 96.0, height: 96.0 };
/// let scenario = pointer_scenario(&[target("radio", 100.0), target("map", 700.0)], PointerOptions::default()).unwrap();
/// let mut predictor = Predictor::new(&scenario);
/// predictor.observe(0.0, &[400.0, 300.0]).unwrap();
/// predictor.observe(0.016, &[409.0, 300.0]).unwrap();
/// assert_eq!(predictor.best().unwrap().id, "map");
/// ```
pub fn pointer_scenario(targets: &[PointerTarget], options: PointerOptions) -> Result<Scenario> {
    let destinations = targets
        .iter()
        .map(|PointerTarget { id, x, y, width, height }| Destination::new(id, [*x, *y]).size([*width, *height]));
    POINTER
        .scenario(&Choices { none: options.none, shake: options.shake, ..Choices::default() }, destinations.collect())
}
