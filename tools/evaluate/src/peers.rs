//! Other predictors, on the same samples. Each names its most likely target; none of them has probabilities that
//! sum to one.

use whither::study::track::{Target, Track, distance};

/// The grid of linear extrapolation: how many samples the velocity is taken over, and how far ahead, in seconds. A hand in
/// mid-air is at its best with the longest.
const SAMPLES: [usize; 4] = [2, 3, 4, 8];
const AHEAD: [f64; 6] = [0.03, 0.06, 0.12, 0.2, 0.4, 0.6];

/// How far ahead for vessels and aircraft, whose samples lie seconds apart.
const FAR_AHEAD: [f64; 4] = [60.0, 300.0, 1200.0, 3600.0];

/// The rule of one other predictor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Peer {
    /// The nearest target.
    Nearest,
    /// The target whose direction is nearest to the direction of the last movement.
    Bearing,
    /// The target nearest to where a straight line leads.
    Extrapolation { samples: usize, ahead: f64 },
    /// intently (github.com/seangeng/intently, src/predict.ts and src/core.ts): the larger of a proximity score,
    /// (1 - distance to the box / 80 px)^2, and a trajectory score, the cosine between the smoothed velocity and the way to
    /// the centre, scaled from .6 to 1 and weighted by the speed. It acts on the target with the highest.
    Intently,
    /// premonish 1.0.4 (npm, src/index.js): the target with the corner nearest to x + 100 (1 + v)^2 sign(v), axis by axis,
    /// v the velocity of the last step in px/ms, clamped to the window.
    Premonish,
}

impl Peer {
    /// All of them; extrapolation at every point of its grid.
    pub fn all() -> Vec<Self> {
        let ahead = AHEAD.into_iter().chain(FAR_AHEAD);
        let grid = ahead.flat_map(|ahead| SAMPLES.map(|samples| Self::Extrapolation { samples, ahead }));
        [Self::Nearest, Self::Bearing, Self::Intently, Self::Premonish].into_iter().chain(grid).collect()
    }

    /// As the table calls it.
    pub fn name(self) -> String {
        match self {
            Self::Nearest => "nearest".to_owned(),
            Self::Bearing => "bearing".to_owned(),
            Self::Extrapolation { samples, ahead } if ahead < 1.0 => {
                format!("extrapolation, {samples} samples, {} ms", 1000.0 * ahead)
            }
            Self::Extrapolation { samples, ahead } => format!("extrapolation, {samples} samples, {ahead} s"),
            Self::Intently => "intently's rule".to_owned(),
            Self::Premonish => "premonish's rule".to_owned(),
        }
    }

    /// Whether its rule applies to tracks like this one.
    pub fn applies(self, track: &Track) -> bool {
        match self {
            Self::Intently | Self::Premonish => track.dimensions() == 2,
            Self::Extrapolation { ahead, .. } if ahead >= 1.0 => {
                let duration = track.samples.last().zip(track.samples.first()).map_or(0.0, |(b, a)| b.time - a.time);
                duration > track.samples.len() as f64
            }
            _ => true,
        }
    }

    /// Its most likely target after each of the first `length` samples.
    pub fn tops(self, track: &Track, length: usize) -> Vec<Option<usize>> {
        match self {
            Self::Intently => intently(track, length),
            Self::Premonish => premonish(track, length),
            _ => (0..length).map(|k| self.top(track, k)).collect(),
        }
    }

    fn top(self, track: &Track, k: usize) -> Option<usize> {
        let here = &track.samples[k].position;
        let back = match self {
            Self::Extrapolation { samples, .. } => k.saturating_sub(samples - 1),
            _ => k.saturating_sub(1),
        };
        let past = &track.samples[back];
        let interval = track.samples[k].time - past.time;
        let way: Vec<f64> = here.iter().zip(&past.position).map(|(now, then)| now - then).collect();
        match self {
            Self::Bearing => {
                let moved = way.iter().map(|w| w * w).sum::<f64>().sqrt();
                if moved == 0.0 {
                    return least(track, |target| distance(&target.center, here));
                }
                least(track, |target| {
                    let offset = target.center.iter().zip(here).map(|(c, x)| c - x);
                    let along: f64 = offset.zip(&way).map(|(r, w)| r * w).sum();
                    -along / (moved * distance(&target.center, here).max(1e-9))
                })
            }
            Self::Extrapolation { ahead, .. } if interval > 0.0 => {
                let end: Vec<f64> = here.iter().zip(&way).map(|(x, w)| x + w / interval * ahead).collect();
                least(track, |target| distance(&target.center, &end))
            }
            _ => least(track, |target| distance(&target.center, here)),
        }
    }
}

/// The target of the smallest cost, the first of equals.
pub fn least(track: &Track, cost: impl Fn(&Target) -> f64) -> Option<usize> {
    let mut best: Option<(usize, f64)> = None;
    for (i, target) in track.targets.iter().enumerate() {
        let cost = cost(target);
        if best.is_none_or(|(_, lowest)| cost < lowest) {
            best = Some((i, cost));
        }
    }
    best.map(|(i, _)| i)
}

