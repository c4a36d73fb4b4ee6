//! Bindings behind `js/study/fit.ts`.

use super::Result;
use crate::error::Code;
use crate::study::fit::{self, Options, Progress};
use crate::study::track::Track;
use crate::value::{Node, Value};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Receives the progress of a search; `js/study/fit.ts` catches what it throws.
    #[derive(Debug)]
    pub type Listener;

    #[wasm_bindgen(structural, method)]
    fn report(this: &Listener, share: f64, loss: f64) -> bool;
}

/// Learns constants from `{ tracks, scenario, constants?, evaluations?, destination? }`: the scenario with them, what they
/// were and are, the mean loss on the tracks left out before and after, and how many tracks were used.
#[wasm_bindgen]
pub fn fit(value: &[u8], listener: &Listener) -> Result<Vec<u8>> {
    let value = Value::from_bytes(value)?;
    let node = Node::root(&value, "");
    let fields = node.fields(&["tracks", "scenario", "constants", "evaluations", "destination"])?;
    let tracks =
        fields.required("tracks")?.items()?.map(|track| Track::read(&track)).collect::<crate::Result<Vec<_>>>()?;
    let scenario = fields.required("scenario")?;
    let mut options = Options::default();
    if let Some(constants) = fields.optional("constants") {
        options.constants =
            constants.items()?.map(|path| Ok(path.text()?.to_owned())).collect::<crate::Result<Vec<_>>>()?;
    }
    if let Some(evaluations) = fields.optional("evaluations") {
        options.evaluations = evaluations.integer(1, 100_000)?;
    }
    let extra = match fields.optional("destination") {
        None => Value::Null,
        Some(node) if matches!(node.value(), Value::Map(_)) => node.value().clone(),
        Some(node) => return Err(node.error(Code::WrongType, "must be an object").into()),
    };
    let report = &mut |progress: Progress| listener.report(progress.share, progress.loss);
    let (scenario, fitted) = fit::fit_value(&tracks, scenario.value(), &extra, &options, report)?;
    let constants = fitted.constants.iter().map(|(path, before, after)| {
        Value::map([("path", Value::text(path)), ("before", Value::Number(*before)), ("after", Value::Number(*after))])
    });
    let [before, after] = fitted.left_out.map(Value::Number);
    let fitted = Value::map([
        ("constants", Value::List(constants.collect())),
        ("leftOut", Value::map([("before", before), ("after", after)])),
        ("tracks", Value::Number(fitted.tracks as f64)),
        ("scenario", scenario),
    ]);
    Ok(fitted.to_bytes())
}
