//! The constants of the pointing model, as a scenario states them.

use super::entry_time::EntryTime;
use super::{Vector, vector};
use crate::error::{Code, Error, Result};
use crate::math::kernel::mixture::HALF_LOG2_E;
use crate::math::kernel::vectors::{Block, Lanes, raise};
use crate::model::initial::InitialDensity;
use crate::model::motion::MotionModels;
use crate::model::observation::ObservationModel;
use crate::value::{Node, Value};
use nalgebra::DMatrix;

/// The most noise scales and time-to-go nodes: both are summed over for every destination.
const MOST_SCALES: usize = 16;
const MOST_NODES: usize = 1001;

/// Every constant. Lengths are in the unit of the positions, times in seconds, angles in radians.
///
/// ```
/// use whither::{scenario::Engine, pointer::{PointerOptions, PointerTarget, pointer_scenario}};
/// let target = PointerTarget { id: "map".to_owned(), x: 0.0, y: 0.0, width: 90.0, height: 90.0 };
/// let scenario = pointer_scenario(&[target], PointerOptions::default()).unwrap();
/// let Engine::Pointing(parameters) = &scenario.engine else { panic!() };
/// // the movement to come is steady or it turns, and is less certain along the way than across it
/// assert!(parameters.scales[0] < parameters.scales[1]);
/// assert!(parameters.along_noise > parameters.across_noise);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// Filter: root of the noise's spectral density at rest (`motion.noise`).
    pub filter_noise: f64,
    /// Filter: how that root grows with the speed (`motion.speedNoise`).
    pub speed_noise: f64,
    /// Filter: deviation of the velocity at the first observation (`initial.velocity`).
    pub first_speed: Vector,
    /// Endpoint density: roots of the spectral density of the movement still to come, one for each scale, equally likely.
    pub scales: Vec<f64>,
    /// Endpoint density: growth of that root with the speed, along the velocity.
    pub along_noise: f64,
    /// Endpoint density: the same, across it.
    pub across_noise: f64,
    /// Endpoint density: the time to go.
    pub time_to_go: TimeToGo,
    /// What the start alone says of the endpoint.
    pub start: Start,
    /// The direction from the start.
    pub direction: Direction,
    /// How far the ratio of endpoint and start density is believed.
    pub power: Power,
    /// Distance from the start, in target sizes, below which a destination is unlikely.
    pub near: f64,
    /// Distance from the start within which a pointer comes to count as resting there, the longer the more (`Course::onset`), so
    /// that what the start says fades: `near` in proportion, the start density by a core that grows with the way that is missing.
    /// 0: never.
    pub rest_distance: f64,
    /// What a destination has to gain before it counts against "none".
    pub none_gain: f64,
    /// What is added to the log weight of "none" once the pointer moves.
    pub none_offset: f64,
    /// Share of the probability of "none" that stays at its prior, whatever the movement says.
    pub none_share: f64,
    /// Share of the probability that is spread evenly over the destinations.
    pub uniform: f64,
    /// The time to the entry into the target, where it is told apart from the nodes' own mean.
    pub remaining: Option<EntryTime>,
}

/// A discrete prior on the time to go, log-normal about a median that follows the speed.
///
/// ```
/// use whither::pointing::parameters::TimeToGo;
/// let prior = TimeToGo { from: 0.1, to: 0.4, points: 3, median: 0.2, spread: 0.5, speed_exponent: -0.25 };
/// assert!((prior.nodes()[1] - 0.2).abs() < 1e-14); // twice the first, half of the last
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TimeToGo {
    /// The first node.
    pub from: f64,
    /// The last node.
    pub to: f64,
    /// How many nodes, evenly spaced in the logarithm.
    pub points: usize,
    /// The median at 950 units of length a second, where `(speed + 50) / 1000` is one.
    pub median: f64,
    /// The deviation of the logarithm.
    pub spread: f64,
    /// The median goes with `((speed + 50) / 1000)^speedExponent`.
    pub speed_exponent: f64,
}

/// Density of the endpoint seen from the start: `(distance^2 + core^2)^(-exponent/2)` within `reach`.
///
/// ```
/// use whither::pointing::parameters::Start;
/// let start = Start { exponent: 0.0, core: 1.0, reach: 10.0 };
/// // flat within its reach: over the length 20 in one axis
/// assert!((start.log_volume(1) - 20f64.ln()).abs() < 1e-3);
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
/// use whither::{scenario::Engine, pointer::{PointerOptions, PointerTarget, pointer_scenario}};
/// let target = PointerTarget { id: "map".to_owned(), x: 0.0, y: 0.0, width: 90.0, height: 90.0 };
/// let scenario = pointer_scenario(&[target], PointerOptions::default()).unwrap();
/// let Engine::Pointing(parameters) = &scenario.engine else { panic!() };
/// // an angle counts between the two
/// assert!(parameters.direction.core < parameters.direction.wide);
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
/// use whither::pointing::parameters::Power;
/// let power = Power { from: 0.5, to: 1.5, time: 0.2 };
/// assert_eq!(power.after(0.0), 0.5);
/// assert!((power.after(0.2 * 2f64.ln()) - 1.0).abs() < 1e-14); // half of the way
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
    pub fn after(&self, elapsed: f64) -> f64 {
        self.to - (self.to - self.from) * (-elapsed / self.time).exp()
    }
}

