//! The same movements under other circumstances: few and many targets, small and wide ones, other sample rates and pixels.
//! Whatever is drawn is drawn by a seed.

use whither::study::simulate::Random;
use whither::study::track::{Sample, Target, Track};

/// What is changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Variant {
    /// Nothing.
    Recorded,
    /// So many targets: the true one and others of the recorded ones by chance; where there are too few, more of the true
    /// one's size anywhere in the smallest rectangle that holds the recorded targets and samples, free of the others if 100
    /// tries find such a place.
    Targets(usize),
    /// The true target and twelve of its size anywhere in the plane of the recorded ones about the start of the movement, free of each
    /// other, between so many and so many times as far from the start as the true one.
    Around([f64; 2]),
    /// All targets of this width and height, where they are.
    Size([f64; 2]),
    /// A list: rows of this width and height one under the other, as many as there were targets. The true one keeps its
    /// height above ground, is any row of the list, and is entered anywhere in the middle four fifths of its width.
    List([f64; 2]),
    /// The sides of every target, each by itself, times .5 to 4, evenly in their logarithm.
    Mixed,
    /// Every n-th sample, and the entry.
    Every(usize),
    /// Every n-th sample of a track that never enters its target, to its end.
    Complete(usize),
    /// So many samples a second: a Catmull-Rom spline through the recorded ones, rounded to units of length.
    Rate(f64),
    /// All lengths times this.
    Scale(f64),
}

/// The targets of [`Variant::Around`].
pub const AROUND: usize = 13;

/// The rows of the table.
pub const ALL: [Variant; 14] = [
    Variant::Recorded,
    Variant::Targets(5),
    Variant::Targets(12),
    Variant::Targets(21),
    Variant::Targets(60),
    Variant::Targets(200),
    Variant::Size([300.0, 24.0]),
    Variant::List([300.0, 24.0]),
    Variant::Mixed,
    Variant::Every(2),
    Variant::Every(4),
    Variant::Rate(8000.0),
    Variant::Scale(0.5),
    Variant::Scale(2.0),
];

impl Variant {
    /// As the table calls it.
    pub fn name(self) -> String {
        match self {
            Self::Recorded => "as recorded".to_owned(),
            Self::Targets(count) => format!("{count} targets"),
            Self::Around([low, high]) => format!("12 others {low} to {high} times as far"),
            Self::Size([width, height]) => format!("{width} x {height}, in place"),
            Self::List([width, height]) => format!("a list of {width} x {height}"),
            Self::Mixed => "mixed sizes".to_owned(),
            Self::Every(2) => "every second sample".to_owned(),
            Self::Every(step) => format!("every {step}th sample"),
            Self::Complete(_) => "to its end".to_owned(),
            Self::Rate(rate) => format!("{} kHz", rate / 1000.0),
            Self::Scale(scale) => format!("pixels x{scale}"),
        }
    }

    /// The changed track and how many samples its approach has; none where it has no approach any more.
    pub fn of(self, track: &Track, seed: u64) -> Option<(Track, usize)> {
        let mut track = track.clone();
        let mut random = Random::new(seed);
        match self {
            Self::Recorded => {}
            Self::Targets(count) => choose(&mut track, count, &mut random),
            Self::Around(range) => around(&mut track, range, &mut random),
            Self::Size(size) => track.targets.iter_mut().for_each(|target| target.size = size.to_vec()),
            Self::List(size) => list(&mut track, size, &mut random),
            Self::Mixed => {
                let sides = track.targets.iter_mut().flat_map(|target| &mut target.size);
                sides.for_each(|side| *side *= 0.5 * 8f64.powf(random.uniform()));
            }
            Self::Every(step) => {
                track.samples = thin(&track.samples[..track.approach()?], step);
                let length = track.samples.len();
                return Some((track, length));
            }
            Self::Complete(step) => {
                track.samples = track.samples.iter().step_by(step).cloned().collect();
                let length = track.samples.len();
                return Some((track, length));
            }
            Self::Rate(rate) => track.samples = resample(&track.samples, 1.0 / rate),
            Self::Scale(scale) => {
                let sides =
                    track.targets.iter_mut().flat_map(|target| target.center.iter_mut().chain(&mut target.size));
                let positions = track.samples.iter_mut().flat_map(|sample| &mut sample.position);
                sides.chain(positions).for_each(|length| *length *= scale);
            }
        }
        let approach = track.approach()?;
        Some((track, approach))
    }
}

/// Every n-th sample, and the last.
pub fn thin(samples: &[Sample], step: usize) -> Vec<Sample> {
    let Some((last, others)) = samples.split_last() else { return Vec::new() };
    others.iter().step_by(step).chain([last]).cloned().collect()
}

