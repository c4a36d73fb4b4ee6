//! Priors on the arrival time `T` and the nodes at which they are summed; Liang (6), Ardeshiri (17).
//!
//! All but `horizon` are priors on `T - t_1`, the time from the first observation; `horizon` is one on `T - t_k`, the
//! time to go, at every step. Every time is greater than zero. `logNormal` and `fitts` are integrated over `ln T`, from
//! four spreads below the median to four above.

use crate::error::{Code, Result};
use crate::math::quadrature::{MAX_POINTS, Quadrature};
use crate::value::{Node, Path, Value, number};

/// The longest time that a prior can name, in seconds; it keeps every power of a step finite.
pub const MAX_TIME: f64 = 1e12;

/// Arrival times and the logs of their prior probabilities.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// `T - t_1`, or the time to go for `horizon`, in seconds; greater than zero.
    pub times: Vec<f64>,
    /// Logs of probabilities that sum to one; minus infinity where a weight is zero.
    pub log_weights: Vec<f64>,
}

/// The prior of the arrival time `T`, in seconds; Liang (6), Ardeshiri (17).
///
/// All but `Horizon` are priors on `T - t_1`, the time from the first observation; `Horizon` is one on `T - t_k`, the time to go, at
/// every observation (not for the methods that accumulate evidence: `algorithm1`, `algorithm2`, `bridging`). Times are above 0 and at
/// most 1e12.
///
/// ```
/// use whither::Arrival;
/// assert_eq!(Arrival::horizon(0.05, 0.5), Arrival::Horizon { from: 0.05, to: 0.5 });
/// assert_eq!(Arrival::discrete([2.0, 5.0]), Arrival::Discrete { times: vec![2.0, 5.0], weights: vec![1.0, 1.0] });
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Arrival {
    /// Evenly between two times from the first observation.
    Uniform {
        /// The earliest, in seconds.
        from: f64,
        /// The latest, in seconds.
        to: f64,
    },
    /// Some times from the first observation, each with its weight.
    Discrete {
        /// The times, in seconds.
        times: Vec<f64>,
        /// Weights, at least one of them above zero; they need not sum to one.
        weights: Vec<f64>,
    },
    /// Log-normal from the first observation: `ln T ~ N(ln median, spread^2)`.
    LogNormal {
        /// The median, in seconds.
        median: f64,
        /// The deviation of `ln T`.
        spread: f64,
    },
    /// Log-normal about Fitts's law in Shannon's form, with the median
    /// `intercept + slope log2(distance / size + 1)` (MacKenzie, Human-Computer Interaction 7, 1992).
    Fitts {
        /// The time at the distance zero, in seconds.
        intercept: f64,
        /// Seconds for each bit of difficulty.
        slope: f64,
        /// The deviation of `ln T`.
        spread: f64,
    },
    /// Evenly between two times to go, at every step.
    Horizon {
        /// The shortest, in seconds.
        from: f64,
        /// The longest, in seconds.
        to: f64,
    },
}

