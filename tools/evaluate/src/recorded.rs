//! A line of a track file: a track whose targets are boxes, balls in space, or Gaussian endpoints.

use crate::variants;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use std::ops::Deref;
use whither::internals::{Node, Value, approach_to, data, scenario, track, track_scenario, track_target};
use whither::study::track::{Target, Track};
use whither::{Code, Scenario};

/// The squared Mahalanobis distance within which 95% of a Gaussian lie, in one, two and three dimensions.
const SQUARED_RADII: [f64; 3] = [3.841_458_820_694_124, 5.991_464_547_107_98, 7.814_727_903_251_179];

/// A track, and which of its targets are Gaussian. In the track such a target is the smallest box around its ellipse, which is what
/// predictors get that know boxes alone.
#[derive(Clone, Debug)]
pub struct Recorded {
    track: Track,
    /// One for each target.
    endpoints: Vec<Option<Endpoint>>,
}

/// The endpoint `N(mean, covariance)` of the first components of the state: positions, then velocities.
#[derive(Clone, Debug)]
struct Endpoint {
    mean: Vec<f64>,
    covariance: Vec<Vec<f64>>,
    /// The covariance of the position.
    position: Cholesky<f64, Dyn>,
}

impl Deref for Recorded {
    type Target = Track;
    fn deref(&self) -> &Track {
        &self.track
    }
}

impl From<Track> for Recorded {
    fn from(track: Track) -> Self {
        Self { endpoints: vec![None; track.targets.len()], track }
    }
}

impl Recorded {
    /// Reads one, with `margin` added to the sizes of boxes and balls.
    pub fn read(value: &Value, margin: f64) -> Result<Self, String> {
        let mut endpoints = Vec::new();
        let mut read = |node: &Node<'_>, dimensions: usize| {
            let endpoint =
                matches!(node.value(), Value::Map(_)).then(|| Endpoint::read(node, dimensions)).transpose()?;
            let mut target = match &endpoint {
                Some(endpoint) => endpoint.around(dimensions),
                None => track_target(node, dimensions)?,
            };
            if endpoint.is_none() {
                target.size.iter_mut().for_each(|side| *side += margin);
            }
            endpoints.push(endpoint);
            Ok(target)
        };
        let track = track(value, &mut read).map_err(|error| error.to_string())?;
        Ok(Self { track, endpoints })
    }

    /// The track, for what knows boxes alone; an error where a target is none.
    pub fn boxes(&self) -> Result<&Track, String> {
        match self.endpoints.iter().position(Option::is_some) {
            None => Ok(&self.track),
            Some(k) => {
                let why =
                    "an endpoint by mean and covariance is for the usual tables, --users, --every and --steps alone";
                Err(format!("targets[{k}]: {why}"))
            }
        }
    }

    /// The same targets and samples in other coordinates.
    pub fn try_map(&self, map: impl FnOnce(&Track) -> Result<Track, String>) -> Result<Self, String> {
        map(self.boxes()?).map(Self::from)
    }

    /// How many samples the approach has, as [`Track::approach`]: a Gaussian target is entered where the Mahalanobis distance of the
    /// position comes within that of 95% of the probability.
    pub fn approach(&self) -> Option<usize> {
        match &self.endpoints[self.track.target] {
            None => self.track.approach(),
            Some(endpoint) => approach_to(&self.track, &|position| endpoint.contains(position)),
        }
    }

    /// Every n-th sample of the approach and the entry, and how many they are; where nothing is entered every n-th of all, if `to_the_end`.
    pub fn every(&self, step: usize, to_the_end: bool) -> Option<(Self, usize)> {
        let samples = match self.approach() {
            Some(length) => variants::thin(&self.track.samples[..length], step),
            None if to_the_end => self.track.samples.iter().step_by(step).cloned().collect(),
            None => return None,
        };
        let length = samples.len();
        let track = Track { samples, ..self.track.clone() };
        Some((Self { track, endpoints: self.endpoints.clone() }, length))
    }

    /// The scenario `template` with the targets as its destinations, each box with the keys of `extra`. A Gaussian endpoint of the
    /// position alone gets the velocity on arrival that the boxes have.
    pub fn scenario(&self, template: &Value, extra: &Value) -> whither::Result<Scenario> {
        let boxes = track_scenario(&self.track, template, extra)?;
        if self.endpoints.iter().all(Option::is_none) {
            return Ok(boxes);
        }
        let mut complete = data(&boxes);
        if let Value::Map(entries) = &mut complete {
            for (key, value) in entries.iter_mut() {
                let Value::List(destinations) = value else { continue };
                if **key == *"destinations" {
                    destinations.iter_mut().zip(&self.endpoints).for_each(|(destination, endpoint)| {
                        if let Some(endpoint) = endpoint {
                            endpoint.replace(destination, self.track.dimensions());
                        }
                    });
                }
            }
        }
        scenario(&complete)
    }
}

