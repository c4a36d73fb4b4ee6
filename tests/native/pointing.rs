//! The pointing model: three dimensions, and the life of a movement.

use crate::problem::Draw;
use crate::support::{golden, numbers, predictor, relative, value};
use serde_json::{Value as Json, json};
use whither::Predictor;
use whither::internals::data;
use whither::{PointerOptions, PointerTarget, pointer_scenario};

fn observations(case: &Json) -> Vec<Vec<f64>> {
    case["observations"].as_array().unwrap().iter().map(numbers).collect()
}

/// A golden scenario and its observations in other coordinates: each position becomes `map(position)`.
fn mapped(case: &Json, dimensions: usize, map: impl Fn(&[f64]) -> Vec<f64>) -> (Json, Vec<(f64, Vec<f64>)>) {
    let mut scenario = case["scenario"].clone();
    scenario["motion"]["dimensions"] = json!(dimensions);
    for destination in scenario["destinations"].as_array_mut().unwrap() {
        destination["center"] = json!(map(&numbers(&destination["center"])));
        destination["size"] = json!(destination["size"][0]);
    }
    let observations = observations(case).iter().map(|row| (row[0], map(&row[1..]))).collect();
    (scenario, observations)
}

fn follow(scenario: &Json, observations: &[(f64, Vec<f64>)]) -> Predictor {
    let mut predictor = predictor(scenario);
    for (time, position) in observations {
        predictor.observe(*time, position).unwrap();
    }
    predictor
}

#[test]
fn a_rotated_and_shifted_movement_has_the_same_destination() {
    let case = golden("pointing-ring12");
    let (c, s) = (0.6, 0.8);
    let (plain, way) = mapped(&case, 2, <[f64]>::to_vec);
    let (turned, turned_way) = mapped(&case, 2, |p| vec![c * p[0] - s * p[1] + 5000.0, s * p[0] + c * p[1] - 300.0]);
    for length in [2, way.len() / 2, way.len()] {
        let mut straight = follow(&plain, &way[..length]);
        let mut rotated = follow(&turned, &turned_way[..length]);
        assert!(relative(rotated.probabilities(), straight.probabilities()) < 1e-9, "after {length} samples");
        let (a, b) = (straight.state().unwrap(), rotated.state().unwrap());
        let expected = [c * a.mean[0] - s * a.mean[1] + 5000.0, s * a.mean[0] + c * a.mean[1] - 300.0];
        assert!(relative(&b.mean.as_slice()[..2], &expected) < 1e-9);
    }
}

#[test]
fn in_space_a_turn_about_any_axis_changes_nothing() {
    let case = golden("pointing-ring12");
    let (flat, way) = mapped(&case, 3, |p| vec![p[0], p[1], 40.0]);
    // about (1, 1, 1): x -> y -> z -> x
    let (turned, turned_way) = mapped(&case, 3, |p| vec![40.0, p[0], p[1]]);
    let (skew, skew_way) = mapped(&case, 3, |p| vec![p[0], 0.6 * p[1] - 0.8 * 40.0, 0.8 * p[1] + 0.6 * 40.0]);
    for length in [2, way.len() / 2, way.len()] {
        let mut level = follow(&flat, &way[..length]);
        for (scenario, way) in [(&turned, &turned_way), (&skew, &skew_way)] {
            let mut other = follow(scenario, &way[..length]);
            assert!(relative(other.probabilities(), level.probabilities()) < 1e-9, "after {length} samples");
        }
        if length == way.len() {
            assert_eq!(level.best().unwrap().index, case["true"].as_u64().unwrap() as usize);
        }
    }
}