const KEYS: [&str; 14] = [
    "noise",
    "alongNoise",
    "acrossNoise",
    "timeToGo",
    "start",
    "direction",
    "power",
    "near",
    "restDistance",
    "noneGain",
    "noneOffset",
    "noneShare",
    "uniform",
    "remaining",
];

impl Parameters {
    /// Reads the key `pointing` of a scenario, together with the filter's three constants.
    ///
    /// # Errors
    /// `unknown-key`, `missing-key`, `wrong-type`, `not-finite`, `out-of-range`, `too-large`.
    pub fn read(
        node: &Node<'_>,
        motion: &MotionModels,
        observation: &ObservationModel,
        initial: &InitialDensity,
    ) -> Result<Self> {
        let filter_noise = filter_noise(motion)?;
        if !observation.is_position() {
            let message = "has no place with the method \"pointing\", which observes positions";
            return Err(Error::new(Code::UnknownKey, "observation.matrix", message));
        }
        axis_variances(observation.noise(), "observation.noise")?;
        let first_speed = vector(initial.flat_deviations().ok_or_else(|| {
            let message = "has no place with the method \"pointing\", which takes initial.velocity";
            Error::new(Code::UnknownKey, "initial.mean", message)
        })?);
        let fields = node.fields(&KEYS)?;
        let scales = read_scales(&fields.required("noise")?)?;
        Ok(Self {
            filter_noise,
            speed_noise: motion.speed_noise.unwrap_or(0.0),
            first_speed,
            scales,
            along_noise: fields.not_negative("alongNoise")?,
            across_noise: fields.not_negative("acrossNoise")?,
            time_to_go: TimeToGo::read(&fields.required("timeToGo")?)?,
            start: Start::read(&fields.required("start")?)?,
            direction: Direction::read(&fields.required("direction")?)?,
            power: Power::read(&fields.required("power")?)?,
            near: fields.not_negative("near")?,
            rest_distance: fields.optional("restDistance").map_or(Ok(0.0), |node| node.not_negative())?,
            none_gain: fields.number("noneGain")?,
            none_offset: fields.optional("noneOffset").map_or(Ok(0.0), |node| node.number())?,
            none_share: fields.optional("noneShare").map_or(Ok(0.0), |node| read_share(&node))?,
            uniform: read_share(&fields.required("uniform")?)?,
            remaining: fields.optional("remaining").map(|node| EntryTime::read(&node)).transpose()?,
        })
    }

    /// The key `pointing` as it is written.
    #[must_use]
    pub fn to_value(&self) -> Value {
        let number = Value::Number;
        Value::map([
            ("noise", Value::numbers(&self.scales)),
            ("alongNoise", number(self.along_noise)),
            ("acrossNoise", number(self.across_noise)),
            ("timeToGo", self.time_to_go.to_value()),
            ("start", self.start.to_value()),
            ("direction", self.direction.to_value()),
            ("power", self.power.to_value()),
            ("near", number(self.near)),
            ("restDistance", number(self.rest_distance)),
            ("noneGain", number(self.none_gain)),
            ("noneOffset", number(self.none_offset)),
            ("noneShare", number(self.none_share)),
            ("uniform", number(self.uniform)),
            ("remaining", self.remaining.as_ref().map_or(Value::Null, EntryTime::to_value)),
        ])
    }
}