impl Endpoint {
    fn read(node: &Node<'_>, dimensions: usize) -> whither::Result<Self> {
        let fields = node.fields(&["mean", "covariance"])?;
        let at = fields.required("mean")?;
        let mean = at.vector(None)?;
        if !(dimensions..=3 * dimensions).contains(&mean.len()) {
            let must = format!("must have {dimensions} to {} numbers, has {}", 3 * dimensions, mean.len());
            return Err(at.error(Code::WrongLength, &must));
        }
        let at = fields.required("covariance")?;
        let size = mean.len();
        if at.items()?.len() != size {
            return Err(at.error(Code::WrongLength, &format!("must have {size} rows, has {}", at.items()?.len())));
        }
        let covariance = at.items()?.map(|row| row.vector(Some(size))).collect::<whither::Result<Vec<_>>>()?;
        let block = |count: usize| DMatrix::from_fn(count, count, |row, column| covariance[row][column]);
        let symmetric = block(size) == block(size).transpose();
        let roots = [size, dimensions].map(|count| Cholesky::new(block(count)));
        let [Some(_), Some(position)] = roots.map(|root| root.filter(|_| symmetric)) else {
            return Err(at.error(Code::NotPositiveDefinite, "must be symmetric and positive definite"));
        };
        Ok(Self { mean, covariance, position })
    }

    /// The smallest box around the ellipse.
    fn around(&self, dimensions: usize) -> Target {
        let side = |axis: usize| 2.0 * (SQUARED_RADII[dimensions - 1] * self.covariance[axis][axis]).sqrt();
        Target { center: self.mean[..dimensions].to_vec(), size: (0..dimensions).map(side).collect() }
    }

    fn contains(&self, position: &[f64]) -> bool {
        let offset = DVector::from_iterator(position.len(), position.iter().zip(&self.mean).map(|(x, mean)| x - mean));
        offset.dot(&self.position.solve(&offset)) <= SQUARED_RADII[position.len() - 1]
    }