#[test]
fn on_a_line_it_distinguishes_left_from_right() {
    let mut scenario = golden("pointing-grid21")["scenario"].clone();
    scenario["motion"]["dimensions"] = json!(1);
    scenario["destinations"] = json!([
        { "id": "left", "center": [0], "size": [60] },
        { "id": "near", "center": [700], "size": [60] },
        { "id": "far", "center": [1000], "size": [60] }
    ]);
    let way: Vec<_> = (0..20).map(|k| (0.016 * f64::from(k), vec![500.0 + 1.2 * f64::from(k * k)])).collect();
    let mut predictor = follow(&scenario, &way);
    assert_eq!(predictor.best().unwrap().id, "far");
    assert!(predictor.probabilities()[0] < 0.01);
}

#[test]
fn destinations_are_added_moved_and_removed_in_mid_movement() {
    let case = golden("pointing-sizes40");
    let way: Vec<_> = observations(&case).iter().map(|row| (row[0], row[1..].to_vec())).collect();
    let mut full = follow(&case["scenario"], &way);
    let mut scenario = case["scenario"].clone();
    let all = scenario["destinations"].as_array().unwrap().clone();
    scenario["destinations"] = json!(all[..20]);
    scenario["destinations"][3]["center"] = json!([0, 0]);
    scenario["destinations"][4]["id"] = json!("extra");
    let mut growing = predictor(&scenario);
    for (k, (time, position)) in way.iter().enumerate() {
        growing.observe(*time, position).unwrap();
        if k == 10 {
            whither::internals::update_destination(&mut growing, "t3", &value(&all[3])).unwrap();
            growing.remove_destination("extra").unwrap();
            whither::internals::add_destination(&mut growing, &value(&all[4])).unwrap();
            for destination in &all[20..] {
                whither::internals::add_destination(&mut growing, &value(destination)).unwrap();
            }
        }
    }
    let place: Vec<usize> = (0..all.len()).map(|i| growing.index_of(&format!("t{i}")).unwrap()).collect();
    let found: Vec<f64> = place.iter().map(|&i| growing.probabilities()[i]).collect();
    assert!(relative(&found, full.probabilities()) < 1e-12);
    whither::internals::set_destinations(&mut growing, &value(&case["scenario"]["destinations"])).unwrap();
    assert!(relative(growing.probabilities(), full.probabilities()) < 1e-12);
}

#[test]
fn a_snapshot_and_a_clone_go_on_to_the_bit() {
    let case = golden("pointing-none");
    let way = observations(&case);
    let mut original = predictor(&case["scenario"]);
    for row in &way[..30] {
        original.observe(row[0], &row[1..]).unwrap();
    }
    let mut copy = original.clone();
    let text = serde_json::to_string(&original.snapshot()).unwrap();
    let mut restored = Predictor::restore(&serde_json::from_str(&text).unwrap()).unwrap();
    for row in &way[30..] {
        for predictor in [&mut original, &mut copy, &mut restored] {
            predictor.observe(row[0], &row[1..]).unwrap();
        }
        assert_eq!(original.probabilities(), copy.probabilities());
        assert_eq!(original.probabilities(), restored.probabilities());
        assert_eq!(original.none(), restored.none());
    }
    assert_eq!(original.state(), restored.state());
    assert_eq!(original.initial_state(), restored.initial_state());
    original.reset();
    assert!(original.state().is_none());
}

#[test]
fn the_forecast_leads_to_the_destination() {
    let case = golden("pointing-grid21");
    let way: Vec<_> = observations(&case).iter().map(|row| (row[0], row[1..].to_vec())).collect();
    let length = way.len() * 6 / 10;
    let mut predictor = follow(&case["scenario"], &way[..length]);
    let now = way[length - 1].0;
    let id = format!("t{}", case["true"]);
    let center = numbers(&case["scenario"]["destinations"][case["true"].as_u64().unwrap() as usize]["center"]);
    let path = predictor.path(&id, &[now, now + 2.0]).unwrap();
    let (here, there) = (&path[..2], &path[2..]);
    let distance = |a: &[f64], b: &[f64]| (a[0] - b[0]).hypot(a[1] - b[1]);
    assert!(distance(here, &way[length - 1].1) < 2.0, "{here:?}");
    // past every node the state is as on arrival: within the box, whose deviation is 96 / sqrt(12) = 28
    assert!(distance(there, &center) < 20.0, "{there:?} against {center:?}");
    let late = predictor.forecast(now + 2.0).unwrap().unwrap();
    assert!(late.covariance[(0, 0)] >= predictor.state().unwrap().covariance[(0, 0)]);
    assert!(late.covariance.clone().cholesky().is_some());
}

