//! Learns the few constants of a scenario from recorded movements, for another device, unit or task.
//!
//! The constants are numbers of the scenario, named by their paths (`pointing.timeToGo.median`); each is searched as a factor
//! of what it is. For the pointing model they minimise the mean log loss over the samples of the approaches; for the papers'
//! methods they maximise the evidence `log p(y_2:k | y_1, D)` of the true destination (maximum likelihood). What was gained
//! is measured on tracks that were left out: of other users where there are at least two, else every second track.

use super::metrics::Score;
use super::track::{Track, extra};
use crate::error::{Code, Error, Result};
use crate::predictor::Predictor;
use crate::scenario::{Scenario, Setup};
use crate::value::{Node, Value, quote};
use cobyla::{RhoBeg, StopTols, minimize};
use std::cell::Cell;
use std::collections::BTreeSet;

/// Tracks that are needed for each constant.
pub const TRACKS_PER_CONSTANT: usize = 10;

/// No constant is moved by more than this factor.
const WIDEST: f64 = 20.0;

/// What a search may cost and what it looks for.
///
/// ```
/// use whither::study::fit::Options;
/// let noise = Options { constants: vec!["motion.noise".to_owned()], ..Options::default() };
/// assert_eq!(noise.evaluations, 60);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Paths of the constants; empty for the usual ones of the scenario's method.
    pub constants: Vec<String>,
    /// How often the tracks are run through, at most, for each of the two searches.
    pub evaluations: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { constants: Vec::new(), evaluations: 60 }
    }
}

/// How far a search has come; [`fit`] calls back with it.
///
/// ```
/// use whither::study::fit::Progress;
/// let mut half = |progress: Progress| progress.share < 0.5; // stops a search half-way
/// assert!(half(Progress { share: 0.1, loss: 2.0 }) && !half(Progress { share: 0.6, loss: 1.9 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// From 0 to 1.
    pub share: f64,
    /// The smallest mean loss so far, in nats.
    pub loss: f64,
}

/// What was learnt by [`fit`], and what it is worth.
///
/// ```
/// use whither::study::fit::Fitted;
/// let constants = vec![("motion.noise".to_owned(), 9.0, 3.1)];
/// let fitted = Fitted { constants, left_out: [2.1, 1.6], tracks: 60 };
/// let gain = fitted.left_out[0] - fitted.left_out[1]; // nats for each sample
/// assert!((gain - 0.5).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// Each constant: its path, what it was, what it is.
    pub constants: Vec<(String, f64, f64)>,
    /// Mean loss on the tracks left out, with the old constants and with ones learnt from the others.
    pub left_out: [f64; 2],
    /// How many tracks were used in all.
    pub tracks: usize,
}

/// Learns constants of `template`, for each track with the destinations of [`Track::scenario`]: the template with the new constants,
/// and what they are. `progress` is called after every pass over the tracks; false ends the search with the best so far, which is
/// of half of the tracks while the gain is still being measured.
///
/// # Errors
/// `out-of-range` with fewer than [`TRACKS_PER_CONSTANT`] usable tracks for each constant, and where a path is no number
/// above 0; those of the scenario.
///
/// ```
/// use whither::study::{fit::{Options, fit}, simulate::{Hand, Random}, track::Target};
/// use whither::{PointerOptions, PointerTarget, pointer_scenario};
/// let targets: Vec<Target> = [[100.0, 100.0], [500.0, 80.0], [300.0, 500.0]]
///     .map(|center| Target { center: center.to_vec(), size: vec![60.0, 60.0] })
///     .to_vec();
/// let mut random = Random::new(1);
/// let tracks: Vec<_> =
///     (0..20).map(|k| Hand::default().reach(&mut random, [300.0, 250.0], &targets, k % 3)).collect();
/// let any = PointerTarget { id: "any".to_owned(), x: 0.0, y: 0.0, width: 1.0, height: 1.0 };
/// let template = pointer_scenario(&[any], PointerOptions::default()).unwrap();
/// let options = Options { constants: vec!["pointing.power.to".to_owned()], evaluations: 8 };
/// let (scenario, fitted) = fit(&tracks, &template, &options, &mut |_| true).unwrap();
/// assert!(fitted.left_out[1] < fitted.left_out[0]);
/// assert_eq!(serde_json::to_value(&scenario).unwrap()["pointing"]["power"]["to"], fitted.constants[0].2);
/// ```
pub fn fit(
    tracks: &[Track],
    template: &Scenario,
    options: &Options,
    progress: &mut dyn FnMut(Progress) -> bool,
) -> Result<(Scenario, Fitted)> {
    let template = template.to_value();
    let (scenario, fitted) = fit_value(tracks, &template, &extra(&template), options, progress)?;
    Ok((Scenario::from_value(&scenario)?, fitted))
}

