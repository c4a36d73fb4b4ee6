//! The constants as scenarios have them, under the key `pointing`, and their validation.

use super::entry_time::EntryTime;
use super::parameters::{Direction, PointingConstants, Power, Start, TimeToGo, axis_variances};
use super::vector;
use crate::error::{Code, Error, Result};
use crate::model::initial::InitialDensity;
use crate::model::motion::MotionModels;
use crate::model::observation::ObservationModel;
use crate::value::{Check, Node, Path, Value};

/// The most noise scales and time-to-go nodes: both are summed over for every destination.
const MOST_SCALES: usize = 16;
const MOST_NODES: usize = 1001;

const FINITE: Check = |at, x| at.number(x);
const POSITIVE: Check = |at, x| at.positive(x);
const NOT_NEGATIVE: Check = |at, x| at.not_negative(x);
const SHARE: Check = |at, x| match at.number(x)? {
    x if (0.0..=1.0).contains(&x) => Ok(x),
    x => Err(at.error(Code::OutOfRange, "must be from 0 to 1", x)),
};

/// Numbers of an object, each with its key and its check.
type Numbers<const N: usize> = [(&'static str, f64, Check); N];

fn check<const N: usize>(at: &Path<'_>, numbers: Numbers<N>) -> Result<()> {
    numbers.iter().try_for_each(|(key, x, check)| check(&at.key(key), *x).map(|_| ()))
}

fn object<const N: usize>(numbers: Numbers<N>) -> Value {
    Value::map(numbers.map(|(key, x, _)| (key, Value::Number(x))))
}

impl PointingConstants {
    /// Reads `{ noise, alongNoise, .. }`; what the filter takes from the scenario is left as it is by default.
    pub(crate) fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&[
            "noise",
            "alongNoise",
            "acrossNoise",
            "timeToGo",
            "start",
            "direction",
            "power",
            "near",
            "restDistance",
            "shake",
            "noneGain",
            "noneOffset",
            "noneShare",
            "uniform",
            "unit",
            "remaining",
        ])?;
        let or = |default, key| fields.optional(key).map_or(Ok(default), |node| node.float());
        Ok(Self {
            scales: fields.required("noise")?.floats()?,
            along_noise: fields.float("alongNoise")?,
            across_noise: fields.float("acrossNoise")?,
            time_to_go: TimeToGo::read(&fields.required("timeToGo")?)?,
            start: Start::read(&fields.required("start")?)?,
            direction: Direction::read(&fields.required("direction")?)?,
            power: Power::read(&fields.required("power")?)?,
            near: fields.float("near")?,
            rest_distance: or(0.0, "restDistance")?,
            shake: or(0.0, "shake")?,
            none_gain: fields.float("noneGain")?,
            none_offset: or(0.0, "noneOffset")?,
            none_share: or(0.0, "noneShare")?,
            uniform: fields.float("uniform")?,
            unit: or(1.0, "unit")?,
            remaining: fields.optional("remaining").map(|node| EntryTime::read(&node)).transpose()?,
            ..Self::default()
        })
    }

    fn numbers(&self) -> Numbers<10> {
        [
            ("alongNoise", self.along_noise, NOT_NEGATIVE),
            ("acrossNoise", self.across_noise, NOT_NEGATIVE),
            ("near", self.near, NOT_NEGATIVE),
            ("restDistance", self.rest_distance, NOT_NEGATIVE),
            ("shake", self.shake, NOT_NEGATIVE),
            ("noneGain", self.none_gain, FINITE),
            ("noneOffset", self.none_offset, FINITE),
            ("noneShare", self.none_share, SHARE),
            ("uniform", self.uniform, SHARE),
            ("unit", self.unit, POSITIVE),
        ]
    }

    /// The constants of a scenario, with those of its motion and its initial density.
    ///
    /// # Errors
    /// `unknown-key`, `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`, `too-large`.
    pub(crate) fn with_filter(
        self,
        motion: &MotionModels,
        observation: &ObservationModel,
        initial: &InitialDensity,
    ) -> Result<Self> {
        let filter_noise = filter_noise(motion)?;
        if !observation.is_position() {
            let message = "cannot be combined with the method \"pointing\", which observes positions";
            return Err(Error::new(Code::UnknownKey, "observation.matrix", message));
        }
        axis_variances(observation.noise(), "observation.noise")?;
        let first_speed = initial.flat_deviations().ok_or_else(|| {
            let message = "cannot be combined with the method \"pointing\", which takes initial.velocity";
            Error::new(Code::UnknownKey, "initial.mean", message)
        })?;
        self.check(&Path::root("pointing"))?;
        let speed_noise = motion.speed_noise.unwrap_or(0.0);
        Ok(Self { filter_noise, speed_noise, first_speed: vector(first_speed), ..self })
    }

    fn check(&self, at: &Path<'_>) -> Result<()> {
        let place = at.key("noise");
        place.each(&self.scales, POSITIVE)?;
        if self.scales.is_empty() || self.scales.len() > MOST_SCALES {
            let message = format!("must have 1 to {MOST_SCALES} numbers, has {}", self.scales.len());
            return Err(Error::new(Code::WrongLength, place.to_string(), message));
        }
        self.time_to_go.check(&at.key("timeToGo"))?;
        check(&at.key("start"), self.start.numbers())?;
        check(&at.key("direction"), self.direction.numbers())?;
        check(&at.key("power"), self.power.numbers())?;
        check(at, self.numbers())?;
        self.remaining.as_ref().map_or(Ok(()), |remaining| remaining.check(&at.key("remaining")))
    }

    /// The key `pointing` as it is written.
    #[must_use]
    pub(crate) fn to_value(&self) -> Value {
        let Value::Map(mut entries) = object(self.numbers()) else { return Value::Null };
        let others = [
            ("noise", Value::numbers(&self.scales)),
            ("timeToGo", object(self.time_to_go.numbers())),
            ("start", object(self.start.numbers())),
            ("direction", object(self.direction.numbers())),
            ("power", object(self.power.numbers())),
            ("remaining", self.remaining.as_ref().map_or(Value::Null, |remaining| object(remaining.numbers()))),
        ];
        entries.extend(others.map(|(key, value)| (key.into(), value)));
        Value::Map(entries)
    }
}

