//! The pointing model on clocks as browsers have them: several places at one time; and pointers that rest.

use crate::problem::{Draw, random};
use crate::support::predictor;
use proptest::prelude::*;
use serde_json::{Value as Json, json};
use whither::{Code, Predictor};
use whither::{PointerOptions, PointerTarget, pointer_scenario};

/// Seven by three icons of 80, 120 apart.
fn icons() -> Vec<PointerTarget> {
    let icon = |i: u32| PointerTarget {
        id: format!("icon {i}"),
        x: 100.0 + 120.0 * f64::from(i % 7),
        y: 100.0 + 120.0 * f64::from(i / 7),
        width: 80.0,
        height: 80.0,
    };
    (0..21).map(icon).collect()
}

fn pointer(none: f64) -> Predictor {
    Predictor::new(&pointer_scenario(&icons(), PointerOptions { none, ..PointerOptions::default() }).unwrap())
}

/// All that a predictor answers, to the bit.
fn answers(predictor: &mut Predictor, time: f64) -> Vec<u64> {
    let mut all = predictor.probabilities().to_vec();
    all.push(predictor.none());
    all.extend_from_slice(predictor.log_likelihoods());
    for state in [predictor.state(), predictor.initial_state(), predictor.forecast(time + 0.1).unwrap()] {
        let state = state.unwrap();
        all.extend(state.mean.iter().chain(state.covariance.iter()));
    }
    let arrival = predictor.arrival(None).unwrap().unwrap();
    all.extend(arrival.times.iter().chain(&arrival.probabilities));
    all.extend(predictor.remaining().into_iter().flat_map(|r| [r.mean, r.low, r.high]));
    all.extend(predictor.path("icon 3", &[time, time + 0.2]).unwrap());
    all.into_iter().map(f64::to_bits).collect()
}

/// A movement of minimum jerk from one place to another, at so many samples a second.
fn movement(from: [f64; 2], to: [f64; 2], duration: f64, rate: f64) -> Vec<(f64, [f64; 2])> {
    let count = (duration * rate) as usize;
    (0..=count)
        .map(|k| {
            let t = k as f64 / rate;
            let u = t / duration;
            let way = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
            (t, [from[0] + way * (to[0] - from[0]), from[1] + way * (to[1] - from[1])])
        })
        .collect()
}

/// The last place of each time.
fn last_of_each(samples: &[(f64, [f64; 2])]) -> Vec<(f64, [f64; 2])> {
    let mut last: Vec<(f64, [f64; 2])> = Vec::new();
    for &(time, place) in samples {
        match last.last_mut() {
            Some((t, position)) if *t == time => *position = place,
            _ => last.push((time, place)),
        }
    }
    last
}

/// 90 samples a second whose times are rounded up to 100 ms, as privacy settings do.
#[test]
fn rounded_clocks_lose_nothing_but_time() {
    for (from, to, target) in
        [([130.0, 340.0], 6, "icon 6"), ([800.0, 90.0], 14, "icon 14"), ([460.0, 200.0], 0, "icon 0")]
    {
        let icon = &icons()[to];
        let track = movement(from, [icon.x, icon.y], 0.9, 90.0);
        let mut rounded = pointer(0.0);
        for (k, (time, place)) in track.iter().enumerate() {
            rounded.observe((time * 10.0).ceil() / 10.0, place).unwrap();
            if k * 10 >= track.len() * 8 {
                let best = rounded.best().unwrap();
                assert_eq!(best.id, target, "at sample {k} of {}", track.len());
            }
        }
        assert!(rounded.best().unwrap().probability > 0.9);
    }
}

proptest! {
    #![proptest_config(random(60))]

    /// Bit for bit what the last places alone give, with `none`, at the first time too, whatever repeats how often; after a
    /// snapshot as well.
    #[test]
    fn the_last_place_of_a_time_counts_alone(
        seed in any::<u64>(), repeats in prop::collection::vec(1..5usize, 3..12), none in prop::sample::select(vec![0.0, 0.2]),
        restored_at in 0..12usize,
    ) {
        let mut draw = Draw(seed);
        let mut samples = Vec::new();
        let mut time = draw.within(0.0, 1000.0);
        for &count in &repeats {
            for _ in 0..count {
                samples.push((time, [draw.within(50.0, 900.0), draw.within(50.0, 400.0)]));
            }
            time += draw.within(0.002, 0.1);
        }
        let (mut all, mut alone) = (pointer(none), pointer(none));
        let noise = |k: usize| (k % 3 == 1).then(|| whither::ObservationNoise::from([1.5, 2.0]));
        for (k, (time, place)) in samples.iter().enumerate() {
            all.observe_with(*time, &place.map(Some), noise(k % 2).as_ref()).unwrap();
            if k == restored_at {
                all = Predictor::restore(&all.snapshot()).unwrap();
            }
            // asking in between changes nothing
            if k % 2 == 0 {
                all.probabilities();
            }
        }
        let parity = |time: f64, place: [f64; 2]| samples.iter().position(|sample| *sample == (time, place)).unwrap() % 2;
        for (time, place) in last_of_each(&samples) {
            alone.observe_with(time, &place.map(Some), noise(parity(time, place)).as_ref()).unwrap();
        }
        let last = samples[samples.len() - 1].0;
        prop_assert_eq!(answers(&mut all, last), answers(&mut alone, last));
        prop_assert_eq!(all.snapshot(), alone.snapshot());
    }
}

