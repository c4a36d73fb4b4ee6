//! A fuzzer: scenarios, right and broken, and whatever can be done with a predictor, from a seed. Nothing may panic, what is
//! refused changes nothing, and probabilities stay probabilities.
//!
//! `WHITHER_FUZZ_SECONDS=300 cargo test --test native fuzz` runs it for minutes; `WHITHER_FUZZ_SEED=n` runs one case.

use crate::problem::{Choice, Draw, KINDS};
use crate::support::value;
use serde_json::json;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};
use whither::internals::{Value, data};
use whither::{Gaussian, Predictor};
use whither::{PointerOptions, PointerTarget, pointer_scenario};

const CASES: u64 = 1500;

impl Draw {
    fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize % n
    }

    fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    /// An extreme number, one that is refused, or a random one.
    fn extreme(&mut self) -> f64 {
        let edge = [0.0, -0.0, 1.0, -1.0, 1e-300, 1e-50, 1e-20, 1e12, 1e20, 1e49, -1e49, 1e50, 1e51, 1e200, f64::MAX];
        let none = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        match self.below(10) {
            0 => none[self.below(3)],
            1..=4 => edge[self.below(edge.len())],
            _ => self.within(-2.0, 2.0) * 10f64.powf(self.within(-15.0, 15.0)),
        }
    }

    fn junk(&mut self) -> Value {
        match self.below(9) {
            0 => Value::Null,
            1 => Value::Bool(true),
            2 => Value::text(["", "a", "uniform", "horizon", "custom", "NaN", "bridging"][self.below(7)]),
            3 => Value::List(vec![]),
            4 => Value::Map(vec![]),
            5 => Value::List((0..self.below(4)).map(|_| Value::Number(self.extreme())).collect()),
            6 => Value::Number(self.below(2000) as f64),
            _ => Value::Number(self.extreme()),
        }
    }

    /// Something, anywhere in the tree, is not as it should be.
    fn corrupt(&mut self, value: &mut Value) {
        match value {
            Value::Map(entries) if !entries.is_empty() && self.chance(0.9) => {
                let i = self.below(entries.len());
                match self.below(12) {
                    0 => drop(entries.remove(i)),
                    1 => entries[i].0 = format!("{}x", entries[i].0).into(),
                    2 => entries.push(entries[i].clone()),
                    _ => self.corrupt(&mut entries[i].1),
                }
            }
            Value::List(items) if !items.is_empty() && self.chance(0.9) => {
                let i = self.below(items.len());
                match self.below(12) {
                    0 => drop(items.remove(i)),
                    1 => items.push(items[i].clone()),
                    _ => self.corrupt(&mut items[i]),
                }
            }
            Value::Number(x) if self.chance(0.5) => *x *= 10f64.powf(self.within(-30.0, 30.0)),
            _ => *value = self.junk(),
        }
    }

    fn choice(&mut self) -> Choice {
        Choice {
            kind: self.below(KINDS.len()),
            dimensions: 1 + self.below(3),
            candidates: self.chance(0.3),
            matrix: self.chance(0.2),
            own_arrivals: self.chance(0.4),
            missing: false,
            own_noise: false,
            endpoints: self.below(3),
            none: self.chance(0.5),
            steps: 2,
            seed: self.0,
        }
    }

    fn scenario(&mut self) -> Value {
        let mut scenario = if self.chance(0.15) {
            let target = |i: usize, draw: &mut Self| PointerTarget {
                id: format!("d{i}"),
                x: draw.within(0.0, 900.0),
                y: draw.within(0.0, 600.0),
                width: draw.within(10.0, 90.0),
                height: draw.within(10.0, 90.0),
            };
            let targets: Vec<_> = (0..4).map(|i| target(i, self)).collect();
            data(&pointer_scenario(&targets, PointerOptions::default()).unwrap())
        } else {
            let methods = [
                "pseudoObservation",
                "algorithm1",
                "algorithm2",
                "bridging",
                "singleFilter",
                "singleFilterApproximate",
            ];
            let mut scenario = self.choice().problem().scenario;
            scenario["method"] = json!(methods[self.below(6)]);
            if self.chance(0.3) {
                scenario["none"] = json!(0);
            }
            if self.chance(0.3) {
                scenario["arrival"]["type"] = json!("horizon");
            }
            if self.chance(0.2) && KINDS.contains(&scenario["motion"]["type"].as_str().unwrap()) {
                scenario.as_object_mut().unwrap().remove("initial");
                scenario["observation"].as_object_mut().unwrap().remove("matrix");
            }
            if self.chance(0.3) {
                scenario["observation"]["noise"] = json!(self.within(0.1, 2.0));
            }
            // in the order of the keys' names, whatever json! keeps: a seed is then the same case for good
            scenario.sort_all_objects();
            value(&scenario)
        };
        while self.chance(0.35) {
            self.corrupt(&mut scenario);
        }
        scenario
    }

    fn destination(&mut self, predictor: &Predictor) -> Value {
        let d = predictor.dimensions();
        let id = format!("d{}", self.below(7));
        let mut destination = if self.chance(0.5) {
            json!({ "id": id, "center": self.list(d, -6.0, 6.0), "size": self.within(0.1, 3.0) })
        } else {
            json!({ "id": id, "mean": self.list(d, -6.0, 6.0), "covariance": self.covariance(d, 1.0), "prior": self.within(0.0, 2.0) })
        };
        if self.chance(0.2) {
            destination["arrival"] = json!({ "type": "discrete", "times": self.list(3, 0.1, 9.0) });
        }
        destination.sort_all_objects();
        let mut destination = value(&destination);
        if self.chance(0.2) {
            self.corrupt(&mut destination);
        }
        destination
    }

    /// One call; what it returns does not matter.
    fn act(&mut self, predictor: &mut Predictor, time: &mut f64) -> whither::Result<()> {
        let id = format!("d{}", self.below(6));
        match self.below(24) {
            0..=10 => {
                let next = match self.below(12) {
                    0 => self.extreme(),
                    1 | 2 => *time,
                    3 => *time + 1e-4,
                    4 => *time - 1e-9,
                    _ => *time + self.within(0.0, 1.0),
                };
                let size = if self.chance(0.05) { 10f64.powf(self.within(-5.0, 52.0)) } else { 6.0 };
                let mut position: Vec<_> =
                    (0..predictor.axes()).map(|_| self.chance(0.95).then(|| self.within(-size, size))).collect();
                if self.chance(0.03) {
                    position = (0..self.below(5)).map(|_| Some(self.extreme())).collect();
                }
                let noise = match self.below(10) {
                    0 => Some(self.junk()),
                    1 => Some(value(&json!(self.covariance(predictor.axes(), 1.0)))),
                    _ => None,
                };
                let noise = noise.map(|noise| whither::internals::noise(&noise, predictor.axes())).transpose()?;
                predictor.observe_with(next, &position, noise.as_ref())?;
                *time = next;
            }
            11 => drop(predictor.arrival(self.chance(0.5).then_some(&*id))?),
            12 => {
                drop(predictor.forecast(
                    *time + self.within(-0.1, 5.0).max(if self.chance(0.1) { self.extreme() } else { 0.0 }),
                )?)
            }
            13 => drop(predictor.path(&id, &[*time, *time + self.within(-0.1, 3.0)])?),
            14 => {
                let destination = self.destination(predictor);
                whither::internals::add_destination(predictor, &destination)?;
            }
            15 => {
                let destination = self.destination(predictor);
                whither::internals::update_destination(predictor, &id, &destination)?;
            }
            16 => predictor.remove_destination(&id)?,
            17 => {
                let list = (0..1 + self.below(5)).map(|_| self.destination(predictor)).collect();
                whither::internals::set_destinations(predictor, &Value::List(list))?;
            }
            18 if self.chance(0.3) => predictor.reset(),
            19 => *predictor = predictor.clone(),
            20 => {
                let text = serde_json::to_string(&predictor.snapshot()).unwrap();
                let mut restored = Predictor::restore(&serde_json::from_str(&text).unwrap()).expect("its own snapshot");
                assert_eq!(restored.snapshot(), predictor.snapshot(), "restored");
                assert_eq!(restored.probabilities(), predictor.probabilities(), "restored");
                *predictor = restored;
            }
            21 => {
                let text = serde_json::to_string(&predictor.snapshot()).unwrap();
                let mut damaged = serde_json::from_str(&text).unwrap();
                self.corrupt(&mut damaged);
                drop(Predictor::restore(&whither::internals::snapshot(damaged)));
            }
            22 => drop(predictor.log_likelihoods().to_vec()),
            _ => drop((predictor.remaining(), predictor.best())),
        }
        Ok(())
    }
}