#[test]
fn the_state_at_the_start_is_what_a_batch_estimate_gives() {
    // Constant velocity without speed noise is linear, so the smoothed start is a regression that can be done by hand.
    // With two exact observations one second apart and hardly any noise the velocity at the start is their difference.
    let mut scenario = golden("pointing-grid21")["scenario"].clone();
    scenario["motion"]["noise"] = json!(1e-3);
    scenario["motion"]["speedNoise"] = json!(0);
    scenario["observation"]["noise"] = json!(1e-3);
    let mut predictor = predictor(&scenario);
    predictor.observe(0.0, &[100.0, 100.0]).unwrap();
    predictor.observe(1.0, &[130.0, 80.0]).unwrap();
    let start = predictor.initial_state().unwrap();
    assert!(relative(start.mean.as_slice(), &[100.0, 100.0, 30.0, -20.0]) < 1e-4, "{}", start.mean);
}

#[test]
fn a_missing_axis_leaves_the_other_one_informed() {
    let case = golden("pointing-grid21");
    let way = observations(&case);
    let mut predictor = predictor(&case["scenario"]);
    for (k, row) in way.iter().enumerate() {
        let y = (k % 3 != 1).then_some(row[2]);
        predictor.observe_with(row[0], &[Some(row[1]), y], None).unwrap();
    }
    assert_eq!(predictor.best().unwrap().index, case["true"].as_u64().unwrap() as usize);
    let deaf = [1000.0, 0.5].into();
    let last = &way[way.len() - 1];
    let before = predictor.state().unwrap().mean[0];
    predictor.observe_with(last[0] + 0.01, &[Some(9000.0), Some(last[2])], Some(&deaf)).unwrap();
    assert!((predictor.state().unwrap().mean[0] - before).abs() < 20.0);
}

#[test]
fn a_scenario_is_written_as_it_was_read() {
    let scenario = whither::internals::scenario(&value(&golden("pointing-sizes40")["scenario"])).unwrap();
    let again = whither::internals::scenario(&data(&scenario)).unwrap();
    assert_eq!(data(&again), data(&scenario));
}

#[test]
fn the_time_to_the_entry_follows_its_constants() {
    let mut scenario = golden("pointing-grid21")["scenario"].clone();
    let entry = json!({ "offset": 0.5, "nodes": 0, "near": 0, "distance": 20, "elapsed": 0, "low": -1, "high": 2 });
    scenario["pointing"]["remaining"] = entry;
    let mut with = predictor(&scenario);
    with.observe(0.0, &[300.0, 300.0]).unwrap();
    assert_eq!(with.remaining(), None, "there is no estimate before it moves");
    with.observe(0.016, &[310.0, 300.0]).unwrap();
    let remaining = with.remaining().unwrap();
    let found = [remaining.mean, remaining.low, remaining.high];
    assert!(relative(&found, &[0.5f64.exp(), (-0.5f64).exp(), 2.5f64.exp()]) < 1e-12, "{found:?}");
    scenario["pointing"]["remaining"]["elapsed"] = json!(4);
    let mut with = predictor(&scenario);
    with.observe(0.0, &[300.0, 300.0]).unwrap();
    with.observe(3.0, &[310.0, 300.0]).unwrap();
    // 0.5 + 4 * 3 / (3 + 1)
    assert!(relative(&[with.remaining().unwrap().mean], &[3.5f64.exp()]) < 1e-12);
}

