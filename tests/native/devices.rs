//! Scenarios for rays and hands: units, the map of directions, none, the time to the entry, lost frames.

use crate::support::{golden, numbers, predictor, relative};
use serde_json::json;
use whither::{AngleUnit, RayMap, RayOptions, RayTarget, ray_scenario};
use whither::{Code, Predictor, Scenario};
use whither::{HandOptions, HandTarget, LengthUnit, hand_scenario};

/// A movement that brakes evenly towards the last of the places, in 60 samples a second.
fn reach<const D: usize>(from: [f64; D], to: [f64; D], seconds: f64) -> Vec<(f64, [f64; D])> {
    let count = (60.0 * seconds) as usize;
    let way = |k: usize| 1.0 - (1.0 - k as f64 / count as f64).powi(2);
    (0..=count).map(|k| (k as f64 / 60.0, std::array::from_fn(|j| from[j] + way(k) * (to[j] - from[j])))).collect()
}

fn lamps(unit: f64) -> Vec<RayTarget> {
    let place = |k: usize| [(k % 3) as f64 * 25.0 - 25.0, (k / 3) as f64 * 25.0 - 25.0];
    let target = |k: usize| RayTarget {
        id: k.to_string(),
        azimuth: unit * place(k)[0],
        elevation: unit * place(k)[1],
        width: unit * 5.0,
        height: unit * 4.0,
    };
    (0..9).map(target).collect()
}

fn icons(unit: f64) -> Vec<HandTarget> {
    let target = |k: usize| HandTarget {
        id: k.to_string(),
        x: unit * (40.0 + 60.0 * (k % 4) as f64),
        y: unit * (30.0 + 60.0 * (k / 4) as f64),
        z: 0.0,
        width: unit * 20.0,
        height: unit * 24.0,
        depth: unit * 10.0,
    };
    (0..12).map(target).collect()
}

/// All that is answered after each sample: probabilities, none and the time to the entry.
fn answers<const D: usize>(scenario: &Scenario, samples: &[(f64, [f64; D])]) -> Vec<Vec<f64>> {
    let mut predictor = Predictor::new(scenario);
    let answer = |(time, position): &(f64, [f64; D])| {
        predictor.observe(*time, position).unwrap();
        let mut all = predictor.probabilities().to_vec();
        all.push(predictor.none());
        all.extend(predictor.remaining().iter().flat_map(|r| [r.mean, r.low, r.high]));
        all
    };
    samples.iter().map(answer).collect()
}

fn same(found: &[Vec<f64>], expected: &[Vec<f64>]) {
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert_eq!(found.len(), expected.len());
        assert!(relative(found, expected) < 1e-9, "after {k}");
    }
}

#[test]
fn degrees_and_radians_have_the_same_answers() {
    let samples = reach([-4.0, -70.0], [25.0, 0.0], 0.6);
    let radian = 180.0 / std::f64::consts::PI;
    let turned: Vec<_> = samples.iter().map(|(time, place)| (*time, place.map(|x| x / radian))).collect();
    for noise in [None, Some(0.5)] {
        let options = RayOptions { none: 0.2, noise, ..RayOptions::default() };
        let degrees = answers(&ray_scenario(&lamps(1.0), options).unwrap(), &samples);
        let options = RayOptions { noise: noise.map(|noise| noise / radian), unit: AngleUnit::Radians, ..options };
        same(&answers(&ray_scenario(&lamps(1.0 / radian), options).unwrap(), &turned), &degrees);
        let last = degrees.last().unwrap();
        assert!(last[5] > 0.5, "{last:?}");
    }
}

#[test]
fn millimetres_and_metres_have_the_same_answers() {
    let samples = reach([150.0, 250.0, 350.0], [220.0, 90.0, 0.0], 0.7);
    let metric: Vec<_> = samples.iter().map(|(time, place)| (*time, place.map(|x| x / 1000.0))).collect();
    for noise in [None, Some(3.0)] {
        let options = HandOptions { none: 0.2, noise, ..HandOptions::default() };
        let millimetres = answers(&hand_scenario(&icons(1.0), options).unwrap(), &samples);
        let options = HandOptions { noise: noise.map(|noise| noise / 1000.0), unit: LengthUnit::Metres, ..options };
        same(&answers(&hand_scenario(&icons(0.001), options).unwrap(), &metric), &millimetres);
        let last = millimetres.last().unwrap();
        assert!(last[7] > 0.5, "{last:?}");
    }
}

#[test]
fn the_unit_of_length_changes_nothing_of_the_pointing_model() {
    for name in ["pointing-ring12", "pointing-sizes40", "pointing-none"] {
        let case = golden(name);
        let plain = &case["scenario"];
        for unit in [1e-3, 40.0] {
            let times = |value: &serde_json::Value| -> serde_json::Value {
                match value {
                    serde_json::Value::Array(items) => {
                        items.iter().map(|x| json!(unit * x.as_f64().unwrap())).collect()
                    }
                    number => json!(unit * number.as_f64().unwrap()),
                }
            };
            let mut scaled = plain.clone();
            for place in ["/motion/noise", "/observation/noise", "/initial/velocity", "/pointing/noise"]
                .into_iter()
                .chain(["/pointing/start/core", "/pointing/start/reach", "/pointing/direction/distance"])
            {
                let place = scaled.pointer_mut(place).unwrap();
                *place = times(place);
            }
            scaled["pointing"]["unit"] = json!(unit);
            for destination in scaled["destinations"].as_array_mut().unwrap() {
                (destination["center"], destination["size"]) =
                    (times(&destination["center"]), times(&destination["size"]));
            }
            let (mut one, mut other) = (predictor(plain), predictor(&scaled));
            for row in case["observations"].as_array().unwrap().iter().map(numbers) {
                one.observe(row[0], &row[1..]).unwrap();
                other.observe(row[0], &[unit * row[1], unit * row[2]]).unwrap();
                assert!(relative(other.probabilities(), one.probabilities()) < 1e-9, "{name}, {unit}");
                assert!((other.none() - one.none()).abs() < 1e-9, "{name}, {unit}");
            }
        }
    }
}

