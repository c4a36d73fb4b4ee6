//! Recorded movements: `{"id", "user", "targets": [[x, y, w, h], ...], "target": k, "samples": [[t, x, y], ...]}`.

use crate::error::{Code, Error, Result};
use crate::predictor::Predictor;
use crate::scenario::Scenario;
use crate::value::{Node, Value, number};
use serde::{Deserialize, Deserializer};
use std::ops::RangeInclusive;

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
/// assert_eq!(track.samples[2], Sample { time: 2.0, position: vec![90.0, 0.0], missing: vec![] });
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Seconds since any moment.
    pub time: f64,
    /// One number for each axis; for one that is missing the number before it, at the start of a track the one after it.
    pub position: Vec<f64>,
    /// The axes that are missing.
    pub missing: Vec<usize>,
}

impl Sample {
    /// Has a predictor observe this sample.
    ///
    /// # Errors
    /// Those of [`Predictor::observe_with`].
    ///
    /// ```
    /// use whither::{Predictor, Scenario, study::track::Sample};
    /// let scenario: Scenario = serde_json::from_str(r#"{
    ///     "motion": { "type": "brownian", "dimensions": 2, "noise": 1 }, "observation": { "noise": 1 },
    ///     "arrival": { "type": "uniform", "from": 1, "to": 5 },
    ///     "destinations": [{ "id": "a", "center": [0, 0], "size": 1 }, { "id": "b", "center": [9, 0], "size": 1 }]
    /// }"#).unwrap();
    /// let [mut sampled, mut observing] = [(); 2].map(|()| Predictor::new(&scenario));
    /// for predictor in [&mut sampled, &mut observing] {
    ///     Sample { time: 0.0, position: vec![4.0, 0.0], missing: vec![] }.observe(predictor).unwrap();
    /// }
    /// Sample { time: 1.0, position: vec![4.0, 7.0], missing: vec![1] }.observe(&mut sampled).unwrap();
    /// observing.observe_with(1.0, &[Some(4.0), None], None).unwrap();
    /// assert_eq!(sampled.probabilities(), observing.probabilities());
    /// ```
    pub fn observe(&self, predictor: &mut Predictor) -> Result<()> {
        if self.missing.is_empty() {
            return predictor.observe(self.time, &self.position);
        }
        let observed = |(axis, x): (usize, &f64)| (!self.missing.contains(&axis)).then_some(*x);
        let position: Vec<Option<f64>> = self.position.iter().enumerate().map(observed).collect();
        predictor.observe_with(self.time, &position, None)
    }
}

impl Track {
    /// Reads one track: in the plane `targets` are `[x, y, width, height]` about their centres and samples `[t, x, y]`, in
    /// space `[x, y, z, diameter]` and `[t, x, y, z]`. A coordinate of a sample that is null is missing. Numbers as `id` and
    /// `user` are read as text.
    ///
    /// # Errors
    /// `unknown-key`, `missing-key`, `wrong-type`, `wrong-length`, `not-finite`; `out-of-range` for a target that is not in
    /// the list, a size that is not above 0 and an empty list; `time-not-increasing` where the time runs back.
    pub(crate) fn read(node: &Node<'_>) -> Result<Self> {
        Self::read_with(node, 2..=3, &mut Target::read)
    }

    /// The same with so many dimensions, and each target read by `target` from its data and their number.
    ///
    /// # Errors
    /// As [`Track::read`], and those of `target`.
    pub(crate) fn read_with(
        node: &Node<'_>,
        dimensions: RangeInclusive<usize>,
        target: &mut dyn FnMut(&Node<'_>, usize) -> Result<Target>,
    ) -> Result<Self> {
        let fields = node.fields(&["id", "user", "targets", "target", "samples"])?;
        let text = |key: &'static str| fields.optional(key).map_or(Ok(String::new()), |node| name(&node));
        let samples = read_samples(&fields.required("samples")?, &dimensions)?;
        let dimensions = samples[0].position.len();
        let list = fields.required("targets")?;
        let targets = list.items()?.map(|item| target(&item, dimensions)).collect::<Result<Vec<_>>>()?;
        if targets.is_empty() {
            return Err(list.error(Code::OutOfRange, "must have at least one target"));
        }
        let target = fields.required("target")?;
        let chosen = target.number()?;
        if chosen < 0.0 || chosen.fract() != 0.0 || chosen >= targets.len() as f64 {
            let must = format!("must be the place of one of the {} targets, counted from 0", targets.len());
            return Err(target.error(Code::OutOfRange, &must));
        }
        Ok(Self { id: text("id")?, user: text("user")?, targets, target: chosen as usize, samples })
    }

    /// Spatial dimensions.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.samples.first().map_or(0, |sample| sample.position.len())
    }

