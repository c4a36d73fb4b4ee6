//! Scores predictors on recorded movements, side by side: `npm run evaluate -- FILE...`.
//!
//! A file has one track a line, `{"id", "user", "targets": [[x, y, w, h], ...], "target": k, "samples": [[t, x, y], ...]}`
//! with the centres of the targets; in space `[x, y, z, diameter]` and `[t, x, y, z]`, along a line `[x, w]` and `[t, x]`; null for a
//! coordinate that is missing; a target may be a Gaussian endpoint, `{"mean", "covariance"}`.
//! What is printed, on the approach up to the last entry into the true target: the share of the time with the true target on
//! top, accuracy on the way, mean log loss, expected calibration error, lead time; with an interval by drawing users.

mod chart;
mod crossings;
mod extras;
mod foresight;
mod grid;
mod habits;
mod intents;
mod learning;
mod methods;
mod node;
mod on_a_map;
mod outcomes;
mod peers;
mod reading;
mod recorded;
mod report;
mod scores;
mod shake;
mod steps;
mod streams;
mod sweep;
mod variants;

use clap::Parser;
use crossings::Crossings;
use foresight::Foresight;
use grid::{Grid, LeftOut};
use methods::{Method, Template};
use outcomes::Gains;
use peers::Peer;
use report::Results;
use scores::Tables;
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Options of the usual tables only.
const OF_SCORES: [&str; 14] = [
    "scenario",
    "methods",
    "points",
    "noise",
    "arrival",
    "steps",
    "more",
    "learning",
    "thresholds",
    "ours",
    "users",
    "margin",
    "every",
    "charts",
];

/// Options and tables that have nothing to do with intents.
const NOT_OF_INTENTS: [&str; 16] = [
    "scenario",
    "methods",
    "points",
    "noise",
    "arrival",
    "steps",
    "more",
    "learning",
    "thresholds",
    "ours",
    "margin",
    "every",
    "charts",
    "sweep",
    "fit",
    "habits",
];

/// The error where nothing was scored.
const NOTHING: &str = "nothing to score: too few tracks enter their target";

