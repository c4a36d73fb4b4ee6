//! The values of `--noise` and `--arrival`.

use std::fmt::{self, Display, Formatter};
use whither::internals::{Node, Value};

/// Where a scenario's prior is a horizon, `uniform` reaches so many times as far: it counts from the first observation.
const WIDER: f64 = 5.0;

/// `motion.noise` of one row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Noise {
    Absolute(f64),
    Factor(f64),
}

impl Noise {
    /// Reads a number, or `x` and a factor.
    pub fn parse(text: &str) -> Result<Self, String> {
        let (number, noise): (_, fn(f64) -> Self) = match text.strip_prefix('x') {
            Some(factor) => (factor, Self::Factor),
            None => (text, Self::Absolute),
        };
        match number.parse() {
            Ok(x) if x > 0.0 && f64::is_finite(x) => Ok(noise(x)),
            _ => Err("must be a number above 0, or x and a factor above 0".to_owned()),
        }
    }

    /// What the scenario's noise becomes.
    pub fn of(self, given: &Value) -> Value {
        let factor = match self {
            Self::Absolute(noise) => return Value::Number(noise),
            Self::Factor(factor) => factor,
        };
        match given {
            Value::Number(noise) => Value::Number(noise * factor),
            Value::List(noises) => Value::List(noises.iter().map(|noise| self.of(noise)).collect()),
            Value::Map(entries) => {
                let of = |key: &str, value: &Value| if key == "candidates" { self.of(value) } else { value.clone() };
                Value::Map(entries.iter().map(|(key, value)| (key.clone(), of(key, value))).collect())
            }
            other => other.clone(),
        }
    }
}

impl Display for Noise {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Absolute(noise) => write!(f, "{noise}"),
            Self::Factor(factor) => write!(f, "x{factor}"),
        }
    }
}

/// An arrival prior, as it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Prior {
    pub text: String,
    pub value: Value,
}

impl Prior {
    /// The keys of each prior that has numbers alone.
    const KEYS: [(&str, &[&str]); 4] = [
        ("horizon", &["from", "to"]),
        ("uniform", &["from", "to"]),
        ("logNormal", &["median", "spread"]),
        ("fitts", &["intercept", "slope", "spread"]),
    ];

    /// Reads `TYPE:NUMBER:...`.
    pub fn parse(text: &str) -> Result<Self, String> {
        let legal = "must be horizon:FROM:TO, uniform:FROM:TO, logNormal:MEDIAN:SPREAD, fitts:INTERCEPT:SLOPE:SPREAD \
                     or discrete:TIME:TIME..., in seconds";
        let mut parts = text.split(':');
        let kind = parts.next().unwrap_or_default();
        let numbers: Vec<f64> = parts.map(str::parse).collect::<Result<_, _>>().map_err(|_| legal)?;
        let mut entries = vec![("type", Value::text(kind))];
        match Self::KEYS.iter().find(|(name, _)| *name == kind) {
            Some((_, keys)) if keys.len() == numbers.len() => {
                entries.extend(keys.iter().copied().zip(numbers.into_iter().map(Value::Number)));
            }
            None if kind == "discrete" && !numbers.is_empty() => entries.push(("times", Value::numbers(&numbers))),
            _ => return Err(legal.to_owned()),
        }
        let entries = entries.into_iter().map(|(key, value)| (key, Some(value))).collect();
        Ok(Self { text: text.to_owned(), value: Value::some(entries) })
    }

    /// A scenario's own.
    pub fn of(value: &Value) -> Self {
        let root = Node::root(value, "");
        let text = |key: &str| root.get(key).and_then(|node| node.text().ok().map(str::to_owned));
        let kind = text("type").unwrap_or_default();
        let keys = Self::KEYS.iter().find(|(name, _)| *name == kind).map_or(&[][..], |(_, keys)| keys);
        let numbers = keys.iter().filter_map(|key| root.get(key)?.float().ok()).map(|x| format!(":{x}"));
        let times = root.get("times").and_then(|times| times.floats().ok()).unwrap_or_default();
        let text = kind.clone() + &numbers.chain(times.iter().map(|x| format!(":{x}"))).collect::<String>();
        Self { text, value: value.clone() }
    }

    /// The priors of a scenario where no other is asked for.
    pub fn defaults(scenario: &Value) -> Vec<Self> {
        let root = Node::root(scenario, "");
        let Some(own) = root.get("arrival") else { return Vec::new() };
        let number = |key: &str| own.get(key)?.float().ok();
        let horizon = own.get("type").and_then(|kind| kind.text().ok()) == Some("horizon");
        let wider = number("from").zip(number("to")).filter(|_| horizon).map(|(from, to)| {
            let entries =
                [("type", Value::text("uniform")), ("from", Value::Number(from)), ("to", Value::Number(WIDER * to))];
            Self::of(&Value::map(entries))
        });
        [Self::of(own.value())].into_iter().chain(wider).collect()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn value(text: &str) -> Value {
        serde_json::from_str(text).unwrap()
    }

    #[test]
    fn a_factor_multiplies_every_noise_and_a_number_replaces_them() {
        let [twice, three] = ["x2", "3"].map(|text| Noise::parse(text).unwrap());
        for (given, expected) in [
            ("5", "10"),
            ("[1, 4]", "[2, 8]"),
            (r#"{"candidates": [1, [2, 3]], "weights": [1, 2]}"#, r#"{"candidates": [2, [4, 6]], "weights": [1, 2]}"#),
        ] {
            assert_eq!(twice.of(&value(given)), value(expected));
            assert_eq!(three.of(&value(given)), value("3"));
        }
        assert_eq!((twice.to_string(), three.to_string()), ("x2".to_owned(), "3".to_owned()));
    }

    #[test]
    fn a_prior_is_a_scenario_s_and_written_as_the_option() {
        for (text, expected) in [
            ("horizon:0.05:0.5", r#"{"type": "horizon", "from": 0.05, "to": 0.5}"#),
            ("logNormal:0.6:0.4", r#"{"type": "logNormal", "median": 0.6, "spread": 0.4}"#),
            ("fitts:0.1:0.2:0.3", r#"{"type": "fitts", "intercept": 0.1, "slope": 0.2, "spread": 0.3}"#),
            ("discrete:1:2", r#"{"type": "discrete", "times": [1, 2]}"#),
        ] {
            assert_eq!(Prior::parse(text).unwrap().value, value(expected));
            assert_eq!(Prior::of(&value(expected)).text, text);
        }
        let defaults = |arrival: &str| -> Vec<String> {
            let scenario = value(&format!(r#"{{"arrival": {arrival}}}"#));
            Prior::defaults(&scenario).into_iter().map(|prior| prior.text).collect()
        };
        assert_eq!(defaults(r#"{"type": "horizon", "from": 2, "to": 30}"#), ["horizon:2:30", "uniform:2:150"]);
        assert_eq!(defaults(r#"{"type": "uniform", "from": 2, "to": 30}"#), ["uniform:2:30"]);
    }
}
