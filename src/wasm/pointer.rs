//! Bindings behind `js/pointing/scenario.ts`.

use super::Result;
use crate::Destination;
use crate::pointer::device::{Choices, Device, HAND, POINTER, RAY};
use crate::value::{Node, Value};
use wasm_bindgen::prelude::wasm_bindgen;

/// The scenario for `{ targets, options? }` and a kind of device: a pointer, a ray, a hand.
#[wasm_bindgen]
pub fn device_scenario(kind: u32, value: &[u8]) -> Result<Vec<u8>> {
    let device = match kind {
        0 => POINTER,
        1 => RAY,
        _ => HAND,
    };
    let value = Value::from_bytes(value)?;
    let node = Node::root(&value, "");
    let fields = node.fields(&["targets", "options"])?;
    let targets =
        fields.required("targets")?.items()?.map(|item| target(&item, &device)).collect::<crate::Result<Vec<_>>>()?;
    let mut choices = Choices::default();
    if let Some(given) = fields.optional("options") {
        let keys = ["none", "shake", "noise", "unit"];
        let given = given.fields(if device.units.is_empty() { &keys[..2] } else { &keys })?;
        for (key, choice) in [("none", &mut choices.none), ("shake", &mut choices.shake)] {
            *choice = given.optional(key).map_or(Ok(0.0), |number| number.number())?;
        }
        choices.noise = given.optional("noise").map(|noise| noise.positive()).transpose()?;
        if let Some(unit) = given.optional("unit") {
            choices.unit = unit.word(device.units)?;
        }
    }
    Ok(device.scenario(&choices, targets)?.to_value().to_bytes())
}

/// A target. Its place on the third axis is 0, and its side there the shorter of the others, where they are not given.
fn target(node: &Node<'_>, device: &Device) -> crate::Result<Destination> {
    let fields = node.fields(device.keys)?;
    let id = fields.required("id")?.text()?;
    let (places, sides) = device.keys[1..].split_at(device.dimensions());
    let (mut center, mut size) = (Vec::new(), Vec::<f64>::new());
    for (axis, key) in places.iter().enumerate() {
        let given = axis < 2 || fields.optional(key).is_some();
        center.push(if given { fields.number(key)? } else { 0.0 });
    }
    for (axis, key) in sides.iter().enumerate() {
        let given = axis < 2 || fields.optional(key).is_some();
        size.push(if given { fields.positive(key)? } else { size[0].min(size[1]) });
    }
    Ok(Destination::new(id, center).size(size))
}