/// Any index below `count`.
fn below(random: &mut Random, count: usize) -> usize {
    (random.uniform() * count as f64) as usize
}

fn choose(track: &mut Track, count: usize, random: &mut Random) {
    let truth = track.targets.swap_remove(track.target);
    let bounds: Vec<[f64; 2]> = (0..truth.center.len())
        .map(|j| {
            let edges = track.targets.iter().chain([&truth]).flat_map(|target| {
                let half = target.size[j] / 2.0;
                [target.center[j] - half, target.center[j] + half]
            });
            let all = edges.chain(track.samples.iter().map(|sample| sample.position[j]));
            all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        })
        .collect();
    let mut others = std::mem::take(&mut track.targets);
    while others.len() >= count {
        others.swap_remove(below(random, others.len()));
    }
    while others.len() + 1 < count {
        let mut place = Target { center: Vec::new(), size: truth.size.clone() };
        for _ in 0..100 {
            let sides = bounds.iter().zip(&truth.size);
            place.center = sides
                .map(|([low, high], side)| low + side / 2.0 + random.uniform() * (high - low - side).max(0.0))
                .collect();
            if others.iter().chain([&truth]).all(|other| !overlap(other, &place)) {
                break;
            }
        }
        others.push(place);
    }
    track.target = below(random, count);
    others.insert(track.target, truth);
    track.targets = others;
}

fn around(track: &mut Track, [low, high]: [f64; 2], random: &mut Random) {
    let width = |j: usize| {
        let centers = track.targets.iter().map(|target| target.center[j]);
        centers.clone().fold(f64::MIN, f64::max) - centers.fold(f64::MAX, f64::min)
    };
    let mut axes: Vec<usize> = (0..track.dimensions()).collect();
    axes.sort_by(|a, b| width(*b).total_cmp(&width(*a)));
    let truth = track.targets.swap_remove(track.target);
    let start = &track.samples[0].position;
    let offsets = truth.center.iter().zip(start).map(|(a, b)| (a - b).powi(2));
    let far = offsets.sum::<f64>().sqrt();
    let mut targets = vec![truth.clone()];
    while targets.len() < AROUND {
        let mut place = truth.clone();
        for _ in 0..100 {
            let (way, angle) =
                (far * (low + (high - low) * random.uniform()), std::f64::consts::TAU * random.uniform());
            let (y, x) = angle.sin_cos();
            axes.iter().zip([x, y]).for_each(|(&axis, share)| place.center[axis] = start[axis] + way * share);
            if targets.iter().all(|other| !overlap(other, &place)) {
                break;
            }
        }
        targets.push(place);
    }
    (track.target, track.targets) = (0, targets);
}

fn overlap(one: &Target, two: &Target) -> bool {
    let sides = one.size.iter().zip(&two.size);
    one.center.iter().zip(&two.center).zip(sides).all(|((a, b), (v, w))| (a - b).abs() < (v + w) / 2.0)
}

fn list(track: &mut Track, [width, height]: [f64; 2], random: &mut Random) {
    let row = below(random, track.targets.len());
    let [x, y] = [0, 1].map(|j| track.targets[track.target].center[j]);
    let x = x + 0.8 * width * (random.uniform() - 0.5);
    for (i, target) in track.targets.iter_mut().enumerate() {
        target.center = vec![x, y + (i as f64 - row as f64) * height];
        target.size = vec![width, height];
    }
    track.target = row;
}

