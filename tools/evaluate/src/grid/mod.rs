//! `--methods`, `--points`, `--noise`, `--arrival`: methods over a grid of what a scenario sets, one row each.

mod options;

use crate::methods::{Template, set};
use clap::Args;
use clap::builder::PossibleValuesParser;
use options::{Noise, Prior};
use std::collections::BTreeMap;
use whither::Code;
use whither::internals::{Node, Value, data, track_scenario};
use whither::study::track::{Target, Track};

/// The pointing model as a scenario's `method`.
const POINTING: &str = "pointing";

/// The methods of the papers, as a scenario spells them; those of one family are neighbours.
const PAPERS: [&str; 6] =
    ["pseudoObservation", "algorithm1", "algorithm2", "bridging", "singleFilter", "singleFilterApproximate"];

/// What is combined; a list that is left out is the scenario's own.
#[derive(Clone, Debug, Default, Args)]
pub struct Grid {
    /// A grid of our methods in place of our scenarios, one row each: all, or some of pointing, pseudoObservation, algorithm1, algorithm2,
    /// bridging, singleFilter, singleFilterApproximate, with commas. Each scenario of --scenario, without one the file's own or the
    /// pointer's two, is the base of its own kind of method; where none is of the papers' methods, theirs has the observation, the
    /// initial state, the times to go as a horizon and the noise (root mean square) of the pointing model's. By default
    /// pseudoObservation, where another list of the grid is given.
    #[arg(long, value_name = "all|LIST", value_delimiter = ',', value_parser = methods())]
    pub methods: Vec<String>,
    /// Points of the quadrature over the arrival time, with commas, for the methods of the papers; by default the scenario's.
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub points: Vec<usize>,
    /// Noises of the motion model (motion.noise), with commas: numbers, or after an x factors of the scenario's, as in 1000,3000 and
    /// x0.5,x1,x2; by default the scenario's.
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = Noise::parse)]
    pub noise: Vec<Noise>,
    /// Arrival priors, with commas, for the methods of the papers: horizon:FROM:TO, uniform:FROM:TO, logNormal:MEDIAN:SPREAD,
    /// fitts:INTERCEPT:SLOPE:SPREAD, discrete:TIME:TIME..., in seconds; by default the scenario's, and where that is a horizon, which
    /// methods that accumulate evidence cannot follow, uniform from the same time to five times the latest, too.
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = Prior::parse)]
    pub arrival: Vec<Prior>,
}

fn methods() -> PossibleValuesParser {
    PossibleValuesParser::new(["all", POINTING].into_iter().chain(PAPERS))
}

/// The rows of a grid.
#[derive(Debug, Default)]
pub struct Rows {
    pub templates: Vec<Template>,
    pub left_out: LeftOut,
}

/// Methods that were left out, by what they were left out with, and why.
pub type LeftOut = BTreeMap<String, Vec<&'static str>>;

impl Grid {
    /// Whether any of the lists is given.
    pub fn is_given(&self) -> bool {
        !(self.methods.is_empty() && self.points.is_empty() && self.noise.is_empty() && self.arrival.is_empty())
    }

    /// The rows for scenarios that are the bases.
    pub fn rows(&self, bases: &[Template]) -> Result<Rows, String> {
        let mut rows = Rows::default();
        let (pointing, mut papers): (Vec<Template>, Vec<Template>) =
            bases.iter().cloned().partition(|base| method(base) == Some(POINTING));
        if papers.is_empty() {
            papers = pointing.iter().map(of_papers).collect::<Result<_, _>>()?;
        }
        if self.wants(POINTING) {
            if pointing.is_empty() {
                let why = ", which no scenario here is of".to_owned();
                rows.left_out.insert(why, vec![POINTING]);
            }
            for base in &pointing {
                for noise in some(&self.noise) {
                    let row = Row { method: POINTING, noise, points: None, arrival: None };
                    rows.add(base, &row, pointing.len() > 1)?;
                }
            }
        }
        for base in &papers {
            let defaults = Prior::defaults(&base.scenario);
            let arrivals = if self.arrival.is_empty() { &defaults } else { &self.arrival };
            for &method in PAPERS.iter().filter(|method| self.wants(method)) {
                for noise in some(&self.noise) {
                    for points in some(&self.points) {
                        for arrival in some(arrivals) {
                            rows.add(base, &Row { method, noise, points, arrival }, papers.len() > 1)?;
                        }
                    }
                }
            }
        }
        Ok(rows)
    }

