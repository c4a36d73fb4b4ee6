//! Destinations, Liang (4): the endpoint `G~ x_T ~ N(a_i, S_i)`, a prior weight, and where wanted an arrival prior of its own.

use super::arrival::Arrival;
use super::observation::read_covariance;
use crate::error::{Code, Error, Result};
use crate::math::kernel::mixture::AXES;
use crate::math::kernel::vectors::Block;
use crate::value::{Node, Value, number, quote};

use std::collections::HashMap;

mod edit;
mod ids;
mod kind;
mod kinds;
mod means;

use crate::math::kernel::columns::{Column, Filler};
use ids::Ids;
pub use kind::Kind;
use kinds::Kinds;
pub use means::Center;
use means::Means;

/// More destinations than this are an error, so that no input can exhaust the memory.
pub const MOST_DESTINATIONS: usize = 1_000_000;

/// One nominal destination.
///
/// ```
/// use whither::{Destination, Value, value::Node};
/// let value: Value = serde_json::from_str(r#"{ "id": "map", "center": [500, 300], "size": [60, 12] }"#).unwrap();
/// let destination = Destination::read(&Node::root(&value, "destination"), 2, 4).unwrap();
/// assert_eq!((destination.mean, destination.prior), (vec![500.0, 300.0], 1.0));
/// assert_eq!(destination.kind.covariance()[(1, 1)], 12.0); // of an even density: 12^2 / 12
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Destination {
    /// Its name, unique among the destinations.
    pub id: String,
    /// The endpoint's mean `a_i`: its first `l` components of the state.
    pub mean: Vec<f64>,
    /// Weight before any observation; only ratios matter.
    pub prior: f64,
    /// Everything that destinations may share.
    pub kind: Kind,
}

const KEYS: [&str; 8] = ["id", "mean", "covariance", "center", "size", "endVelocity", "prior", "arrival"];

impl Destination {
    /// Reads `{ id, mean, covariance }` or `{ id, center, size, endVelocity? }`, each with `prior?` (1) and `arrival?`, for a
    /// motion model of `states` components in `dimensions` axes. A box's covariance is that of a uniform density over it,
    /// `size^2 / 12` for each side.
    ///
    /// # Errors
    /// `unknown-key`, `missing-key`, `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`, `not-positive-definite`.
    pub fn read(node: &Node<'_>, dimensions: usize, states: usize) -> Result<Self> {
        let fields = node.fields(&KEYS)?;
        let id = fields.required("id")?.text()?.to_owned();
        let prior = fields.optional("prior").map_or(Ok(1.0), |prior| prior.not_negative())?;
        let arrival = fields.optional("arrival").map(|node| {
            let arrival = Arrival::read(&node)?;
            arrival.check(node.place()).map(|()| arrival)
        });
        let arrival = arrival.transpose()?;
        let Some(center) = fields.optional("center") else {
            for key in ["size", "endVelocity"] {
                if let Some(extra) = fields.optional(key) {
                    return Err(extra.error(Code::UnknownKey, "cannot be combined with mean and covariance"));
                }
            }
            let field = fields.required("mean")?;
            let mean = field.vector(None)?;
            if mean.len() < dimensions || mean.len() > states {
                let must = format!("must have {dimensions} to {states} numbers, has {}", mean.len());
                return Err(field.error(Code::WrongLength, &must));
            }
            let covariance = read_covariance(&fields.required("covariance")?, mean.len())?;
            return Ok(Self { id, mean, prior, kind: Kind::of_covariance(covariance, arrival) });
        };
        for key in ["mean", "covariance"] {
            if let Some(extra) = fields.optional(key) {
                return Err(extra.error(Code::UnknownKey, "cannot be combined with center and size"));
            }
        }
        let mut mean = center.vector(Some(dimensions))?;
        let size = fields.required("size")?.for_each_axis(dimensions, |n| n.positive())?;
        let end_velocity = fields.optional("endVelocity");
        if let Some(field) = &end_velocity {
            if states < 2 * dimensions {
                return Err(field.error(Code::OutOfRange, "the motion model has no velocity"));
            }
            mean.extend(vec![0.0; dimensions]);
        }
        let end_velocity = end_velocity.map(|field| field.positive()).transpose()?;
        Ok(Self { id, mean, prior, kind: Kind::of_box(&size, end_velocity, arrival) })
    }

