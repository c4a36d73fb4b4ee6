//! What a predictor with the method `pointing` learns of its user from the outcomes of movements.

use crate::support::{change, predictor, relative};
use serde_json::{Value as Json, json};
use whither::internals::data;
use whither::{Code, Destination, Learnt, PointerOptions, PointerTarget, Predictor, Snapshot, pointer_scenario};

/// Five icons of 60 in a row, 200 apart, that choices leave equally likely; no probability is spread over all of them alike.
fn row(changes: &Json) -> Predictor {
    let icon = |i: u32| PointerTarget {
        id: format!("icon {i}"),
        x: 200.0 * f64::from(i),
        y: 300.0,
        width: 60.0,
        height: 60.0,
    };
    let icons: Vec<_> = (0..5).map(icon).collect();
    let scenario = data(&pointer_scenario(&icons, PointerOptions::default()).unwrap());
    let plain = json!({ "/learning": { "strength": 1e50 }, "/pointing/uniform": 0 });
    let scenario = serde_json::to_value(&scenario).unwrap();
    predictor(&change(&change(&scenario, &plain), changes))
}

/// A movement of minimum jerk along the row in `count` steps of 16 ms, with a hook at its beginning.
fn movement(from: f64, to: f64, count: u32) -> Vec<(f64, [f64; 2])> {
    let at = |k: u32| {
        let u = f64::from(k) / f64::from(count);
        let way = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
        (0.016 * f64::from(k), [from + way * (to - from), 300.0 + 40.0 * (6.3 * u).sin()])
    };
    (0..=count).map(at).collect()
}

fn observe(predictor: &mut Predictor, samples: &[(f64, [f64; 2])]) {
    predictor.reset();
    samples.iter().for_each(|(time, place)| predictor.observe(*time, place).unwrap());
}

/// How many samples there are before the last entry into an icon.
fn entry(samples: &[(f64, [f64; 2])], icon: usize) -> usize {
    let outside = |place: &[f64; 2]| (place[0] - 200.0 * icon as f64).abs().max((place[1] - 300.0).abs()) > 30.0;
    samples.iter().rposition(|(_, place)| outside(place)).unwrap() + 1
}

/// The rule of `model::learnt`, from what the public interface answers. Of movements of at most eight samples all are used.
struct Reference {
    known: Learnt,
    samples: Vec<f64>,
}

impl Reference {
    fn take(&mut self, chosen: usize, movement: &[(f64, [f64; 2])]) {
        let n = entry(movement, chosen);
        let (mut excess, mut variance, mut later) = (0.0, 0.0, [0.0; 3]);
        let mut alone = row(&json!({}));
        alone.set_learnt(self.known).unwrap();
        alone.observe(movement[0].0, &movement[0].1).unwrap();
        for (k, (time, place)) in movement.iter().enumerate().take(n + 1).skip(1) {
            alone.observe(*time, place).unwrap();
            let q = alone.probabilities().to_vec();
            let mean: f64 = q.iter().map(|q| q * q.ln()).sum();
            excess += mean - q[chosen].ln();
            variance += q.iter().map(|q| q * (q.ln() - mean).powi(2)).sum::<f64>();
            let remaining = alone.remaining().filter(|_| k < n).into_iter();
            let ends = remaining.flat_map(|r| [r.mean, r.low, r.high]);
            for (later, end) in later.iter_mut().zip(ends) {
                *later += f64::from(u8::from(movement[n].0 - time > end));
            }
        }
        let used = n as f64;
        self.samples.push(n as f64);
        let m = self.samples.len() as f64;
        let weight = n as f64 / (self.samples.iter().sum::<f64>() / m);
        let Learnt { confidence, precision, mean, low, high, .. } = &mut self.known;
        *precision += weight.min(4.0) * variance / used;
        let b = confidence.ln() - weight.min(4.0) * (excess / used).clamp(-6.0, 6.0) / *precision;
        *confidence = b.clamp(-1.5, 1.0).exp();
        let [above_mean, above_low, above_high] = later.map(|sum| sum / (used - 1.0));
        let (middle, tails) = ((0.05 + 0.3 / m) * weight.min(3.0), (0.1 + 4.0 / (m + 4.0)) * weight.min(3.0));
        *mean += middle * (above_mean - 0.5);
        *low += tails * (0.1 - (1.0 - above_low));
        *high += tails * (above_high - 0.1);
        (self.known.movements, self.known.samples) = (m, self.samples.iter().sum::<f64>() / m);
    }
}

fn numbers(learnt: Learnt) -> Vec<f64> {
    let Learnt { confidence, precision, movements, samples, mean, low, high } = learnt;
    vec![confidence, precision, movements, samples, mean, low, high]
}