fn sound(predictor: &mut Predictor) {
    let none = predictor.none();
    let probabilities = predictor.probabilities();
    assert!((0.0..=1.0).contains(&none), "none {none}");
    assert!(probabilities.iter().all(|p| (0.0..=1.0).contains(p)), "{probabilities:?}");
    let sum: f64 = probabilities.iter().sum();
    assert!((sum + none - 1.0).abs() < 1e-9, "{probabilities:?} and {none}");
    assert!(predictor.log_likelihoods().iter().all(|l| !l.is_nan() && *l < f64::INFINITY), "log likelihoods");
    let state = |what: &str, gaussian: Option<Gaussian>| {
        if let Some(Gaussian { mean, covariance }) = gaussian {
            assert!(mean.iter().all(|x| x.is_finite()), "{what} {mean}");
            let fine = |x: &f64| x.is_finite() && *x >= 0.0;
            assert!(covariance.diagonal().iter().all(fine), "{what} {covariance}");
        }
    };
    state("state", predictor.state());
    state("start", predictor.initial_state());
    if let Some(arrival) = predictor.arrival(None).unwrap() {
        let sum: f64 = arrival.probabilities.iter().sum();
        assert!(
            (sum - 1.0).abs() < 1e-9 && arrival.mean.is_finite() && arrival.deviation >= 0.0,
            "arrival {arrival:?}"
        );
    }
}

