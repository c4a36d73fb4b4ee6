//! What is compared: scenarios of ours, and other predictors.

use crate::foresight::Foresight;
use crate::on_a_map;
use crate::peers::Peer;
use crate::recorded::Recorded;
use crate::steps::{self, Step};
use std::borrow::Cow;
use std::path::Path;
use whither::internals::{Node, Value, data};
use whither::study::metrics::{Prediction, Score};
use whither::study::track::Track;
use whither::{HandOptions, HandTarget, PointerOptions, PointerTarget, RayOptions, RayTarget};
use whither::{Scenario, hand_scenario, pointer_scenario, ray_scenario};

/// One row of the tables.
#[derive(Debug)]
pub struct Method {
    /// As the tables call it.
    pub name: String,
    rule: Rule,
}

#[derive(Debug)]
enum Rule {
    Ours(Template),
    Peer(Peer),
    Foresight(Foresight),
}

/// A scenario file.
#[derive(Clone, Debug)]
pub struct Template {
    pub name: String,
    /// The scenario without its destinations.
    pub scenario: Value,
    /// Keys that each destination gets.
    pub extra: Value,
    /// Added to the size of every target, for a cursor that has a size itself.
    pub margin: f64,
    /// Whether tracks that never enter their target count, to their last sample: recorded without a press.
    pub to_the_end: bool,
    /// Whether azimuth and elevation are places on a map about the middle of the targets.
    map: bool,
}

impl Template {
    /// For one file of tracks: the scenario of the same name in `tools/evaluate/scenarios`, where there is one.
    pub fn of(file: &Path) -> Result<Option<Self>, String> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
        let own = file.file_stem().map(|stem| folder.join(stem).with_extension("json")).filter(|path| path.exists());
        own.map(|path| Self::read(&path)).transpose()
    }

    /// Reads `{ "name", "scenario", "destination"?, "margin"?, "toTheEnd"?, "map"? }`.
    pub fn read(path: &Path) -> Result<Self, String> {
        let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        Self::parse(&text).map_err(|error| format!("{}: {error}", path.display()))
    }

    fn parse(text: &str) -> Result<Self, String> {
        let value: Value = serde_json::from_str(text).map_err(|error| error.to_string())?;
        Self::from_value(&value).map_err(|error| error.to_string())
    }

    fn from_value(value: &Value) -> whither::Result<Self> {
        let node = Node::root(value, "");
        let fields = node.fields(&["name", "scenario", "destination", "margin", "toTheEnd", "map"])?;
        let scenario = fields.required("scenario")?;
        let scenario = match scenario.value() {
            Value::Text(_) => {
                let device = scenario.word(&[("pointerScenario", 0), ("rayScenario", 1), ("handScenario", 2)])?;
                data(&[pointer, ray, hand][device]()?)
            }
            given => given.clone(),
        };
        let is_set = |key| fields.optional(key).is_some_and(|node| *node.value() == Value::Bool(true));
        Ok(Self {
            name: fields.required("name")?.text()?.to_owned(),
            scenario,
            extra: fields.optional("destination").map_or(Value::Null, |extra| extra.value().clone()),
            margin: fields.optional("margin").map_or(Ok(0.0), |node| node.number())?,
            to_the_end: is_set("toTheEnd"),
            map: is_set("map"),
        })
    }

    /// The scenario of `pointerScenario`.
    pub fn pointer() -> Result<Self, String> {
        Self::parse(r#"{ "name": "whither, pointing model", "scenario": "pointerScenario" }"#)
    }

    /// The same in so many dimensions.
    pub fn in_dimensions(mut self, dimensions: usize) -> Self {
        set(&mut self.scenario, &["motion", "dimensions"], Value::Number(dimensions as f64));
        self
    }

    /// Whether the method has a likelihood, and not only something in proportion to one.
    fn has_likelihood(&self) -> bool {
        let root = Node::root(&self.scenario, "");
        let method = root.get("method").and_then(|method| method.text().ok());
        !matches!(method, Some("pointing" | "singleFilterApproximate"))
    }

    /// The track as this scenario has it.
    pub fn coordinates<'a>(&self, track: &'a Track) -> Result<Cow<'a, Track>, String> {
        if self.map { on_a_map::track(track).map(Cow::Owned) } else { Ok(Cow::Borrowed(track)) }
    }

    /// What was recorded as this scenario has it.
    fn recorded<'a>(&self, recorded: &'a Recorded) -> Result<Cow<'a, Recorded>, String> {
        if self.map { recorded.try_map(on_a_map::track).map(Cow::Owned) } else { Ok(Cow::Borrowed(recorded)) }
    }

    /// The papers' exact method with constant velocity, as a pointer's user would set it.
    pub fn constant_velocity() -> Result<Self, String> {
        Self::parse(include_str!("../scenarios/constant_velocity.json"))
    }
}

/// Puts a value at a path of an object, and the objects that it lies in.
pub fn set(place: &mut Value, path: &[&str], new: Value) {
    let [key, rest @ ..] = path else {
        *place = new;
        return;
    };
    if !matches!(place, Value::Map(_)) {
        *place = Value::Map(Vec::new());
    }
    let Value::Map(entries) = place else { return };
    let at = entries.iter().position(|(name, _)| **name == **key).unwrap_or_else(|| {
        entries.push(((*key).into(), Value::Null));
        entries.len() - 1
    });
    set(&mut entries[at].1, rest, new);
}

fn any() -> String {
    "any".to_owned()
}

fn pointer() -> whither::Result<Scenario> {
    let any = PointerTarget { id: any(), x: 0.0, y: 0.0, width: 1.0, height: 1.0 };
    pointer_scenario(&[any], PointerOptions::default())
}

fn ray() -> whither::Result<Scenario> {
    let any = RayTarget { id: any(), azimuth: 0.0, elevation: 0.0, width: 1.0, height: 1.0 };
    ray_scenario(&[any], RayOptions::default())
}

fn hand() -> whither::Result<Scenario> {
    let any = HandTarget { id: any(), x: 0.0, y: 0.0, z: 0.0, width: 1.0, height: 1.0, depth: 1.0 };
    hand_scenario(&[any], HandOptions::default())
}

impl Method {
    /// A scenario of ours.
    pub fn ours(template: Template) -> Self {
        Self { name: template.name.clone(), rule: Rule::Ours(template) }
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

    /// Scores one track; none where the method does not apply to such tracks. With the steps, if they are wanted and there are some.
    pub fn score(
        &self,
        track: &Recorded,
        approach: usize,
        wants_steps: bool,
    ) -> Result<Option<(Score, Vec<Step>)>, String> {
        let message = |error: whither::Error| error.to_string();
        let tops = match &self.rule {
            Rule::Ours(template) => {
                let track = template.recorded(track)?;
                let scenario = track.scenario(&template.scenario, &template.extra).map_err(message)?;
                if wants_steps {
                    let run = steps::run(&track, approach, &scenario, template.has_likelihood());
                    return run.map(Some).map_err(message);
                }
                let score = Score::of_scenario(&track, approach, &scenario).map_err(message)?;
                return Ok(Some((score, Vec::new())));
            }
            Rule::Peer(peer) if peer.applies(track) => peer.tops(track, approach),
            Rule::Foresight(foresight) if track.dimensions() == 2 => foresight.tops(track, approach)?,
            Rule::Peer(_) | Rule::Foresight(_) => return Ok(None),
        };
        let predictions: Vec<Prediction> = tops.into_iter().map(|top| Prediction { top, chances: None }).collect();
        Ok(Some((Score::of(track, &predictions), Vec::new())))
    }
}
