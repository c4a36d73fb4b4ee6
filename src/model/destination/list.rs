//! The destinations of a predictor: found by their ids, and by the classes that share their matrices.

use super::class::Fingerprint;
use super::kept::Kept;
use super::{Destination, Endpoint, EndpointClass};
use crate::error::{Code, Error, Result};
use crate::value::{Path, Value, number, quote};
use fnv::FnvHashMap;
use std::any::Any;
use std::ops::Range;
use std::sync::Arc;
use whither_kernel::mixture::AXES;

/// More destinations than this are an error, so that no input can exhaust the memory.
pub const MOST_DESTINATIONS: usize = 1_000_000;

/// The destinations of a predictor, validated, in order.
#[derive(Clone, Debug)]
pub struct Destinations {
    dimensions: usize,
    /// The ids, one after the other: thousands of small allocations that stay would scatter all later ones over the memory.
    ids: String,
    endpoints: Vec<Endpoint>,
    /// In the order of their first destinations; each has one.
    classes: Vec<EndpointClass>,
    /// The prior weights in force: those that were given, or learnt.
    priors: Vec<f64>,
    /// What an engine has computed from all of this.
    kept: Kept,
}

impl Destinations {
    /// The destinations for a motion model of `states` components in `dimensions` axes.
    ///
    /// # Errors
    /// Those of [`Destination`], at `destinations[i]`; `no-destinations`, `duplicate-id`, `too-large`, and `out-of-range` where no
    /// prior is above zero.
    pub fn new(list: &[Destination], dimensions: usize, states: usize) -> Result<Self> {
        let (path, count) = (&Path::root("destinations"), list.len());
        if count == 0 {
            let message = "must have at least one destination, has none";
            return Err(Error::new(Code::NoDestinations, path.to_string(), message));
        }
        if count > MOST_DESTINATIONS {
            return Err(too_many(path, &format!(", has {count}")));
        }
        let mut all = Self {
            dimensions,
            ids: String::new(),
            endpoints: Vec::with_capacity(count),
            classes: Vec::new(),
            priors: Vec::with_capacity(count),
            kept: Kept::default(),
        };
        let mut classes: FnvHashMap<Fingerprint, usize> = FnvHashMap::default();
        for (i, destination) in list.iter().enumerate() {
            let path = path.index(i);
            all.ids.push_str(&destination.id);
            let (mut endpoint, class) = destination.check(&path, dimensions, states)?;
            endpoint.id_end = all.ids.len();
            // most are of the class before, which is sooner compared than looked up
            endpoint.class = match all.endpoints.last() {
                Some(before) if all.classes[before.class as usize] == class => before.class,
                _ => {
                    let place = *classes.entry(class.fingerprint()).or_insert(all.classes.len());
                    if place == all.classes.len() {
                        all.classes.push(class);
                    }
                    place as u32
                }
            };
            all.priors.push(endpoint.prior);
            all.endpoints.push(endpoint);
        }
        all.classes.shrink_to_fit();
        let mut places = FnvHashMap::with_capacity_and_hasher(count, Default::default());
        for (id, second) in all.ids().zip(0usize..) {
            if let Some(first) = places.insert(id, second) {
                return Err(duplicate(&path.index(second).key("id"), id, first));
            }
        }
        all.ids.shrink_to_fit();
        all.check_priors(path)?;
        Ok(all)
    }

    fn check_priors(&self, path: &Path<'_>) -> Result<()> {
        let total: f64 = self.given_priors().sum();
        if total > 0.0 && total.is_finite() {
            return Ok(());
        }
        let message = format!("the priors must have a finite sum above 0, it is {}", number(total));
        Err(Error::new(Code::OutOfRange, path.to_string(), message))
    }

    /// Adds a destination at the end.
    ///
    /// # Errors
    /// Those of [`Destination`], at `destination`; `duplicate-id`, `too-large`.
    pub fn with(&self, destination: Destination, states: usize) -> Result<Self> {
        let id = &destination.id;
        let (mut endpoint, class) = destination.check(&Path::root("destination"), self.dimensions, states)?;
        if let Some(first) = self.find(id) {
            return Err(duplicate(&Path::root("id"), id, first));
        }
        if self.len() >= MOST_DESTINATIONS {
            return Err(too_many(&Path::root("destinations"), ""));
        }
        let mut changed = self.clone();
        changed.ids.push_str(id);
        endpoint.id_end = changed.ids.len();
        changed.endpoints.push(endpoint);
        changed.reclassify(self.len(), Some(class));
        Ok(changed)
    }