type Read = fn(&Node<'_>) -> Result<Arrival>;

/// Every `type` and how it is read.
const TYPES: [(&str, Read); 5] = [
    ("uniform", |node| {
        let fields = node.fields(&["type", "from", "to"])?;
        Ok(Arrival::Uniform { from: fields.float("from")?, to: fields.float("to")? })
    }),
    ("discrete", |node| {
        let fields = node.fields(&["type", "times", "weights"])?;
        let times = fields.required("times")?.floats()?;
        let weights = fields.optional("weights").map_or_else(|| Ok(vec![1.0; times.len()]), |list| list.floats())?;
        Ok(Arrival::Discrete { times, weights })
    }),
    ("logNormal", |node| {
        let fields = node.fields(&["type", "median", "spread"])?;
        Ok(Arrival::LogNormal { median: fields.float("median")?, spread: fields.float("spread")? })
    }),
    ("fitts", |node| {
        let fields = node.fields(&["type", "intercept", "slope", "spread"])?;
        let (intercept, slope) = (fields.float("intercept")?, fields.float("slope")?);
        Ok(Arrival::Fitts { intercept, slope, spread: fields.float("spread")? })
    }),
    ("horizon", |node| {
        let fields = node.fields(&["type", "from", "to"])?;
        Ok(Arrival::Horizon { from: fields.float("from")?, to: fields.float("to")? })
    }),
];

/// The largest deviation of `ln T`; one such deviation is a factor of 22 000.
const MAX_SPREAD: f64 = 10.0;
/// The most bits of difficulty that Fitts's law is asked for; a target without size would need infinitely many.
const MAX_DIFFICULTY: f64 = 64.0;

impl Arrival {
    /// Evenly between two times from the first observation, in seconds.
    #[must_use]
    pub const fn uniform(from: f64, to: f64) -> Self {
        Self::Uniform { from, to }
    }

    /// Some times from the first observation, in seconds, equally likely.
    pub fn discrete(times: impl Into<Vec<f64>>) -> Self {
        let times = times.into();
        Self::Discrete { weights: vec![1.0; times.len()], times }
    }

    /// Log-normal from the first observation: the median in seconds and the deviation of `ln T`.
    #[must_use]
    pub const fn log_normal(median: f64, spread: f64) -> Self {
        Self::LogNormal { median, spread }
    }

    /// Log-normal about Fitts's law.
    #[must_use]
    pub const fn fitts(intercept: f64, slope: f64, spread: f64) -> Self {
        Self::Fitts { intercept, slope, spread }
    }

    /// Evenly between two times to go, in seconds, at every step.
    #[must_use]
    pub const fn horizon(from: f64, to: f64) -> Self {
        Self::Horizon { from, to }
    }

    /// Reads `{ "type", ... }`.
    pub(crate) fn read(node: &Node<'_>) -> Result<Self> {
        node.tag("type", &TYPES)?(node)
    }

    /// Whether this is a prior.
    ///
    /// # Errors
    /// `wrong-length`, `not-finite`, `out-of-range`, `too-large`.
    pub(crate) fn check(&self, at: &Path<'_>) -> Result<()> {
        match self {
            Self::Uniform { from, to } | Self::Horizon { from, to } => {
                let (from, latest) = (time(&at.key("from"), *from)?, at.key("to"));
                if time(&latest, *to)? <= from {
                    let must = format!("must be greater than \"from\", which is {}", number(from));
                    return Err(latest.error(Code::OutOfRange, &must, *to));
                }
                Ok(())
            }
            Self::Discrete { times, weights } => check_discrete(at, times, weights),
            Self::LogNormal { median, spread } => {
                time(&at.key("median"), *median)?;
                check_spread(&at.key("spread"), *spread)
            }
            Self::Fitts { intercept, slope, spread } => {
                time(&at.key("intercept"), *intercept)?;
                let place = at.key("slope");
                if place.not_negative(*slope)? > 0.0 {
                    time(&place, *slope)?;
                }
                check_spread(&at.key("spread"), *spread)
            }
        }
    }

    /// The prior as a scenario writes it.
    #[must_use]
    pub(crate) fn to_value(&self) -> Value {
        match self {
            Self::Uniform { from, to } => interval_value("uniform", *from, *to),
            Self::Horizon { from, to } => interval_value("horizon", *from, *to),
            Self::Discrete { times, weights } => Value::map([
                ("type", Value::text("discrete")),
                ("times", Value::numbers(times)),
                ("weights", Value::numbers(weights)),
            ]),
            Self::LogNormal { median, spread } => Value::map([
                ("type", Value::text("logNormal")),
                ("median", Value::Number(*median)),
                ("spread", Value::Number(*spread)),
            ]),
            Self::Fitts { intercept, slope, spread } => Value::map([
                ("type", Value::text("fitts")),
                ("intercept", Value::Number(*intercept)),
                ("slope", Value::Number(*slope)),
                ("spread", Value::Number(*spread)),
            ]),
        }
    }

    /// How many nodes it has.
    #[must_use]
    pub(crate) fn points(&self, quadrature: &Quadrature) -> usize {
        match self {
            Self::Discrete { times, .. } => times.len(),
            _ => quadrature.points(),
        }
    }

    /// Whether it is a prior on the time to go at every step.
    #[must_use]
    pub(crate) const fn is_horizon(&self) -> bool {
        matches!(self, Self::Horizon { .. })
    }

    /// Whether it depends on the destination's distance and size.
    #[must_use]
    pub(crate) const fn needs_distance(&self) -> bool {
        matches!(self, Self::Fitts { .. })
    }

    /// The nodes and the logs of their probabilities. `distance`, from the first observation to the destination's
    /// centre, and `size`, its extent, matter only where [`Arrival::needs_distance`].
    #[must_use]
    pub(crate) fn grid(&self, quadrature: &Quadrature, distance: f64, size: f64) -> Grid {
        match self {
            Self::Uniform { from, to } | Self::Horizon { from, to } => {
                let rule = quadrature.rule();
                let times = rule.nodes.iter().map(|x| from + (to - from) * x).collect();
                Grid::new(times, &rule.weights)
            }
            Self::Discrete { times, weights } => Grid::new(times.clone(), weights),
            Self::LogNormal { median, spread } => Grid::log_normal(*median, *spread, quadrature),
            Self::Fitts { intercept, slope, spread } => {
                let difficulty = if distance > 0.0 { (distance / size + 1.0).log2().min(MAX_DIFFICULTY) } else { 0.0 };
                Grid::log_normal(intercept + slope * difficulty, *spread, quadrature)
            }
        }
    }
}

impl Grid {
    fn new(times: Vec<f64>, weights: &[f64]) -> Self {
        let sum: f64 = weights.iter().sum();
        Self { times, log_weights: weights.iter().map(|w| (w / sum).ln()).collect() }
    }

    fn log_normal(median: f64, spread: f64, quadrature: &Quadrature) -> Self {
        let rule = quadrature.normal_rule();
        Self::new(rule.nodes.iter().map(|z| median * (spread * z).exp()).collect(), &rule.weights)
    }
}

fn interval_value(kind: &str, from: f64, to: f64) -> Value {
    Value::map([("type", Value::text(kind)), ("from", Value::Number(from)), ("to", Value::Number(to))])
}

fn check_discrete(at: &Path<'_>, times: &[f64], weights: &[f64]) -> Result<()> {
    let (place, count) = (at.key("times"), times.len());
    if count == 0 {
        return Err(place.error(Code::WrongLength, "must have at least one time", times));
    }
    if count > MAX_POINTS {
        let must = format!("must have at most {MAX_POINTS} times, has {count}");
        return Err(place.error(Code::TooLarge, &must, times));
    }
    place.each(times, time)?;
    let place = at.key("weights");
    let sum: f64 = place.vector(weights, count, |at, x| at.not_negative(x))?.iter().sum();
    if sum > 0.0 && sum.is_finite() {
        return Ok(());
    }
    Err(place.error(Code::OutOfRange, "must have a finite sum greater than 0", weights))
}

fn check_spread(at: &Path<'_>, spread: f64) -> Result<()> {
    if at.number(spread)? > 0.0 && spread <= MAX_SPREAD {
        return Ok(());
    }
    let must = format!("must be greater than 0 and at most {}", number(MAX_SPREAD));
    Err(at.error(Code::OutOfRange, &must, spread))
}

/// A time in seconds, greater than zero and at most [`MAX_TIME`].
fn time(at: &Path<'_>, t: f64) -> Result<f64> {
    if at.number(t)? > 0.0 && t <= MAX_TIME {
        return Ok(t);
    }
    Err(at.error(Code::OutOfRange, "must be greater than 0 and at most 1e12 seconds", t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::log_sum_exp::log_sum_exp;

    const RULES: [Quadrature; 4] = [
        Quadrature::Simpson { points: 31 },
        Quadrature::Trapezoid { points: 31 },
        Quadrature::GaussLegendre { points: 31 },
        Quadrature::MonteCarlo { points: 1001, seed: 5 },
    ];
    const EACH: [&str; 5] = [
        r#"{"type": "uniform", "from": 0.5, "to": 4.0}"#,
        r#"{"type": "discrete", "times": [1.0, 3.0, 2.0], "weights": [1.0, 0.0, 3.0]}"#,
        r#"{"type": "logNormal", "median": 2.0, "spread": 0.25}"#,
        r#"{"type": "fitts", "intercept": 0.5, "slope": 0.25, "spread": 0.1}"#,
        r#"{"type": "horizon", "from": 0.05, "to": 0.5}"#,
    ];

    fn read(json: &str) -> Result<Arrival> {
        let value: Value = serde_json::from_str(json).unwrap();
        let node = Node::root(&value, "arrival");
        let arrival = Arrival::read(&node)?;
        arrival.check(node.place())?;
        Ok(arrival)
    }

    fn mean(grid: &Grid, f: impl Fn(f64) -> f64) -> f64 {
        grid.times.iter().zip(&grid.log_weights).map(|(t, w)| w.exp() * f(*t)).sum()
    }

    #[test]
    fn what_is_read_is_written_again() {
        for json in EACH {
            assert_eq!(read(json).unwrap().to_value(), serde_json::from_str(json).unwrap());
        }
    }

    #[test]
    fn every_grid_has_positive_times_and_weights_that_sum_to_one() {
        for json in EACH {
            for rule in &RULES {
                let grid = read(json).unwrap().grid(rule, 700.0, 100.0);
                assert_eq!(grid.times.len(), grid.log_weights.len());
                assert!(grid.times.iter().all(|t| *t > 0.0 && t.is_finite()));
                assert!(log_sum_exp(&grid.log_weights).abs() < 1e-12, "{json}, {rule:?}");
            }
        }
    }

    #[test]
    fn only_the_horizon_is_a_time_to_go_and_only_fitts_needs_a_distance() {
        let arrivals = EACH.map(|json| read(json).unwrap());
        assert_eq!(arrivals.each_ref().map(Arrival::is_horizon), [false, false, false, false, true]);
        assert_eq!(arrivals.each_ref().map(Arrival::needs_distance), [false, false, false, true, false]);
    }

    #[test]
    fn moments_are_those_of_the_prior() {
        for rule in &RULES {
            let drawn = matches!(rule, Quadrature::MonteCarlo { .. });
            let near = |found: f64, expected: f64| {
                assert!((found - expected).abs() < if drawn { 0.1 } else { 1e-3 }, "{rule:?}: {found}, not {expected}");
            };
            let uniform = read(EACH[0]).unwrap().grid(rule, 0.0, 1.0);
            near(mean(&uniform, |t| t), 2.25);
            let log_normal = read(EACH[2]).unwrap().grid(rule, 0.0, 1.0);
            near(mean(&log_normal, f64::ln), 2f64.ln());
            near(mean(&log_normal, |t| t), 2.0 * (0.25f64 * 0.25 / 2.0).exp());
            // log2(700 / 100 + 1) = 3 bits: 0.5 + 3 * 0.25
            let fitts = read(EACH[3]).unwrap().grid(rule, 700.0, 100.0);
            near(mean(&fitts, f64::ln), 1.25f64.ln());
        }
    }

    #[test]
    fn discrete_times_stay_as_they_are_given() {
        let grid = read(EACH[1]).unwrap().grid(&Quadrature::default(), 0.0, 1.0);
        assert_eq!(grid.times, [1.0, 3.0, 2.0]);
        assert_eq!(grid.log_weights, [0.25f64.ln(), f64::NEG_INFINITY, 0.75f64.ln()]);
        let equal = read(r#"{"type": "discrete", "times": [1, 2, 3, 4]}"#).unwrap();
        assert_eq!(equal.grid(&Quadrature::default(), 0.0, 1.0).log_weights, [0.25f64.ln(); 4]);
    }

    #[test]
    fn fitts_s_law_is_finite_for_a_target_without_size_and_for_no_distance() {
        let fitts = read(EACH[3]).unwrap();
        for (distance, size) in [(700.0, 0.0), (0.0, 0.0), (0.0, 100.0)] {
            let grid = fitts.grid(&Quadrature::default(), distance, size);
            assert!(grid.times.iter().all(|t| *t > 0.0 && t.is_finite()), "{distance}, {size}");
        }
    }

    #[test]
    fn bad_priors_are_refused_by_name() {
        let cases = [
            (r#"{}"#, "missing-key", "arrival.type: missing key \"type\""),
            (
                r#"{"type": "uniform", "from": 0, "to": 1}"#,
                "out-of-range",
                "arrival.from: must be greater than 0 and at most 1e12 seconds, got 0",
            ),
            (
                r#"{"type": "uniform", "from": 1, "to": 1e13}"#,
                "out-of-range",
                "arrival.to: must be greater than 0 and at most 1e12 seconds, got 10000000000000",
            ),
            (
                r#"{"type": "horizon", "from": 2, "to": 1}"#,
                "out-of-range",
                "arrival.to: must be greater than \"from\", which is 2, got 1",
            ),
            (r#"{"type": "uniform", "from": 1}"#, "missing-key", "arrival.to: missing key \"to\""),
            (
                r#"{"type": "discrete", "times": []}"#,
                "wrong-length",
                "arrival.times: must have at least one time, got []",
            ),
            (
                r#"{"type": "discrete", "times": [1, 2], "weights": [1]}"#,
                "wrong-length",
                "arrival.weights: must have 2 numbers, has 1, got [1]",
            ),
            (
                r#"{"type": "discrete", "times": [1, 2], "weights": [0, 0]}"#,
                "out-of-range",
                "arrival.weights: must have a finite sum greater than 0, got [0, 0]",
            ),
            (
                r#"{"type": "discrete", "times": [1, 2], "weights": [1, -1]}"#,
                "out-of-range",
                "arrival.weights[1]: must be at least 0, got -1",
            ),
            (
                r#"{"type": "logNormal", "median": 1, "spread": 11}"#,
                "out-of-range",
                "arrival.spread: must be greater than 0 and at most 10, got 11",
            ),
            (
                r#"{"type": "fitts", "intercept": 0.1, "slope": -1, "spread": 0.1}"#,
                "out-of-range",
                "arrival.slope: must be at least 0, got -1",
            ),
        ];
        for (json, code, text) in cases {
            let error = read(json).expect_err(json);
            assert_eq!((error.code().as_str(), error.to_string().as_str()), (code, text));
        }
        let many = format!(r#"{{"type": "discrete", "times": {:?}}}"#, vec![1.0; MAX_POINTS + 1]);
        let error = read(&many).unwrap_err();
        let text = "arrival.times: must have at most 1001 times, has 1002, got [1, 1, 1, 1, ...]";
        assert_eq!((error.code().as_str(), error.to_string().as_str()), ("too-large", text));
    }
}