#[test]
fn outcomes_teach_by_the_rule() {
    let mut predictor = row(&json!({}));
    let mut reference = Reference { known: Learnt::default(), samples: Vec::new() };
    for (from, chosen, count) in [(0.0, 4, 9), (800.0, 1, 8), (0.0, 2, 7), (800.0, 3, 9)] {
        let way = movement(from, 200.0 * chosen as f64, count);
        assert!(entry(&way, chosen) <= 8, "the reference uses all samples");
        observe(&mut predictor, &way);
        predictor.chosen(&format!("icon {chosen}")).unwrap();
        reference.take(chosen, &way);
        let (found, expected) = (numbers(predictor.learnt()), numbers(reference.known));
        assert!(relative(&found, &expected) < 1e-12, "{found:?} {expected:?}");
    }
    assert!((predictor.learnt().confidence - 1.0).abs() > 0.01 && predictor.learnt().mean != 0.0);
}

#[test]
fn the_log_scores_are_multiplied_from_the_second_sample_on() {
    let wide = json!({ "size": [90, 40], "center": [400, 0], "id": "icon 2", "prior": 3 });
    // one sample of 1e30 px leaves the range of the fast path
    for (changes, far) in [(json!({}), 0.0), (json!({ "/destinations/2": wide, "/none": 0.2 }), 0.0), (json!({}), 1e30)]
    {
        let mut plain = row(&changes);
        let mut tempered = row(&changes);
        tempered.set_learnt(Learnt { confidence: 0.6, ..Learnt::default() }).unwrap();
        let mut way = movement(0.0, 600.0, 12);
        way[9].1[1] += far;
        plain.reset();
        tempered.reset();
        for (k, (time, place)) in way.iter().enumerate() {
            let power = if k > 0 { 0.6 } else { 1.0 };
            let [mut p, q] = [&mut plain, &mut tempered].map(|predictor| {
                predictor.observe(*time, place).unwrap();
                let mut all = predictor.probabilities().to_vec();
                all.push(predictor.none());
                all
            });
            // a tenth of "none" stays at its prior
            let none = p[5];
            if none > 0.0 && k > 0 {
                p[5] = (none - 0.02) / 0.9;
                p[..5].iter_mut().for_each(|p| *p *= (1.0 - (none - 0.02) / 0.9) / (1.0 - none));
            }
            let mut expected: Vec<f64> = p.iter().map(|p| p.powf(power)).collect();
            let total: f64 = expected.iter().sum();
            expected.iter_mut().for_each(|p| *p /= total);
            if none > 0.0 && k > 0 {
                let kept = 0.9 * expected[5] + 0.02;
                expected[..5].iter_mut().for_each(|q| *q *= (1.0 - kept) / (1.0 - (kept - 0.02) / 0.9));
                expected[5] = kept;
            }
            assert!(relative(&q, &expected) < 1e-9, "{k}: {q:?} {expected:?}");
        }
        let scaled: Vec<f64> = plain.log_likelihoods().iter().map(|l| 0.6 * l).collect();
        assert!(relative(tempered.log_likelihoods(), &scaled) < 1e-12);
    }
}

#[test]
fn a_movement_teaches_once_and_only_with_learning() {
    let way = movement(0.0, 800.0, 40);
    let mut predictor = row(&json!({}));
    predictor.chosen("icon 4").unwrap(); // before any movement
    observe(&mut predictor, &way[..1]);
    predictor.chosen("icon 4").unwrap(); // one sample
    assert_eq!(predictor.learnt(), Learnt::default());
    observe(&mut predictor, &way);
    predictor.chosen("icon 4").unwrap();
    let once = predictor.learnt();
    assert_eq!(once.movements, 1.0);
    predictor.chosen("icon 4").unwrap();
    predictor.observe(5.0, &[500.0, 300.0]).unwrap();
    predictor.observe(5.1, &[600.0, 300.0]).unwrap();
    predictor.chosen("icon 3").unwrap();
    assert_eq!(predictor.learnt(), once);
    observe(&mut predictor, &way);
    predictor.chosen("icon 4").unwrap();
    assert_eq!(predictor.learnt().movements, 2.0);

    let mut without = row(&json!({ "/learning": null }));
    observe(&mut without, &way);
    without.chosen("icon 4").unwrap();
    assert_eq!(without.learnt(), Learnt::default());
    // what is set holds all the same
    let before = without.probabilities().to_vec();
    without.set_learnt(Learnt { confidence: 0.5, ..Learnt::default() }).unwrap();
    assert_ne!(without.probabilities(), before);
    without.set_learnt(Learnt::default()).unwrap();
    assert_eq!(without.probabilities(), before);
}

