//! Adding, moving and removing destinations while the object is on its way.

use super::Predictor;
use crate::error::{Code, Error, Result};
use crate::model::destination::{Destination, Destinations};
use crate::value::quote;

impl Predictor {
    /// Adds a destination at the end, in mid-movement too.
    ///
    /// # Errors
    /// Those of a scenario's destination; `duplicate-id`; `method-accumulates` in mid-movement where the method, or a motion
    /// model that knows the destination, accumulates for each of them. Nothing has changed then.
    pub fn add_destination(&mut self, destination: Destination) -> Result<()> {
        self.replace(self.destinations.with(destination, self.states())?)
    }

    /// Puts another destination, of the same id, in the place of `id`.
    ///
    /// # Errors
    /// `unknown-id`, `out-of-range` for another id, and as [`Predictor::add_destination`].
    pub fn update_destination(&mut self, id: &str, destination: Destination) -> Result<()> {
        let i = self.destinations.index_of(id)?;
        if destination.id() != id {
            let message = format!("must stay {}, got {}", quote(id), quote(destination.id()));
            return Err(Error::new(Code::OutOfRange, "destination.id", message));
        }
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

    /// Sets all destinations at once; ids that stay keep their state.
    ///
    /// # Errors
    /// Those of a scenario's destinations, and as [`Predictor::add_destination`].
    pub fn set_destinations(&mut self, destinations: impl IntoIterator<Item = Destination>) -> Result<()> {
        let list: Vec<Destination> = destinations.into_iter().collect();
        self.replace(Destinations::new(&list, self.dimensions(), self.states())?)
    }

    fn replace(&mut self, changed: Destinations) -> Result<()> {
        self.scenario.check_destinations(&changed)?;
        let mut origin = None;
        if self.movement.is_some() {
            self.scenario.refuse_accumulating("destinations", "destinations cannot change in mid-movement")?;
            if self.scenario.motion.depends_on_destination() {
                origin = Some(self.origins(&changed)?);
            }
        }
        self.put_in_force(changed, origin.as_deref());
        Ok(())
    }

    /// Which of the present destinations each of `changed` is: their motion, and so their evidence, must stay.
    fn origins(&self, changed: &Destinations) -> Result<Vec<usize>> {
        let places = self.destinations.places();
        let find = |j: usize| {
            let found = places.get(changed.id(j)).copied();
            found.filter(|&i| self.destinations.center(i) == changed.center(j)).ok_or_else(|| {
                let message = "cannot be added or moved in mid-movement: the motion model depends on the destination, so \
                               evidence accumulates for each of them";
                Error::new(Code::MethodAccumulates, format!("destinations[{j}]"), message)
            })
        };
        (0..changed.len()).map(find).collect()
    }
}
