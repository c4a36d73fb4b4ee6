//! A scenario for a hand that moves in the air, towards a screen or free targets.

use super::device::{Choices, HAND};
use crate::error::Result;
use crate::model::destination::Destination;
use crate::scenario::Scenario;

/// The unit of lengths.
///
/// ```
/// use whither::{HandOptions, LengthUnit};
/// let options = HandOptions { unit: LengthUnit::Metres, ..HandOptions::default() };
/// assert_eq!(HandOptions::default().unit, LengthUnit::Millimetres);
/// # let _ = options;
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LengthUnit {
    /// What trackers of hands measure in.
    #[default]
    Millimetres,
    /// What WebXR measures in.
    Metres,
}

/// A target in space: an icon of a screen, a button in the air.
///
/// ```
/// use whither::HandTarget;
/// let map = HandTarget { id: "map".to_owned(), x: 60.0, y: 40.0, z: 0.0, width: 20.0, height: 20.0, depth: 20.0 };
/// assert_eq!(map.clone(), map);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct HandTarget {
    /// Its name, unique among the targets.
    pub id: String,
    /// The centre.
    pub x: f64,
    /// The centre.
    pub y: f64,
    /// The centre.
    pub z: f64,
    /// The side along x.
    pub width: f64,
    /// The side along y.
    pub height: f64,
    /// The side along z.
    pub depth: f64,
}

/// What an application may want to set.
///
/// ```
/// use whither::HandOptions;
/// let shaky = HandOptions { none: 0.2, noise: Some(3.0), ..HandOptions::default() }; // a tracker of 3 mm
/// # let _ = shaky;
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HandOptions {
    /// The prior probability that the hand is going to none of the targets.
    pub none: f64,
    /// The largest amplitude, in `unit`, by which a moving car or a tremor is expected to shake the hand, as
    /// [`PointerOptions::shake`](super::PointerOptions::shake); by default none.
    pub shake: f64,
    /// The deviation of an observed coordinate, in `unit`; by default 0.25 mm.
    pub noise: Option<f64>,
    /// The unit of all lengths.
    pub unit: LengthUnit,
}

/// The scenario for a hand towards `targets`, in space and seconds.
///
/// # Errors
/// Those of a scenario's destinations: `no-destinations`, `duplicate-id`, `not-finite`, `out-of-range`; and `out-of-range` for
/// `observation.noise` and `none`.
///
/// ```
/// use whither::{HandOptions, HandTarget, Predictor, hand_scenario};
/// let icon = |id: &str, x| HandTarget { id: id.to_owned(), x, y: 0.0, z: 0.0, width: 20.0, height: 20.0, depth: 20.0 };
/// let scenario = hand_scenario(&[icon("radio", -80.0), icon("map", 80.0)], HandOptions::default()).unwrap();
/// let mut predictor = Predictor::new(&scenario);
/// predictor.observe(0.0, &[0.0, -100.0, 300.0]).unwrap();
/// predictor.observe(0.014, &[2.0, -97.0, 293.0]).unwrap();
/// assert_eq!(predictor.best().unwrap().id, "map");
/// ```
pub fn hand_scenario(targets: &[HandTarget], options: HandOptions) -> Result<Scenario> {
    let destinations = targets.iter().map(|HandTarget { id, x, y, z, width, height, depth }| {
        Destination::new(id, [*x, *y, *z]).size([*width, *height, *depth])
    });
    let HandOptions { none, shake, noise, unit } = options;
    let unit = HAND.units[unit as usize].1;
    HAND.scenario(&Choices { none, shake, noise, unit }, destinations.collect())
}
