//! What the outcomes of a user's movements teach: how far the pointing model holds for them, and how long they take.
//!
//! From the second sample of a movement on the log score of each target, prior included, is multiplied by `confidence`, which is `e^b`:
//! that is `z_i`, and `q = softmax(z)`. When the target `k` of a movement is known, over samples of its approach
//! ```text
//! G = mean(sum_i q_i z_i - z_k), held in +-6    C = mean(var_q z)    w = min(4, n / mean n)
//! precision += w C                              b -= w G / precision, held in [-1.5, 1]
//! ```
//! with `n` the samples of the approach and `mean n` over the user's movements so far. That is a Newton step of the log loss, by the
//! precision of all before it; it begins with that of `b ~ N(0, .5^2)`. Three more numbers are added to the logarithms of
//! the time to the entry and its interval: with `W = min(3, n / mean n)` after the movement `m`, by a step of each quantile's pinball loss
//! ```text
//! mean += W (.05 + .3/m) (share of samples that enter after it - .5)
//! low  += W (.1 + 4/(m + 4)) (share that enter after it - .9)      high += W (.1 + 4/(m + 4)) (share that enter after it - .1)
//! ```

use crate::error::{Code, Result};
use crate::value::{Node, Path, Value, number};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Of each number its key, the least and the most that may be set.
const NUMBERS: [(&str, f64, f64); 7] = [
    ("confidence", 0.2, 3.0),
    ("precision", 0.001, 1e9),
    ("movements", 0.0, 1e9),
    ("samples", 0.0, 1e9),
    ("mean", -3.0, 3.0),
    ("low", -3.0, 3.0),
    ("high", -3.0, 3.0),
];

/// What the outcomes of a user's movements have taught a predictor with the method `pointing`; [`Learnt::default`] is a new user, of whom
/// nothing is known. It is a handful of plain numbers, for an application to keep from one visit to the next, and no record of what was
/// chosen.
///
/// ```
/// use whither::{Learnt, PointerOptions, PointerTarget, Predictor, pointer_scenario};
/// let target = |id: &str, x| PointerTarget { id: id.to_owned(), x, y: 300.0, width: 80.0, height: 80.0 };
/// let scenario = pointer_scenario(&[target("a", 100.0), target("b", 700.0)], PointerOptions::default())?;
/// let mut predictor = Predictor::new(&scenario);
/// predictor.set_learnt(Learnt { confidence: 0.8, ..Learnt::default() })?; // a user who is hard to predict
/// let json = serde_json::to_string(&predictor.learnt())?;
/// assert_eq!(serde_json::from_str::<Learnt>(&json)?, predictor.learnt());
/// predictor.set_learnt(Learnt::default())?; // forgotten
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Learnt {
    /// What the log score of every target is multiplied by: below 1 for users whose movements show less of where they go than the model
    /// has it. From .2 to 3; 1 for a new user.
    pub confidence: f64,
    /// How much is known of it: the inverse of the variance of its logarithm. From .001; 4 for a new user.
    pub precision: f64,
    /// From how many movements.
    pub movements: f64,
    /// How many samples a movement has, on average.
    pub samples: f64,
    /// What is added to the logarithm of the median time to the entry, [`Remaining::mean`](crate::Remaining::mean), from -3 to 3.
    pub mean: f64,
    /// The same for [`Remaining::low`](crate::Remaining::low).
    pub low: f64,
    /// The same for [`Remaining::high`](crate::Remaining::high).
    pub high: f64,
}

impl Default for Learnt {
    fn default() -> Self {
        Self::of([1.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }
}

/// What one movement teaches.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Lesson {
    /// `n`.
    pub samples: f64,
    /// How many of them the sums are over.
    pub used: f64,
    /// The sum for `G`.
    pub excess: f64,
    /// The sum for `C`.
    pub variance: f64,
    /// How many of them are known to be before the entry.
    pub timed: f64,
    /// How many of these enter after `mean`, `low` and `high`.
    pub later: [f64; 3],
}

impl Learnt {
    /// Takes in one movement.
    pub(crate) fn take(&mut self, lesson: &Lesson) {
        if lesson.used < 1.0 || !(lesson.excess + lesson.variance).is_finite() {
            return;
        }
        self.movements += 1.0;
        self.samples += (lesson.samples - self.samples) / self.movements;
        let weight = lesson.samples / self.samples;
        let once = weight.min(4.0);
        self.precision += once * lesson.variance / lesson.used;
        let step = once * (lesson.excess / lesson.used).clamp(-6.0, 6.0) / self.precision;
        self.confidence = (self.confidence.ln() - step).clamp(-1.5, 1.0).exp();
        if lesson.timed > 0.0 {
            let weight = weight.min(3.0);
            let [mean, low, high] = lesson.later.map(|later| later / lesson.timed);
            let tails = (0.1 + 4.0 / (self.movements + 4.0)) * weight;
            self.mean += (0.05 + 0.3 / self.movements) * weight * (mean - 0.5);
            self.low += tails * (low - 0.9);
            self.high += tails * (high - 0.1);
        }
        let mut numbers = self.numbers();
        numbers.iter_mut().zip(NUMBERS).for_each(|(x, (_, least, most))| *x = x.max(least).min(most));
        *self = Self::of(numbers);
    }

    /// All numbers.
    pub(crate) const fn numbers(&self) -> [f64; 7] {
        [self.confidence, self.precision, self.movements, self.samples, self.mean, self.low, self.high]
    }

    /// What [`Learnt::numbers`] returned.
    pub(crate) const fn of([confidence, precision, movements, samples, mean, low, high]: [f64; 7]) -> Self {
        Self { confidence, precision, movements, samples, mean, low, high }
    }

    /// Reads `{ confidence, precision?, movements?, samples?, mean?, low?, high? }`.
    pub(crate) fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&NUMBERS.map(|(key, ..)| key))?;
        let mut numbers = Self::default().numbers();
        for (k, (key, ..)) in NUMBERS.into_iter().enumerate() {
            if k == 0 || fields.optional(key).is_some() {
                numbers[k] = fields.float(key)?;
            }
        }
        Ok(Self::of(numbers))
    }

    /// Itself, if these numbers are legal.
    ///
    /// # Errors
    /// `not-finite`, `out-of-range`.
    pub(crate) fn check(self, at: &Path<'_>) -> Result<Self> {
        for (x, (key, least, most)) in self.numbers().into_iter().zip(NUMBERS) {
            let place = at.key(key);
            if !(least..=most).contains(&place.number(x)?) {
                let must = format!("must be from {} to {}", number(least), number(most));
                return Err(place.error(Code::OutOfRange, &must, x));
            }
        }
        Ok(self)
    }
}

impl Serialize for Learnt {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let entries = self.numbers().into_iter().zip(NUMBERS).map(|(x, (key, ..))| (key.into(), Value::Number(x)));
        Value::Map(entries.collect()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Learnt {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        let value = Value::deserialize(deserializer)?;
        let node = Node::root(&value, "learnt");
        Self::read(&node).and_then(|learnt| learnt.check(&Path::root("learnt"))).map_err(serde::de::Error::custom)
    }
}
