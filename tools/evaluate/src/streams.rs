//! `--streams`: the same movements as other devices and busy pages report them, for `Predictor` and for `whither/dom`.
//!
//! Every row is scored at the moments of the recorded samples, by what is predicted from the events that have come until then.

use crate::node::Node;
use crate::reading::{self, Line};
use crate::variants::resample;
use presentation::table;
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use std::path::Path;
use whither::internals::{Value, track_scenario};
use whither::study::metrics::{Prediction, Score};
use whither::study::simulate::Random;
use whither::study::track::{Sample, Target, Track};
use whither::{Code, Predictor};

/// What comes at one time: samples with times of their own.
#[derive(Clone, Debug, PartialEq)]
struct Event {
    time: f64,
    samples: Vec<Sample>,
}

/// How a movement is reported.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stream {
    /// As recorded.
    Recorded,
    /// So many events a second, on whole units of length: a spline through the recorded samples.
    Rate(f64),
    /// Each event is lost with this probability.
    Dropped(f64),
    /// What came within this many seconds comes together at their end, each sample with its own time.
    Bunched(f64),
    /// The same, each sample with the time at which it comes.
    Stamped(f64),
    /// The same, one after the other by a millisecond.
    Burst(f64),
    /// Each event comes late by up to so many seconds, never before the one ahead of it, with the time at which it comes.
    Late(f64),
    /// A tenth of the events come this many seconds late, behind others, with their own times.
    Overtaken(f64),
    /// Nothing is reported for so many seconds, from any moment in the first half of the approach on.
    Gap(f64),
}

/// The rows of the table.
const ALL: [Stream; 20] = [
    Stream::Recorded,
    Stream::Rate(10.0),
    Stream::Rate(30.0),
    Stream::Rate(125.0),
    Stream::Rate(250.0),
    Stream::Rate(1000.0),
    Stream::Dropped(0.1),
    Stream::Dropped(0.5),
    Stream::Bunched(0.05),
    Stream::Bunched(0.1),
    Stream::Stamped(0.05),
    Stream::Stamped(0.1),
    Stream::Burst(0.05),
    Stream::Burst(0.1),
    Stream::Late(0.02),
    Stream::Late(0.05),
    Stream::Overtaken(0.05),
    Stream::Overtaken(0.15),
    Stream::Gap(0.2),
    Stream::Gap(0.4),
];

/// As tables have it.
fn milliseconds(seconds: f64) -> f64 {
    (1000.0 * seconds).round()
}

impl Stream {
    fn name(self) -> String {
        match self {
            Self::Recorded => "as recorded".to_owned(),
            Self::Rate(rate) => format!("{rate} Hz"),
            Self::Dropped(share) => format!("{}% dropped", 100.0 * share),
            Self::Bunched(every) => format!("bunched, every {} ms", milliseconds(every)),
            Self::Stamped(every) => format!("bunched, every {} ms, one time", milliseconds(every)),
            Self::Burst(every) => format!("bunched, every {} ms, times 1 ms apart", milliseconds(every)),
            Self::Late(most) => format!("late by up to {} ms, and timed late", milliseconds(most)),
            Self::Overtaken(delay) => format!("a tenth late by {} ms, overtaken", milliseconds(delay)),
            Self::Gap(length) => format!("a gap of {} ms", milliseconds(length)),
        }
    }

