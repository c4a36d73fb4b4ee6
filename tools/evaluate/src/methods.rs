//! What is compared: scenarios of ours, and other predictors.

use crate::foresight::Foresight;
use crate::peers::Peer;
use std::path::Path;
use whither::internals::{Value, track_scenario};
use whither::study::metrics::{Prediction, Score};
use whither::study::track::Track;
use whither::{PointerOptions, PointerTarget, pointer_scenario};

/// One row of the tables.
#[derive(Debug)]
pub struct Method {
    /// As the tables call it.
    pub name: String,
    rule: Rule,
}

#[derive(Debug)]
enum Rule {
    Ours { scenario: Value, extra: Value },
    Peer(Peer),
    Foresight(Foresight),
}

/// A scenario file.
#[derive(Debug)]
pub struct Template {
    name: String,
    /// The scenario without its destinations.
    pub scenario: Value,
    /// Keys that each destination gets.
    pub extra: Value,
    /// Added to the size of every target, for a cursor that has a size itself.
    pub margin: f64,
}

impl Template {
    /// For one file of tracks: the scenario of the same name in `tools/evaluate/scenarios`, where there is one.
    pub fn of(file: &Path) -> Result<Option<Self>, String> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
        let own = file.file_stem().map(|stem| folder.join(stem).with_extension("json")).filter(|path| path.exists());
        own.map(|path| Self::read(&path)).transpose()
    }

    /// Reads `{ "name", "scenario", "destination"?, "margin"? }`.
    pub fn read(path: &Path) -> Result<Self, String> {
        let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        Self::parse(&text).map_err(|error| format!("{}: {error}", path.display()))
    }

    fn parse(text: &str) -> Result<Self, String> {
        let value: Value = serde_json::from_str(text).map_err(|error| error.to_string())?;
        let node = whither::internals::Node::root(&value, "");
        let fields = node.fields(&["name", "scenario", "destination", "margin"]).map_err(|error| error.to_string())?;
        let required = |key: &'static str| fields.required(key).map_err(|error| error.to_string());
        Ok(Self {
            name: required("name")?.text().map_err(|error| error.to_string())?.to_owned(),
            scenario: required("scenario")?.value().clone(),
            extra: fields.optional("destination").map_or(Value::Null, |extra| extra.value().clone()),
            margin: fields
                .optional("margin")
                .map_or(Ok(0.0), |node| node.number())
                .map_err(|error| error.to_string())?,
        })
    }

    /// The scenario of `pointerScenario`.
    pub fn pointer() -> Result<Self, String> {
        let any = PointerTarget { id: "any".to_owned(), x: 0.0, y: 0.0, width: 1.0, height: 1.0 };
        let scenario = pointer_scenario(&[any], PointerOptions::default()).map_err(|error| error.to_string())?;
        Ok(Self {
            name: "whither, pointing model".to_owned(),
            scenario: whither::internals::data(&scenario),
            extra: Value::Null,
            margin: 0.0,
        })
    }

    /// The papers' exact method with constant velocity, as a pointer's user would set it.
    pub fn constant_velocity() -> Result<Self, String> {
        Self::parse(include_str!("../scenarios/constant_velocity.json"))
    }
}

impl Method {
    /// A scenario of ours.
    pub fn ours(template: Template) -> Self {
        Self { name: template.name, rule: Rule::Ours { scenario: template.scenario, extra: template.extra } }
    }

    /// Another predictor's rule.
    pub fn peer(peer: Peer) -> Self {
        Self { name: peer.name(), rule: Rule::Peer(peer) }
    }

    /// ForesightJS.
    pub fn foresight(foresight: Foresight) -> Self {
        Self { name: "ForesightJS".to_owned(), rule: Rule::Foresight(foresight) }
    }

    /// Whether this is one point of a grid, of which the tables show the best.
    pub fn is_of_grid(&self) -> bool {
        matches!(self.rule, Rule::Peer(Peer::Extrapolation { .. }))
    }

    /// Scores one track; none where the method does not apply to such tracks.
    pub fn score(&self, track: &Track, approach: usize) -> Result<Option<Score>, String> {
        let tops = match &self.rule {
            Rule::Ours { scenario, extra } => {
                let scenario = track_scenario(track, scenario, extra).map_err(|error| error.to_string())?;
                return Score::of_scenario(track, approach, &scenario).map(Some).map_err(|error| error.to_string());
            }
            Rule::Peer(peer) if peer.applies(track) => peer.tops(track, approach),
            Rule::Foresight(foresight) if track.dimensions() == 2 => foresight.tops(track, approach)?,
            Rule::Peer(_) | Rule::Foresight(_) => return Ok(None),
        };
        let predictions: Vec<Prediction> = tops.into_iter().map(|top| Prediction { top, chances: None }).collect();
        Ok(Some(Score::of(track, &predictions)))
    }
}
