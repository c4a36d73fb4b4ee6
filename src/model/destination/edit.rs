//! Destinations that come, change and go.

use super::{Destination, Destinations, MOST_DESTINATIONS, duplicate};
use crate::error::{Code, Error, Result};

impl Destinations {
    /// Adds a destination at the end.
    ///
    /// # Errors
    /// `duplicate-id`, `too-large`.
    pub fn add(&mut self, destination: &Destination) -> Result<()> {
        self.learnt = None;
        let place = match self.by_id.binary_search_by(|&i| self.id(i as usize).cmp(destination.id.as_str())) {
            Ok(place) => return Err(duplicate("id".to_owned(), &destination.id, self.by_id[place] as usize)),
            Err(place) => place,
        };
        if self.len() >= MOST_DESTINATIONS {
            let message = format!("must have at most {MOST_DESTINATIONS} destinations");
            return Err(Error::new(Code::TooLarge, "destinations", message));
        }
        self.by_id.insert(place, self.ids.len() as u32);
        let kind = self.kinds.place(&destination.kind, None);
        self.push(destination, kind);
        Ok(())
    }

    /// Puts another destination in the place of `i`, under the same id.
    ///
    /// # Errors
    /// `out-of-range` where no prior would be left above zero; nothing has changed then.
    pub fn update(&mut self, i: usize, destination: &Destination) -> Result<()> {
        self.learnt = None;
        let prior = self.priors.replace(i, destination.prior);
        if let Err(error) = self.check_priors("prior") {
            self.priors.replace(i, prior);
            return Err(error);
        }
        self.means.replace(i, &destination.mean);
        if *self.kind(i) != destination.kind {
            self.kinds.replace(i, &destination.kind);
        }
        Ok(())
    }

    /// Takes destination `i` out; those after it move up.
    ///
    /// # Errors
    /// `no-destinations` where it is the last one, `out-of-range` where no prior would be left above zero.
    pub fn remove(&mut self, i: usize) -> Result<()> {
        self.learnt = None;
        if self.len() == 1 {
            return Err(Error::new(Code::NoDestinations, "id", "the last destination cannot be removed"));
        }
        let prior = self.priors.replace(i, 0.0);
        if let Err(error) = self.check_priors("destinations") {
            self.priors.replace(i, prior);
            return Err(error);
        }
        self.ids.remove(i);
        self.priors.remove(i);
        self.kinds.remove(i);
        self.means.remove(i);
        self.by_id.retain(|&j| j as usize != i);
        for j in &mut self.by_id {
            *j -= u32::from(*j as usize > i);
        }
        Ok(())
    }

    /// Numbers the kinds anew, as reading a list does: what is computed from a list must not depend on how it came about.
    pub fn renumber(&mut self) {
        self.kinds.renumber();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::{Node, Value};

    #[test]
    fn a_longer_endpoint_makes_room_and_moves_no_other() {
        let list: Value = serde_json::from_str(
            r#"[{ "id": "a", "center": [1, 2], "size": 3 }, { "id": "b", "center": [4, 5], "size": 3 }]"#,
        )
        .unwrap();
        let mut destinations = Destinations::read(&Node::root(&list, "destinations"), 2, 4).unwrap();
        let longer: Value = serde_json::from_str(
            r#"{ "id": "c", "mean": [6, 7, 8], "covariance": [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }"#,
        )
        .unwrap();
        destinations.add(&Destination::read(&Node::root(&longer, "destination"), 2, 4).unwrap()).unwrap();
        assert_eq!([0, 1, 2].map(|i| destinations.mean(i)), [vec![1.0, 2.0], vec![4.0, 5.0], vec![6.0, 7.0, 8.0]]);
        let longest: Value =
            serde_json::from_str(r#"{ "id": "a", "center": [-1, -2], "size": 3, "endVelocity": 9 }"#).unwrap();
        destinations.update(0, &Destination::read(&Node::root(&longest, "destination"), 2, 4).unwrap()).unwrap();
        destinations.remove(1).unwrap();
        assert_eq!([0, 1].map(|i| destinations.mean(i)), [vec![-1.0, -2.0, 0.0, 0.0], vec![6.0, 7.0, 8.0]]);
        assert_eq!(destinations.ids().collect::<Vec<_>>(), ["a", "c"]);
    }
}