#[test]
fn what_follows_the_entry_teaches_nothing() {
    let way = movement(0.0, 800.0, 20);
    let mut predictor = row(&json!({}));
    observe(&mut predictor, &way[..=entry(&way, 4)]);
    predictor.chosen("icon 4").unwrap();
    let expected = predictor.learnt();
    predictor.set_learnt(Learnt::default()).unwrap();
    observe(&mut predictor, &way);
    // so few that nothing is thinned out
    for k in 1..5 {
        let shaky = [800.0 + f64::from(k % 3), 300.0];
        predictor.observe(0.32 + 0.1 * f64::from(k), &shaky).unwrap();
    }
    predictor.chosen("icon 4").unwrap();
    assert_eq!(predictor.learnt(), expected);
}

#[test]
fn long_movements_are_thinned_out_and_enter_at_the_same_time() {
    // the same movement at 60 and at 960 samples a second, whose entries differ by at most a sample of the slower one
    let learn = |factor: u32| {
        let mut predictor = row(&json!({}));
        let way = movement(0.0, 800.0, 30 * factor);
        let faster = |(time, place): &(f64, [f64; 2])| (time / f64::from(factor), *place);
        observe(&mut predictor, &way.iter().map(faster).collect::<Vec<_>>());
        predictor.chosen("icon 4").unwrap();
        predictor.learnt()
    };
    let (slow, fast) = (learn(1), learn(16));
    assert!((fast.samples / 16.0 - slow.samples).abs() <= 1.0, "{slow:?} {fast:?}");
    assert!((fast.confidence / slow.confidence - 1.0).abs() < 0.05, "{slow:?} {fast:?}");
}

#[test]
fn whatever_happens_what_is_learnt_stays_within_bounds() {
    let mut predictor = row(&json!({}));
    // chosen is always what the pointer leaves
    for _ in 0..200 {
        observe(&mut predictor, &movement(0.0, 800.0, 20));
        predictor.chosen("icon 0").unwrap();
    }
    let learnt = predictor.learnt();
    assert!((learnt.confidence - (-1.5f64).exp()).abs() < 1e-15, "{learnt:?}");
    let Learnt { movements, mean, low, high, .. } = learnt;
    assert_eq!([movements, mean, low, high], [200.0, 0.0, 0.0, 0.0], "it never entered, so no time is known");
    // always what it goes to at once; then always later than anybody
    predictor.set_learnt(Learnt::default()).unwrap();
    for _ in 0..400 {
        observe(&mut predictor, &movement(0.0, 800.0, 9));
        predictor.chosen("icon 4").unwrap();
    }
    let learnt = predictor.learnt();
    assert!(learnt.confidence > 1.0 && learnt.confidence <= std::f64::consts::E, "{learnt:?}");
    assert!([learnt.mean, learnt.low, learnt.high].iter().all(|offset| offset.abs() <= 3.0), "{learnt:?}");
    for _ in 0..400 {
        let way: Vec<_> = (0..60).map(|k| (2.0 * f64::from(k), [14.0 * f64::from(k), 300.0])).collect();
        observe(&mut predictor, &way);
        predictor.chosen("icon 4").unwrap();
    }
    let learnt = predictor.learnt();
    assert_eq!([learnt.mean, learnt.low, learnt.high], [3.0; 3]);
    let remaining = predictor.remaining().unwrap();
    assert!(remaining.low <= remaining.mean && remaining.mean <= remaining.high);
    // places beyond all measure, equal times, targets that come and go
    predictor.reset();
    for (k, x) in [0.0, 1e50, -1e50, 1e50, 0.0, 0.0].into_iter().enumerate() {
        predictor.observe((k / 2) as f64, &[x, 0.0]).unwrap();
    }
    predictor.set_destinations([Destination::new("new", [5.0, 5.0]).size(3.0)]).unwrap();
    predictor.chosen("new").unwrap();
    assert!(numbers(predictor.learnt()).iter().all(|x| x.is_finite()));
    assert_eq!(predictor.probabilities(), [1.0]);
}

#[test]
fn targets_that_come_in_mid_movement_are_learnt_from_as_if_they_had_been_there() {
    let way = movement(0.0, 800.0, 20);
    let mut there = row(&json!({}));
    observe(&mut there, &way);
    let list = |predictor: &Predictor| data(predictor.scenario());
    let all: Json = serde_json::to_value(list(&there)).unwrap();
    let mut later = row(&json!({ "/destinations": [all["destinations"][0]] }));
    observe(&mut later, &way);
    whither::internals::set_destinations(&mut later, &crate::support::value(&all["destinations"])).unwrap();
    there.chosen("icon 4").unwrap();
    later.chosen("icon 4").unwrap();
    assert_eq!(later.learnt(), there.learnt());
    // one that its prior rules out teaches nothing
    let mut out = row(&json!({ "/destinations/4/prior": 0 }));
    observe(&mut out, &way);
    out.chosen("icon 4").unwrap();
    assert_eq!(out.learnt(), Learnt::default());
}