/// Directions and their places about the middle, in degrees: as in `tests/js/rays.test.mjs`.
#[test]
fn the_map_keeps_angles_from_its_middle() {
    let about = |middle, unit| RayMap::about(middle, unit).unwrap();
    let close = |found: [f64; 2], expected: [f64; 2]| {
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {expected:?}");
    };
    let ahead = about([0.0, 0.0, -3.0], AngleUnit::Degrees);
    for (direction, expected) in [
        ([0.0, 0.0, -1.0], [0.0, 0.0]),
        ([1.0, 0.0, -1.0], [45.0, 0.0]),
        ([0.0, -2.0, -2.0], [0.0, -45.0]),
        ([-1.0, 0.0, 0.0], [-90.0, 0.0]),
        ([0.0, 1.0, 0.0], [0.0, 90.0]),
        ([3.0, 4.0, 0.0], [54.0, 72.0]),
        ([0.0, 0.0, 1.0], [180.0, 0.0]),
        ([1e-200, 0.0, -1e-200], [45.0, 0.0]),
    ] {
        close(ahead.position(direction).unwrap(), expected);
    }
    let radians = about([0.0, 0.0, -1.0], AngleUnit::Radians);
    close(radians.position([0.0, 1.0, 0.0]).unwrap(), [0.0, std::f64::consts::FRAC_PI_2]);
    // to the right, and up: right is then backwards
    let right = about([1.0, 0.0, 0.0], AngleUnit::Degrees);
    close(right.position([0.0, 0.0, 1.0]).unwrap(), [90.0, 0.0]);
    close(right.position([1.0, 1.0, 0.0]).unwrap(), [0.0, 45.0]);
    for (middle, above) in [([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]), ([0.0, -1.0, 0.0], [0.0, 0.0, -1.0])] {
        let vertical = about(middle, AngleUnit::Degrees);
        close(vertical.position(middle).unwrap(), [0.0, 0.0]);
        close(vertical.position([1.0, 0.0, 0.0]).unwrap(), [90.0, 0.0]);
        close(vertical.position(above).unwrap(), [0.0, 90.0]);
    }
}

#[test]
fn a_direction_that_is_none_is_refused_by_name() {
    let shown = |error: whither::Error| (error.code(), error.to_string());
    let error = RayMap::about([0.0; 3], AngleUnit::Degrees).unwrap_err();
    assert_eq!(shown(error), (Code::OutOfRange, "middle: must have a direction, got [0, 0, 0]".to_owned()));
    let map = RayMap::about([1.0, 0.0, 0.0], AngleUnit::Degrees).unwrap();
    let error = map.position([0.0, f64::NAN, 0.0]).unwrap_err();
    assert_eq!(shown(error), (Code::NotFinite, "direction[1]: must be a finite number, got NaN".to_owned()));
}

#[test]
fn frames_that_a_tracker_loses_leave_what_it_found() {
    let samples = reach([150.0, 250.0, 350.0], [220.0, 90.0, 0.0], 0.7);
    let scenario = hand_scenario(&icons(1.0), HandOptions { noise: Some(2.0), ..HandOptions::default() }).unwrap();
    let mut predictor = Predictor::new(&scenario);
    for (k, (time, [x, y, z])) in samples[..30].iter().enumerate() {
        match k % 5 {
            // nothing found, and the depth alone
            2 => continue,
            3 => predictor.observe_with(*time, &[None, None, Some(*z)], None).unwrap(),
            _ => predictor.observe(*time, &[*x, *y, *z]).unwrap(),
        }
    }
    let complete = answers(&scenario, &samples[..30]);
    let best = predictor.best().unwrap();
    assert_eq!((best.id.as_str(), best.index), ("7", 7));
    assert!((best.probability - complete[29][7]).abs() < 0.1, "{} {}", best.probability, complete[29][7]);
}

#[test]
fn none_grows_where_no_target_is() {
    let scenario = |targets: &[HandTarget]| hand_scenario(targets, HandOptions { none: 0.2, ..HandOptions::default() });
    let samples = reach([150.0, 250.0, 350.0], [220.0, 90.0, 0.0], 0.7);
    let [all, some] = [12, 2].map(|count| answers(&scenario(&icons(1.0)[..count]).unwrap(), &samples[..32]));
    let [with, without] = [&all[31], &some[31]].map(|all| all[all.len() - 4]);
    assert!(with < 0.1 && without > 0.3, "{with} {without}");
    let rays = reach([-4.0, -70.0], [25.0, 0.0], 0.6);
    let scenario = |lamps: &[RayTarget]| ray_scenario(lamps, RayOptions { none: 0.2, ..RayOptions::default() });
    let [all, some] = [9, 2].map(|count| answers(&scenario(&lamps(1.0)[..count]).unwrap(), &rays[..30]));
    let [with, without] = [&all[29], &some[29]].map(|all| all[all.len() - 4]);
    assert!(with < 0.1 && without > 0.3, "{with} {without}");
}