/// The same of data: the template may be without destinations, and each track's have the keys of `extra`.
pub(crate) fn fit_value(
    tracks: &[Track],
    template: &Value,
    extra: &Value,
    options: &Options,
    progress: &mut dyn FnMut(Progress) -> bool,
) -> Result<(Value, Fitted)> {
    let paths = if options.constants.is_empty() { usual(template)? } else { options.constants.clone() };
    let mut usable: Vec<&Track> = Vec::with_capacity(tracks.len());
    for (k, track) in tracks.iter().enumerate() {
        track.scenario_of(template, extra).map_err(|error| of_track(k, &error))?;
        if track.approach().is_some() {
            usable.push(track);
        }
    }
    let needed = TRACKS_PER_CONSTANT * paths.len();
    if usable.len() < needed {
        let message = format!(
            "must have at least {needed} tracks that enter their target, {TRACKS_PER_CONSTANT} for each of {} constants, has {}",
            paths.len(),
            usable.len()
        );
        return Err(Error::new(Code::OutOfRange, "tracks", message));
    }
    let before = paths.iter().map(|path| read(template, path)).collect::<Result<Vec<f64>>>()?;
    let search = Search { template, extra, paths: &paths, before: &before, evaluations: options.evaluations.max(1) };
    let users: BTreeSet<&str> = usable.iter().map(|track| track.user.as_str()).collect();
    let half = |k: usize, track: &Track| match users.len() {
        1 => k % 2,
        _ => users.iter().position(|user| *user == track.user).unwrap_or(0) % 2,
    };
    let side = |wanted: usize| -> Vec<&Track> {
        let mine = usable.iter().enumerate().filter(|(k, track)| half(*k, track) == wanted);
        mine.map(|(_, track)| *track).collect()
    };
    let (train, test) = (side(0), side(1));
    let mut stopped = false;
    let mut report = |state: Progress| {
        stopped |= !progress(state);
        !stopped
    };
    let partly = search.run(&train, [0.0, 1.0 / 3.0], &mut report)?;
    let ones = vec![1.0; paths.len()];
    let left_out = [search.loss(&test, &ones)?, search.loss(&test, &partly)?];
    let factors = if stopped { partly } else { search.run(&usable, [1.0 / 3.0, 1.0], progress)? };
    let constants =
        paths.iter().zip(&before).zip(&factors).map(|((path, was), factor)| (path.clone(), *was, was * factor));
    let fitted = Fitted { constants: constants.collect(), left_out, tracks: usable.len() };
    Ok((search.scenario(&factors)?, fitted))
}

/// An error of the scenario as the track numbered `k` makes it: what is wrong with its destinations is wrong with the track.
fn of_track(k: usize, error: &Error) -> Error {
    let path = match error.path().strip_prefix("destinations") {
        Some(rest) => format!("tracks[{k}].targets{rest}"),
        None => error.path().to_owned(),
    };
    Error::new(error.code(), path, error.message())
}

/// The constants that are usually worth learning.
fn usual(template: &Value) -> Result<Vec<String>> {
    let paths: &[&str] = match Node::root(template, "").get("method").as_ref().map(Node::text).transpose()? {
        Some("pointing") => &[
            "motion.noise",
            "pointing.alongNoise",
            "pointing.timeToGo.median",
            "pointing.direction.power",
            "pointing.power.to",
        ],
        Some("singleFilterApproximate") => {
            let message = "must not be \"singleFilterApproximate\": its likelihoods are known up to a factor only";
            return Err(Error::new(Code::OutOfRange, "method", message));
        }
        _ => &["motion.noise", "observation.noise"],
    };
    Ok(paths.iter().map(|path| (*path).to_owned()).collect())
}

fn read(template: &Value, path: &str) -> Result<f64> {
    let mut place = template;
    for key in path.split('.') {
        let next = match place {
            Value::Map(entries) => entries.iter().find(|(name, _)| **name == *key).map(|(_, value)| value),
            Value::List(items) => key.parse().ok().and_then(|i: usize| items.get(i)),
            _ => None,
        };
        place = next.unwrap_or(&Value::Null);
    }
    match place {
        Value::Number(x) if *x > 0.0 && x.is_finite() => Ok(*x),
        other => {
            let message = format!("{} must be a number above 0 to be learnt, got {}", quote(path), other.quoted());
            Err(Error::new(Code::OutOfRange, "constants", message))
        }
    }
}

