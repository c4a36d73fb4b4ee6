//! Observations and destinations as data: read, and given to the typed methods. JavaScript's objects come in here.

use super::Predictor;
use crate::error::Result;
use crate::model::destination::Destination;
#[cfg(feature = "wasm")]
use crate::model::observation::ObservationNoise;
use crate::value::{Node, Value};

impl Predictor {
    /// Observes `{ time, position, noise? }`.
    #[cfg(feature = "wasm")]
    pub(crate) fn observe_value(&mut self, node: &Node<'_>) -> Result<()> {
        let fields = node.fields(&["time", "position", "noise"])?;
        let time = fields.float("time")?;
        let position = fields.required("position")?;
        let coordinate = |item: Node<'_>| match item.value() {
            Value::Null => Ok(None),
            _ => item.float().map(Some),
        };
        let position = position.items()?.map(coordinate).collect::<Result<Vec<_>>>()?;
        let noise = fields.optional("noise").map(|noise| ObservationNoise::read(&noise, self.axes())).transpose()?;
        self.observe_with(time, &position, noise.as_ref())
    }

    /// Adds `{ destination }`.
    pub(crate) fn add_value(&mut self, node: &Node<'_>) -> Result<()> {
        let fields = node.fields(&["destination"])?;
        let destination = Destination::read(&fields.required("destination")?, self.dimensions())?;
        self.add_destination(destination)
    }

    /// Replaces `{ id, destination }`, which may leave out its own id.
    pub(crate) fn update_value(&mut self, node: &Node<'_>) -> Result<()> {
        let fields = node.fields(&["id", "destination"])?;
        let (id, destination) = (fields.required("id")?.text()?, fields.required("destination")?);
        self.index_of(id)?;
        let mut named = destination.value().clone();
        if let Value::Map(entries) = &mut named
            && destination.get("id").is_none()
        {
            entries.retain(|(key, _)| **key != *"id");
            entries.push(("id".into(), Value::text(id)));
        }
        let destination = Destination::read(&Node::root(&named, "destination"), self.dimensions())?;
        self.update_destination(id, destination)
    }

    /// Sets all `{ destinations }`.
    pub(crate) fn set_value(&mut self, node: &Node<'_>) -> Result<()> {
        let fields = node.fields(&["destinations"])?;
        let destinations = Destination::read_all(&fields.required("destinations")?, self.dimensions())?;
        self.set_destinations(destinations)
    }
}