    /// Puts another destination in the place of `i`, under the same id.
    ///
    /// # Errors
    /// Those of [`Destination`], at `destination`; `out-of-range` where no prior would be left above zero.
    pub fn with_replaced(&self, i: usize, destination: Destination, states: usize) -> Result<Self> {
        let (endpoint, class) = destination.check(&Path::root("destination"), self.dimensions, states)?;
        let mut changed = self.clone();
        changed.endpoints[i] = Endpoint { id_end: self.endpoints[i].id_end, ..endpoint };
        changed.check_priors(&Path::root("prior"))?;
        changed.reclassify(i, Some(class));
        Ok(changed)
    }

    /// Takes destination `i` out; those after it move up.
    ///
    /// # Errors
    /// `no-destinations` where it is the last one, `out-of-range` where no prior would be left above zero.
    pub fn without(&self, i: usize) -> Result<Self> {
        if self.len() == 1 {
            return Err(Error::new(Code::NoDestinations, "id", "the last destination cannot be removed"));
        }
        let mut changed = self.clone();
        changed.endpoints.remove(i);
        let id = self.id_range(i);
        changed.endpoints[i..].iter_mut().for_each(|endpoint| endpoint.id_end -= id.len());
        changed.ids.drain(id);
        changed.check_priors(&Path::root("destinations"))?;
        changed.reclassify(i, None);
        Ok(changed)
    }

    /// After a change: the given priors are in force, and the classes, with `class` for endpoint `i`, are numbered by their first
    /// destinations, as reading a list does, since what is computed must not depend on how a list came about.
    fn reclassify(&mut self, i: usize, class: Option<EndpointClass>) {
        self.priors = self.given_priors().collect();
        if let Some(class) = class {
            let known = self.classes.iter().position(|known| *known == class);
            self.endpoints[i].class = known.unwrap_or(self.classes.len()) as u32;
            if known.is_none() {
                self.classes.push(class);
            }
        }
        let mut numbers = vec![None; self.classes.len()];
        let mut classes = Vec::new();
        for endpoint in &mut self.endpoints {
            let before = endpoint.class as usize;
            endpoint.class = *numbers[before].get_or_insert_with(|| {
                classes.push(self.classes[before].clone());
                classes.len() as u32 - 1
            });
        }
        self.classes = classes;
    }

    /// How many there are; at least one.
    #[must_use]
    pub fn len(&self) -> usize {
        self.endpoints.len()
    }