    fn wants(&self, method: &str) -> bool {
        match self.methods.as_slice() {
            [] => method == PAPERS[0],
            wanted => wanted.iter().any(|wanted| wanted == method || wanted == "all"),
        }
    }
}

/// Each of a list; none once for an empty one.
fn some<T>(list: &[T]) -> Vec<Option<&T>> {
    if list.is_empty() { vec![None] } else { list.iter().map(Some).collect() }
}

/// One point of the grid.
struct Row<'a> {
    method: &'static str,
    noise: Option<&'a Noise>,
    points: Option<&'a usize>,
    arrival: Option<&'a Prior>,
}

impl Row<'_> {
    /// As the tables call it; without a comma, since it is a field of CSV, too.
    fn name(&self) -> String {
        let parts = [
            Some(self.method.to_owned()),
            self.noise.map(|noise| format!("noise:{noise}")),
            self.points.map(|points| format!("points:{points}")),
            self.arrival.map(|arrival| arrival.text.clone()),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join(" ")
    }

    fn template(&self, base: &Template) -> Template {
        let mut template = base.clone();
        set(&mut template.scenario, &["method"], Value::text(self.method));
        if let Some(noise) = self.noise {
            let root = Node::root(&base.scenario, "");
            let given = root.get("motion").and_then(|motion| motion.get("noise").map(|noise| noise.value().clone()));
            set(&mut template.scenario, &["motion", "noise"], noise.of(&given.unwrap_or(Value::Null)));
        }
        if let Some(&points) = self.points {
            if Node::root(&base.scenario, "").get("quadrature").is_none() {
                set(&mut template.scenario, &["quadrature", "rule"], Value::text("simpson"));
            }
            set(&mut template.scenario, &["quadrature", "points"], Value::Number(points as f64));
        }
        if let Some(arrival) = self.arrival {
            set(&mut template.scenario, &["arrival"], arrival.value.clone());
            if let Value::Map(entries) = &mut template.extra {
                entries.retain(|(key, _)| **key != *"arrival");
            }
        }
        template
    }

    /// What is wrong with the scenario, after the option that it came from.
    fn refused(&self, error: &whither::Error) -> String {
        let option = match error.path().split(['.', '[']).next() {
            Some("quadrature") => self.points.map(|points| format!("--points {points}")),
            Some("arrival") => self.arrival.map(|arrival| format!("--arrival {}", arrival.text)),
            Some("motion") => self.noise.map(|noise| format!("--noise {noise}")),
            _ => None,
        };
        format!("{}: {error}", option.unwrap_or_else(|| self.method.to_owned()))
    }
}

impl Rows {
    fn add(&mut self, base: &Template, row: &Row<'_>, several: bool) -> Result<(), String> {
        let mut template = row.template(base);
        template.name = if several { format!("{}: {}", base.name, row.name()) } else { row.name() };
        match checked(&template) {
            Err(error) if error.code() == Code::MethodAccumulates => {
                let arrival = row.arrival.map_or("its arrival prior", |arrival| &arrival.text);
                let methods = self.left_out.entry(format!(" with {arrival}, which moves with every observation"));
                let methods = methods.or_default();
                if !methods.contains(&row.method) {
                    methods.push(row.method);
                }
            }
            Err(error) => return Err(row.refused(&error)),
            Ok(_) if self.templates.iter().any(|other| other.name == template.name) => {}
            Ok(_) => self.templates.push(template),
        }
        Ok(())
    }
}

/// What was left out for any file, in one line.
pub fn left_out(all: &LeftOut) -> Option<String> {
    let all: Vec<String> = all.iter().map(|(why, methods)| methods.join(", ") + why).collect();
    (!all.is_empty()).then(|| format!("left out: {}", all.join("; ")))
}

fn method(template: &Template) -> Option<&str> {
    let Value::Map(entries) = &template.scenario else { return None };
    match entries.iter().find(|(key, _)| **key == *"method") {
        Some((_, Value::Text(method))) => Some(method),
        _ => None,
    }
}