    /// Puts this endpoint in the place of a box.
    fn replace(&self, destination: &mut Value, dimensions: usize) {
        let Value::Map(entries) = destination else { return };
        let (mut mean, mut covariance) = (self.mean.clone(), self.covariance.clone());
        let of_velocity = entries.iter().find(|(key, _)| **key == *"endVelocity").map(|(_, value)| value.clone());
        if let (Some(Value::Number(deviation)), true) = (of_velocity, mean.len() == dimensions) {
            mean.resize(2 * dimensions, 0.0);
            covariance.iter_mut().for_each(|row| row.resize(2 * dimensions, 0.0));
            covariance.extend((dimensions..2 * dimensions).map(|axis| {
                (0..2 * dimensions).map(|other| if other == axis { deviation * deviation } else { 0.0 }).collect()
            }));
        }
        entries.retain(|(key, _)| !["center", "size", "endVelocity"].contains(&&**key));
        entries.push(("mean".into(), Value::numbers(&mean)));
        entries.push(("covariance".into(), Value::List(covariance.iter().map(Value::numbers).collect())));
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Recorded, String> {
        Recorded::read(&serde_json::from_str(text).unwrap(), 0.0)
    }

    #[test]
    fn a_gaussian_is_entered_at_its_ellipse_of_95_percent() {
        // the deviations are 1 along (1, 1) and 3 along (1, -1): the square of the radius is 5.99
        let track = |x: f64, y: f64| {
            read(&format!(
                r#"{{"targets": [{{"mean": [0, 0], "covariance": [[5, -4], [-4, 5]]}}], "target": 0,
                    "samples": [[0, 90, 90], [1, {x}, {y}], [2, 90, 90]]}}"#
            ))
            .unwrap()
        };
        let (along, across) = (2.44 / 2f64.sqrt(), 7.34 / 2f64.sqrt());
        assert_eq!(track(along, along).approach(), Some(2));
        assert_eq!(track(1.01 * along, 1.01 * along).approach(), None);
        assert_eq!(track(across, -across).approach(), Some(2));
        assert_eq!(track(1.01 * across, -1.01 * across).approach(), None);
        let [width, height] = track(0.0, 0.0).targets[0].size[..] else { panic!("a box") };
        assert!((width - 2.0 * (5.991_464_547_f64 * 5.0).sqrt()).abs() < 1e-8 && width == height);
    }

    #[test]
    fn along_a_line_targets_are_intervals_and_gaussians() {
        let track = read(
            r#"{"targets": [[0, 2], {"mean": [10], "covariance": [[4]]}], "target": 1,
                "samples": [[0, 3], [1, null], [2, 6], [3, 6.1], [4, 11]]}"#,
        )
        .unwrap();
        assert_eq!((track.dimensions(), track.approach()), (1, Some(4)), "10 - 1.96 * 2 = 6.08");
        assert_eq!(track.every(2, false).map(|(thin, length)| (thin.samples.len(), length)), Some((3, 3)));
        assert_eq!(track.targets[0], Target { center: vec![0.0], size: vec![2.0] });
    }

    #[test]
    fn an_endpoint_is_a_destination_with_the_velocity_that_boxes_have() {
        let track = read(
            r#"{"targets": [[0, 2], {"mean": [10], "covariance": [[4]]}, {"mean": [5, 1], "covariance": [[4, 0], [0, 2]]}],
                "target": 1, "samples": [[0, 3]]}"#,
        )
        .unwrap();
        let template = serde_json::from_str(
            r#"{"motion": {"type": "constantVelocity", "dimensions": 1, "noise": 1}, "observation": {"noise": 1},
                "arrival": {"type": "uniform", "from": 1, "to": 2}}"#,
        )
        .unwrap();
        let destinations = |extra: &str| {
            let scenario = track.scenario(&template, &serde_json::from_str(extra).unwrap()).unwrap();
            serde_json::to_value(&scenario).unwrap()["destinations"].clone()
        };
        let bare = destinations("{}");
        assert_eq!(bare[0]["size"], 2.0);
        assert_eq!((&bare[1]["mean"], bare[1]["id"].as_str()), (&serde_json::json!([10.0]), Some("1")));
        let moving = destinations(r#"{"endVelocity": 3, "prior": 2}"#);
        assert_eq!(moving[1]["covariance"], serde_json::json!([[4.0, 0.0], [0.0, 9.0]]));
        assert_eq!(moving[1]["prior"], 2.0);
        assert_eq!(moving[2]["covariance"], serde_json::json!([[4.0, 0.0], [0.0, 2.0]]), "it has one of its own");
    }

    #[test]
    fn what_is_wrong_is_named() {
        let cases = [
            (r#"{"mean": [1, 2]}"#, "targets[0].covariance: missing key \"covariance\""),
            (r#"{"mean": [1], "covariance": [[1]]}"#, "targets[0].mean: must have 2 to 6 numbers, has 1, got [1]"),
            (
                r#"{"mean": [1, 2], "covariance": [[1, 0]]}"#,
                "targets[0].covariance: must have 2 rows, has 1, got [[1, 0]]",
            ),
            (
                r#"{"mean": [1, 2], "covariance": [[1, 2], [2, 1]]}"#,
                "targets[0].covariance: must be symmetric and positive definite, got [[1, 2], [2, 1]]",
            ),
            (
                r#"{"mean": [1, 2], "covariance": [[1, 0.5], [0, 1]]}"#,
                "targets[0].covariance: must be symmetric and positive definite, got [[1, 0.5], [0, 1]]",
            ),
            (
                r#"{"mean": [1, 2], "covariance": [[1, 0], [0, 1]], "size": 3}"#,
                "targets[0].size: unknown key \"size\", expected one of \"mean\", \"covariance\"",
            ),
            ("[0, 0, 1]", "targets[0]: must have 4 numbers, has 3, got [0, 0, 1]"),
        ];
        for (target, expected) in cases {
            let line = format!(r#"{{"targets": [{target}], "target": 0, "samples": [[0, 1, 2]]}}"#);
            assert_eq!(read(&line).unwrap_err(), expected);
        }
        let found = read(r#"{"targets": [[1]], "target": 0, "samples": [[0, 1]]}"#).unwrap_err();
        assert_eq!(found, "targets[0]: must have 2 numbers, has 1, got [1]");
        let found = read(r#"{"targets": [[1, 2]], "target": 0, "samples": [[0]]}"#).unwrap_err();
        assert_eq!(found, "samples[0]: must be [t, x], [t, x, y] or [t, x, y, z], got [0]");
    }
}