#[test]
fn a_share_of_none_stays_at_its_prior() {
    let case = golden("pointing-none");
    let mut scenario = case["scenario"].clone();
    scenario["pointing"]["noneShare"] = json!(0.25);
    let (mut plain, mut kept) = (predictor(&case["scenario"]), predictor(&scenario));
    for row in observations(&case) {
        for predictor in [&mut plain, &mut kept] {
            predictor.observe(row[0], &row[1..]).unwrap();
        }
        let expected = 0.75 * plain.none() + 0.25 * 0.2;
        assert!((kept.none() - expected).abs() < 1e-12);
        let sum: f64 = kept.probabilities().iter().sum::<f64>() + kept.none();
        assert!((sum - 1.0).abs() < 1e-12);
        let scale = (1.0 - kept.none()) / (1.0 - plain.none());
        let scaled: Vec<f64> = plain.probabilities().iter().map(|p| scale * p).collect();
        assert!(relative(kept.probabilities(), &scaled) < 1e-9);
    }
}

/// The probabilities that the log likelihoods, one destination at a time, lead to.
fn from_log_likelihoods(predictor: &mut Predictor, scenario: &Json, start: &[f64]) -> Vec<f64> {
    let pointing = &scenario["pointing"];
    let (near, uniform) = (pointing["near"].as_f64().unwrap(), pointing["uniform"].as_f64().unwrap());
    let log_likelihoods = predictor.log_likelihoods().to_vec();
    let destinations = scenario["destinations"].as_array().unwrap();
    let log_prior = |destination: &Json| {
        let (center, size) = (numbers(&destination["center"]), numbers(&destination["size"]));
        let each = center.iter().zip(start).zip(&size);
        let volume: f64 = size.iter().product();
        let square: f64 = each.map(|((c, s), size)| ((c - s) / size).powi(2)).sum();
        let square = square + volume.powf(-2.0 / center.len() as f64);
        (square / (square + near * near)).ln() + destination["prior"].as_f64().unwrap().ln()
    };
    let logs: Vec<f64> = log_likelihoods.iter().zip(destinations).map(|(l, d)| l + log_prior(d)).collect();
    let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = logs.iter().map(|l| (l - top).exp()).sum();
    let none = predictor.none();
    logs.iter()
        .map(|l| (1.0 - none) * ((1.0 - uniform) * (l - top).exp() / sum + uniform / logs.len() as f64))
        .collect()
}

#[test]
fn the_hot_loop_agrees_with_one_destination_at_a_time() {
    let base = serde_json::to_value(
        pointer_scenario(
            &[PointerTarget { id: "a".to_owned(), x: 0.0, y: 0.0, width: 50.0, height: 50.0 }],
            PointerOptions::default(),
        )
        .unwrap(),
    )
    .unwrap();
    let mut worst = 0.0f64;
    for seed in 0..60u32 {
        let mut draw = Draw(u64::from(seed).wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1);
        let d = 1 + seed as usize % 3;
        let (count, sizes) = (3 + seed as usize, [1, 3, 1000][seed as usize / 3 % 3]);
        // some layouts are much wider than a movement reaches
        let extent = if seed % 5 == 0 { 1e5 } else { 900.0 };
        let kinds: Vec<Vec<f64>> = (0..sizes.min(count)).map(|_| draw.list(d, 15.0, 90.0)).collect();
        let mut scenario = base.clone();
        scenario["motion"]["dimensions"] = json!(d);
        scenario["none"] = json!(if seed % 2 == 0 { 0.0 } else { 0.2 });
        let destination = |i: usize, draw: &mut Draw| {
            let center = draw.list(d, 0.0, extent);
            json!({ "id": format!("d{i}"), "center": center, "size": kinds[i % kinds.len()], "prior": draw.within(0.2, 2.0) })
        };
        let mut destinations: Vec<Json> = (0..count).map(|i| destination(i, &mut draw)).collect();
        // one where the movement begins, one straight behind it
        let (start, velocity) = (draw.list(d, 100.0, 800.0), draw.list(d, -900.0, 900.0));
        destinations[0]["center"] = json!(start);
        destinations[1]["center"] = json!(start.iter().zip(&velocity).map(|(x, v)| x - v).collect::<Vec<_>>());
        scenario["destinations"] = json!(destinations);
        let mut predictor = predictor(&scenario);
        for k in 0..25 {
            let time = 0.016 * f64::from(k);
            let position: Vec<f64> = start.iter().zip(&velocity).map(|(x, v)| x + v * time).collect();
            predictor.observe(time, &position).unwrap();
            let expected = from_log_likelihoods(&mut predictor, &scenario, &start);
            let found = predictor.probabilities();
            for (found, expected) in found.iter().zip(&expected) {
                worst = worst.max((found - expected).abs());
                assert!((found - expected).abs() < 1e-12, "seed {seed} k {k}: {found:e} {expected:e}");
            }
        }
    }
    assert!(worst > 0.0, "compared with itself");
}

