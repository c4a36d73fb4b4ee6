//! Bindings behind `js/pointing/scenario.ts`.

use super::Result;
use crate::pointer::{self, PointerOptions, PointerTarget};
use crate::value::{Node, Value};
use wasm_bindgen::prelude::wasm_bindgen;

/// The scenario for `{ targets, options? }` on a screen.
#[wasm_bindgen]
pub fn pointer_scenario(value: &[u8]) -> Result<Vec<u8>> {
    let value = Value::from_bytes(value)?;
    let node = Node::root(&value, "");
    let fields = node.fields(&["targets", "options"])?;
    let targets =
        fields.required("targets")?.items()?.map(|item| pointer_target(&item)).collect::<crate::Result<Vec<_>>>()?;
    let mut options = PointerOptions::default();
    if let Some(given) = fields.optional("options")
        && let Some(none) = given.fields(&["none"])?.optional("none")
    {
        options.none = none.number()?;
    }
    Ok(pointer::pointer_scenario(&targets, options)?.to_value().to_bytes())
}

fn pointer_target(node: &Node<'_>) -> crate::Result<PointerTarget> {
    let fields = node.fields(&["id", "x", "y", "width", "height"])?;
    Ok(PointerTarget {
        id: fields.required("id")?.text()?.to_owned(),
        x: fields.number("x")?,
        y: fields.number("y")?,
        width: fields.positive("width")?,
        height: fields.positive("height")?,
    })
}
