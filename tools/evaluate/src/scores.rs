//! The usual tables: every method on every track of a file, and what else is asked for.

use crate::Arguments;
use crate::crossings::{self, Crossings};
use crate::extras::{self, Extras, Sums};
use crate::methods::{Method, Template};
use crate::reading;
use crate::recorded::Recorded;
use crate::report::{self, Results, Set};
use crate::steps::{self, Step};
use crate::variants::Variant;
use std::collections::BTreeMap;
use std::path::Path;
use whither::Learnt;
use whither::study::metrics::Score;

/// Where the results of a file go.
pub struct Tables<'a> {
    pub results: &'a mut Results,
    pub more: Option<&'a mut BTreeMap<String, Sums>>,
    pub crossings: Option<&'a mut Crossings>,
    pub steps: Option<&'a mut steps::Table>,
}

/// Scores the methods on the tracks of a file, and the file's scenario on what else is asked for; returns how many broken lines were
/// skipped.
pub fn run(
    arguments: &Arguments,
    (file, template): (&Path, &Template),
    methods: &[Method],
    mut into: Tables<'_>,
) -> Result<usize, String> {
    let name = reading::name(file);
    let mut sets: Vec<Set> = Vec::new();
    let margin = arguments.margin.unwrap_or(template.margin);
    let also = [into.more.is_some(), into.crossings.is_some()].map(|wanted| wanted.then_some(template));
    let mut failed = None;
    let skipped = reading::each(
        file,
        |line| score(line, (margin, arguments, template.to_the_end), methods, also),
        |scored| {
            let (part, user) = (reading::part(&scored.track), &scored.track.user);
            report::add(&mut sets, &name, part, methods, user, &scored.scores);
            if let (Some(sums), Some(extras)) = (into.more.as_deref_mut(), scored.extras) {
                sums.entry(format!("{name}{part}")).or_default().add(&extras);
            }
            if let (Some(crossings), Some(crossing)) = (into.crossings.as_deref_mut(), scored.crossing) {
                crossings.entry(format!("{name}{part}")).or_default().entry(user.clone()).or_default().add(&crossing);
            }
            if let Some(table) = into.steps.as_deref_mut() {
                for (method, steps) in methods.iter().zip(&scored.steps) {
                    if failed.is_none() {
                        failed = table.add(file, scored.line, &scored.track, &method.name, steps).err();
                    }
                }
            }
        },
    )?;
    into.results.sets.extend(sets);
    failed.map_or(Ok(skipped), Err)
}

/// The results of one track.
struct Scored {
    line: usize,
    track: Recorded,
    /// One for each method, as the steps.
    scores: Vec<Option<Score>>,
    steps: Vec<Vec<Step>>,
    extras: Option<Extras>,
    crossing: Option<crossings::Sums>,
}

fn score(
    line: &reading::Line,
    (margin, arguments, to_the_end): (f64, &Arguments, bool),
    methods: &[Method],
    [more, thresholds]: [Option<&Template>; 2],
) -> Result<Option<Scored>, String> {
    let (mut recorded, every) = (line.recorded(margin)?, arguments.every);
    if let Some([low, high]) = arguments.around.as_deref() {
        let boxes = recorded.boxes()?;
        let Some((other, _)) = Variant::Around([*low, *high]).of(boxes, line.number as u64) else {
            return Ok(None);
        };
        recorded = other.into();
    }
    let Some((track, approach)) = recorded.every(every, to_the_end) else { return Ok(None) };
    let score = |method: &Method| method.score(&track, approach, arguments.steps.is_some());
    let scores = methods.iter().map(score).collect::<Result<Vec<_>, _>>()?;
    let (scores, steps) = scores.into_iter().map(Option::unzip).unzip::<_, _, Vec<_>, Vec<_>>();
    let steps = steps.into_iter().map(Option::unwrap_or_default).collect();
    let extras = more.map(|template| extras::run(template, track.boxes()?, approach, line.number, &Learnt::default()));
    let crossing = thresholds.map(|template| crossings::run(template, recorded.boxes()?, every));
    let (extras, crossing) = (extras.transpose()?, crossing.transpose()?.flatten());
    Ok(Some(Scored { line: line.number, track, scores, steps, extras, crossing }))
}
