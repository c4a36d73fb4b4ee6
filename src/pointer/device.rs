//! What people point with, as a table: the constants of each, its units, and how its targets are described.

use crate::error::Result;
use crate::model::destination::Destination;
use crate::model::initial::Initial;
use crate::model::motion::Motion;
use crate::model::observation::Observation;
use crate::pointing::defaults;
use crate::pointing::parameters::PointingConstants;
use crate::scenario::Scenario;

/// A kind of device.
pub(crate) struct Device {
    /// The keys of a target: its id, a coordinate for each axis, a side for each axis.
    pub keys: &'static [&'static str],
    /// The units that the user may choose among, and how many there are in the one that the constants are in.
    pub units: &'static [(&'static str, f64)],
    /// Deviation of an observation.
    noise: f64,
    /// The other constants.
    constants: fn() -> PointingConstants,
}

/// What the application chooses.
pub(crate) struct Choices {
    /// The prior of none of the targets.
    pub none: f64,
    /// The largest amplitude of a shake that is expected, in the user's unit of length.
    pub shake: f64,
    /// The deviation of an observation, where it is not the device's.
    pub noise: Option<f64>,
    /// How many of the user's units of length there are in the one that the constants are in.
    pub unit: f64,
}

/// A pointer on a screen, in px.
pub(crate) const POINTER: Device = Device {
    keys: &["id", "x", "y", "width", "height"],
    units: &[],
    noise: defaults::OBSERVATION_NOISE,
    constants: PointingConstants::default,
};

/// A ray, in degrees.
pub(crate) const RAY: Device = Device {
    keys: &["id", "azimuth", "elevation", "width", "height"],
    units: &[("degrees", 1.0), ("radians", std::f64::consts::PI / 180.0)],
    noise: 0.05,
    constants: || PointingConstants::of(defaults::RAY),
};

/// A hand in space, in mm.
pub(crate) const HAND: Device = Device {
    keys: &["id", "x", "y", "z", "width", "height", "depth"],
    units: &[("millimetres", 1.0), ("metres", 0.001)],
    noise: 0.25,
    constants: || PointingConstants::of(defaults::HAND),
};

impl Default for Choices {
    fn default() -> Self {
        Self { none: 0.0, shake: 0.0, noise: None, unit: 1.0 }
    }
}

impl Device {
    /// How many axes there are.
    pub fn dimensions(&self) -> usize {
        self.keys.len() / 2
    }

    /// The scenario for these destinations.
    ///
    /// # Errors
    /// Those of a scenario's destinations, noise and prior of none.
    pub fn scenario(&self, choices: &Choices, destinations: Vec<Destination>) -> Result<Scenario> {
        let (dimensions, unit) = (self.dimensions(), choices.unit);
        let mut constants = (self.constants)();
        constants.scales.iter_mut().for_each(|scale| *scale *= unit);
        constants.filter_noise *= unit;
        constants.start.core *= unit;
        constants.start.reach *= unit;
        constants.direction.distance *= unit;
        constants.rest_distance *= unit;
        constants.unit *= unit;
        constants.shake = choices.shake;
        if let Some(remaining) = &mut constants.remaining {
            remaining.distance *= unit;
        }
        let motion = Motion::ConstantVelocity {
            dimensions,
            noise: constants.filter_noise.into(),
            speed_noise: Some(constants.speed_noise),
        };
        Scenario::builder(motion, Observation::deviation(choices.noise.unwrap_or(self.noise * unit)))
            .initial(Initial::velocity(constants.first_speed[0] * unit))
            .pointing(constants)
            .none(choices.none)
            .destinations(destinations)
            .build()
    }
}