#[test]
fn snapshots_keep_what_was_learnt_and_what_is_still_to_be_learnt_from() {
    let mut predictor = row(&json!({}));
    observe(&mut predictor, &movement(0.0, 800.0, 40));
    predictor.chosen("icon 4").unwrap();
    let way = movement(800.0, 200.0, 70);
    observe(&mut predictor, &way[..50]);
    let json = serde_json::to_string(&predictor.snapshot()).unwrap();
    let mut restored = Predictor::restore(&serde_json::from_str::<Snapshot>(&json).unwrap()).unwrap();
    assert_eq!(serde_json::to_string(&restored.snapshot()).unwrap(), json);
    for one in [&mut predictor, &mut restored] {
        way[50..].iter().for_each(|(time, place)| one.observe(*time, place).unwrap());
    }
    assert_eq!(predictor.probabilities(), restored.probabilities());
    predictor.chosen("icon 1").unwrap();
    restored.chosen("icon 1").unwrap();
    assert_eq!(predictor.learnt(), restored.learnt());
    assert_eq!(predictor.learnt().movements, 2.0);
    assert_eq!(predictor.probabilities(), restored.probabilities());
    assert_eq!(predictor.clone().learnt(), predictor.learnt());

    // without learning a snapshot is what it was in earlier versions
    let mut plain = row(&json!({ "/learning": null }));
    observe(&mut plain, &way[..50]);
    let body = serde_json::to_value(plain.snapshot()).unwrap()["body"].clone();
    assert!(body["learnt"].is_null() && body["movement"]["engine"]["trail"].is_null());
    assert_eq!(body.as_object().unwrap().len(), 3);
}

#[test]
fn what_is_learnt_is_data_and_checked() {
    let mut predictor = row(&json!({}));
    let read = |json: Json| serde_json::from_value::<Learnt>(json).map_err(|error| error.to_string());
    let alone = read(json!({ "confidence": 0.8 })).unwrap();
    assert_eq!(alone, Learnt { confidence: 0.8, ..Learnt::default() });
    predictor.set_learnt(alone).unwrap();
    let text = serde_json::to_string(&predictor.learnt()).unwrap();
    assert_eq!(
        text,
        r#"{"confidence":0.8,"precision":4.0,"movements":0.0,"samples":0.0,"mean":0.0,"low":0.0,"high":0.0}"#
    );
    assert_eq!(serde_json::from_str::<Learnt>(&text).unwrap(), alone);
    for (json, message) in [
        (json!({}), "learnt.confidence: missing key \"confidence\""),
        (json!({ "confidence": 9 }), "learnt.confidence: must be from 0.2 to 3, got 9"),
        (json!({ "confidence": 1, "low": "0" }), "learnt.low: must be a number, got \"0\""),
    ] {
        assert_eq!(read(json).unwrap_err(), message);
    }
    let bad = |learnt: Learnt| {
        let error = row(&json!({})).set_learnt(learnt).unwrap_err();
        (error.code(), error.path().to_owned())
    };
    let new = Learnt::default();
    for (learnt, code, path) in [
        (Learnt { confidence: f64::NAN, ..new }, Code::NotFinite, "learnt.confidence"),
        (Learnt { confidence: 0.1, ..new }, Code::OutOfRange, "learnt.confidence"),
        (Learnt { precision: 0.0, ..new }, Code::OutOfRange, "learnt.precision"),
        (Learnt { movements: -1.0, ..new }, Code::OutOfRange, "learnt.movements"),
        (Learnt { samples: f64::INFINITY, ..new }, Code::NotFinite, "learnt.samples"),
        (Learnt { low: 4.0, ..new }, Code::OutOfRange, "learnt.low"),
    ] {
        assert_eq!(bad(learnt), (code, path.to_owned()));
    }
    assert_eq!(predictor.set_learnt(Learnt { precision: -1.0, ..new }).unwrap_err().code(), Code::OutOfRange);
    assert_eq!(predictor.learnt(), alone, "an error changes nothing");
}

#[test]
fn other_methods_have_no_use_for_it() {
    let scenario = json!({
        "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 3000 }, "observation": { "noise": 1.5 },
        "arrival": { "type": "horizon", "from": 0.05, "to": 0.5 }, "learning": { "strength": 1e50 },
        "destinations": [
            { "id": "a", "center": [0, 0], "size": 60 }, { "id": "b", "center": [900, 300], "size": 60 }
        ],
    });
    let mut predictor = predictor(&scenario);
    observe(&mut predictor, &movement(100.0, 900.0, 30));
    let before = predictor.probabilities().to_vec();
    predictor.chosen("b").unwrap();
    assert_eq!(predictor.learnt(), Learnt::default());
    predictor.set_learnt(Learnt { confidence: 0.5, ..Learnt::default() }).unwrap();
    assert_eq!(predictor.probabilities(), before);
}
