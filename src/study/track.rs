//! Recorded movements: `{"id", "user", "targets": [[x, y, w, h], ...], "target": k, "samples": [[t, x, y], ...]}`.

use crate::error::{Code, Error, Result};
use crate::scenario::Scenario;
use crate::value::{Node, Value, number, say};
use serde::{Deserialize, Deserializer};

/// One recorded movement towards one of several targets.
///
/// ```
/// use whither::study::track::Track;
/// let track: Track = serde_json::from_str(r#"{
///     "target": 1, "targets": [[0, 0, 40, 40], [100, 0, 40, 40]],
///     "samples": [[0, 50, 0], [1, 60, 0], [2, 90, 0], [3, 95, 0]]
/// }"#).unwrap();
/// assert_eq!(track.dimensions(), 2);
/// assert_eq!(track.approach(), Some(3)); // the third sample is the first in the target
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Its name.
    pub id: String,
    /// Who moved.
    pub user: String,
    /// What could have been the target.
    pub targets: Vec<Target>,
    /// Which one was.
    pub target: usize,
    /// When and where, in order of time.
    pub samples: Vec<Sample>,
}

/// A box in the plane, or a ball in space.
///
/// ```
/// use whither::study::track::Target;
/// let target = Target { center: vec![100.0, 0.0], size: vec![40.0, 20.0] };
/// assert!(target.contains(&[85.0, 5.0]) && !target.contains(&[85.0, 15.0]));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The centre.
    pub center: Vec<f64>,
    /// The sides of the box; the diameter of the ball, once for each axis.
    pub size: Vec<f64>,
}

/// One observation.
///
/// ```
/// use whither::study::track::{Sample, Track};
/// let track: Track = serde_json::from_str(r#"{
///     "target": 1, "targets": [[0, 0, 40, 40], [100, 0, 40, 40]],
///     "samples": [[0, 50, 0], [1, 60, 0], [2, 90, 0], [3, 95, 0]]
/// }"#).unwrap();
/// assert_eq!(track.samples[2], Sample { time: 2.0, position: vec![90.0, 0.0] });
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Seconds since any moment.
    pub time: f64,
    /// One number for each axis.
    pub position: Vec<f64>,
}

impl Track {
    /// Reads one track: in the plane `targets` are `[x, y, width, height]` about their centres and samples `[t, x, y]`, in
    /// space `[x, y, z, diameter]` and `[t, x, y, z]`.
    ///
    /// # Errors
    /// `unknown-key`, `missing-key`, `wrong-type`, `wrong-length`, `not-finite`; `out-of-range` for a target that is not in
    /// the list, a size that is not above 0 and an empty list; `time-not-increasing` where the time runs back.
    pub fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["id", "user", "targets", "target", "samples"])?;
        let text = |key: &'static str| fields.optional(key).map_or(Ok(String::new()), |t| t.text().map(str::to_owned));
        let list = fields.required("samples")?;
        let mut samples = Vec::with_capacity(list.items()?.len());
        for item in list.items()? {
            let numbers = item.vector(None)?;
            let sample = Sample {
                time: numbers.first().copied().unwrap_or(0.0),
                position: numbers[1.min(numbers.len())..].to_vec(),
            };
            check_sample(&sample, samples.last(), &item)?;
            samples.push(sample);
        }
        let Some(first) = samples.first() else {
            return Err(list.error(Code::OutOfRange, "must have at least one sample"));
        };
        let dimensions = first.position.len();
        let list = fields.required("targets")?;
        let targets = list.items()?.map(|item| Target::read(&item, dimensions)).collect::<Result<Vec<_>>>()?;
        if targets.is_empty() {
            return Err(list.error(Code::OutOfRange, "must have at least one target"));
        }
        let target = fields.required("target")?;
        let chosen = target.number()?;
        if chosen < 0.0 || chosen.fract() != 0.0 || chosen >= targets.len() as f64 {
            let must = say!("must be the place of one of the ", targets.len(), " targets, counted from 0");
            return Err(target.error(Code::OutOfRange, &must));
        }
        Ok(Self { id: text("id")?, user: text("user")?, targets, target: chosen as usize, samples })
    }

    /// Spatial dimensions.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.samples.first().map_or(0, |sample| sample.position.len())
    }

    /// How many samples the approach has: up to and with the last entry into the true target. None where the movement never
    /// enters it, or begins in it and never leaves.
    #[must_use]
    pub fn approach(&self) -> Option<usize> {
        let target = &self.targets[self.target];
        let mut entry = None;
        let mut inside = false;
        for (k, sample) in self.samples.iter().enumerate() {
            let now = target.contains(&sample.position);
            if now && !inside {
                entry = Some(k);
            }
            inside = now;
        }
        entry.filter(|&k| k > 0).map(|k| k + 1)
    }

    /// The scenario for this track: `template` with destinations made from the targets, each with the keys of `extra` (an
    /// object, or nothing). Their ids are their places.
    ///
    /// # Errors
    /// Those of the scenario.
    pub fn scenario(&self, template: &Value, extra: &Value) -> Result<Scenario> {
        let Value::Map(entries) = template else {
            return Err(Error::new(Code::WrongType, "", "a scenario must be an object"));
        };
        let mut entries: Vec<_> = entries.iter().filter(|(key, _)| key != "destinations").cloned().collect();
        let destinations = self.targets.iter().enumerate().map(|(i, target)| {
            let mut entries = vec![
                ("id".to_owned(), Value::Text(i.to_string())),
                ("center".to_owned(), Value::numbers(&target.center)),
                ("size".to_owned(), Value::numbers(&target.size)),
            ];
            if let Value::Map(extra) = extra {
                entries.extend(extra.iter().cloned());
            }
            Value::Map(entries)
        });
        entries.push(("destinations".to_owned(), Value::List(destinations.collect())));
        Scenario::from_value(&Value::Map(entries))
    }
}