    /// The events of a movement whose approach has so many samples, in the order in which they come.
    fn of(self, track: &Track, approach: usize, seed: u64) -> Vec<Event> {
        let mut random = Random::new(seed);
        let start = track.samples[0].time;
        let alone = |sample: &Sample| Event { time: sample.time, samples: vec![sample.clone()] };
        let mut events: Vec<Event> = match self {
            Self::Rate(rate) => resample(&track.samples, 1.0 / rate).iter().map(alone).collect(),
            _ => track.samples.iter().map(alone).collect(),
        };
        let every = |every: f64, time: f64| start + ((time - start) / every - 1e-9).ceil().max(0.0) * every;
        match self {
            Self::Recorded | Self::Rate(_) => {}
            Self::Dropped(share) => events.retain(|_| random.uniform() >= share),
            Self::Bunched(length) => {
                events.iter_mut().for_each(|event| event.time = every(length, event.time));
                events = together(events);
            }
            Self::Stamped(length) => events.iter_mut().for_each(|event| retime(event, every(length, event.time))),
            Self::Burst(length) => {
                let mut last = f64::NEG_INFINITY;
                for event in &mut events {
                    last = every(length, event.time).max(last + 0.001);
                    retime(event, last);
                }
            }
            Self::Late(most) => {
                let mut last = f64::NEG_INFINITY;
                for event in &mut events {
                    last = (event.time + most * random.uniform()).max(last);
                    retime(event, last);
                }
            }
            Self::Overtaken(delay) => {
                for event in &mut events {
                    event.time += if random.uniform() < 0.1 { delay } else { 0.0 };
                }
                events.sort_by(|a, b| a.time.total_cmp(&b.time));
            }
            Self::Gap(length) => {
                let from = start + 0.5 * random.uniform() * (track.samples[approach - 1].time - start);
                events.retain(|event| event.time <= from || event.time >= from + length);
            }
        }
        events
    }
}

/// An event that has the time at which it comes.
fn retime(event: &mut Event, time: f64) {
    event.time = time;
    event.samples.iter_mut().for_each(|sample| sample.time = time);
}

/// Events of one time as one event.
fn together(events: Vec<Event>) -> Vec<Event> {
    let mut joined: Vec<Event> = Vec::new();
    for event in events {
        match joined.last_mut() {
            Some(last) if last.time == event.time => last.samples.extend(event.samples),
            _ => joined.push(event),
        }
    }
    joined
}

/// Of one stream.
#[derive(Clone, Debug, Default)]
struct Row {
    predictor: Score,
    dom: Score,
    /// How many movements the page took it for.
    movements: f64,
}