fn write(place: &mut Value, path: &str, number: f64) {
    let (key, rest) = path.split_once('.').map_or((path, None), |(key, rest)| (key, Some(rest)));
    let next = match place {
        Value::Map(entries) => entries.iter_mut().find(|(name, _)| **name == *key).map(|(_, value)| value),
        Value::List(items) => key.parse().ok().and_then(|i: usize| items.get_mut(i)),
        _ => None,
    };
    match (next, rest) {
        (Some(next), Some(rest)) => write(next, rest, number),
        (Some(next), None) => *next = Value::Number(number),
        (None, _) => {}
    }
}

struct Search<'a> {
    template: &'a Value,
    extra: &'a Value,
    paths: &'a [String],
    before: &'a [f64],
    evaluations: usize,
}

impl Search<'_> {
    fn scenario(&self, factors: &[f64]) -> Result<Value> {
        let mut scenario = self.template.clone();
        for ((path, was), factor) in self.paths.iter().zip(self.before).zip(factors) {
            write(&mut scenario, path, was * factor);
        }
        Ok(scenario)
    }

    /// The mean loss over the samples of all approaches.
    fn loss(&self, tracks: &[&Track], factors: &[f64]) -> Result<f64> {
        let template = self.scenario(factors)?;
        let (mut loss, mut samples) = (0.0, 0.0);
        for track in tracks {
            let Some(approach) = track.approach() else { continue };
            let scenario = track.scenario_of(&template, self.extra)?;
            if matches!(scenario.setup, Setup::Pointing(_)) {
                let score = Score::of_scenario(track, approach, &scenario)?;
                loss += score.loss;
                samples += score.samples;
            } else {
                let mut predictor = Predictor::new(&scenario);
                for sample in &track.samples[..approach] {
                    sample.observe(&mut predictor)?;
                }
                let evidence = predictor.log_likelihoods()[track.target];
                loss -= if evidence.is_finite() { evidence } else { -1e6 };
                samples += approach as f64 - 1.0;
            }
        }
        Ok(loss / samples.max(1.0))
    }

    /// The factors that lose the least; `of` is where in the complete work this search begins and ends.
    fn run(&self, tracks: &[&Track], of: [f64; 2], progress: &mut dyn FnMut(Progress) -> bool) -> Result<Vec<f64>> {
        let best = Cell::new((f64::INFINITY, 0usize, false));
        let factors = std::cell::RefCell::new(vec![1.0; self.paths.len()]);
        let progress = std::cell::RefCell::new(progress);
        let failed = std::cell::RefCell::new(None);
        let objective = |logs: &[f64], _: &mut ()| -> f64 {
            let (lowest, count, stopped) = best.get();
            if stopped {
                return lowest + 1.0;
            }
            let tried: Vec<f64> = logs.iter().map(|log| log.exp()).collect();
            let loss = self.loss(tracks, &tried).unwrap_or_else(|error| {
                failed.replace(Some(error));
                f64::INFINITY
            });
            let lower = loss < lowest;
            if lower {
                factors.replace(tried);
            }
            let lowest = if lower { loss } else { lowest };
            let done = (count + 1) as f64 / self.evaluations as f64;
            let share = of[0] + (of[1] - of[0]) * done.min(1.0);
            let go_on = (progress.borrow_mut())(Progress { share, loss: lowest });
            best.set((lowest, count + 1, !go_on));
            if loss.is_finite() { loss } else { 1e9 }
        };
        let bounds = vec![(-WIDEST.ln(), WIDEST.ln()); self.paths.len()];
        let start = vec![0.0; self.paths.len()];
        let no_constraints: [fn(&[f64], &mut ()) -> f64; 0] = [];
        let stop = StopTols { ftol_rel: 1e-5, ..StopTols::default() };
        // However it ends, the best point that it passed is kept.
        let _ =
            minimize(objective, &start, &bounds, &no_constraints, (), self.evaluations, RhoBeg::All(0.3), Some(stop));
        if best.get().0.is_infinite()
            && let Some(error) = failed.into_inner()
        {
            return Err(error);
        }
        Ok(factors.into_inner())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::study::track::{Sample, Target};

    fn template(noise: f64) -> Value {
        serde_json::from_str(&format!(
            r#"{{"motion": {{"type": "brownian", "dimensions": 2, "noise": {noise}}}, "observation": {{"noise": 0.01}},
                "arrival": {{"type": "uniform", "from": 1, "to": 40}}}}"#
        ))
        .unwrap()
    }

    /// Brownian motion of deviation 3 for each root of a second, until it enters the target.
    fn walk(random: &mut Random, user: usize) -> Option<Track> {
        let targets = [30.0, -30.0].map(|x| Target { center: vec![x, 0.0], size: vec![40.0, 40.0] }).to_vec();
        let mut samples = vec![Sample { time: 0.0, position: vec![0.0, 0.0], missing: vec![] }];
        while samples.len() < 40 && !targets[0].contains(&samples[samples.len() - 1].position) {
            let last = &samples[samples.len() - 1];
            let position = last.position.iter().map(|x| x + 3.0 * random.normal()).collect();
            samples.push(Sample { time: last.time + 1.0, position, missing: vec![] });
        }
        let track = Track { id: String::new(), user: user.to_string(), targets, target: 0, samples };
        track.approach().is_some().then_some(track)
    }

    #[test]
    fn maximum_evidence_finds_the_noise_that_moved_it() {
        let mut random = Random::new(5);
        let tracks: Vec<Track> = (0..60).filter_map(|user| walk(&mut random, user % 4)).collect();
        let options = Options { constants: vec!["motion.noise".to_owned()], evaluations: 40 };
        let mut calls = 0;
        let (scenario, fitted) = fit_value(&tracks, &template(9.0), &Value::Null, &options, &mut |progress| {
            calls += 1;
            assert!(progress.share > 0.0 && progress.share <= 1.0);
            true
        })
        .unwrap();
        let (path, was, is) = &fitted.constants[0];
        assert_eq!((path.as_str(), *was), ("motion.noise", 9.0));
        assert!((*is - 3.0).abs() < 0.5, "{is}");
        assert!(fitted.left_out[1] < fitted.left_out[0], "{:?}", fitted.left_out);
        assert!(calls > 4);
        assert_eq!(read(&scenario, "motion.noise").unwrap(), *is);
    }

    #[test]
    fn too_few_tracks_are_refused_with_the_number_needed() {
        let mut random = Random::new(5);
        let tracks: Vec<Track> = (0..20).filter_map(|user| walk(&mut random, user)).take(7).collect();
        let error = fit_value(&tracks, &template(3.0), &Value::Null, &Options::default(), &mut |_| true).unwrap_err();
        let needed = "tracks: must have at least 20 tracks that enter their target, 10 for each of 2 constants";
        assert_eq!(error.to_string(), format!("{needed}, has 7"));
        let error = fit_value(&[], &template(3.0), &Value::Null, &Options::default(), &mut |_| true).unwrap_err();
        assert_eq!(error.to_string(), format!("{needed}, has 0"));
    }

    #[test]
    fn a_track_that_does_not_suit_the_scenario_is_named() {
        let mut random = Random::new(5);
        let mut tracks: Vec<Track> = (0..30).filter_map(|user| walk(&mut random, user)).collect();
        tracks[4].targets[1].size = vec![40.0, -1.0];
        let error = fit_value(&tracks, &template(3.0), &Value::Null, &Options::default(), &mut |_| true).unwrap_err();
        assert_eq!(error.path(), "tracks[4].targets[1].size[1]");
        let error = fit_value(&tracks, &Value::Null, &Value::Null, &Options::default(), &mut |_| true).unwrap_err();
        assert_eq!(error.to_string(), "a scenario must be an object");
    }

    #[test]
    fn what_is_no_constant_is_named_and_a_search_can_be_stopped() {
        let mut random = Random::new(5);
        let tracks: Vec<Track> = (0..60).filter_map(|user| walk(&mut random, user % 4)).collect();
        let options = Options { constants: vec!["motion.speed".to_owned()], ..Options::default() };
        let error = fit_value(&tracks, &template(3.0), &Value::Null, &options, &mut |_| true).unwrap_err();
        assert_eq!(error.to_string(), "constants: \"motion.speed\" must be a number above 0 to be learnt, got nothing");
        let options = Options { constants: vec!["motion.noise".to_owned()], evaluations: 40 };
        let mut calls = 0;
        let stop = &mut |_| {
            calls += 1;
            false
        };
        fit_value(&tracks, &template(9.0), &Value::Null, &options, stop).unwrap();
        assert_eq!(calls, 1, "no second search after the first was stopped");
    }
}
