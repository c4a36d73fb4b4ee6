//! The pointing model in a moving car: what is expected to shake is followed, and nothing else changes.

use whither::study::simulate::Random;
use whither::{Destination, PointerOptions, PointerTarget, Predictor, Scenario, Snapshot, pointer_scenario};

/// Seven by three icons of 80, 120 apart.
fn scenario(shake: f64) -> Scenario {
    let icon = |i: u32| PointerTarget {
        id: format!("icon {i}"),
        x: 100.0 + 120.0 * f64::from(i % 7),
        y: 100.0 + 120.0 * f64::from(i / 7),
        width: 80.0,
        height: 80.0,
    };
    let icons: Vec<PointerTarget> = (0..21).map(icon).collect();
    pointer_scenario(&icons, PointerOptions { shake, ..PointerOptions::default() }).unwrap()
}

/// A movement of minimum jerk from one icon to another in half a second, shaken by so many px at so many Hz, 60 times a second.
fn movement(random: &mut Random, [from, to]: [[f64; 2]; 2], amplitude: f64, frequency: f64) -> Vec<(f64, [f64; 2])> {
    let turns = [random.uniform(), random.uniform()];
    let at = |k: u32| {
        let time = f64::from(k) / 60.0;
        let u = (time / 0.5).min(1.0);
        let way = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
        let shake = turns.map(|turn| amplitude * (std::f64::consts::TAU * (turn + frequency * time)).sin());
        (time, [0, 1].map(|j| from[j] + way * (to[j] - from[j]) + shake[j]))
    };
    (0..=30).map(at).collect()
}

const LEFT: [f64; 2] = [100.0, 220.0];
const RIGHT: [f64; 2] = [820.0, 100.0];

fn observe(predictor: &mut Predictor, samples: &[(f64, [f64; 2])]) {
    samples.iter().for_each(|(time, place)| predictor.observe(*time, place).unwrap());
}

/// All that a predictor answers, to the bit.
fn answers(predictor: &mut Predictor) -> Vec<u64> {
    let mut all = predictor.probabilities().to_vec();
    for state in [predictor.state(), predictor.initial_state()].into_iter().flatten() {
        all.extend(state.mean.iter().chain(state.covariance.iter()));
    }
    all.into_iter().map(f64::to_bits).collect()
}

/// The mean error of the velocity in the second half of so many movements, in px a second.
fn error(predictor: &mut Predictor, movements: usize, shake: [f64; 2]) -> f64 {
    let mut random = Random::new(5);
    let mut sum = 0.0;
    for _ in 0..movements {
        predictor.reset();
        for (k, (time, place)) in movement(&mut random, [LEFT, RIGHT], shake[0], shake[1]).iter().enumerate() {
            predictor.observe(*time, place).unwrap();
            if k >= 15 {
                let u = time / 0.5;
                let pace = 30.0 * u * u * (1.0 - u) * (1.0 - u) / 0.5;
                let state = predictor.state().unwrap().mean;
                let off = [0, 1].map(|j| state[2 + j] - pace * (RIGHT[j] - LEFT[j]));
                sum += off[0].hypot(off[1]) / 16.0;
            }
        }
    }
    sum / movements as f64
}

#[test]
fn the_velocity_is_the_hands_and_not_the_cars() {
    let of = |shake: f64, frequency: f64| {
        [0.0, 20.0].map(|expected| error(&mut Predictor::new(&scenario(expected)), 20, [shake, frequency]))
    };
    // a hand as fast as this one leaves little to distinguish at 4 Hz
    for (frequency, share) in [(4.0, 1.02), (8.0, 0.75)] {
        let [plain, followed] = of(20.0, frequency);
        assert!(followed < share * plain, "{followed} for {plain} px/s at {frequency} Hz");
    }
    let [plain, followed] = of(0.0, 4.0);
    assert!((followed / plain - 1.0).abs() < 0.02, "{followed} for {plain} px/s where nothing shakes");
}