type Scored = (&'static str, Vec<Row>);

/// Runs all streams of a file's tracks; returns how many broken lines were skipped.
pub fn run(template: &Value, file: &Path, into: &mut Vec<Json>) -> Result<usize, String> {
    let mut sets: BTreeMap<String, Vec<Row>> = BTreeMap::new();
    let (name, page) = (reading::name(file), Node::new("streams.mjs"));
    let skipped = reading::each(
        file,
        |line| score(template, line, &page),
        |(part, rows)| {
            let sums = sets.entry(format!("{name}{part}")).or_insert_with(|| vec![Row::default(); ALL.len()]);
            sums.iter_mut().zip(&rows).for_each(|(sum, row)| sum.add(row));
        },
    )?;
    for (set, rows) in &sets {
        print(set, rows);
        into.push(json!({ "set": set, "rows": ALL.iter().zip(rows).map(|(stream, row)| row.json(*stream)).collect::<Vec<_>>() }));
    }
    Ok(skipped)
}

fn score(template: &Value, line: &Line, page: &Node) -> Result<Option<Scored>, String> {
    let track = line.track(0.0)?;
    let Some(approach) = track.approach().filter(|_| track.dimensions() == 2) else { return Ok(None) };
    let message = |error: whither::Error| error.to_string();
    let scenario = track_scenario(&track, template, &Value::Null).map_err(message)?;
    let mut rows = Vec::with_capacity(ALL.len());
    for (k, stream) in ALL.into_iter().enumerate() {
        let events = stream.of(&track, approach, (line.number * ALL.len() + k) as u64);
        let mut predictor = Predictor::new(&scenario);
        let predictions = predictions(&track, approach, &events, &mut predictor).map_err(message)?;
        let (on_page, movements) = on_page(&track, approach, &events, page)?;
        rows.push(Row { predictor: Score::of(&track, &predictions), dom: Score::of(&track, &on_page), movements });
    }
    Ok(Some((reading::part(&track), rows)))
}

/// What is predicted at each moment of the approach; what is earlier than what came before it is passed over.
fn predictions(
    track: &Track,
    approach: usize,
    events: &[Event],
    predictor: &mut Predictor,
) -> whither::Result<Vec<Prediction>> {
    let mut events = events.iter().peekable();
    let mut predictions = Vec::with_capacity(approach);
    for moment in &track.samples[..approach] {
        while let Some(event) = events.next_if(|event| event.time <= moment.time + 1e-9) {
            for sample in &event.samples {
                match sample.observe(predictor) {
                    Err(error) if error.code() != Code::TimeNotIncreasing => return Err(error),
                    _ => {}
                }
            }
        }
        let top = predictor.best().map(|best| best.index);
        let probabilities = predictor.probabilities();
        let chances =
            top.map_or([1.0 / probabilities.len() as f64; 2], |top| [probabilities[top], probabilities[track.target]]);
        predictions.push(Prediction { top, chances: Some(chances) });
    }
    Ok(predictions)
}

/// The same on a page that `whither/dom` watches, and how many movements it took it for.
fn on_page(track: &Track, approach: usize, events: &[Event], page: &Node) -> Result<(Vec<Prediction>, f64), String> {
    let sample = |sample: &Sample| json!([sample.time, sample.position[0], sample.position[1]]);
    let event = |event: &Event| json!([event.time, event.samples.iter().map(sample).collect::<Vec<_>>()]);
    let target = |target: &Target| [&target.center[..], &target.size[..]].concat();
    let answer = page.ask(&json!({
        "targets": track.targets.iter().map(target).collect::<Vec<_>>(),
        "target": track.target,
        "events": events.iter().map(event).collect::<Vec<_>>(),
        "moments": track.samples[..approach].iter().map(|sample| sample.time).collect::<Vec<_>>(),
    }))?;
    let (moments, movements): (Vec<(Option<usize>, f64, f64)>, f64) =
        serde_json::from_value(answer).map_err(|error| format!("streams.mjs: {error}"))?;
    let prediction = |(top, of_top, of_target)| Prediction { top, chances: Some([of_top, of_target]) };
    Ok((moments.into_iter().map(prediction).collect(), movements))
}

impl Row {
    fn add(&mut self, other: &Self) {
        self.predictor.add(&other.predictor);
        self.dom.add(&other.dom);
        self.movements += other.movements;
    }

    fn movements(&self) -> f64 {
        self.movements / self.dom.tracks.max(1.0)
    }

    fn json(&self, stream: Stream) -> Json {
        let of = |score: &Score| {
            let figures = score.figures();
            json!({ "time": figures.time, "loss": figures.loss, "calibration": figures.calibration })
        };
        json!({
            "stream": stream.name(), "tracks": self.predictor.tracks, "predictor": of(&self.predictor), "dom": of(&self.dom),
            "movements": self.movements(),
        })
    }
}

fn print(set: &str, rows: &[Row]) {
    let header = [
        "",
        "time %",
        "log loss",
        "calibration error",
        "whither/dom: time %",
        "log loss",
        "calibration error",
        "movements",
    ];
    let mut table = table(header, 1);
    for (stream, row) in ALL.iter().zip(rows) {
        let cells = |score: &Score| {
            let figures = score.figures();
            let [loss, calibration] = [figures.loss, figures.calibration].map(|x| format!("{:.3}", x.unwrap_or(0.0)));
            vec![format!("{:.1}", figures.time), loss, calibration]
        };
        table.add_row(
            [vec![stream.name()], cells(&row.predictor), cells(&row.dom), vec![format!("{:.2}", row.movements())]]
                .concat(),
        );
    }
    println!("\n{set}: {} tracks\n{table}", rows[0].predictor.tracks);
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Ten samples, 20 ms apart, the last one in its target.
    fn track() -> Track {
        let samples: Vec<String> = (0..=10).map(|k| format!("[{}, {}, 0]", 0.02 * f64::from(k), 10 * k)).collect();
        let text = format!(
            r#"{{"targets": [[0, 0, 10, 10], [100, 0, 10, 10]], "target": 1, "samples": [{}]}}"#,
            samples.join(",")
        );
        serde_json::from_str(&text).unwrap()
    }

    fn of(stream: Stream) -> Vec<Event> {
        stream.of(&track(), 11, 1)
    }

    /// The times at which events come, in milliseconds.
    fn times(events: &[Event]) -> Vec<f64> {
        events.iter().map(|event| milliseconds(event.time)).collect()
    }

    /// The times that samples have, in milliseconds.
    fn stamps(events: &[Event]) -> Vec<f64> {
        events.iter().flat_map(|event| &event.samples).map(|sample| milliseconds(sample.time)).collect()
    }

    #[test]
    fn what_is_bunched_comes_together_with_times_as_the_row_has_them() {
        let recorded = stamps(&of(Stream::Recorded));
        assert_eq!(recorded, (0..=10).map(|k| 20.0 * f64::from(k)).collect::<Vec<_>>());
        let bunched = of(Stream::Bunched(0.1));
        assert_eq!((times(&bunched), stamps(&bunched)), (vec![0.0, 100.0, 200.0], recorded));
        let stamped = of(Stream::Stamped(0.1));
        assert_eq!(stamps(&stamped), [vec![0.0], vec![100.0; 5], vec![200.0; 5]].concat());
        let burst = of(Stream::Burst(0.1));
        assert_eq!(times(&burst)[..7], [0.0, 100.0, 101.0, 102.0, 103.0, 104.0, 200.0]);
        assert_eq!(times(&burst), stamps(&burst));
    }

    #[test]
    fn late_events_keep_their_order_and_overtaken_ones_their_times() {
        let late = of(Stream::Late(0.05));
        assert_eq!(times(&late), stamps(&late));
        assert!(times(&late).is_sorted() && times(&late) != times(&of(Stream::Recorded)));
        let overtaken = (0..20).map(|seed| Stream::Overtaken(0.05).of(&track(), 11, seed));
        let unsorted = overtaken.filter(|events| times(events).is_sorted() && !stamps(events).is_sorted()).count();
        assert!(unsorted > 5, "{unsorted} of 20");
    }

    #[test]
    fn gaps_and_drops_leave_the_other_samples_as_they_are() {
        for seed in 0..20 {
            let gap = stamps(&Stream::Gap(0.1).of(&track(), 11, seed));
            let longest = gap.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
            assert!((100.0..=120.0).contains(&longest), "{gap:?}");
        }
        let dropped = stamps(&of(Stream::Dropped(0.5)));
        assert!((2..=9).contains(&dropped.len()) && dropped.iter().all(|time| time % 20.0 == 0.0), "{dropped:?}");
    }

    #[test]
    fn a_moment_is_scored_by_what_has_come_until_then() {
        let track = track();
        let template = crate::methods::Template::pointer().unwrap().scenario;
        let scenario = track_scenario(&track, &template, &Value::Null).unwrap();
        let of = |events: &[Event]| predictions(&track, 11, events, &mut Predictor::new(&scenario)).unwrap();
        let late: Vec<Event> = of_last_only(&track);
        let predicted = of(&late);
        assert_eq!(predicted[9], Prediction { top: None, chances: Some([0.5, 0.5]) });
        assert!(predicted[10].top.is_some());
        // what was overtaken is passed over
        let mut back = Stream::Recorded.of(&track, 11, 1);
        let plain = of(&back);
        back[6].samples[0].time = 0.05;
        assert_eq!(of(&back)[..6], plain[..6]);
    }

    fn of_last_only(track: &Track) -> Vec<Event> {
        Stream::Recorded.of(track, 11, 1).split_off(10)
    }

    #[test]
    fn on_a_page_a_movement_is_one_movement_and_predicted() {
        let track = track();
        let (predicted, movements) =
            on_page(&track, 11, &Stream::Recorded.of(&track, 11, 1), &Node::new("streams.mjs")).unwrap();
        assert_eq!((predicted.len(), movements), (11, 1.0));
        assert_eq!(predicted[0].top, None);
        assert_eq!(predicted[10].top, Some(1));
    }
}
