//! Quadrature over an interval: nodes and weights that sum to one.

use crate::error::{Code, Result};
use crate::value::{Node, Value};

/// The most nodes that a rule can have.
pub const MAX_POINTS: usize = 1001;
const DEFAULT_POINTS: usize = 15;

/// A rule that turns an integral over the arrival time into a sum, Liang (6).
///
/// ```
/// use whither::math::quadrature::Quadrature;
/// let rule = Quadrature::Simpson { points: 3 }.rule();
/// assert_eq!(rule.nodes, [0.0, 0.5, 1.0]);
/// assert!((rule.weights[1] - 4.0 / 6.0).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Quadrature {
    /// Simpson's rule over evenly spaced nodes; an odd number of them, at least 3.
    Simpson {
        /// How many nodes.
        points: usize,
    },
    /// The trapezoid rule over evenly spaced nodes; at least 2.
    Trapezoid {
        /// How many nodes.
        points: usize,
    },
}

/// Nodes in `[0, 1]` and weights that sum to one.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// Where the integrand is taken, ascending.
    pub nodes: Vec<f64>,
    /// How much each node counts.
    pub weights: Vec<f64>,
}

impl Default for Quadrature {
    /// Simpson's rule with 15 nodes.
    fn default() -> Self {
        Self::Simpson { points: DEFAULT_POINTS }
    }
}

#[derive(Clone, Copy)]
enum Kind {
    Simpson,
    Trapezoid,
}

const KINDS: [(&str, Kind); 2] = [("simpson", Kind::Simpson), ("trapezoid", Kind::Trapezoid)];

impl Quadrature {
    /// Reads `{ "rule"?, "points"? }`.
    ///
    /// # Errors
    /// `unknown-key`, `wrong-type`, `not-finite`, `out-of-range` (Simpson's rule with an even count among them),
    /// `too-large`.
    pub fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["rule", "points"])?;
        let kind = match fields.optional("rule") {
            Some(node) => node.word(&KINDS)?,
            None => Kind::Simpson,
        };
        let points = |least: usize| match fields.optional("points") {
            Some(node) => node.whole(least, MAX_POINTS),
            None => Ok(DEFAULT_POINTS),
        };
        Ok(match kind {
            Kind::Simpson => {
                let points = points(3)?;
                if points.is_multiple_of(2) {
                    return Err(fields
                        .required("points")?
                        .error(Code::OutOfRange, "must be odd: Simpson's rule takes pairs of intervals"));
                }
                Self::Simpson { points }
            }
            Kind::Trapezoid => Self::Trapezoid { points: points(2)? },
        })
    }

    /// The rule as a scenario writes it.
    #[must_use]
    pub fn to_value(&self) -> Value {
        let (rule, points) = match self {
            Self::Simpson { points } => ("simpson", points),
            Self::Trapezoid { points } => ("trapezoid", points),
        };
        Value::map([("rule", Value::text(rule)), ("points", Value::Number(*points as f64))])
    }

    /// The nodes and weights over `[0, 1]`.
    #[must_use]
    pub fn rule(&self) -> Rule {
        let mut rule = match *self {
            Self::Simpson { points } => evenly(points, |i| match i {
                _ if i == 0 || i + 1 == points => 1.0,
                _ if i % 2 == 1 => 4.0,
                _ => 2.0,
            }),
            Self::Trapezoid { points } => evenly(points, |i| if i == 0 || i + 1 == points { 0.5 } else { 1.0 }),
        };
        let sum: f64 = rule.weights.iter().sum();
        rule.weights.iter_mut().for_each(|w| *w /= sum);
        rule
    }
}

fn evenly(points: usize, weight: impl Fn(usize) -> f64) -> Rule {
    let last = points.saturating_sub(1).max(1) as f64;
    Rule { nodes: (0..points).map(|i| i as f64 / last).collect(), weights: (0..points).map(weight).collect() }
}