/// What comes axis by axis at one time is one observation of both; what has no axis at all is none.
#[test]
fn axes_that_come_one_after_the_other_are_one_observation() {
    let (mut apart, mut together) = (pointer(0.1), pointer(0.1));
    for (k, (time, [x, y])) in movement([130.0, 340.0], [820.0, 100.0], 0.6, 60.0).into_iter().enumerate() {
        together.observe(time, &[x, y]).unwrap();
        if k == 0 {
            apart.observe(time, &[x - 7.0, y]).unwrap();
            apart.observe_with(time, &[Some(x), None], None).unwrap();
        } else {
            apart.observe_with(time, &[Some(x), None], None).unwrap();
            apart.observe_with(time, &[None, Some(y)], None).unwrap();
        }
        apart.observe_with(time, &[None, None], None).unwrap();
        assert_eq!(answers(&mut apart, time), answers(&mut together, time), "sample {k}");
    }
}

/// A refused observation at the time of the last one replaces nothing.
#[test]
fn a_bad_observation_replaces_nothing() {
    let mut pointer = pointer(0.0);
    pointer.observe(1.0, &[100.0, 100.0]).unwrap();
    pointer.observe(1.1, &[160.0, 120.0]).unwrap();
    let before = answers(&mut pointer, 1.1);
    assert_eq!(pointer.observe(1.1, &[f64::NAN, 1.0]).unwrap_err().code(), Code::NotFinite);
    assert_eq!(pointer.observe(1.05, &[170.0, 120.0]).unwrap_err().code(), Code::TimeNotIncreasing);
    assert_eq!(answers(&mut pointer, 1.1), before);
}

/// The papers' methods count equal times as observations of their own: two of one place are as one of half the variance.
#[test]
fn the_papers_methods_count_equal_times_as_observations() {
    let scenario = |noise: f64| -> Json {
        json!({
            "motion": { "type": "constantVelocity", "dimensions": 1, "noise": 5 }, "observation": { "noise": noise },
            "initial": { "velocity": 9 }, "arrival": { "type": "uniform", "from": 2, "to": 4 },
            "destinations": [{ "id": "left", "center": [-20], "size": 3 }, { "id": "right", "center": [30], "size": 3 }]
        })
    };
    let (mut twice, mut once) = (predictor(&scenario(2.0)), predictor(&scenario(2f64.sqrt())));
    // of the first time the default counts nothing but what comes after the first observation
    once.observe(0.0, &[0.0]).unwrap();
    twice.observe_with(0.0, &[Some(0.0)], Some(&2f64.sqrt().into())).unwrap();
    for (time, place) in [(0.4, 3.0), (0.9, 4.0)] {
        once.observe(time, &[place]).unwrap();
        twice.observe(time, &[place]).unwrap();
        twice.observe(time, &[place]).unwrap();
    }
    assert!(crate::support::relative(twice.probabilities(), once.probabilities()) < 1e-9);
}

/// It rests on an icon from the first sample on: after half a second the icon is above its prior, and the likelier the longer it
/// rests.
#[test]
fn a_pointer_at_rest_raises_the_icon_under_it() {
    for (which, tremor, offset) in
        [(10, 0.0, [0.0, 0.0]), (10, 0.4, [0.0, 0.0]), (0, 0.4, [20.0, -20.0]), (20, 0.0, [35.0, 0.0])]
    {
        for none in [0.0, 0.05] {
            let (icon, mut draw) = (&icons()[which], Draw(which as u64 + 3));
            let mut pointer = pointer(none);
            let mut at = Vec::new();
            for k in 0..=60 {
                let mut place = [icon.x + offset[0], icon.y + offset[1]];
                place.iter_mut().for_each(|x| *x += tremor * draw.within(-1.7, 1.7));
                pointer.observe(f64::from(k) / 60.0, &place).unwrap();
                if [30, 45, 60].contains(&k) {
                    at.push(pointer.probabilities()[which]);
                }
            }
            let prior = (1.0 - none) / 21.0;
            assert!(at[0] > prior, "{which} {tremor} {none}: {at:?}");
            assert!(at.windows(2).all(|pair| pair[1] > 1.02 * pair[0]), "{which} {tremor} {none}: {at:?}");
            assert_eq!(pointer.best().unwrap().index, which, "{which} {tremor} {none}: {:?}", pointer.probabilities());
            // but not so likely that it would be acted upon
            assert!(at[2] > 2.0 * prior && at[2] < 0.8, "{which} {tremor} {none}: {at:?}");
        }
    }
}

/// A scenario that does not state `restDistance` is as before; a movement that has begun is too.
#[test]
fn rest_is_one_constant_more() {
    let stated = serde_json::to_value(pointer_scenario(&icons(), PointerOptions::default()).unwrap()).unwrap();
    let mut without = stated.clone();
    without["pointing"].as_object_mut().unwrap().remove("restDistance").unwrap();
    let mut both = [&stated, &without].map(predictor);
    for (k, (time, place)) in movement([130.0, 340.0], [820.0, 100.0], 0.6, 60.0).into_iter().enumerate() {
        both.iter_mut().for_each(|pointer| pointer.observe(time, &place).unwrap());
        let [with, without] = both.each_mut().map(|pointer| pointer.probabilities().to_vec());
        if k > 12 {
            assert_eq!(with, without, "sample {k}");
        }
    }
}