/// The spline at evenly spaced times, rounded, and at the last sample.
pub fn resample(samples: &[Sample], interval: f64) -> Vec<Sample> {
    let (Some(first), Some(last)) = (samples.first(), samples.last()) else { return Vec::new() };
    let count = ((last.time - first.time) / interval).floor() as usize;
    let mut dense = Vec::with_capacity(count + 2);
    let mut k = 0;
    for i in 0..=count {
        let time = first.time + i as f64 * interval;
        while k + 2 < samples.len() && samples[k + 1].time <= time {
            k += 1;
        }
        let [a, b, c, d] = [k.saturating_sub(1), k, k + 1, k + 2].map(|n| &samples[n.min(samples.len() - 1)]);
        let step = c.time - b.time;
        let u = if step > 0.0 { ((time - b.time) / step).clamp(0.0, 1.0) } else { 0.0 };
        // the velocity at a recorded sample is that between its neighbours
        let slope = |from: &Sample, to: &Sample, j: usize| {
            let span = to.time - from.time;
            if span > 0.0 { (to.position[j] - from.position[j]) / span * step } else { 0.0 }
        };
        let at = |j: usize| {
            let (from, to) = (b.position[j], c.position[j]);
            let (out, into) = (slope(a, c, j), slope(b, d, j));
            let way = u * u * (3.0 - 2.0 * u);
            from + way * (to - from) + u * (1.0 - u) * ((1.0 - u) * out - u * into)
        };
        let position = (0..b.position.len()).map(|j| at(j).round()).collect();
        dense.push(Sample { time, position, missing: vec![] });
    }
    if dense.last().is_some_and(|sample| sample.time < last.time) {
        dense.push(last.clone());
    }
    dense
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn track() -> Track {
        serde_json::from_str(
            r#"{"targets": [[0, 0, 20, 20], [100, 0, 20, 20], [300, 100, 20, 20], [0, 300, 20, 20]], "target": 2,
                "samples": [[0, 150, 0], [0.1, 180, 20], [0.2, 240, 60], [0.3, 285, 90], [0.4, 296, 99], [0.5, 300, 100]]}"#,
        )
        .unwrap()
    }

    #[test]
    fn the_true_target_stays_where_it_is_among_few_and_many() {
        for count in [2, 4, 5, 60] {
            for seed in 0..20 {
                let (changed, approach) = Variant::Targets(count).of(&track(), seed).unwrap();
                assert_eq!((changed.targets.len(), approach), (count, 5));
                assert_eq!(changed.targets[changed.target], track().targets[2]);
            }
        }
        let (many, _) = Variant::Targets(60).of(&track(), 1).unwrap();
        let pairs = (0..60).flat_map(|i| (0..i).map(move |j| (i, j)));
        let overlaps = pairs.filter(|&(i, j)| overlap(&many.targets[i], &many.targets[j])).count();
        assert_eq!(overlaps, 0);
        assert!(many.targets.iter().all(|t| t.center[0] >= 0.0 && t.center[0] <= 300.0 && t.center[1] <= 300.0));
        let places = |seed| Variant::Targets(9).of(&track(), seed).unwrap().0;
        assert_eq!(places(3), places(3));
        assert_ne!(places(3), places(4));
    }

    #[test]
    fn others_lie_around_the_start_as_far_as_is_stated() {
        let (changed, approach) = Variant::Around([0.5, 2.0]).of(&track(), 3).unwrap();
        assert_eq!((changed.targets.len(), changed.target, approach), (13, 0, 5));
        assert_eq!(changed.targets[0], track().targets[2]);
        let far = |target: &Target| (target.center[0] - 150.0).hypot(target.center[1]);
        let truth = far(&changed.targets[0]);
        assert!(changed.targets.iter().all(|target| (0.5..=2.0).contains(&(far(target) / truth))));
    }

    #[test]
    fn a_list_has_its_rows_one_under_the_other_and_is_entered_in_the_true_one() {
        for seed in 0..50 {
            let (changed, approach) = Variant::List([300.0, 24.0]).of(&track(), seed).unwrap();
            assert!(changed.targets.windows(2).all(|rows| rows[1].center[1] - rows[0].center[1] == 24.0));
            assert!(changed.targets[changed.target].contains(&changed.samples[approach - 1].position));
            assert_eq!(changed.targets[changed.target].center[1], 100.0);
        }
    }

    #[test]
    fn sizes_samples_and_lengths_change_as_their_names_say() {
        let (mixed, _) = Variant::Mixed.of(&track(), 1).unwrap();
        let sides: Vec<f64> = mixed.targets.iter().flat_map(|target| target.size.clone()).collect();
        assert!(sides.iter().all(|side| (10.0..=80.0).contains(side)) && sides[0] != sides[1]);
        let (half, approach) = Variant::Every(2).of(&track(), 1).unwrap();
        let times: Vec<f64> = half.samples.iter().map(|sample| sample.time).collect();
        assert_eq!((times, approach), (vec![0.0, 0.2, 0.4], 3));
        let (large, approach) = Variant::Scale(2.0).of(&track(), 1).unwrap();
        assert_eq!(
            (&large.targets[2].center[..], &large.targets[2].size[..], approach),
            (&[600.0, 200.0][..], &[40.0; 2][..], 5)
        );
        assert_eq!(large.samples[1].position, [360.0, 40.0]);
        assert_eq!(Variant::Recorded.of(&track(), 1).unwrap(), (track(), 5));
    }

    #[test]
    fn a_faster_mouse_goes_through_the_recorded_samples() {
        let (fast, approach) = Variant::Rate(1000.0).of(&track(), 1).unwrap();
        assert_eq!(fast.samples.len(), 501);
        for (k, sample) in track().samples.iter().enumerate() {
            assert_eq!(fast.samples[100 * k].position, sample.position);
        }
        assert!(fast.samples.windows(2).all(|pair| pair[1].time - pair[0].time < 0.0011));
        assert!(fast.samples[approach - 1].time > 0.3 && fast.samples[approach - 1].time < 0.4);
    }
}
