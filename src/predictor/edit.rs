//! Adding, moving and removing destinations while the object is on its way.

use super::Predictor;
use crate::error::{Code, Error, Result};
use crate::model::destination::{Destination, Destinations};
use crate::value::{Node, Value};
use std::sync::Arc;

impl Predictor {
    /// Adds a destination at the end, in mid-movement too.
    ///
    /// # Errors
    /// Those of a scenario's destination; `duplicate-id`; `method-accumulates` in mid-movement where the method, or a motion
    /// model that depends on the destination, accumulates for each of them. Nothing has changed then.
    pub fn add_destination(&mut self, destination: &Value) -> Result<()> {
        let destination = Destination::read(&Node::root(destination, "destination"), self.dimensions())?;
        self.replace(self.destinations.with(destination, self.states())?)
    }

    /// Puts another destination in the place of `id`; it keeps the id, and `destination` may leave it out.
    ///
    /// # Errors
    /// `unknown-id`, and as [`Predictor::add_destination`].
    pub fn update_destination(&mut self, id: &str, destination: &Value) -> Result<()> {
        let i = self.destinations.index_of(id)?;
        let mut named = destination.clone();
        if let Value::Map(entries) = &mut named {
            match entries.iter().find(|(key, value)| key == "id" && *value != Value::Null) {
                Some((_, given)) if *given != Value::text(id) => {
                    let message = format!("must stay {}, got {}", Value::text(id).quoted(), given.quoted());
                    return Err(Error::new(Code::OutOfRange, "destination.id", message));
                }
                Some(_) => {}
                None => {
                    entries.retain(|(key, _)| key != "id");
                    entries.push(("id".to_owned(), Value::text(id)));
                }
            }
        }
        let destination = Destination::read(&Node::root(&named, "destination"), self.dimensions())?;
        self.replace(self.destinations.with_replaced(i, destination, self.states())?)
    }

    /// Takes a destination out.
    ///
    /// # Errors
    /// `unknown-id`, `no-destinations` for the last one, and as [`Predictor::add_destination`].
    pub fn remove_destination(&mut self, id: &str) -> Result<()> {
        let i = self.destinations.index_of(id)?;
        self.replace(self.destinations.without(i)?)
    }

    /// Sets all destinations at once, a scenario's list of them; ids that stay keep their state.
    ///
    /// # Errors
    /// Those of a scenario's destinations, and as [`Predictor::add_destination`].
    pub fn set_destinations(&mut self, destinations: &Value) -> Result<()> {
        let node = Node::root(destinations, "destinations");
        let changed = Destinations::read(&node, self.dimensions(), self.states())?;
        self.replace(changed)
    }

    fn replace(&mut self, changed: Destinations) -> Result<()> {
        self.scenario.check_destinations(&changed)?;
        if self.movement.is_none() {
            self.destinations = Arc::new(changed);
            self.apply_habits();
            self.stale = true;
            return Ok(());
        }
        self.scenario.refuse_accumulating("destinations", "destinations cannot change in mid-movement")?;
        let origin = if self.scenario.motion.depends_on_destination() { Some(self.origins(&changed)?) } else { None };
        self.destinations = Arc::new(changed);
        self.apply_habits();
        if let Some(movement) = &mut self.movement {
            movement.engine.replan(&self.destinations, origin.as_deref());
        }
        self.stale = true;
        Ok(())
    }

    /// Which of the present destinations each of `changed` is: their motion, and so their evidence, must stay.
    fn origins(&self, changed: &Destinations) -> Result<Vec<usize>> {
        let find = |j: usize| {
            let found =
                self.destinations.find(changed.id(j)).filter(|&i| self.destinations.center(i) == changed.center(j));
            found.ok_or_else(|| {
                let message = "cannot be added or moved in mid-movement: the motion model depends on the destination, so \
                               evidence accumulates for each of them";
                Error::new(Code::MethodAccumulates, format!("destinations[{j}]"), message)
            })
        };
        (0..changed.len()).map(find).collect()
    }
}
