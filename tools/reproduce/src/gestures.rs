//! Freehand pointing in three dimensions, in metres: simulated in a car, and recorded in mid-air where the recordings are there.

use crate::movement::{Movement, scenario};
use crate::random::Normals;
use nalgebra::Vector3;
use serde_json::json;
use std::f64::consts::{PI, TAU};
use std::path::Path;
use whither::Scenario;

/// One pointing gesture and everything that could have been its target: centre and size in metres.
pub struct Gesture {
    pub movement: Movement,
    pub targets: Vec<[f64; 4]>,
}

/// The predictor: constant velocity in three dimensions.
pub fn predictor_of(targets: &[[f64; 4]], method: &str, noise: f64) -> Scenario {
    scenario(json!({
        "motion": { "type": "constantVelocity", "dimensions": 3, "noise": noise },
        "observation": { "noise": 0.003 },
        "initial": { "velocity": 1 },
        "arrival": { "type": "uniform", "from": 0.4, "to": 1.6 },
        "quadrature": { "rule": "simpson", "points": 15 },
        "method": method,
        "destinations": targets.iter().enumerate().map(|(i, target)| json!({
            "id": format!("D{}", i + 1), "center": target[..3], "size": target[3],
        })).collect::<Vec<_>>(),
    }))
}

/// What was assumed of the predictor.
pub const PREDICTOR: &str = "The predictor: metres and seconds, an endpoint of position only with the target's size, an arrival time of U(0.4 s, 1.6 s) after the first observation with Simpson's rule and q = 15, observations with a deviation of 3 mm, 1 m/s for the velocity at the start.";

/// What was assumed of the simulated gestures.
pub const SIMULATION: &str = "Simulated gestures at 50 Hz: from a hand at about 0.45 m in front of the screen, minimum jerk to a first endpoint, in 70% of the time, that falls short by 4% of the way and misses by 6% along and 2.5% across it, a second one to the target from 55% of the time on, a sideways bow of 3%, tremor at 8 to 11 Hz (0.7 mm), road vibration that resonates at 4 Hz (2 mm), tracker noise of 2 mm; their duration by Fitts's law, 0.3 s + 0.12 s log2(D/W + 1), with 20% spread. 21 icons of 24 mm, 7 by 3, 40 mm apart.";

/// The icons on the dashboard's screen, 7 by 3, in the plane z = 0.
pub fn icons() -> Vec<[f64; 4]> {
    (0..21).map(|i| [0.04 * f64::from(i % 7 - 3), 0.04 * f64::from(1 - i / 7), 0.0, 0.024]).collect()
}

/// Gestures to random icons.
pub fn simulated(count: usize, seed: u64) -> Vec<Gesture> {
    let mut random = Normals::new(seed);
    (0..count)
        .map(|_| {
            let targets = icons();
            let truth = (random.between(0.0, 21.0) as usize).min(20);
            let start = vector(&mut random, 0.06) + Vector3::new(-0.05, -0.18, 0.42);
            Gesture { movement: gesture(start, &targets, truth, &mut random), targets }
        })
        .collect()
}

/// One gesture of a hand in a moving car.
pub fn gesture(start: Vector3<f64>, targets: &[[f64; 4]], truth: usize, random: &mut Normals) -> Movement {
    const RATE: f64 = 50.0;
    let [x, y, z, size] = targets[truth];
    let end = Vector3::new(x, y, z) + vector(random, size / 8.0);
    let way = end - start;
    let duration = (0.3 + 0.12 * (way.norm() / size + 1.0).log2()) * (0.2 * random.draw()).exp();
    let first_end = end + vector(random, 0.025 * way.norm()) + way * (0.06 * random.draw() - 0.04);
    let bow = way.cross(&vector(random, 1.0)).normalize() * (0.03 * way.norm() * random.draw());
    let tremor: [(f64, f64); 3] = std::array::from_fn(|_| (random.between(8.0, 11.0), random.between(0.0, TAU)));
    let mut vibration = Vibration::new(4.0, 0.25, 1.0 / RATE);
    let shake = Vector3::new(0.001, 0.0015, 0.001);
    for _ in 0..200 {
        vibration.next(random);
    }
    let samples = (duration * RATE).ceil() as usize;
    let observed = (0..=samples).map(|k| {
        let t = k as f64 / RATE;
        let path = start
            + (first_end - start) * minimum_jerk(t / (0.7 * duration))
            + (end - first_end) * minimum_jerk((t / duration - 0.55) / 0.45)
            + bow * (PI * (t / duration).min(1.0)).sin();
        let hand = Vector3::from_fn(|i, _| 0.0007 * (TAU * tremor[i].0 * t + tremor[i].1).sin());
        let measured = path + hand + shake.component_mul(&vibration.next(random)) + vector(random, 0.002);
        (t, measured.as_slice().to_vec())
    });
    Movement { observations: observed.collect(), truth }
}

/// The share of the way at a share of the time (Flash and Hogan).
fn minimum_jerk(share: f64) -> f64 {
    let u = share.clamp(0.0, 1.0);
    u * u * u * (10.0 - 15.0 * u + 6.0 * u * u)
}

fn vector(random: &mut Normals, deviation: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| deviation * random.draw())
}

/// A damped oscillator driven by noise, of deviation one on each axis.
struct Vibration {
    now: Vector3<f64>,
    before: Vector3<f64>,
    coefficients: [f64; 2],
    drive: f64,
}

impl Vibration {
    fn new(frequency: f64, damping: f64, step: f64) -> Self {
        let omega = TAU * frequency;
        let decay = (-damping * omega * step).exp();
        let [a, b] = [2.0 * decay * (omega * (1.0 - damping * damping).sqrt() * step).cos(), -decay * decay];
        // the variance of x_k = a x_{k-1} + b x_{k-2} + e
        let variance = (1.0 - b) / ((1.0 + b) * ((1.0 - b) * (1.0 - b) - a * a));
        Self { now: Vector3::zeros(), before: Vector3::zeros(), coefficients: [a, b], drive: variance.sqrt().recip() }
    }

    fn next(&mut self, random: &mut Normals) -> Vector3<f64> {
        let next = self.now * self.coefficients[0] + self.before * self.coefficients[1] + vector(random, self.drive);
        self.before = std::mem::replace(&mut self.now, next);
        next
    }
}

/// Every `every`-th recorded gesture, in metres, if the folder that `RECORDINGS` names has them.
pub fn recorded(every: usize) -> Option<Vec<Gesture>> {
    let path = Path::new(&std::env::var_os("RECORDINGS")?).join("fitts3d_midair.jsonl");
    let text = std::fs::read_to_string(path).ok()?;
    text.lines().step_by(every).map(read).collect()
}

fn read(line: &str) -> Option<Gesture> {
    let track: serde_json::Value = serde_json::from_str(line).ok()?;
    let rows = |key: &str| -> Option<Vec<Vec<f64>>> {
        let numbers = |row: &serde_json::Value| row.as_array()?.iter().map(serde_json::Value::as_f64).collect();
        track.get(key)?.as_array()?.iter().map(numbers).collect()
    };
    let metres = |row: &[f64]| row.iter().map(|x| x / 1000.0).collect::<Vec<f64>>();
    let targets = rows("targets")?.iter().map(|row| metres(row).try_into().ok()).collect::<Option<_>>()?;
    let observations = rows("samples")?.iter().map(|row| (row[0], metres(&row[1..]))).collect();
    let truth = track.get("target")?.as_u64()? as usize;
    Some(Gesture { movement: Movement { observations, truth }, targets })
}