    /// How many samples the approach has: up to and with the last entry into the true target, as far as samples with all their
    /// coordinates show. None where the movement never
    /// enters it, or begins in it and stays.
    #[must_use]
    pub fn approach(&self) -> Option<usize> {
        let target = &self.targets[self.target];
        self.approach_to(&|position| target.contains(position))
    }

    /// The same for a target that holds the positions for which `contains` is true.
    pub(crate) fn approach_to(&self, contains: &dyn Fn(&[f64]) -> bool) -> Option<usize> {
        let mut entry = None;
        let mut inside = false;
        for (k, sample) in self.samples.iter().enumerate().filter(|(_, sample)| sample.missing.is_empty()) {
            let now = contains(&sample.position);
            if now && !inside {
                entry = Some(k);
            }
            inside = now;
        }
        entry.filter(|&k| k > 0).map(|k| k + 1)
    }

    /// The scenario for this track: `template` with the targets as its destinations, each with the arrival prior and the end
    /// velocity of the template's first one. Their ids are their places.
    ///
    /// # Errors
    /// Those of the scenario.
    pub fn scenario(&self, template: &Scenario) -> Result<Scenario> {
        let template = template.to_value();
        self.scenario_of(&template, &extra(&template))
    }

    /// The same of data: each destination has the keys of `extra`, an object or nothing.
    pub(crate) fn scenario_of(&self, template: &Value, extra: &Value) -> Result<Scenario> {
        let Value::Map(entries) = template else {
            return Err(Error::new(Code::WrongType, "", "a scenario must be an object"));
        };
        let mut entries: Vec<_> = entries.iter().filter(|(key, _)| **key != *"destinations").cloned().collect();
        let destinations = self.targets.iter().enumerate().map(|(i, target)| {
            let mut entries = vec![
                ("id".into(), Value::Text(i.to_string())),
                ("center".into(), Value::numbers(&target.center)),
                ("size".into(), Value::numbers(&target.size)),
            ];
            if let Value::Map(extra) = extra {
                entries.extend(extra.iter().cloned());
            }
            Value::Map(entries)
        });
        entries.push(("destinations".into(), Value::List(destinations.collect())));
        Scenario::from_value(&Value::Map(entries))
    }
}

/// What the first destination of a scenario has that a target does not change.
pub(super) fn extra(template: &Value) -> Value {
    let root = Node::root(template, "");
    let destinations = root.get("destinations");
    if let Some(Value::List(list)) = destinations.as_ref().map(|list| list.value())
        && let Some(Value::Map(first)) = list.first()
    {
        let kept = first.iter().filter(|(key, _)| ["arrival", "endVelocity"].contains(&&**key));
        return Value::Map(kept.cloned().collect());
    }
    Value::Null
}

/// A text, or a number as one.
fn name(node: &Node<'_>) -> Result<String> {
    match node.value() {
        Value::Number(x) => Ok(number(*x)),
        _ => node.text().map(str::to_owned),
    }
}

/// All samples, at least one; coordinates that are missing repeat their neighbours.
fn read_samples(list: &Node<'_>, dimensions: &RangeInclusive<usize>) -> Result<Vec<Sample>> {
    let mut samples: Vec<Sample> = Vec::with_capacity(list.items()?.len());
    for item in list.items()? {
        let sample = read_sample(&item)?;
        check_sample(&sample, samples.last(), dimensions, &item)?;
        samples.push(sample);
    }
    let Some(first) = samples.first() else {
        return Err(list.error(Code::OutOfRange, "must have at least one sample"));
    };
    for axis in 0..first.position.len() {
        let observed = samples.iter().find(|sample| !sample.missing.contains(&axis));
        let Some(mut last) = observed.map(|sample| sample.position[axis]) else {
            return Err(list.error(Code::OutOfRange, &format!("must have a number at least once for axis {axis}")));
        };
        for sample in &mut samples {
            if sample.missing.contains(&axis) {
                sample.position[axis] = last;
            }
            last = sample.position[axis];
        }
    }
    Ok(samples)
}

