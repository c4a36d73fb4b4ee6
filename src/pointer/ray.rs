//! A scenario for rays: of a controller, of the eyes, through a fingertip; and the map on which directions are points of a plane.

use super::device::{Choices, RAY};
use crate::error::{Code, Result};
use crate::model::destination::Destination;
use crate::pointing::{Vector, cross, dot};
use crate::scenario::Scenario;
use crate::value::{Path, Value};

/// The unit of angles.
///
/// ```
/// use whither::{AngleUnit, RayOptions};
/// let options = RayOptions { unit: AngleUnit::Radians, ..RayOptions::default() };
/// assert_eq!(RayOptions::default().unit, AngleUnit::Degrees);
/// # let _ = options;
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AngleUnit {
    /// A turn has 360.
    #[default]
    Degrees,
    /// A turn has two times pi.
    Radians,
}

/// A target of a ray, as large as it appears from where the ray begins.
///
/// ```
/// use whither::RayTarget;
/// let lamp = RayTarget { id: "lamp".to_owned(), azimuth: -20.0, elevation: 5.0, width: 4.0, height: 4.0 };
/// assert_eq!(lamp.clone(), lamp);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RayTarget {
    /// Its name, unique among the targets.
    pub id: String,
    /// The centre: the angle to the right, or the first coordinate on a [`RayMap`].
    pub azimuth: f64,
    /// The centre: the angle upwards, or the second coordinate on a [`RayMap`].
    pub elevation: f64,
    /// The angle that it takes up from left to right.
    pub width: f64,
    /// The angle that it takes up from bottom to top.
    pub height: f64,
}

/// What an application may want to set.
///
/// ```
/// use whither::RayOptions;
/// let gaze = RayOptions { none: 0.2, noise: Some(0.5), ..RayOptions::default() }; // an eye tracker of half a degree
/// # let _ = gaze;
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RayOptions {
    /// The prior probability that the ray is going to none of the targets.
    pub none: f64,
    /// The largest amplitude, in `unit`, by which a moving car or a tremor is expected to shake the ray, as
    /// [`PointerOptions::shake`](super::PointerOptions::shake); by default none. What it gains was measured for pointers and hands alone.
    pub shake: f64,
    /// The deviation of an observed angle, in `unit`; by default 0.05 degrees.
    pub noise: Option<f64>,
    /// The unit of all angles.
    pub unit: AngleUnit,
}

/// The scenario for a ray towards `targets`, angles and seconds: observations are azimuth and elevation, or points of a [`RayMap`].
///
/// # Errors
/// Those of a scenario's destinations: `no-destinations`, `duplicate-id`, `not-finite`, `out-of-range`; and `out-of-range` for
/// `observation.noise` and `none`.
///
/// ```
/// use whither::{Predictor, RayOptions, RayTarget, ray_scenario};
/// let target = |id: &str, azimuth| RayTarget { id: id.to_owned(), azimuth, elevation: 0.0, width: 5.0, height: 5.0 };
/// let scenario = ray_scenario(&[target("lamp", -30.0), target("door", 30.0)], RayOptions::default()).unwrap();
/// let mut predictor = Predictor::new(&scenario);
/// predictor.observe(0.0, &[0.0, -40.0]).unwrap();
/// predictor.observe(0.02, &[1.0, -38.5]).unwrap();
/// assert_eq!(predictor.best().unwrap().id, "door");
/// ```
pub fn ray_scenario(targets: &[RayTarget], options: RayOptions) -> Result<Scenario> {
    let destinations = targets.iter().map(|RayTarget { id, azimuth, elevation, width, height }| {
        Destination::new(id, [*azimuth, *elevation]).size([*width, *height])
    });
    let RayOptions { none, shake, noise, unit } = options;
    let unit = RAY.units[unit as usize].1;
    RAY.scenario(&Choices { none, shake, noise, unit }, destinations.collect())
}

/// Directions as points of a plane, by the azimuthal equidistant map: as far from its middle, and in the direction, in which the ray has
/// to be turned to get there. A degree is then as long in every direction about the middle, where a degree of azimuth grows shorter
/// the higher or lower the ray points, and there is no seam behind.
///
/// Directions are vectors of any length in a frame whose y axis points up (WebXR's): the first coordinate grows to the right, the
/// second upwards.
///
/// ```
/// use whither::{AngleUnit, RayMap};
/// let map = RayMap::about([0.0, 0.0, -1.0], AngleUnit::Degrees).unwrap(); // ahead
/// assert_eq!(map.position([0.0, 0.0, -2.0]).unwrap(), [0.0, 0.0]);
/// let [right, up] = map.position([1.0, 0.0, -1.0]).unwrap();
/// assert!((right - 45.0).abs() < 1e-12 && up == 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayMap {
    right: Vector,
    up: Vector,
    middle: Vector,
    /// How many of the unit there are in a radian.
    radian: f64,
}

impl RayMap {
    /// The map about `middle`, a direction near the middle of the targets.
    ///
    /// # Errors
    /// `not-finite`, `out-of-range` for a vector without a direction.
    pub fn about(middle: [f64; 3], unit: AngleUnit) -> Result<Self> {
        let middle = unit_vector(middle, "middle")?;
        let [x, _, z] = middle;
        // straight up and down there is no right: any will do
        let across = x.hypot(z);
        let right = if across > 1e-6 { [-z / across, 0.0, x / across] } else { [1.0, 0.0, 0.0] };
        let radian = RAY.units[unit as usize].1 / RAY.units[AngleUnit::Radians as usize].1;
        Ok(Self { right, up: cross(&right, &middle), middle, radian })
    }

    /// The place of a direction.
    ///
    /// # Errors
    /// `not-finite`, `out-of-range` for a vector without a direction.
    pub fn position(&self, direction: [f64; 3]) -> Result<[f64; 2]> {
        let direction = unit_vector(direction, "direction")?;
        let [x, y] = [dot(&direction, &self.right), dot(&direction, &self.up)];
        let across = x.hypot(y);
        let angle = self.radian * across.atan2(dot(&direction, &self.middle));
        Ok(if across > 0.0 { [angle * x / across, angle * y / across] } else { [angle, 0.0] })
    }
}

/// The vector of length one in the same direction.
fn unit_vector(direction: [f64; 3], name: &str) -> Result<Vector> {
    let at = Path::root(name);
    at.each(&direction, |at, x| at.number(x))?;
    let largest = direction.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if largest == 0.0 {
        return Err(at.error(Code::OutOfRange, "must have a direction", Value::numbers(&direction)));
    }
    let [x, y, z] = direction.map(|x| x / largest);
    let length = dot(&[x, y, z], &[x, y, z]).sqrt();
    Ok([x / length, y / length, z / length])
}
