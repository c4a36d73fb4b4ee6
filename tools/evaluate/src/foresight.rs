//! ForesightJS, run through its own package in Node on the same samples.

use crate::node::Node;
use crate::peers::least;
use serde_json::json;
use whither::study::track::{Track, distance};

/// Node processes that are waiting for a track.
#[derive(Debug)]
pub struct Foresight(Node);

impl Foresight {
    /// Tries it on one track of its own; the reason where it cannot run.
    pub fn start() -> Result<Self, String> {
        let foresight = Self(Node::new("foresight.mjs"));
        let track: Track = serde_json::from_str(r#"{"targets": [[0, 0, 1, 1]], "target": 0, "samples": [[0, 0, 0]]}"#)
            .map_err(|error| error.to_string())?;
        foresight.tops(&track, 1)?;
        Ok(foresight)
    }

    /// The target nearest to the point that the package predicts, after each of the first `length` samples.
    pub fn tops(&self, track: &Track, length: usize) -> Result<Vec<Option<usize>>, String> {
        let samples: Vec<[f64; 3]> =
            track.samples[..length].iter().map(|s| [s.time, s.position[0], s.position[1]]).collect();
        let installed = |error: String| format!("{error}; is js.foresight installed (npm ci)?");
        let answer = self.0.ask(&json!(samples)).map_err(installed)?;
        let points: Vec<[f64; 2]> = serde_json::from_value(answer).map_err(|error| error.to_string())?;
        if points.len() != length {
            return Err("its process gave too few points".to_owned());
        }
        Ok(points.iter().map(|point| least(track, |target| distance(&target.center, point))).collect())
    }
}