fn read_sample(item: &Node<'_>) -> Result<Sample> {
    let mut numbers = Vec::new();
    let mut missing = Vec::new();
    for (i, number) in item.items()?.enumerate() {
        if i > 0 && *number.value() == Value::Null {
            missing.push(i - 1);
            numbers.push(0.0);
        } else {
            numbers.push(number.number()?);
        }
    }
    let time = numbers.first().copied().unwrap_or(0.0);
    Ok(Sample { time, position: numbers.split_off(1.min(numbers.len())), missing })
}

fn check_sample(
    sample: &Sample,
    last: Option<&Sample>,
    dimensions: &RangeInclusive<usize>,
    item: &Node<'_>,
) -> Result<()> {
    if !dimensions.contains(&sample.position.len()) {
        let one = if dimensions.contains(&1) { "[t, x], " } else { "" };
        return Err(item.error(Code::WrongLength, &format!("must be {one}[t, x, y] or [t, x, y, z]")));
    }
    let Some(last) = last else { return Ok(()) };
    if last.position.len() != sample.position.len() {
        return Err(item.error(Code::WrongLength, "must have as many numbers as the sample before"));
    }
    if sample.time < last.time {
        let must = format!("must not be before the sample at {}", number(last.time));
        return Err(item.error(Code::TimeNotIncreasing, &must));
    }
    Ok(())
}

impl Target {
    /// Reads `[x, width]`, `[x, y, width, height]` or `[x, y, z, diameter]`.
    ///
    /// # Errors
    /// `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`.
    pub(crate) fn read(node: &Node<'_>, dimensions: usize) -> Result<Self> {
        let numbers = node.vector(Some(if dimensions == 1 { 2 } else { 4 }))?;
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
    fn numbers_are_names_too() {
        let track =
            read(r#"{"id": 7, "user": 2.5, "targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, 5, 0]]}"#).unwrap();
        assert_eq!((track.id.as_str(), track.user.as_str()), ("7", "2.5"));
    }

    #[test]
    fn a_missing_coordinate_is_the_one_beside_it_and_no_entry() {
        let track = read(
            r#"{"targets": [[100, 0, 20, 10]], "target": 0, "samples": [
                [0, null, 0], [1, 50, null], [2, 95, null], [3, null, 30], [4, 100, 0], [5, null, null], [6, 101, 0]]}"#,
        )
        .unwrap();
        let positions: Vec<_> = track.samples.iter().map(|sample| sample.position.as_slice()).collect();
        assert_eq!(positions[..4], [[50.0, 0.0], [50.0, 0.0], [95.0, 0.0], [95.0, 30.0]]);
        let missing: Vec<_> = track.samples.iter().map(|sample| sample.missing.as_slice()).collect();
        assert_eq!(missing, [&[0][..], &[1], &[1], &[0], &[], &[0, 1], &[]]);
        // whether it was inside at 2 is not known, and at 5 it need not have left
        assert_eq!(track.approach(), Some(5));
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
            (
                r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[null, 1, 2]]}"#,
                "samples[0][0]: must be a number",
            ),
            (
                r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, 1, null], [1, 1, null]]}"#,
                "samples: must have a number at least once for axis 1",
            ),
            (r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[null]]}"#, "samples[0][0]: must be a number"),
            (r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, null]]}"#, "samples[0]: must be [t, x, y]"),
            (
                r#"{"user": true, "targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, 1, 2]]}"#,
                "user: must be a string",
            ),
            (r#"{"target": 0, "samples": [[0, 1, 2]], "speed": 1}"#, "speed: unknown key \"speed\""),
        ];
        for (text, expected) in cases {
            let found = read(text).unwrap_err();
            assert!(found.starts_with(expected), "{found}");
        }
    }
}