    /// Never true: a predictor keeps at least one destination.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.endpoints.is_empty()
    }

    /// Spatial dimensions `d`.
    #[must_use]
    pub const fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// The ids, in order.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = &str> {
        (0..self.len()).map(|i| self.id(i))
    }

    /// The id of destination `i`.
    #[must_use]
    pub fn id(&self, i: usize) -> &str {
        self.ids.get(self.id_range(i)).unwrap_or_default()
    }

    /// How many bytes all ids have together.
    #[must_use]
    pub const fn ids_length(&self) -> usize {
        self.ids.len()
    }

    fn id_range(&self, i: usize) -> Range<usize> {
        let start = if i == 0 { 0 } else { self.endpoints[i - 1].id_end };
        start..self.endpoints[i].id_end
    }

    /// The place of a destination in the order.
    #[must_use]
    pub fn find(&self, id: &str) -> Option<usize> {
        self.ids().position(|known| known == id)
    }

    /// The places of all, for those who look many up.
    #[must_use]
    pub fn places(&self) -> FnvHashMap<&str, usize> {
        self.ids().zip(0..).collect()
    }

    /// The place of a destination in the order.
    ///
    /// # Errors
    /// `unknown-id`.
    pub fn index_of(&self, id: &str) -> Result<usize> {
        self.find(id).ok_or_else(|| {
            let shown: Vec<String> = self.ids().take(5).map(quote).collect();
            let more = if self.len() > 5 { ", ..." } else { "" };
            let message = format!("no destination {}, there are {}{more}", quote(id), shown.join(", "));
            Error::new(Code::UnknownId, "id", message)
        })
    }

    /// The centre, the first `d` components of the endpoint's mean.
    #[must_use]
    pub fn center(&self, i: usize) -> &[f64] {
        &self.endpoints[i].center[..self.dimensions]
    }

    /// The centre; components beyond the dimensions are zero.
    #[must_use]
    pub fn position(&self, i: usize) -> &[f64; AXES] {
        &self.endpoints[i].center
    }

    /// The components of the endpoint's mean after the first `d`; none where all are zero.
    #[must_use]
    pub fn rest(&self, i: usize) -> &[f64] {
        &self.endpoints[i].rest
    }

    /// The endpoint's mean `a_i`, of length `l`.
    #[must_use]
    pub fn mean(&self, i: usize) -> Vec<f64> {
        let length = self.class(i).length();
        let mut mean = Vec::with_capacity(length);
        mean.extend_from_slice(self.center(i));
        mean.extend_from_slice(&self.endpoints[i].rest);
        mean.resize(length, 0.0);
        mean
    }

    /// The prior weights, not normalised.
    #[must_use]
    pub fn priors(&self) -> &[f64] {
        &self.priors
    }

    /// The prior weights as they were given, not normalised.
    pub fn given_priors(&self) -> impl ExactSizeIterator<Item = f64> {
        self.endpoints.iter().map(|endpoint| endpoint.prior)
    }

    /// The same with learnt priors in force, one for each destination.
    #[must_use]
    pub fn with_priors(self, priors: Vec<f64>) -> Self {
        Self { priors, kept: Kept::default(), ..self }
    }

    /// What an engine computes from these destinations alone: `make` is called for the first of those who ask, and the value is
    /// kept. All who ask have to ask for the same.
    #[must_use]
    pub fn kept<T: Any + Send + Sync>(&self, make: impl Fn() -> T) -> Arc<T> {
        self.kept.get(make)
    }

    /// The class of destination `i`.
    #[must_use]
    pub fn class(&self, i: usize) -> &EndpointClass {
        &self.classes[self.class_number(i)]
    }

    /// Which of the classes destination `i` is of.
    #[must_use]
    pub fn class_number(&self, i: usize) -> usize {
        self.endpoints[i].class as usize
    }

    /// The classes, in the order of their first destinations.
    #[must_use]
    pub fn classes(&self) -> &[EndpointClass] {
        &self.classes
    }

    /// How many destinations each class has.
    #[must_use]
    pub fn class_sizes(&self) -> Vec<usize> {
        let mut sizes = vec![0; self.classes.len()];
        self.endpoints.iter().for_each(|endpoint| sizes[endpoint.class as usize] += 1);
        sizes
    }

    /// The description of destination `i`.
    #[must_use]
    pub fn get(&self, i: usize) -> Destination {
        let (endpoint, class) = (&self.endpoints[i], self.class(i));
        let described = match class.size() {
            Some(size) => {
                let described = Destination::new(self.id(i), self.center(i)).size(size.to_vec());
                class.end_velocity().into_iter().fold(described, Destination::end_velocity)
            }
            None => Destination::gaussian(self.id(i), self.mean(i), class.covariance()),
        };
        class.arrival().cloned().into_iter().fold(described.prior(endpoint.prior), Destination::arrival)
    }

    /// The scenario's own form.
    #[must_use]
    pub fn to_value(&self) -> Value {
        Value::List((0..self.len()).map(|i| self.get(i).to_value()).collect())
    }
}

fn duplicate(path: &Path<'_>, id: &str, first: usize) -> Error {
    let message = format!("the id {} is taken by destinations[{first}]", quote(id));
    Error::new(Code::DuplicateId, path.to_string(), message)
}

fn too_many(path: &Path<'_>, found: &str) -> Error {
    let message = format!("must have at most {MOST_DESTINATIONS} destinations{found}");
    Error::new(Code::TooLarge, path.to_string(), message)
}