/// Scores predictors on recorded movements.
#[derive(Debug, Parser)]
#[command(name = "npm run evaluate --")]
struct Arguments {
    /// Files of tracks, one JSON object a line: {"id"?, "user"?, "targets": [[x, y, width, height], ...] about their centres,
    /// "target": k, "samples": [[t, x, y], ...]}; in space [x, y, z, diameter] and [t, x, y, z], along a line [x, width] and [t, x]. A
    /// coordinate that is missing is null. A target may be a Gaussian endpoint, {"mean": [...], "covariance": [[...], ...]}, of the position
    /// or of position and velocity; it is entered at its ellipse of 95%.
    #[arg(required_unless_present = "habits")]
    files: Vec<PathBuf>,
    /// Files of scenarios of your own, {"name", "scenario", "destination"?, "margin"?, "toTheEnd"?, "map"?}: the scenario without its
    /// destinations, or the name of a function that makes one ("rayScenario"); keys that each of them gets; where it is the track
    /// file's own, what is added to their sizes, and whether tracks that never enter their target count to their last sample; and
    /// whether azimuth and elevation in degrees are put on a map about the targets. Where tools/evaluate/scenarios has one of the same
    /// name as a track file, it is used.
    #[arg(long)]
    scenario: Vec<PathBuf>,
    #[command(flatten)]
    grid_of_methods: Grid,
    /// Where to write what our scenarios predict after each sample that is scored, as CSV, one row for each track, method and sample: file,
    /// line, id, user, method, step, time, target, top, none, log_likelihood, log_evidence, arrival, arrival_deviation, remaining, x, y, z,
    /// vx, vy, vz, and p0, p1, ... for the targets in their order; a field is empty where there is nothing. docs/comparing.md has what
    /// they are.
    #[arg(long, value_name = "FILE.csv")]
    steps: Option<PathBuf>,
    /// Score the first of our scenarios on two more things: the time to the entry, and "none of them" with the target taken out of
    /// half of the tracks.
    #[arg(long)]
    more: bool,
    /// Score the first of our scenarios without and with what the outcomes of each user's movements before have taught, in the order of
    /// the file; with --more on the time to the entry and "none", too.
    #[arg(long)]
    learning: bool,
    /// Print when the posterior of the first of our scenarios first crosses a threshold, too: right and wrong, how early, how often, by the
    /// threshold and the release, after a rest, and by other rules. Computed on the posteriors; what whither/dom makes of them on a page
    /// is replayed by --intents and --wandering.
    #[arg(long)]
    thresholds: bool,
    /// Leave the other predictors out.
    #[arg(long)]
    ours: bool,
    /// A table by user, too.
    #[arg(long)]
    users: bool,
    /// Added to the size of every target, for a cursor that has a size itself; by default the margin of the file's scenario.
    #[arg(long)]
    margin: Option<f64>,
    /// Only every n-th sample.
    #[arg(long, default_value_t = 1)]
    every: usize,
    /// Instead of the recorded targets the true one and twelve others, LOW to HIGH times as far from the start of the movement.
    #[arg(long, value_names = ["LOW", "HIGH"], num_args = 2, conflicts_with_all = ["sweep", "fit", "habits", "intents"])]
    around: Option<Vec<f64>>,
    /// A table of other circumstances instead: few and many targets, small and wide ones, other sample rates and pixels.
    #[arg(long, conflicts_with_all = OF_SCORES, conflicts_with_all = ["fit", "habits"])]
    sweep: bool,
    /// Instead, learn constants from half of the users, and from each user's own first movements, and score the rest.
    #[arg(long, conflicts_with_all = OF_SCORES, conflicts_with = "habits")]
    fit: bool,
    /// Instead, simulate users with habits, and print the gain from learning their habits.
    #[arg(long, conflicts_with_all = OF_SCORES, conflicts_with = "files")]
    habits: bool,
    /// Instead, shake the movements by 2 to 20 units of length at 2 to 8 Hz, and simulated ones too, without and with the option.
    #[arg(long, conflicts_with_all = OF_SCORES, conflicts_with_all = ["sweep", "fit", "habits"])]
    shake: bool,
    /// Instead, report the movements otherwise, at other rates, dropped, bunched, late, with gaps, to Predictor and to whither/dom.
    #[arg(long, conflicts_with_all = OF_SCORES, conflicts_with_all = ["sweep", "fit", "habits", "shake"])]
    streams: bool,
    /// Instead, replay the tracks through whither/dom with thresholds, weights of "none" and holding times varied one at a time: intents
    /// that were wrong, early and right, their lead, and those of a page without the target.
    #[arg(long, conflicts_with_all = NOT_OF_INTENTS)]
    intents: bool,
    /// Instead, replay each user's tracks through whither/dom as one stream, of which half and four fifths lead to nothing on the page:
    /// wrong intents a minute, and what they are worth where there is a press, by the threshold and the prior of "none".
    #[arg(long, conflicts_with_all = NOT_OF_INTENTS, conflicts_with = "intents")]
    wandering: bool,
    /// Instead, lay menus around the tracks and replay them through whither/menu, floating-ui's safePolygon and a delay: panels closed on
    /// the way to them, and held on the way elsewhere. On the half of the users on which nothing was tuned.
    #[arg(long, conflicts_with_all = NOT_OF_INTENTS, conflicts_with_all = ["intents", "wandering", "users", "shake", "streams"])]
    menus: bool,
    /// With --menus, the other half of the users, with the values that were compared on them.
    #[arg(long, requires = "menus")]
    tuned: bool,
    /// With --intents, every combination of these in the report, too.
    #[arg(long, requires = "intents")]
    grid: bool,
    /// Where to write the report as JSON.
    #[arg(long, default_value = "target/evaluate/report.json")]
    json: PathBuf,
    /// Where to write the charts, one SVG for each set: accuracy over the course of the movement, and calibration.
    #[arg(long, default_value = "target/evaluate")]
    charts: PathBuf,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), String> {
    if arguments.every == 0 {
        return Err("--every must be at least 1".to_owned());
    }
    if arguments.habits {
        return report::write_json(&arguments.json, &json!({ "habits": habits::run(&Template::pointer()?)? }));
    }
    if arguments.sweep {
        return in_place_of_scores(arguments, "sweep", Vec::new(), |file, into| {
            sweep::run(&Template::pointer()?.scenario, file, into)
        });
    }
    if arguments.fit {
        return in_place_of_scores(arguments, "fit", Vec::new(), |file, into| {
            learning::run(&template_for(file)?, file, into)
        });
    }
    if arguments.shake {
        let simulated = shake::simulated(&Template::pointer()?)?;
        return in_place_of_scores(arguments, "shake", simulated, |file, into| {
            shake::run(&template_for(file)?, file, into)
        });
    }
    if arguments.streams {
        return in_place_of_scores(arguments, "streams", Vec::new(), |file, into| {
            streams::run(&Template::pointer()?.scenario, file, into)
        });
    }
    if arguments.intents {
        let flags = [("--users", arguments.users), ("--grid", arguments.grid)];
        return intents::run("intents/intents.mjs", &arguments.files, &arguments.json, &flags);
    }
    if arguments.wandering {
        let flags = [("--wandering", true), ("--users", arguments.users)];
        return intents::run("intents/intents.mjs", &arguments.files, &arguments.json, &flags);
    }
    if arguments.menus {
        let flags = [("--tuned", arguments.tuned)];
        return intents::run("menus/menus.mjs", &arguments.files, &arguments.json, &flags);
    }
    let mut results = Results::default();
    let mut skipped = 0;
    let mut more = arguments.more.then(BTreeMap::new);
    let mut crossings = arguments.thresholds.then(Crossings::new);
    let mut gains = arguments.learning.then(Gains::new);
    let mut left_out = LeftOut::new();
    let mut steps = arguments.steps.as_deref().map(|path| begin_steps(arguments, path)).transpose()?;
    for file in &arguments.files {
        let methods = methods_for(arguments, file, &mut left_out)?;
        let into =
            Tables { results: &mut results, more: more.as_mut(), crossings: crossings.as_mut(), steps: steps.as_mut() };
        skipped += scores::run(arguments, (file, &template_for(file)?), &methods, into)?;
        if let Some(gains) = &mut gains {
            let template = template_for(file)?;
            let margin = arguments.margin.unwrap_or(template.margin);
            outcomes::run(&template, file, (margin, arguments.every), arguments.more, gains)?;
        }
    }
    if results.sets.is_empty() {
        return Err(NOTHING.to_owned());
    }
    results.print(arguments.users);
    if let Some(line) = grid::left_out(&left_out) {
        println!("\n{line}");
    }
    let extras = more.map(|sums| extras::report(sums.iter().map(|(set, sums)| (set.clone(), sums))));
    let gains = gains.map(|gains| outcomes::report(&gains, arguments.more));
    let crossings = crossings.map(|crossings| crossings::report(&crossings));
    print_skipped(skipped);
    results.write(&arguments.json, [extras, gains, crossings])?;
    let charts = chart::write_all(&results, &arguments.charts)?;
    println!("report: {}   charts: {}", arguments.json.display(), charts.join(", "));
    if let Some(steps) = steps {
        println!("steps: {}", steps.finish()?);
    }
    Ok(())
}