#[test]
fn the_evidence_of_a_movement_outlasts_it_and_a_new_predictor_has_none() {
    let mut random = Random::new(1);
    let mut after = Predictor::new(&scenario(20.0));
    for _ in 0..5 {
        observe(&mut after, &movement(&mut random, [LEFT, RIGHT], 20.0, 8.0));
        after.reset();
    }
    let samples = &movement(&mut random, [RIGHT, LEFT], 20.0, 8.0)[..6];
    let mut new = Predictor::new(&scenario(20.0));
    observe(&mut after, samples);
    observe(&mut new, samples);
    assert_ne!(answers(&mut after), answers(&mut new));
    // where none is expected a movement leaves nothing
    let mut plain = [(); 2].map(|()| Predictor::new(&scenario(0.0)));
    observe(&mut plain[0], &movement(&mut random, [LEFT, RIGHT], 20.0, 8.0));
    plain.iter_mut().for_each(Predictor::reset);
    let [one, other] = plain.each_mut().map(|predictor| {
        observe(predictor, samples);
        answers(predictor)
    });
    assert_eq!(one, other);
}

#[test]
fn a_snapshot_keeps_it_within_a_movement_and_between_movements() {
    let mut random = Random::new(2);
    let mut predictor = Predictor::new(&scenario(20.0));
    observe(&mut predictor, &movement(&mut random, [LEFT, RIGHT], 20.0, 4.0));
    predictor.reset();
    let samples = movement(&mut random, [RIGHT, LEFT], 20.0, 4.0);
    let through_json = |predictor: &Predictor| {
        let json = serde_json::to_string(&predictor.snapshot()).unwrap();
        Predictor::restore(&serde_json::from_str::<Snapshot>(&json).unwrap()).unwrap()
    };
    for (done, sample) in samples.iter().enumerate() {
        let mut restored = through_json(&predictor);
        predictor.observe(sample.0, &sample.1).unwrap();
        restored.observe(sample.0, &sample.1).unwrap();
        assert_eq!(answers(&mut restored), answers(&mut predictor), "after {done}");
        assert_eq!(answers(&mut predictor.clone()), answers(&mut predictor));
    }
}

#[test]
fn doubled_samples_change_nothing() {
    let mut random = Random::new(3);
    let samples = movement(&mut random, [LEFT, RIGHT], 10.0, 4.0);
    let [mut once, mut twice] = [(); 2].map(|()| Predictor::new(&scenario(20.0)));
    observe(&mut once, &samples);
    for (time, [x, y]) in &samples {
        twice.observe(*time, &[x + 9.0, y - 5.0]).unwrap();
        twice.observe(*time, &[*x, *y]).unwrap();
    }
    assert_eq!(answers(&mut twice), answers(&mut once));
}

#[test]
fn axes_may_be_missing_and_there_may_be_three_of_them() {
    let mut random = Random::new(4);
    let mut predictor = Predictor::new(&scenario(20.0));
    for (k, (time, [x, y])) in movement(&mut random, [LEFT, RIGHT], 20.0, 4.0).into_iter().enumerate() {
        predictor.observe_with(time, &[Some(x), (k % 3 != 1).then_some(y)], None).unwrap();
    }
    assert_eq!(predictor.best().unwrap().id, "icon 6");
    let json = serde_json::to_value(scenario(20.0)).unwrap();
    let mut space = json.clone();
    space["motion"]["dimensions"] = 3.into();
    space["destinations"] = serde_json::json!([
        { "id": "near", "center": [100.0, 220.0, 0.0], "size": 80.0 }, { "id": "far", "center": [820.0, 100.0, 400.0], "size": 80.0 }
    ]);
    let mut predictor = Predictor::new(&serde_json::from_value(space).unwrap());
    for (time, [x, y]) in movement(&mut random, [LEFT, RIGHT], 20.0, 4.0) {
        predictor.observe(time, &[x, y, 0.5 * (x - 100.0)]).unwrap();
    }
    assert_eq!(predictor.best().unwrap().id, "far");
    predictor.set_destinations([Destination::new("only", [0.0; 3]).size(5.0)]).unwrap();
    assert_eq!(predictor.probabilities(), [1.0]);
}

#[test]
fn nothing_that_is_observed_breaks_it() {
    let mut random = Random::new(9);
    let mut draw = || random.uniform();
    for shake in [1e-6, 20.0, 1e6] {
        let mut predictor = Predictor::new(&scenario(shake));
        let mut time = 0.0;
        for _ in 0..400 {
            time += [0.0, 1e-9, 0.001, 0.016, 3.0, 1e6][(6.0 * draw()) as usize];
            let far = [1.0, 100.0, 1e4, 1e9][(4.0 * draw()) as usize];
            predictor.observe(time, &[far * (draw() - 0.5), far * (draw() - 0.5)]).unwrap();
            let sum: f64 = predictor.probabilities().iter().sum();
            assert!((sum - 1.0).abs() < 1e-9, "{sum} with {shake}");
        }
    }
}