/// The products of what directions are measured with come close to the limits of floating point.
#[test]
fn directions_may_be_as_wide_and_as_narrow_as_numbers_are() {
    let base = serde_json::to_value(
        pointer_scenario(
            &[("a", 300.0), ("b", 420.0)].map(|(id, x)| PointerTarget {
                id: id.to_owned(),
                x,
                y: 90.0,
                width: 50.0,
                height: 50.0,
            }),
            PointerOptions::default(),
        )
        .unwrap(),
    )
    .unwrap();
    for (core, wide, size) in [(1e-50, 1e-50, 50.0), (1e-50, 1e50, 50.0), (1e50, 1e50, 50.0), (0.1, 0.5, 1e50)] {
        let mut scenario = base.clone();
        scenario["pointing"]["direction"]["core"] = json!(core);
        scenario["pointing"]["direction"]["wide"] = json!(wide);
        for i in 0..2 {
            scenario["destinations"][i]["size"] = json!([size, size]);
            scenario["destinations"][i]["prior"] = json!(1.0);
        }
        let mut predictor = predictor(&scenario);
        for k in 0..8 {
            predictor.observe(0.016 * f64::from(k), &[14.0 * f64::from(k), 5.0 * f64::from(k)]).unwrap();
            let expected = from_log_likelihoods(&mut predictor, &scenario, &[0.0, 0.0]);
            for (found, expected) in predictor.probabilities().iter().zip(&expected) {
                assert!((found - expected).abs() < 1e-12, "{core:e} {wide:e} {size:e} k {k}: {found:e} {expected:e}");
            }
        }
    }
}

#[test]
fn a_movement_beyond_all_numbers_keeps_the_posterior_at_the_prior() {
    let case = golden("pointing-ring12");
    for (far, noise) in [(1e12, 0.5), (1e25, 0.5), (1e31, 1e22), (1e48, 1e28), (1e49, 0.5)] {
        let mut scenario = case["scenario"].clone();
        scenario["observation"]["noise"] = json!(noise);
        let mut predictor = predictor(&scenario);
        for (k, position) in [[0.0, 0.0], [far, -far], [-far, 0.5 * far], [far, far]].iter().enumerate() {
            predictor.observe(0.01 * k as f64, position).unwrap();
            let sum: f64 = predictor.probabilities().iter().sum::<f64>() + predictor.none();
            let arrival = predictor.arrival(None).unwrap().unwrap();
            let nodes: f64 = arrival.probabilities.iter().sum();
            assert!((sum - 1.0).abs() < 1e-12 && (nodes - 1.0).abs() < 1e-12, "{far:e} k = {k}: {sum} {nodes}");
            let now = predictor.state().unwrap();
            let fine = now.mean.iter().all(|x| x.is_finite()) && now.covariance.diagonal().iter().all(|x| *x >= 0.0);
            assert!(fine, "{far:e} k = {k}: {now:?}");
        }
    }
}