/// Another table for each file, and the same under `key` of the report, after what is in `all`.
fn in_place_of_scores(
    arguments: &Arguments,
    key: &str,
    mut all: Vec<Json>,
    run: impl Fn(&Path, &mut Vec<Json>) -> Result<usize, String>,
) -> Result<(), String> {
    let mut skipped = 0;
    for file in &arguments.files {
        skipped += run(file, &mut all)?;
    }
    print_skipped(skipped);
    if all.is_empty() {
        return Err(NOTHING.to_owned());
    }
    report::write_json(&arguments.json, &json!({ key: all }))?;
    println!("report: {}", arguments.json.display());
    Ok(())
}

fn print_skipped(lines: usize) {
    if lines > 0 {
        println!("{lines} broken lines skipped, see above");
    }
}

/// A file's own scenarios; without one the pointer's two, in the dimensions of its tracks.
fn templates_for(file: &Path) -> Result<Vec<Template>, String> {
    if let Some(own) = Template::of(file)? {
        return Ok(vec![own]);
    }
    let dimensions = reading::dimensions(file)?.unwrap_or(2);
    let templates = [Template::pointer()?, Template::constant_velocity()?];
    Ok(templates.map(|template| template.in_dimensions(dimensions)).into())
}

/// A file's own scenario, else the pointer's.
fn template_for(file: &Path) -> Result<Template, String> {
    Ok(templates_for(file)?.swap_remove(0))
}

