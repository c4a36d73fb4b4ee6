//! The time to the entry into the target, as it is told to the user.

use crate::error::{Code, Result};
use crate::value::{Node, Value};

/// The time to the entry into the target: log-normal-like about a median that follows the nodes and the speed. The nodes'
/// own mean is too early, since their work is to rank destinations.
///
/// ```
/// use whither::likelihood::pointing::entry_time::EntryTime;
/// let entry = EntryTime { offset: 0.0, nodes: 1.0, speed: 0.0, low: -1.0, high: 1.0 };
/// let [median, low, high] = entry.at(0.3f64.ln(), 800.0);
/// assert!((median - 0.3).abs() < 1e-12 && low < 0.12 && high > 0.8);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct EntryTime {
    /// `ln median = offset + nodes E[ln R] + speed ln(speed + 50)`.
    pub offset: f64,
    /// Weight of the nodes' mean logarithm.
    pub nodes: f64,
    /// Weight of the logarithm of the speed.
    pub speed: f64,
    /// One in ten arrives before the median times `exp(low)`.
    pub low: f64,
    /// One in ten arrives after the median times `exp(high)`.
    pub high: f64,
}

impl EntryTime {
    /// Reads `{ offset, nodes, speed, low, high }`.
    ///
    /// # Errors
    /// Those of reading a value; `out-of-range`.
    pub fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["offset", "nodes", "speed", "low", "high"])?;
        let number = |key: &'static str| fields.required(key)?.number();
        let (low, high) = (number("low")?, number("high")?);
        if low >= 0.0 {
            return Err(fields.required("low")?.error(Code::OutOfRange, "must be less than 0"));
        }
        if high <= 0.0 {
            return Err(fields.required("high")?.error(Code::OutOfRange, "must be greater than 0"));
        }
        Ok(Self { offset: number("offset")?, nodes: number("nodes")?, speed: number("speed")?, low, high })
    }

    /// As a scenario writes it.
    #[must_use]
    pub fn to_value(&self) -> Value {
        Value::map([
            ("offset", Value::Number(self.offset)),
            ("nodes", Value::Number(self.nodes)),
            ("speed", Value::Number(self.speed)),
            ("low", Value::Number(self.low)),
            ("high", Value::Number(self.high)),
        ])
    }

    /// The median, and the ends of the 80% interval, in seconds; within what a clock can tell apart.
    #[must_use]
    pub fn at(&self, mean_log_node: f64, speed: f64) -> [f64; 3] {
        let median = self.offset + self.nodes * mean_log_node + self.speed * (speed + 50.0).ln();
        [median, median + self.low, median + self.high].map(|log| log.clamp(-20.0, 20.0).exp())
    }
}