/// The one noise that `constantVelocity` has on every axis.
fn filter_noise(motion: &MotionModels) -> Result<f64> {
    let value = motion.to_value();
    let node = Node::root(&value, "motion");
    if node.get("type").map(|name| name.value().clone()) != Some(Value::text("constantVelocity")) {
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

impl TimeToGo {
    fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["from", "to", "points", "median", "spread", "speedExponent"])?;
        Ok(Self {
            from: fields.float("from")?,
            to: fields.float("to")?,
            points: fields.required("points")?.integer(2, MOST_NODES)?,
            median: fields.float("median")?,
            spread: fields.float("spread")?,
            speed_exponent: fields.float("speedExponent")?,
        })
    }

    fn numbers(&self) -> Numbers<6> {
        [
            ("from", self.from, POSITIVE),
            ("to", self.to, POSITIVE),
            ("points", self.points as f64, |at, points| at.integer(points, 2, MOST_NODES).map(|_| points)),
            ("median", self.median, POSITIVE),
            ("spread", self.spread, POSITIVE),
            ("speedExponent", self.speed_exponent, FINITE),
        ]
    }

    fn check(&self, at: &Path<'_>) -> Result<()> {
        check(at, self.numbers())?;
        if self.to > self.from {
            return Ok(());
        }
        Err(at.key("to").error(Code::OutOfRange, "must be greater than from", self.to))
    }
}

impl Start {
    fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["exponent", "core", "reach"])?;
        Ok(Self { exponent: fields.float("exponent")?, core: fields.float("core")?, reach: fields.float("reach")? })
    }

    fn numbers(&self) -> Numbers<3> {
        [("exponent", self.exponent, NOT_NEGATIVE), ("core", self.core, POSITIVE), ("reach", self.reach, POSITIVE)]
    }
}

impl Direction {
    fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["power", "core", "wide", "distance", "time"])?;
        Ok(Self {
            power: fields.float("power")?,
            core: fields.float("core")?,
            wide: fields.float("wide")?,
            distance: fields.float("distance")?,
            time: fields.float("time")?,
        })
    }

    fn numbers(&self) -> Numbers<5> {
        [
            ("power", self.power, NOT_NEGATIVE),
            ("core", self.core, POSITIVE),
            ("wide", self.wide, POSITIVE),
            ("distance", self.distance, POSITIVE),
            ("time", self.time, NOT_NEGATIVE),
        ]
    }
}

impl Power {
    fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["from", "to", "time"])?;
        Ok(Self { from: fields.float("from")?, to: fields.float("to")?, time: fields.float("time")? })
    }

    fn numbers(&self) -> Numbers<3> {
        [("from", self.from, NOT_NEGATIVE), ("to", self.to, NOT_NEGATIVE), ("time", self.time, POSITIVE)]
    }
}

impl EntryTime {
    fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["offset", "nodes", "near", "distance", "elapsed", "low", "high"])?;
        Ok(Self {
            offset: fields.float("offset")?,
            nodes: fields.float("nodes")?,
            near: fields.float("near")?,
            distance: fields.float("distance")?,
            elapsed: fields.float("elapsed")?,
            low: fields.float("low")?,
            high: fields.float("high")?,
        })
    }

    fn numbers(&self) -> Numbers<7> {
        [
            ("offset", self.offset, FINITE),
            ("nodes", self.nodes, FINITE),
            ("near", self.near, FINITE),
            ("distance", self.distance, POSITIVE),
            ("elapsed", self.elapsed, FINITE),
            ("low", self.low, FINITE),
            ("high", self.high, FINITE),
        ]
    }

    fn check(&self, at: &Path<'_>) -> Result<()> {
        check(at, self.numbers())?;
        if self.low >= 0.0 {
            return Err(at.key("low").error(Code::OutOfRange, "must be less than 0", self.low));
        }
        if self.high <= 0.0 {
            return Err(at.key("high").error(Code::OutOfRange, "must be greater than 0", self.high));
        }
        Ok(())
    }
}