    /// The scenario's own form.
    #[must_use]
    pub fn to_value(&self) -> Value {
        let mut entries = vec![("id".to_owned(), Value::text(&self.id))];
        let mut put = |key: &str, value: Value| entries.push((key.to_owned(), value));
        if let Some(size) = self.kind.size() {
            put("center", Value::numbers(&self.mean[..size.len()]));
            put("size", Value::numbers(size));
            if let Some(deviation) = self.kind.end_velocity() {
                put("endVelocity", Value::Number(deviation));
            }
        } else {
            put("mean", Value::numbers(&self.mean));
            let covariance = self.kind.covariance();
            let rows = covariance.row_iter().map(|row| Value::numbers(row.iter()));
            put("covariance", Value::List(rows.collect()));
        }
        put("prior", Value::Number(self.prior));
        if let Some(arrival) = self.kind.arrival() {
            put("arrival", arrival.to_value());
        }
        Value::Map(entries)
    }
}

/// The destinations of a predictor, in order, as flat arrays, a list for each axis, which the hot loops read as they stand;
/// what destinations share is kept once for each kind.
///
/// ```
/// use whither::{Value, model::destination::Destinations, value::Node};
/// let value: Value = serde_json::from_str(r#"[
///     { "id": "near", "center": [10], "size": 12 }, { "id": "far", "center": [90], "size": 12, "prior": 3 }
/// ]"#).unwrap();
/// let destinations = Destinations::read(&Node::root(&value, "destinations"), 1, 1).unwrap();
/// assert_eq!((destinations.len(), destinations.index_of("far").unwrap()), (2, 1));
/// assert_eq!(destinations.priors(), [1.0, 3.0]);
/// assert_eq!(destinations.kinds().len(), 1); // of the same size, so they share their covariance
/// ```
#[derive(Clone, Debug)]
pub struct Destinations {
    ids: Ids,
    /// Positions in `ids`, sorted by id.
    by_id: Vec<u32>,
    means: Means,
    priors: Column,
    /// The priors in force where they are learnt.
    learnt: Option<Column>,
    kinds: Kinds,
}

impl Destinations {
    /// Reads a list of destinations for a motion model of `states` components in `dimensions` axes.
    ///
    /// # Errors
    /// As [`Destination::read`]; `no-destinations`, `duplicate-id`, `too-large`, and `out-of-range` where every prior is zero.
    pub fn read(node: &Node<'_>, dimensions: usize, states: usize) -> Result<Self> {
        let items = node.items()?;
        let count = items.len();
        if count == 0 {
            return Err(Error::new(Code::NoDestinations, node.path(), "must have at least one destination, has none"));
        }
        if count > MOST_DESTINATIONS {
            let message = format!("must have at most {MOST_DESTINATIONS} destinations, has {count}");
            return Err(Error::new(Code::TooLarge, node.path(), message));
        }
        let mut all = Self {
            ids: Ids::with_capacity(count),
            by_id: Vec::new(),
            means: Means::with_capacity(count, dimensions),
            priors: Column::with_capacity(count, Filler::Zero),
            learnt: None,
            kinds: Kinds::default(),
        };
        let mut known = HashMap::new();
        for item in items {
            let destination = Destination::read(&item, dimensions, states)?;
            let kind = *known.entry(destination.kind.fingerprint()).or_insert(all.kinds.list().len());
            if kind == all.kinds.list().len() {
                all.kinds.add(&destination.kind);
            }
            all.push(&destination, kind);
        }
        let mut by_id: Vec<u32> = (0..count as u32).collect();
        by_id.sort_by_key(|&i| all.ids.get(i as usize));
        for pair in by_id.windows(2) {
            let (first, second) = (pair[0] as usize, pair[1] as usize);
            if all.ids.get(first) == all.ids.get(second) {
                let path = format!("{}[{second}].id", node.path());
                return Err(duplicate(path, all.ids.get(first), first));
            }
        }
        all.by_id = by_id;
        all.ids.trim();
        all.kinds.trim();
        all.check_priors(&node.path())?;
        Ok(all)
    }

    fn push(&mut self, destination: &Destination, kind: usize) {
        self.ids.push(&destination.id);
        self.means.push(&destination.mean);
        self.priors.push(destination.prior);
        self.kinds.push(kind);
    }