/// The scenario for one target, as it is written with all of its parts.
fn checked(template: &Template) -> whither::Result<Value> {
    let root = Node::root(&template.scenario, "");
    let dimensions = root.get("motion").and_then(|motion| motion.get("dimensions")?.float().ok()).unwrap_or(2.0);
    let axes = dimensions.clamp(1.0, 3.0) as usize;
    let targets = vec![Target { center: vec![0.0; axes], size: vec![1.0; axes] }];
    let track = Track { id: String::new(), user: String::new(), targets, target: 0, samples: Vec::new() };
    track_scenario(&track, &template.scenario, &template.extra).map(|scenario| data(&scenario))
}

/// The papers' scenario with what a scenario of the pointing model states about its movements.
fn of_papers(pointing: &Template) -> Result<Template, String> {
    let complete = checked(pointing).map_err(|error| format!("{}: {error}", pointing.name))?;
    let root = Node::root(&complete, "");
    let part = |key: &str| root.get(key).map(|node| node.value().clone());
    let own = root.get("pointing");
    let noises = own.as_ref().and_then(|own| own.get("noise")?.floats().ok()).unwrap_or_default();
    let mean_square = noises.iter().map(|noise| noise * noise).sum::<f64>() / noises.len().max(1) as f64;
    let time = |key: &str| {
        let time = own.as_ref().and_then(|own| own.get("timeToGo")?.get(key)?.float().ok());
        Value::Number(time.unwrap_or_default())
    };
    let motion = root.get("motion");
    let dimensions = motion.and_then(|motion| motion.get("dimensions").map(|node| node.value().clone()));
    let scenario = Value::some(vec![
        (
            "motion",
            Some(Value::some(vec![
                ("type", Some(Value::text("constantVelocity"))),
                ("dimensions", dimensions),
                ("noise", Some(Value::Number(mean_square.sqrt()))),
            ])),
        ),
        ("observation", part("observation")),
        ("initial", part("initial")),
        ("none", part("none")),
        ("arrival", Some(Value::map([("type", Value::text("horizon")), ("from", time("from")), ("to", time("to"))]))),
    ]);
    let mut papers = pointing.clone();
    papers.scenario = scenario;
    Ok(papers)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::methods::Method;
    use crate::recorded::Recorded;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        grid: Grid,
    }

    fn grid(line: &str) -> Grid {
        Line::try_parse_from(["evaluate"].into_iter().chain(line.split(' ').filter(|part| !part.is_empty())))
            .unwrap()
            .grid
    }

    fn bases() -> Vec<Template> {
        vec![Template::pointer().unwrap(), Template::constant_velocity().unwrap()]
    }

    fn names(line: &str, bases: &[Template]) -> Vec<String> {
        grid(line).rows(bases).unwrap().templates.into_iter().map(|row| row.name).collect()
    }

    fn track() -> Recorded {
        let text = r#"{"targets": [[0, 0, 90, 90], [500, 40, 90, 90], {"mean": [300, 400], "covariance": [[700, 100], [100, 600]]}],
            "target": 1, "samples": [[0, 90, 200], [0.1, 110, 190], [0.2, 180, 160], [0.3, 290, 120], [0.4, 390, 80], [0.5, 470, 50]]}"#;
        Recorded::read(&serde_json::from_str(text).unwrap(), 0.0).unwrap()
    }

    #[test]
    fn the_rows_are_all_combinations_in_the_order_of_the_lists() {
        let found = names(
            "--methods bridging,pointing --points 5,9 --noise 70,x2 --arrival uniform:0.1:2,horizon:0.1:1",
            &bases(),
        );
        let expected = [
            "pointing noise:70",
            "pointing noise:x2",
            "bridging noise:70 points:5 uniform:0.1:2",
            "bridging noise:70 points:9 uniform:0.1:2",
            "bridging noise:x2 points:5 uniform:0.1:2",
            "bridging noise:x2 points:9 uniform:0.1:2",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn what_is_not_legal_is_left_out_and_named_in_one_line() {
        let rows = grid("--methods all").rows(&bases()).unwrap();
        assert_eq!(rows.templates.len(), 1 + 3 * 2 + 3);
        let expected =
            "left out: algorithm1, algorithm2, bridging with horizon:0.05:0.5, which moves with every observation";
        assert_eq!(left_out(&rows.left_out).as_deref(), Some(expected));
        let rows = grid("--methods pointing,singleFilter").rows(&bases()[1..]).unwrap();
        assert_eq!(rows.templates.len(), 2);
        assert_eq!(left_out(&rows.left_out).as_deref(), Some("left out: pointing, which no scenario here is of"));
        assert_eq!(left_out(&LeftOut::new()), None);
    }

    #[test]
    fn without_a_list_it_is_the_scenario_s() {
        assert_eq!(
            names("--points 5", &bases()),
            ["pseudoObservation points:5 horizon:0.05:0.5", "pseudoObservation points:5 uniform:0.05:2.5",]
        );
        assert!(!grid("").is_given() && grid("--noise 3").is_given());
        // of the pointing model alone, its times to go and noises
        let rows = grid("--methods pseudoObservation").rows(&bases()[..1]).unwrap();
        assert_eq!(rows.templates[0].name, "pseudoObservation horizon:0.04:1.2");
        let scenario = checked(&rows.templates[0]).unwrap();
        let noise = Node::root(&scenario, "").get("motion").unwrap().get("noise").unwrap().float().unwrap();
        assert!((noise - ((467.0 * 467.0 + 4200.0 * 4200.0) / 2f64).sqrt()).abs() < 1e-9);
    }

    #[test]
    fn several_scenarios_of_a_kind_differ_by_their_names() {
        let mut other = bases().swap_remove(1);
        other.name = "other".to_owned();
        let found = names("--arrival uniform:1:2", &[bases().swap_remove(1), other]);
        let expected =
            ["whither, exact constant velocity: pseudoObservation uniform:1:2", "other: pseudoObservation uniform:1:2"];
        assert_eq!(found, expected);
    }

    #[test]
    fn methods_that_are_equal_have_equal_scores() {
        let line = "--methods all --points 7 --noise x0.5 --arrival uniform:0.1:1.5,logNormal:0.6:0.5,fitts:0.1:0.2:0.4,discrete:0.4:0.9";
        let rows = grid(line).rows(&bases()).unwrap();
        assert!(rows.left_out.is_empty());
        let score = |method: &str, arrival: &str| {
            let row = rows.templates.iter().find(|row| row.name == format!("{method} noise:x0.5 points:7 {arrival}"));
            let (score, _) = Method::ours(row.unwrap().clone()).score(&track(), 6, false).unwrap().unwrap();
            score.loss
        };
        for arrival in ["uniform:0.1:1.5", "logNormal:0.6:0.5", "fitts:0.1:0.2:0.4", "discrete:0.4:0.9"] {
            let [pseudo, bridging] = ["pseudoObservation", "bridging"].map(|method| score(method, arrival));
            for (method, expected) in [("algorithm1", pseudo), ("algorithm2", pseudo), ("singleFilter", bridging)] {
                assert!((score(method, arrival) - expected).abs() < 1e-9, "{method} {arrival}");
            }
            assert!((pseudo - bridging).abs() > 1e-6, "they construct the endpoint differently");
        }
    }

    #[test]
    fn what_is_wrong_is_named_with_its_option() {
        let refused = |line: &str, expected: &str| {
            let found = match Line::try_parse_from(["evaluate"].into_iter().chain(line.split(' '))) {
                Err(error) => error.to_string(),
                Ok(line) => line.grid.rows(&bases()).unwrap_err(),
            };
            assert!(found.contains(expected), "{line}: {found}");
        };
        refused("--methods bridge", "invalid value 'bridge' for '--methods <all|LIST>'");
        refused(
            "--noise 3,x-1",
            "invalid value 'x-1' for '--noise <LIST>': must be a number above 0, or x and a factor above 0",
        );
        refused("--points many", "invalid value 'many' for '--points <LIST>'");
        refused("--points 4", "--points 4: quadrature.points: must be");
        refused("--arrival uniform:1", "invalid value 'uniform:1' for '--arrival <LIST>': must be horizon:FROM:TO");
        refused("--arrival soon:1:2", "invalid value 'soon:1:2' for '--arrival <LIST>'");
        refused(
            "--arrival uniform:2:1",
            "--arrival uniform:2:1: arrival.to: must be greater than \"from\", which is 2, got 1",
        );
        refused(
            "--arrival discrete:0",
            "--arrival discrete:0: arrival.times[0]: must be greater than 0 and at most 1e12 seconds, got 0",
        );
    }
}