fn check_sample(sample: &Sample, last: Option<&Sample>, item: &Node<'_>) -> Result<()> {
    let dimensions = sample.position.len();
    if !(2..=3).contains(&dimensions) {
        return Err(item.error(Code::WrongLength, "must be [t, x, y] or [t, x, y, z]"));
    }
    let Some(last) = last else { return Ok(()) };
    if last.position.len() != dimensions {
        return Err(item.error(Code::WrongLength, "must have as many numbers as the sample before"));
    }
    if sample.time < last.time {
        let must = say!("must not be before the sample at ", number(last.time));
        return Err(item.error(Code::TimeNotIncreasing, &must));
    }
    Ok(())
}

impl Target {
    fn read(node: &Node<'_>, dimensions: usize) -> Result<Self> {
        let numbers = node.vector(Some(4))?;
        let (center, size) = numbers.split_at(dimensions);
        if size.iter().any(|side| *side <= 0.0) {
            return Err(node.error(Code::OutOfRange, "must have sizes above 0"));
        }
        let size = if dimensions == 3 { vec![size[0]; 3] } else { size.to_vec() };
        Ok(Self { center: center.to_vec(), size })
    }

    /// Whether a position is in the box, or in the ball; the edge belongs to it.
    #[must_use]
    pub fn contains(&self, position: &[f64]) -> bool {
        if self.center.len() == 3 {
            return distance(&self.center, position) <= self.size[0] / 2.0;
        }
        self.center.iter().zip(position).zip(&self.size).all(|((c, x), side)| (x - c).abs() <= side / 2.0)
    }
}

/// The Euclidean distance.
#[must_use]
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

impl<'de> Deserialize<'de> for Track {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        let value = Value::deserialize(deserializer)?;
        Self::read(&Node::root(&value, "")).map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn read(text: &str) -> std::result::Result<Track, String> {
        serde_json::from_str(text).map_err(|error| error.to_string())
    }

    #[test]
    fn the_approach_ends_at_the_last_entry() {
        let track = read(
            r#"{"id": "a", "user": "u", "targets": [[0, 0, 10, 10], [100, 0, 20, 10]], "target": 1,
                "samples": [[0, 0, 0], [1, 50, 0], [2, 90, 5], [3, 120, 0], [4, 111, 0], [5, 110, 0], [6, 100, 0]]}"#,
        )
        .unwrap();
        // in at 2 (on the corner), out at 3, in again at 5
        assert_eq!(track.approach(), Some(6));
        assert_eq!(track.dimensions(), 2);
    }

    #[test]
    fn in_space_a_target_is_a_ball() {
        let track = read(
            r#"{"targets": [[0, 0, 0, 10]], "target": 0, "samples": [[0, 9, 9, 9], [1, 4, 4, 4], [2, 3, 4, 0], [3, 0, 0, 0]]}"#,
        )
        .unwrap();
        assert_eq!(track.approach(), Some(3), "(4, 4, 4) is in the box but not in the ball");
        assert_eq!(track.targets[0].size, [10.0; 3]);
    }

    #[test]
    fn a_movement_without_an_entry_has_no_approach() {
        let track = read(r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, 0, 0], [1, 0.5, 0]]}"#).unwrap();
        assert_eq!(track.approach(), None);
        let track = read(r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, 5, 0], [1, 3, 0]]}"#).unwrap();
        assert_eq!(track.approach(), None);
    }

    #[test]
    fn what_is_wrong_is_named() {
        let cases = [
            (r#"{"target": 0, "samples": [[0, 1, 2]]}"#, "targets: missing key \"targets\""),
            (r#"{"targets": [], "target": 0, "samples": [[0, 1, 2]]}"#, "targets: must have at least one target"),
            (r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": []}"#, "samples: must have at least one sample"),
            (
                r#"{"targets": [[0, 0, 2, 2]], "target": 1, "samples": [[0, 1, 2]]}"#,
                "target: must be the place of one of the 1 targets, counted from 0, got 1",
            ),
            (
                r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[1, 1, 2], [0.5, 1, 2]]}"#,
                "samples[1]: must not be before the sample at 1, got [0.5, 1, 2]",
            ),
            (
                r#"{"targets": [[0, 0, 2, 0]], "target": 0, "samples": [[1, 1, 2]]}"#,
                "targets[0]: must have sizes above 0",
            ),
            (
                r#"{"targets": [[0, 0, 2]], "target": 0, "samples": [[1, 1, 2]]}"#,
                "targets[0]: must have 4 numbers, has 3",
            ),
            (
                r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[1, "a", 2]]}"#,
                "samples[0][1]: must be a number",
            ),
            (r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[1, 1]]}"#, "samples[0]: must be [t, x, y]"),
            (
                r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[1, 1, 2], [2, 1, 2, 3]]}"#,
                "samples[1]: must have as many numbers as the sample before",
            ),
            (r#"{"target": 0, "samples": [[0, 1, 2]], "speed": 1}"#, "speed: unknown key \"speed\""),
        ];
        for (text, expected) in cases {
            let found = read(text).unwrap_err();
            assert!(found.starts_with(expected), "{found}");
        }
    }
}
