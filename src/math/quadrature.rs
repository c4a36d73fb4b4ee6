//! Quadrature over an interval, for Liang (6): nodes and weights that sum to one.

use super::cosine::cosine;
use super::radix_sort::sort_numbers;
use super::random::Random;
use crate::error::{Code, Result};
use crate::value::{Node, Path, Value};

/// The most nodes that a rule can have.
pub const MAX_POINTS: usize = 1001;
const DEFAULT_POINTS: usize = 15;

/// How an integral over the arrival time becomes a sum, Liang (6): at most 1001 nodes, 15 of Simpson's rule by default.
///
/// ```
/// use whither::Quadrature;
/// assert_eq!(Quadrature::default(), Quadrature::simpson(15));
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
    /// Gauss and Legendre's rule; at least 1. The limits of the interval are no nodes.
    GaussLegendre {
        /// How many nodes.
        points: usize,
    },
    /// Random nodes of equal weight; at least 1. A seed gives the same nodes on every platform.
    MonteCarlo {
        /// How many nodes.
        points: usize,
        /// What the random numbers follow from.
        seed: u32,
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

/// A rule with so many points.
type With = fn(usize) -> Quadrature;

/// Every `rule`, the least number of points of each, and the rule with so many of them.
const RULES: [(&str, (usize, With)); 4] = [
    ("simpson", (3, Quadrature::simpson)),
    ("trapezoid", (2, Quadrature::trapezoid)),
    ("gaussLegendre", (1, Quadrature::gauss_legendre)),
    ("monteCarlo", (1, |points| Quadrature::monte_carlo(points, 0))),
];

/// How many deviations the normal density is integrated over to either side; 6e-5 of it lies beyond.
const NORMAL_RANGE: f64 = 4.0;

impl Quadrature {
    /// Simpson's rule: an odd number of nodes, at least 3.
    #[must_use]
    pub const fn simpson(points: usize) -> Self {
        Self::Simpson { points }
    }

    /// The trapezoid rule: at least 2 nodes.
    #[must_use]
    pub const fn trapezoid(points: usize) -> Self {
        Self::Trapezoid { points }
    }

    /// Gauss and Legendre's rule: at least 1 node.
    #[must_use]
    pub const fn gauss_legendre(points: usize) -> Self {
        Self::GaussLegendre { points }
    }

    /// Random nodes, at least 1.
    #[must_use]
    pub const fn monte_carlo(points: usize, seed: u32) -> Self {
        Self::MonteCarlo { points, seed }
    }

    /// Reads `{ "rule"?, "points"?, "seed"? }`, `seed` for `monteCarlo` alone.
    pub(crate) fn read(node: &Node<'_>) -> Result<Self> {
        let (least, with) = node.get("rule").map_or(Ok(RULES[0].1), |rule| rule.word(&RULES))?;
        let keys: &[&str] = match with(least) {
            Self::MonteCarlo { .. } => &["rule", "points", "seed"],
            _ => &["rule", "points"],
        };
        let fields = node.fields(keys)?;
        let points =
            fields.optional("points").map_or(Ok(DEFAULT_POINTS), |points| points.integer(least, MAX_POINTS))?;
        Ok(match (with(points), fields.optional("seed")) {
            (Self::MonteCarlo { points, .. }, Some(seed)) => {
                Self::MonteCarlo { points, seed: seed.integer(0, u32::MAX as usize)? as u32 }
            }
            (rule, _) => rule,
        })
    }

    /// Whether there is such a rule.
    ///
    /// # Errors
    /// `out-of-range` (Simpson's rule with an even count among them), `too-large`.
    pub(crate) fn check(&self, at: &Path<'_>) -> Result<()> {
        let (_, (least, _)) = RULES[self.place()];
        let (place, points) = (at.key("points"), self.points() as f64);
        place.integer(points, least, MAX_POINTS)?;
        if matches!(self, Self::Simpson { points } if points.is_multiple_of(2)) {
            let must = "must be odd: Simpson's rule takes pairs of intervals";
            return Err(place.error(Code::OutOfRange, must, points));
        }
        Ok(())
    }

    /// The place in [`RULES`].
    const fn place(&self) -> usize {
        match self {
            Self::Simpson { .. } => 0,
            Self::Trapezoid { .. } => 1,
            Self::GaussLegendre { .. } => 2,
            Self::MonteCarlo { .. } => 3,
        }
    }

    /// How many nodes.
    #[must_use]
    pub(crate) const fn points(&self) -> usize {
        match *self {
            Self::Simpson { points }
            | Self::Trapezoid { points }
            | Self::GaussLegendre { points }
            | Self::MonteCarlo { points, .. } => points,
        }
    }

    /// The rule as a scenario writes it.
    #[must_use]
    pub(crate) fn to_value(&self) -> Value {
        let (rule, _) = RULES[self.place()];
        let mut entries =
            vec![("rule".into(), Value::text(rule)), ("points".into(), Value::Number(self.points() as f64))];
        if let Self::MonteCarlo { seed, .. } = self {
            entries.push(("seed".into(), Value::Number(f64::from(*seed))));
        }
        Value::Map(entries)
    }

    /// The nodes and weights over `[0, 1]`.
    #[must_use]
    pub(crate) fn rule(&self) -> Rule {
        match *self {
            Self::Simpson { points } => evenly(points, |i| match i {
                _ if i == 0 || i + 1 == points => 1.0,
                _ if i % 2 == 1 => 4.0,
                _ => 2.0,
            }),
            Self::Trapezoid { points } => evenly(points, |i| if i == 0 || i + 1 == points { 0.5 } else { 1.0 }),
            Self::GaussLegendre { points } => gauss_legendre(points),
            Self::MonteCarlo { points, seed } => drawn(points, seed, Random::uniform),
        }
        .normalised()
    }

    /// Nodes and weights for the standard normal density: the rule over four deviations to either side, each weight times
    /// the density there; `monteCarlo` draws from the density itself.
    #[must_use]
    pub(crate) fn normal_rule(&self) -> Rule {
        if let Self::MonteCarlo { points, seed } = *self {
            return drawn(points, seed, Random::normal).normalised();
        }
        let mut rule = self.rule();
        for (node, weight) in rule.nodes.iter_mut().zip(&mut rule.weights) {
            *node = NORMAL_RANGE * (2.0 * *node - 1.0);
            *weight *= (-0.5 * *node * *node).exp();
        }
        rule.normalised()
    }
}

impl Rule {
    fn normalised(mut self) -> Self {
        let sum: f64 = self.weights.iter().sum();
        self.weights.iter_mut().for_each(|weight| *weight /= sum);
        self
    }
}

fn evenly(points: usize, weight: impl Fn(usize) -> f64) -> Rule {
    let last = points.saturating_sub(1).max(1) as f64;
    Rule { nodes: (0..points).map(|i| i as f64 / last).collect(), weights: (0..points).map(weight).collect() }
}

fn drawn(points: usize, seed: u32, draw: fn(&mut Random) -> f64) -> Rule {
    let mut random = Random::new(u64::from(seed));
    let mut nodes: Vec<f64> = (0..points).map(|_| draw(&mut random)).collect();
    sort_numbers(&mut nodes);
    Rule { nodes, weights: vec![1.0; points] }
}

/// The roots of Legendre's polynomial by Newton's method, the upper half of them from Tricomi's estimate.
fn gauss_legendre(points: usize) -> Rule {
    let mut rule = Rule { nodes: vec![0.5; points], weights: vec![1.0; points] };
    for i in 0..points / 2 {
        let mut root = cosine((i as f64 + 0.75) / (2.0 * points as f64 + 1.0));
        for _ in 0..8 {
            let (value, slope) = legendre(points, root);
            root -= value / slope;
        }
        let (_, slope) = legendre(points, root);
        let weight = 2.0 / ((1.0 - root * root) * slope * slope);
        let mirror = points - 1 - i;
        rule.nodes[i] = 0.5 * (1.0 - root);
        rule.nodes[mirror] = 0.5 * (1.0 + root);
        rule.weights[i] = weight;
        rule.weights[mirror] = weight;
    }
    if points % 2 == 1 {
        let (_, slope) = legendre(points, 0.0);
        rule.weights[points / 2] = 2.0 / (slope * slope);
    }
    rule
}

/// Legendre's polynomial of a degree and its derivative, inside `(-1, 1)`.
fn legendre(degree: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..degree {
        let k = k as f64;
        let next = ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0);
        before = value;
        value = next;
    }
    (value, degree as f64 * (before - x * value) / (1.0 - x * x))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(json: &str) -> Result<Quadrature> {
        let value: Value = serde_json::from_str(json).unwrap();
        let node = Node::root(&value, "quadrature");
        let quadrature = Quadrature::read(&node)?;
        quadrature.check(node.place())?;
        Ok(quadrature)
    }

    fn integral(rule: &Rule, f: impl Fn(f64) -> f64) -> f64 {
        rule.nodes.iter().zip(&rule.weights).map(|(x, w)| w * f(*x)).sum()
    }

    #[test]
    fn each_rule_is_exact_for_the_polynomials_that_it_should_be() {
        let rules = [
            (Quadrature::Simpson { points: 3 }, 3),
            (Quadrature::Simpson { points: 1001 }, 3),
            (Quadrature::Trapezoid { points: 2 }, 1),
            (Quadrature::GaussLegendre { points: 1 }, 1),
            (Quadrature::GaussLegendre { points: 2 }, 3),
            (Quadrature::GaussLegendre { points: 9 }, 17),
            (Quadrature::GaussLegendre { points: 1001 }, 30),
        ];
        for (quadrature, degree) in rules {
            let rule = quadrature.rule();
            for power in 0..=degree {
                let found = integral(&rule, |x| x.powi(power));
                assert!((found * f64::from(power + 1) - 1.0).abs() < 2e-14, "{quadrature:?}, x^{power}: {found}");
            }
        }
    }

    #[test]
    fn gauss_and_legendre_s_nodes_are_those_of_the_tables() {
        // Abramowitz and Stegun, table 25.4, n = 5, moved to [0, 1]
        let rule = Quadrature::GaussLegendre { points: 5 }.rule();
        let expected = [
            (0.0, 0.568_888_888_888_888_9),
            (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
            (0.906_179_845_938_664, 0.236_926_885_056_189_1),
        ];
        for (i, (node, weight)) in expected.into_iter().enumerate() {
            assert!((rule.nodes[2 + i] - 0.5 * (1.0 + node)).abs() < 1e-15);
            assert!((rule.nodes[2 - i] - 0.5 * (1.0 - node)).abs() < 1e-15);
            assert!((rule.weights[2 + i] - 0.5 * weight).abs() < 1e-15);
            assert!((rule.weights[2 - i] - 0.5 * weight).abs() < 1e-15);
        }
    }

    #[test]
    fn random_nodes_follow_from_their_seed_and_converge() {
        let of = |seed| Quadrature::MonteCarlo { points: 1001, seed }.rule();
        assert_eq!(of(3), of(3));
        assert_ne!(of(3), of(4));
        assert!(of(3).nodes.is_sorted());
        // the mean of x^2 is 1/3, with a deviation of 0.0094
        assert!((integral(&of(3), |x| x * x) - 1.0 / 3.0).abs() < 0.03);
    }

    #[test]
    fn the_normal_rules_have_the_moments_of_the_normal_density() {
        let rules = [
            (Quadrature::Simpson { points: 31 }, 2e-3),
            (Quadrature::Trapezoid { points: 31 }, 2e-3),
            (Quadrature::GaussLegendre { points: 31 }, 2e-3),
            (Quadrature::MonteCarlo { points: 1001, seed: 0 }, 0.2),
        ];
        for (quadrature, tolerance) in rules {
            let rule = quadrature.normal_rule();
            for (power, expected) in [(0, 1.0), (1, 0.0), (2, 1.0)] {
                let found = integral(&rule, |z| z.powi(power));
                assert!((found - expected).abs() < tolerance, "{quadrature:?}, z^{power}: {found}");
            }
        }
    }

    #[test]
    fn what_is_read_is_written_again() {
        for json in [
            r#"{"rule": "simpson", "points": 15.0}"#,
            r#"{"rule": "trapezoid", "points": 2.0}"#,
            r#"{"rule": "gaussLegendre", "points": 1001.0}"#,
            r#"{"rule": "monteCarlo", "points": 100.0, "seed": 7.0}"#,
        ] {
            assert_eq!(read(json).unwrap().to_value(), serde_json::from_str(json).unwrap());
        }
        assert_eq!(read("{}").unwrap(), Quadrature::Simpson { points: 15 });
        assert_eq!(read(r#"{"rule": "monteCarlo"}"#).unwrap(), Quadrature::MonteCarlo { points: 15, seed: 0 });
    }

    #[test]
    fn bad_rules_are_refused_by_name() {
        let cases = [
            (
                r#"{"points": 14}"#,
                "out-of-range",
                "quadrature.points: must be odd: Simpson's rule takes pairs of intervals, got 14",
            ),
            (r#"{"points": 1}"#, "out-of-range", "quadrature.points: must be an integer from 3 to 1001, got 1"),
            (r#"{"points": 1003}"#, "too-large", "quadrature.points: must be an integer from 3 to 1001, got 1003"),
            (
                r#"{"rule": "trapezoid", "points": 2.5}"#,
                "out-of-range",
                "quadrature.points: must be an integer from 2 to 1001, got 2.5",
            ),
            (
                r#"{"seed": 1}"#,
                "unknown-key",
                "quadrature.seed: unknown key \"seed\", expected one of \"rule\", \"points\"",
            ),
            (
                r#"{"rule": "romberg"}"#,
                "out-of-range",
                "quadrature.rule: must be one of \"simpson\", \"trapezoid\", \"gaussLegendre\", \"monteCarlo\", got \"romberg\"",
            ),
        ];
        for (json, code, text) in cases {
            let error = read(json).expect_err(json);
            assert_eq!((error.code().as_str(), error.to_string().as_str()), (code, text));
        }
    }
}