fn intently(track: &Track, length: usize) -> Vec<Option<usize>> {
    const RADIUS: f64 = 80.0;
    const CONE: f64 = 0.6;
    const SMOOTHING: f64 = 0.7;
    let mut velocity = [0.0; 2]; // px/ms
    let mut tops = Vec::with_capacity(length);
    for k in 0..length {
        let sample = &track.samples[k];
        let here = &sample.position;
        if k > 0 {
            let last = &track.samples[k - 1];
            let interval = (1000.0 * (sample.time - last.time)).max(1.0);
            for j in 0..2 {
                velocity[j] = SMOOTHING * velocity[j] + (1.0 - SMOOTHING) * (here[j] - last.position[j]) / interval;
            }
        }
        let speed = f64::hypot(velocity[0], velocity[1]);
        let top = least(track, |target| {
            let outside = |j: usize| ((here[j] - target.center[j]).abs() - target.size[j] / 2.0).max(0.0);
            let proximity = (1.0 - f64::hypot(outside(0), outside(1)) / RADIUS).max(0.0).powi(2);
            let offset = [target.center[0] - here[0], target.center[1] - here[1]];
            let far = f64::hypot(offset[0], offset[1]).max(f64::MIN_POSITIVE);
            let aligned = (offset[0] * velocity[0] + offset[1] * velocity[1]) / (far * speed);
            let trajectory = if speed < 0.04 || aligned <= CONE {
                0.0
            } else {
                (aligned - CONE) / (1.0 - CONE) * (0.6 + 0.4 * (speed / 0.6).min(1.0))
            };
            -proximity.max(trajectory)
        });
        tops.push(top);
    }
    tops
}

fn premonish(track: &Track, length: usize) -> Vec<Option<usize>> {
    // The window is not recorded: the smallest one from the origin that holds all targets and samples.
    let corner = |target: &Target, j: usize| target.center[j] + target.size[j] / 2.0;
    let edge = |j: usize| {
        let targets = track.targets.iter().map(|target| corner(target, j));
        targets.chain(track.samples.iter().map(|sample| sample.position[j])).fold(0.0, f64::max)
    };
    let window = [edge(0), edge(1)];
    (0..length)
        .map(|k| {
            let (last, now) = (&track.samples[k.saturating_sub(1)], &track.samples[k]);
            let interval = 1000.0 * (now.time - last.time);
            let aim: [f64; 2] = std::array::from_fn(|j| {
                let velocity = if interval > 0.0 { (now.position[j] - last.position[j]) / interval } else { 0.0 };
                let sign = if velocity == 0.0 { 0.0 } else { velocity.signum() };
                (now.position[j] + 100.0 * (1.0 + velocity).powi(2) * sign).clamp(0.0, window[j])
            });
            least(track, |target| {
                let nearest_corner = |j: usize| ((aim[j] - target.center[j]).abs() - target.size[j] / 2.0).abs();
                f64::hypot(nearest_corner(0), nearest_corner(1))
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(samples: &str) -> Track {
        serde_json::from_str(&format!(
            r#"{{"targets": [[0, 0, 20, 20], [100, 0, 20, 20], [300, 0, 20, 20], [0, 300, 20, 20]], "target": 2,
                "samples": {samples}}}"#
        ))
        .expect("a track")
    }

    #[test]
    fn a_fast_movement_to_the_right_is_told_as_each_rule_would() {
        // 2 px/ms to the right
        let track = track("[[0, 0, 0], [0.01, 20, 0], [0.02, 40, 0]]");
        let top = |peer: Peer| peer.tops(&track, 3)[2];
        assert_eq!(top(Peer::Nearest), Some(0));
        assert_eq!(top(Peer::Bearing), Some(1), "both are straight ahead, the first counts");
        assert_eq!(top(Peer::Extrapolation { samples: 2, ahead: 0.03 }), Some(1)); // 40 + 60
        assert_eq!(top(Peer::Extrapolation { samples: 3, ahead: 0.12 }), Some(2)); // 40 + 240
        assert_eq!(top(Peer::Premonish), Some(2)); // 40 + 100 * 9, clamped to 310
        assert_eq!(top(Peer::Intently), Some(1)); // trajectory 1 for both, the first counts
    }

    #[test]
    fn far_ahead_is_for_slow_things() {
        let far = Peer::Extrapolation { samples: 2, ahead: 60.0 };
        assert!(!far.applies(&track("[[0, 0, 0], [0.01, 20, 0], [0.02, 40, 0]]")));
        let vessel = track("[[0, 0, 0], [30, 20, 0], [60, 40, 0]]");
        assert!(far.applies(&vessel) && Peer::Extrapolation { samples: 2, ahead: 0.2 }.applies(&vessel));
        assert_eq!(far.tops(&vessel, 3)[2], Some(1)); // 40 + 40
    }

    #[test]
    fn at_rest_every_rule_falls_back_to_what_is_near() {
        let track = track("[[0, 12, 290], [0.5, 12, 290]]");
        for peer in Peer::all() {
            assert_eq!(peer.tops(&track, 2)[1], Some(3), "{}", peer.name());
        }
    }
}
