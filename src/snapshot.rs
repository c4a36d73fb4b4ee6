//! Snapshots: a predictor as plain data, versioned and sealed, from which what follows is identical to the bit.

use crate::error::{Code, Error, Result};
use crate::model::habits::Habits;
use crate::model::learnt::Learnt;
use crate::predictor::{Movement, Predictor};
use crate::scenario::Scenario;
use crate::value::{Node, Value, number};
use fnv::FnvHasher;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::hash::Hasher;
use std::sync::Arc;

/// The form of a snapshot. It changes whenever an older reader could misunderstand a newer snapshot.
const VERSION: f64 = 1.0;

/// A predictor at one moment: opaque, and of any serde format, JSON included. [`Predictor::snapshot`] writes it,
/// [`Predictor::restore`] reads it, and checks it then.
///
/// ```
/// use whither::{Arrival, Code, Destination, Motion, Observation, Predictor, Scenario, Snapshot};
/// let scenario = Scenario::builder(Motion::brownian(1, 1.0), Observation::deviation(0.1))
///     .arrival(Arrival::uniform(1.0, 2.0))
///     .destination(Destination::new("there", [5.0]).size(1.0))
///     .build()?;
/// let json = serde_json::to_string(&Predictor::new(&scenario).snapshot())?;
/// let damaged: Snapshot = serde_json::from_str(&json.replace("there", "where"))?;
/// assert_eq!(Predictor::restore(&damaged).unwrap_err().code(), Code::BadSnapshot);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot(pub(crate) Value);

impl Serialize for Snapshot {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Snapshot {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        Value::deserialize(deserializer).map(Self)
    }
}

impl Predictor {
    /// The predictor as it is: the scenario with the destinations as they are now, and the movement. What follows a restored one is
    /// identical to the bit.
    ///
    /// ```
    /// # use whither::{Arrival, Destination, Motion, Observation, Scenario};
    /// # let scenario = Scenario::builder(Motion::brownian(1, 1.0), Observation::deviation(0.1))
    /// #     .arrival(Arrival::uniform(1.0, 2.0))
    /// #     .destinations([Destination::new("a", [0.0]).size(1.0), Destination::new("b", [5.0]).size(1.0)])
    /// #     .build()
    /// #     .unwrap();
    /// let mut predictor = whither::Predictor::new(&scenario);
    /// predictor.observe(0.0, &[1.0]).unwrap();
    /// let json = serde_json::to_string(&predictor.snapshot()).unwrap();
    /// let mut restored = whither::Predictor::restore(&serde_json::from_str(&json).unwrap()).unwrap();
    /// predictor.observe(0.5, &[2.0]).unwrap();
    /// restored.observe(0.5, &[2.0]).unwrap();
    /// assert_eq!(predictor.probabilities(), restored.probabilities());
    /// ```
    #[must_use]
    pub fn snapshot(&self) -> Snapshot {
        let movement = self.movement.as_ref().map_or(Value::Null, Movement::save);
        let habits = if self.scenario.learning.is_some() { self.habits.save() } else { Value::Null };
        let scenario = self.scenario.to_value_with(&self.destinations);
        let mut body = Value::map([("scenario", scenario), ("habits", habits), ("movement", movement)]);
        if let Value::Map(entries) = &mut body {
            if self.learnt() != Learnt::default() {
                entries.push(("learnt".into(), Value::exact_numbers(&self.learnt().numbers())));
            }
            if self.lasting.iter().any(|number| *number != 0.0) {
                entries.push(("lasting".into(), Value::exact_numbers(&self.lasting)));
            }
        }
        let seal = seal(&body);
        Snapshot(Value::map([
            ("whither", Value::text("snapshot")),
            ("version", Value::Number(VERSION)),
            ("seal", seal),
            ("body", body),
        ]))
    }

    /// The predictor that [`Predictor::snapshot`] wrote.
    ///
    /// # Errors
    /// `bad-snapshot` where it is damaged, truncated, no snapshot at all, or from another version.
    pub fn restore(Snapshot(snapshot): &Snapshot) -> Result<Self> {
        let node = Node::root(snapshot, "snapshot");
        let bad = |path: String, message: String| Error::new(Code::BadSnapshot, path, message);
        let kind = node.get("whither").map(|kind| kind.value().clone());
        if kind != Some(Value::text("snapshot")) {
            return Err(bad(
                "snapshot".to_owned(),
                format!("must be what snapshot() returned, got {}", snapshot.quoted()),
            ));
        }
        match node.get("version").map(|version| version.value()) {
            Some(Value::Number(version)) if *version == VERSION => {}
            other => {
                let found = other.map_or_else(|| "nothing".to_owned(), Value::quoted);
                let message = format!("must be {}, the version that this build writes, got {found}", number(VERSION));
                return Err(bad("snapshot.version".to_owned(), message));
            }
        }
        let (Some(body), Some(given)) = (node.get("body"), node.get("seal")) else {
            return Err(bad("snapshot".to_owned(), "is truncated: it has no body or no seal".to_owned()));
        };
        if seal(body.value()) != *given.value() {
            return Err(bad("snapshot".to_owned(), "is damaged: its contents do not match its seal".to_owned()));
        }
        Self::read_body(&body).map_err(|error| bad(error.path().to_owned(), error.message().to_owned()))
    }

    fn read_body(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["scenario", "habits", "movement", "learnt", "lasting"])?;
        let scenario = Arc::new(Scenario::from_value(fields.required("scenario")?.value())?);
        let destinations = Arc::clone(&scenario.destinations);
        let load = |movement: Node<'_>| Movement::load(&movement, &scenario, &destinations);
        let movement = fields.optional("movement").map(load).transpose()?;
        let mut predictor = Self::with_movement(scenario, destinations, movement);
        if let Some(habits) = fields.optional("habits") {
            predictor.habits = Habits::load(&habits)?;
            predictor.apply_habits();
        }
        if let Some(learnt) = fields.optional("learnt") {
            let mut numbers = Learnt::default().numbers();
            let saved = learnt.exact_numbers(numbers.len())?;
            numbers.copy_from_slice(&saved);
            predictor.apply_learnt(Learnt::of(numbers));
        }
        if let Some(lasting) = fields.optional("lasting") {
            let saved = lasting.exact_numbers(predictor.lasting.len())?;
            predictor.lasting.copy_from_slice(&saved);
        }
        Ok(predictor)
    }
}

/// A checksum over everything in a snapshot's body.
fn seal(body: &Value) -> Value {
    let mut words = Vec::new();
    body.bits(&mut words);
    let mut hasher = FnvHasher::default();
    words.iter().for_each(|word| hasher.write(&word.to_le_bytes()));
    Value::Text(format!("{:016x}", hasher.finish()))
}