/// The one noise that `constantVelocity` has on every axis.
fn filter_noise(motion: &MotionModels) -> Result<f64> {
    let value = motion.to_value();
    let node = Node::root(&value, "motion");
    if node.get("type").map(|kind| kind.value().clone()) != Some(Value::text("constantVelocity")) {
        let message = "must be \"constantVelocity\" with the method \"pointing\"";
        return Err(Error::new(Code::OutOfRange, "motion.type", message));
    }
    match node.get("noise").map(|noise| noise.value().clone()) {
        Some(Value::Number(noise)) => Ok(noise),
        _ => {
            let message = "must be one number with the method \"pointing\": the same on every axis, no candidates";
            Err(Error::new(Code::WrongType, "motion.noise", message))
        }
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

fn read_scales(node: &Node<'_>) -> Result<Vec<f64>> {
    let scales = node.numbers(|item| item.positive())?;
    if scales.is_empty() || scales.len() > MOST_SCALES {
        let message = format!("must have 1 to {MOST_SCALES} numbers, has {}", scales.len());
        return Err(Error::new(Code::WrongLength, node.path(), message));
    }
    Ok(scales)
}

fn read_share(node: &Node<'_>) -> Result<f64> {
    let share = node.number()?;
    if (0.0..=1.0).contains(&share) { Ok(share) } else { Err(node.error(Code::OutOfRange, "must be from 0 to 1")) }
}

impl TimeToGo {
    fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["from", "to", "points", "median", "spread", "speedExponent"])?;
        let (from, to) = (fields.positive("from")?, fields.positive("to")?);
        if from >= to {
            return Err(fields.required("to")?.error(Code::OutOfRange, "must be greater than from"));
        }
        Ok(Self {
            from,
            to,
            points: fields.required("points")?.whole(2, MOST_NODES)?,
            median: fields.positive("median")?,
            spread: fields.positive("spread")?,
            speed_exponent: fields.number("speedExponent")?,
        })
    }

    fn to_value(&self) -> Value {
        Value::map([
            ("from", Value::Number(self.from)),
            ("to", Value::Number(self.to)),
            ("points", Value::Number(self.points as f64)),
            ("median", Value::Number(self.median)),
            ("spread", Value::Number(self.spread)),
            ("speedExponent", Value::Number(self.speed_exponent)),
        ])
    }

    /// The nodes.
    #[must_use]
    pub fn nodes(&self) -> Vec<f64> {
        let (from, to) = (self.from.ln(), self.to.ln());
        let last = self.points - 1;
        (0..self.points).map(|n| (from + (to - from) * n as f64 / last as f64).exp()).collect()
    }

    /// The weights at a speed of the nodes with these logarithms over that of the median; they sum to one. `ones` has zeros
    /// where there is no node.
    pub fn weights(&self, log_nodes: &[Block], ones: &[Block], speed: f64, into: &mut [Block]) {
        let s = Lanes::splat;
        let (middle, over) = (s(self.speed_exponent * ((speed + 50.0) / 1000.0).ln()), s(1.0 / self.spread));
        let mut top = s(f64::MIN);
        for (exponent, log) in into.iter_mut().zip(log_nodes) {
            let apart = (Lanes::load(log) - middle) * over;
            let whole = s(-HALF_LOG2_E) * apart * apart;
            whole.store(exponent);
            top = whole.at_least(top);
        }
        let over = s(1.0 / raise(into, ones, top.most()));
        for weight in into {
            (Lanes::load(weight) * over).store(weight);
        }
    }
}

impl Start {
    fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["exponent", "core", "reach"])?;
        Ok(Self {
            exponent: fields.not_negative("exponent")?,
            core: fields.positive("core")?,
            reach: fields.positive("reach")?,
        })
    }

    fn to_value(&self) -> Value {
        Value::map([
            ("exponent", Value::Number(self.exponent)),
            ("core", Value::Number(self.core)),
            ("reach", Value::Number(self.reach)),
        ])
    }

    /// `ln` of the integral of `(r^2 + core^2)^(-exponent/2)` over the ball of radius `reach`.
    #[must_use]
    pub fn log_volume(&self, dimensions: usize) -> f64 {
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
            // sinh and cosh by hand: the library's weigh a kilobyte
            let (grown, shrunk) = (self.core * u.exp(), self.core * (-u).exp());
            let (radius, length) = (0.5 * (grown - shrunk), 0.5 * (grown + shrunk));
            radius.powi(dimensions as i32 - 1) * ((1.0 - self.exponent) * length.ln()).exp()
        };
        let inner: f64 = (1..INTERVALS).map(|k| if k % 2 == 1 { 4.0 } else { 2.0 } * integrand(k as f64 * width)).sum();
        (surface * width / 3.0 * (integrand(0.0) + inner + integrand(end))).ln()
    }
}

impl Direction {
    fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["power", "core", "wide", "distance", "time"])?;
        Ok(Self {
            power: fields.not_negative("power")?,
            core: fields.positive("core")?,
            wide: fields.positive("wide")?,
            distance: fields.positive("distance")?,
            time: fields.not_negative("time")?,
        })
    }

    fn to_value(&self) -> Value {
        Value::map([
            ("power", Value::Number(self.power)),
            ("core", Value::Number(self.core)),
            ("wide", Value::Number(self.wide)),
            ("distance", Value::Number(self.distance)),
            ("time", Value::Number(self.time)),
        ])
    }
}

impl Power {
    fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["from", "to", "time"])?;
        Ok(Self { from: fields.not_negative("from")?, to: fields.not_negative("to")?, time: fields.positive("time")? })
    }

    fn to_value(&self) -> Value {
        Value::map([
            ("from", Value::Number(self.from)),
            ("to", Value::Number(self.to)),
            ("time", Value::Number(self.time)),
        ])
    }
}