/// The methods for one file: its own scenarios, then those of `--scenario`, or a grid of methods in their place; then peers.
fn methods_for(arguments: &Arguments, file: &Path, left_out: &mut LeftOut) -> Result<Vec<Method>, String> {
    let given = arguments.scenario.iter().map(|path| Template::read(path)).collect::<Result<Vec<_>, _>>()?;
    let templates = if arguments.grid_of_methods.is_given() {
        let bases = if given.is_empty() { templates_for(file)? } else { given };
        let rows = arguments.grid_of_methods.rows(&bases)?;
        left_out.extend(rows.left_out);
        rows.templates
    } else {
        [templates_for(file)?, given].concat()
    };
    let mut methods: Vec<Method> = templates.into_iter().map(Method::ours).collect();
    if !arguments.ours {
        methods.extend(Peer::all().into_iter().map(Method::peer));
        match Foresight::start() {
            Ok(foresight) => methods.push(Method::foresight(foresight)),
            Err(reason) => eprintln!("ForesightJS is left out: {reason}"),
        }
    }
    Ok(methods)
}

/// The file of `--steps`, with columns for the most targets that any track has.
fn begin_steps(arguments: &Arguments, path: &Path) -> Result<steps::Table, String> {
    let counts = arguments.files.iter().map(|file| reading::most_targets(file)).collect::<Result<Vec<_>, _>>()?;
    let most = counts.into_iter().max().unwrap_or(0);
    steps::Table::create(path, if arguments.around.is_some() { variants::AROUND } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_help_is_what_scripts_print_without_compiling() {
        let help = Arguments::command().term_width(100).render_long_help().to_string();
        assert_eq!(include_str!("../help.txt"), help, "tools/evaluate/help.txt has to be:\n{help}");
    }

    #[test]
    fn the_command_line_is_sound_and_refuses_what_cannot_be_combined() {
        Arguments::command().debug_assert();
        let refused = |line: &str| Arguments::try_parse_from(line.split(' ')).is_err();
        assert!(
            !refused("evaluate a.jsonl --more")
                && !refused("evaluate a.jsonl --sweep")
                && !refused("evaluate --habits")
                && !refused("evaluate a.jsonl --intents --users --grid")
                && !refused("evaluate a.jsonl --wandering --users")
                && !refused("evaluate a.jsonl --menus --tuned")
                && !refused("evaluate a.jsonl --more --thresholds")
                && !refused("evaluate --methods all --steps steps.csv --users a.jsonl")
        );
        for line in [
            "evaluate",
            "evaluate --fit",
            "evaluate a --fit --sweep",
            "evaluate a --habits",
            "evaluate a --sweep --more",
            "evaluate --intents",
            "evaluate a --intents --sweep",
            "evaluate a --intents --every 2",
            "evaluate a --grid",
            "evaluate a --wandering --intents",
            "evaluate a --wandering --more",
            "evaluate a --thresholds --sweep",
            "evaluate a --menus --intents",
            "evaluate a --tuned",
            "evaluate a --methods all --sweep",
            "evaluate a --points 7 --fit",
            "evaluate a --noise 3 --shake",
            "evaluate a --arrival uniform:1:2 --streams",
            "evaluate a --steps steps.csv --intents",
        ] {
            assert!(refused(line), "{line}");
        }
    }
}