/// Whether a predictor could be made.
fn run(seed: u64) -> bool {
    let mut draw = Draw(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    draw.unit();
    let scenario = draw.scenario();
    let Ok(read) = whither::internals::scenario(&scenario) else { return false };
    let mut predictor = Predictor::new(&read);
    let again = whither::internals::scenario(&data(&read)).expect("what was written is read");
    assert_eq!(data(&again), data(&read), "a scenario written and read again");
    let mut time = draw.within(-5.0, 5.0);
    for _ in 0..4 + draw.below(25) {
        let before = predictor.snapshot();
        if draw.act(&mut predictor, &mut time).is_err() {
            assert_eq!(predictor.snapshot(), before, "what is refused changes nothing");
        }
        sound(&mut predictor);
    }
    true
}

/// What once broke one: log likelihoods that were infinite, probabilities a bit above one.
#[test]
fn what_once_broke_a_predictor_does_not() {
    for seed in [26_643_139_591, 25_049_123_538, 25_049_222_097] {
        assert!(run(seed));
    }
}

#[test]
fn nothing_breaks_a_predictor() {
    let setting = |name: &str| std::env::var(name).ok().map(|text| text.parse::<u64>().expect("an integer"));
    if let Some(seed) = setting("WHITHER_FUZZ_SEED") {
        run(seed);
        return;
    }
    let long = setting("WHITHER_FUZZ_SECONDS").map(Duration::from_secs);
    // a long run takes other cases each time
    let first = if long.is_some() { std::process::id() as u64 * 1_000_003 } else { 0 };
    let begun = Instant::now();
    let (mut made, mut failed) = (0u64, Vec::new());
    for seed in first.. {
        if long.map_or(seed - first >= CASES, |long| begun.elapsed() >= long) || failed.len() >= 12 {
            println!("{} cases from {first}, {made} of them with a predictor", seed - first);
            break;
        }
        match catch_unwind(AssertUnwindSafe(|| run(seed))) {
            Ok(predictor) => made += u64::from(predictor),
            Err(panic) => {
                let message = panic.downcast_ref::<String>().cloned();
                let message = message.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
                failed.push(format!("WHITHER_FUZZ_SEED={seed}: {}", message.unwrap_or_default()));
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(made > 100, "{made} predictors");
}
