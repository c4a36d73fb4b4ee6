//! One movement with the posterior after each sample, as far as the press, and what crossings are judged by.

use whither::Predictor;
use whither::internals::{Node, Value, track_scenario};
use whither::study::track::{Sample, Target, Track};

/// The direction of a movement is read from so long before a sample, or from the sample before it, in seconds.
const HEADING: f64 = 0.03;

/// Samples a second of a rest.
const RESTING: f64 = 60.0;

/// Where a target lies that was not the true one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The movement began on it.
    Origin,
    /// The movement goes over it.
    Path,
    Elsewhere,
}

impl Place {
    /// How the table calls them.
    pub const NAMES: [&str; 3] = ["of these the origin", "on the path", "elsewhere"];
}

/// What is known after one sample of one target.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Posterior probability.
    pub probability: f64,
    /// The way to the target's edge, in the px of the model.
    pub distance: f64,
    /// The cosine between the direction of the movement and that to the target's centre; 1 where there is neither.
    pub ahead: f64,
    /// Whether the pointer is on the target.
    pub over: bool,
    /// Whether the movement began on the target, and has not left it and turned back to it or half of the way.
    pub leaving: bool,
}

/// A movement until the press.
#[derive(Clone, Debug)]
pub struct Course {
    pub target: usize,
    pub times: Vec<f64>,
    /// Speed over the highest so far.
    pub speeds: Vec<f64>,
    /// The samples with which the pointer comes to its target for good, and with which it is pressed.
    pub entry: usize,
    pub press: usize,
    /// After each sample of each target.
    pub moments: Vec<Vec<Moment>>,
    places: Vec<Place>,
}

impl Course {
    /// Predicts a movement, only every n-th sample of it, the entry and the press; with `rest` after so many seconds at its first position.
    /// None where it does not come to its target from elsewhere.
    pub fn of(
        track: &Track,
        (scenario, extra): (&Value, &Value),
        every: usize,
        rest: f64,
    ) -> Result<Option<Self>, String> {
        let message = |error: whither::Error| error.to_string();
        let Some(entry) = track.approach().map(|samples| samples - 1) else { return Ok(None) };
        let truth = &track.targets[track.target];
        let press = track.samples.iter().rposition(|sample| truth.contains(&sample.position)).unwrap_or(entry);
        let kept: Vec<usize> = (0..=press).filter(|&k| k.is_multiple_of(every) || k == entry || k == press).collect();
        let mut predictor = Predictor::new(&track_scenario(track, scenario, extra).map_err(message)?);
        let first = &track.samples[0];
        for step in (1..=(rest * RESTING).round() as usize).rev() {
            let resting = Sample { time: first.time - step as f64 / RESTING, ..first.clone() };
            resting.observe(&mut predictor).map_err(message)?;
        }
        let px = pixel(scenario);
        let samples: Vec<&Sample> = kept.iter().map(|&k| &track.samples[k]).collect();
        let mut course = Self {
            target: track.target,
            times: samples.iter().map(|sample| sample.time).collect(),
            speeds: Vec::with_capacity(samples.len()),
            entry: kept.partition_point(|&k| k < entry),
            press: samples.len() - 1,
            moments: Vec::with_capacity(samples.len()),
            places: track.targets.iter().map(|target| place(target, &samples)).collect(),
        };
        let (mut fastest, mut farthest) = (0.0, 0.0);
        let mut left = vec![false; track.targets.len()];
        for (k, sample) in samples.iter().enumerate() {
            sample.observe(&mut predictor).map_err(message)?;
            let before = samples[..k].iter().rev().find(|other| sample.time - other.time >= HEADING - 1e-9);
            let before = before.unwrap_or(&samples[0]);
            let heading = minus(&sample.position, &before.position);
            let speed = length(&heading) / (sample.time - before.time).max(1e-9);
            fastest = f64::max(fastest, speed);
            course.speeds.push(if fastest > 0.0 { speed / fastest } else { 0.0 });
            let covered = length(&minus(&sample.position, &first.position));
            farthest = f64::max(farthest, covered);
            let probabilities = predictor.probabilities();
            let moments = track.targets.iter().enumerate().map(|(i, target)| {
                let over = target.contains(&sample.position);
                left[i] |= !over;
                let back = left[i] && (over || covered <= farthest / 2.0);
                let way = minus(&target.center, &sample.position);
                let lengths = length(&heading) * length(&way);
                Moment {
                    probability: probabilities[i],
                    distance: edge(&way, target) / px,
                    ahead: if lengths > 0.0 { dot(&heading, &way) / lengths } else { 1.0 },
                    over,
                    leaving: course.places[i] == Place::Origin && !back,
                }
            });
            course.moments.push(moments.collect());
        }
        Ok(Some(course))
    }

    /// Where a target lies.
    pub fn place(&self, target: usize) -> Place {
        self.places[target]
    }

    /// Seconds from a sample to the entry, and to the press.
    pub fn leads(&self, sample: usize) -> [f64; 2] {
        [self.entry, self.press].map(|event| self.times[event] - self.times[sample])
    }
}