    fn check_priors(&self, path: &str) -> Result<()> {
        let total: f64 = self.priors.numbers().iter().sum();
        if total > 0.0 && total.is_finite() {
            return Ok(());
        }
        Err(Error::new(
            Code::OutOfRange,
            path,
            format!("the priors must have a finite sum above 0, it is {}", number(total)),
        ))
    }

    /// How many there are; at least one.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Never true: a predictor keeps at least one destination.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Spatial dimensions `d`.
    #[must_use]
    pub const fn dimensions(&self) -> usize {
        self.means.dimensions
    }

    /// The ids, in order.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = &str> {
        self.ids.iter()
    }

    /// The id of destination `i`.
    #[must_use]
    pub fn id(&self, i: usize) -> &str {
        self.ids.get(i)
    }

    /// The place of a destination in the order.
    #[must_use]
    pub fn find(&self, id: &str) -> Option<usize> {
        self.by_id.binary_search_by(|&i| self.ids.get(i as usize).cmp(id)).ok().map(|place| self.by_id[place] as usize)
    }

    /// The place of a destination in the order.
    ///
    /// # Errors
    /// `unknown-id`.
    pub fn index_of(&self, id: &str) -> Result<usize> {
        self.find(id).ok_or_else(|| {
            let shown: Vec<String> = self.ids.iter().take(5).map(quote).collect();
            let more = if self.len() > 5 { ", ..." } else { "" };
            let message = format!("no destination {}, there are {}{more}", quote(id), shown.join(", "));
            Error::new(Code::UnknownId, "id", message)
        })
    }

    /// The endpoint's mean `a_i`, of length `l`.
    #[must_use]
    pub fn mean(&self, i: usize) -> Vec<f64> {
        self.means.components(i, 0, self.kind(i).length())
    }

    /// The centre, the first `d` components of the endpoint's mean.
    #[must_use]
    pub fn center(&self, i: usize) -> Center {
        self.means.center(i)
    }

    /// The components of the endpoint's mean after the first `d`.
    #[must_use]
    pub fn rest(&self, i: usize) -> Vec<f64> {
        self.means.components(i, self.dimensions(), self.kind(i).length())
    }

    /// The centres in whole blocks, a list for each axis. The last block is filled up with its first destination.
    #[must_use]
    pub(crate) fn coordinates(&self) -> [&[Block]; AXES] {
        self.means.coordinates()
    }

    fn in_force(&self) -> &Column {
        self.learnt.as_ref().unwrap_or(&self.priors)
    }

    /// The prior weights, not normalised.
    #[must_use]
    pub fn priors(&self) -> &[f64] {
        self.in_force().numbers()
    }

    /// The same in whole blocks; the last one is filled up with zeros.
    #[must_use]
    pub(crate) fn prior_blocks(&self) -> &[Block] {
        self.in_force().blocks()
    }

    /// The prior weights as they were given, not normalised.
    #[must_use]
    pub fn given_priors(&self) -> &[f64] {
        self.priors.numbers()
    }

    /// Puts learnt priors in force, one for each destination, until the destinations change.
    pub fn learn(&mut self, priors: &[f64]) {
        let mut learnt = Column::with_capacity(priors.len(), Filler::Zero);
        priors.iter().for_each(|prior| learnt.push(*prior));
        self.learnt = (priors.len() == self.len()).then_some(learnt);
    }

    /// What destination `i` shares with others.
    #[must_use]
    pub fn kind(&self, i: usize) -> &Kind {
        &self.kinds()[self.kind_number(i)]
    }

    /// Which of the kinds destination `i` is of.
    #[must_use]
    pub fn kind_number(&self, i: usize) -> usize {
        self.kinds.of(i)
    }

    /// The kinds; some may have no destination left.
    #[must_use]
    pub fn kinds(&self) -> &[Kind] {
        self.kinds.list()
    }

    /// Destination `i` in full.
    #[must_use]
    pub fn get(&self, i: usize) -> Destination {
        Destination {
            id: self.id(i).to_owned(),
            mean: self.mean(i),
            prior: self.priors.numbers()[i],
            kind: self.kind(i).clone(),
        }
    }

    /// The scenario's own form.
    #[must_use]
    pub fn to_value(&self) -> Value {
        Value::List((0..self.len()).map(|i| self.get(i).to_value()).collect())
    }
}

fn duplicate(path: String, id: &str, first: usize) -> Error {
    Error::new(Code::DuplicateId, path, format!("the id {} is taken by destinations[{first}]", quote(id)))
}