/// How many units of length the model's px has: lengths of a scenario for something else are those of a pointer times this.
fn pixel(scenario: &Value) -> f64 {
    let root = Node::root(scenario, "");
    let core = root.get("pointing").and_then(|pointing| pointing.get("start")?.get("core")?.number().ok());
    core.map_or(1.0, |core| core / 8.0)
}

fn place(target: &Target, samples: &[&Sample]) -> Place {
    let mut over = samples.iter().map(|sample| target.contains(&sample.position));
    match (over.next(), over.any(|over| over)) {
        (Some(true), _) => Place::Origin,
        (_, true) => Place::Path,
        _ => Place::Elsewhere,
    }
}

fn minus(to: &[f64], from: &[f64]) -> Vec<f64> {
    to.iter().zip(from).map(|(a, b)| a - b).collect()
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

fn length(way: &[f64]) -> f64 {
    dot(way, way).sqrt()
}

/// The way to the edge of a box in the plane, or of a ball in space.
fn edge(way: &[f64], target: &Target) -> f64 {
    if way.len() == 3 {
        return (length(way) - target.size[0] / 2.0).max(0.0);
    }
    length(&way.iter().zip(&target.size).map(|(x, side)| (x.abs() - side / 2.0).max(0.0)).collect::<Vec<_>>())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
pub mod tests {
    use super::*;
    use crate::methods::Template;

    /// From one target through another to a third, back out of that and in again.
    pub fn track() -> Track {
        serde_json::from_str(
            r#"{"targets": [[0, 0, 40, 40], [100, 0, 40, 40], [300, 0, 40, 40], [0, 500, 40, 40]], "target": 2,
                "samples": [[0, 0, 0], [0.1, 60, 0], [0.2, 110, 0], [0.3, 200, 0], [0.4, 290, 0], [0.5, 330, 0], [0.6, 310, 0],
                            [0.7, 300, 0], [0.8, 400, 0]]}"#,
        )
        .unwrap()
    }

    /// Its course, with the probabilities of the samples in place of the predicted ones.
    pub fn course(probabilities: &[[f64; 4]]) -> Course {
        let template = Template::pointer().unwrap();
        let mut course = Course::of(&track(), (&template.scenario, &template.extra), 1, 0.0).unwrap().unwrap();
        for (moments, probabilities) in course.moments.iter_mut().zip(probabilities) {
            moments.iter_mut().zip(probabilities).for_each(|(moment, p)| moment.probability = *p);
        }
        course
    }

    #[test]
    fn the_press_is_the_last_sample_in_the_target_and_the_entry_the_beginning_of_that_visit() {
        let course = course(&[]);
        assert_eq!((course.entry, course.press, course.times.len()), (6, 7, 8));
        let [entry, press] = course.leads(3);
        assert!((entry - 0.3).abs() < 1e-12 && (press - 0.4).abs() < 1e-12);
        let places = [0, 1, 3].map(|i| course.place(i));
        assert_eq!(places, [Place::Origin, Place::Path, Place::Elsewhere]);
    }

    #[test]
    fn moments_have_the_way_the_direction_and_whether_the_origin_is_left() {
        let course = course(&[]);
        let at = |k: usize, i: usize| course.moments[k][i];
        assert_eq!([at(1, 2).distance, at(2, 1).distance, at(1, 0).distance], [220.0, 0.0, 40.0]);
        assert_eq!([at(1, 2).ahead, at(1, 0).ahead, at(0, 0).ahead], [1.0, -1.0, 1.0]);
        // the corner at (20, 480) from (60, 0)
        assert!((at(1, 3).distance - 480f64.hypot(40.0)).abs() < 1e-9);
        assert!(at(2, 1).over && !at(1, 1).over);
        assert!(at(1, 0).leaving && at(7, 0).leaving && !at(1, 1).leaving);
        let speeds = [1, 4, 7].map(|k| (1e9 * course.speeds[k]).round() / 1e9);
        assert_eq!(speeds, [1.0, 1.0, 0.111111111]);
    }

    #[test]
    fn every_other_sample_keeps_the_entry_and_the_press_and_a_rest_changes_the_posterior() {
        let template = Template::pointer().unwrap();
        let scenario = (&template.scenario, &template.extra);
        let of = |every: usize, rest: f64| Course::of(&track(), scenario, every, rest).unwrap().unwrap();
        let thinned = of(4, 0.0);
        assert_eq!((thinned.times.as_slice(), thinned.entry, thinned.press), (&[0.0, 0.4, 0.6, 0.7][..], 2, 3));
        let origin = |course: &Course| course.moments[0][0].probability;
        assert!(origin(&of(1, 1.0)) > 0.8 && origin(&of(1, 0.0)) < 0.5);
    }

    #[test]
    fn lengths_are_those_of_the_scenario_s_px() {
        let fitts: Value = serde_json::from_str(r#"{"pointing": {"start": {"core": 4}}}"#).unwrap();
        assert_eq!(
            [pixel(&fitts), pixel(&Template::pointer().unwrap().scenario), pixel(&Value::Null)],
            [0.5, 1.0, 1.0]
        );
        let ball = Target { center: vec![0.0; 3], size: vec![10.0; 3] };
        assert_eq!(edge(&[6.0, 0.0, 8.0], &ball), 5.0);
    }
}
