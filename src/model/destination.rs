//! Destinations, Liang (4): the endpoint `G~ x_T ~ N(a_i, S_i)`, a prior weight, and where wanted an arrival prior of its own.

use super::arrival::Arrival;
use super::matrix::Matrix;
use super::per_axis::PerAxis;
use crate::error::{Code, Error, Result};
use crate::value::{Node, Path, Value, quote};
use serde::{Serialize, Serializer};
use whither_kernel::mixture::AXES;

mod class;
mod kept;
mod list;

pub use class::EndpointClass;
pub use list::Destinations;

/// One nominal destination, as it is described: a box, whose endpoint has the covariance of a uniform density over it,
/// `size^2 / 12` for each side, or a Gaussian. What takes destinations validates them.
///
/// ```
/// use whither::Destination;
/// let map = Destination::new("map", [600.0, 300.0]).size([90.0, 60.0]).end_velocity(200.0).prior(2.0);
/// let harbour = Destination::gaussian("harbour", [4.0, 9.0], [[2.0, 0.5], [0.5, 1.0]]);
/// assert_eq!(serde_json::to_value(&map).unwrap()["size"][1], 60.0);
/// assert_eq!(serde_json::to_value(&harbour).unwrap()["covariance"][1][0], 0.5);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Destination {
    id: String,
    center: Option<Vec<f64>>,
    size: Option<PerAxis>,
    end_velocity: Option<f64>,
    mean: Option<Vec<f64>>,
    covariance: Option<Matrix>,
    prior: f64,
    /// Boxed, since few have one, and thousands of destinations are moved.
    arrival: Option<Box<Arrival>>,
}

/// An endpoint `N(a_i, S_i)`, validated, with its prior weight.
#[derive(Clone, Debug)]
struct Endpoint {
    /// The offset of the end of its id in the text of all ids.
    id_end: usize,
    /// The first `d` components of the mean `a_i`.
    center: [f64; AXES],
    /// The components after the centre; empty where they are zero, as a box's are.
    rest: Box<[f64]>,
    prior: f64,
    /// Its place among the classes of [`Destinations`], which has `S_i`.
    class: u32,
}

impl Destination {
    fn with_id(id: impl Into<String>) -> Self {
        let id = id.into();
        Self {
            id,
            center: None,
            size: None,
            end_velocity: None,
            mean: None,
            covariance: None,
            prior: 1.0,
            arrival: None,
        }
    }

    /// A box about `center`, one number for each axis, of a [`Destination::size`] that is still to be given; `id` is unique among
    /// the destinations.
    #[must_use]
    pub fn new(id: impl Into<String>, center: impl Into<Vec<f64>>) -> Self {
        Self { center: Some(center.into()), ..Self::with_id(id) }
    }

    /// A Gaussian endpoint: the mean `a_i` and the covariance `S_i` of the first `l` components of the state, from the position
    /// alone to all of it.
    #[must_use]
    pub fn gaussian(id: impl Into<String>, mean: impl Into<Vec<f64>>, covariance: impl Into<Matrix>) -> Self {
        Self { mean: Some(mean.into()), covariance: Some(covariance.into()), ..Self::with_id(id) }
    }

    /// The sides of the box, greater than zero: one number for all axes, or one for each.
    #[must_use]
    pub fn size(self, size: impl Into<PerAxis>) -> Self {
        Self { size: Some(size.into()), ..self }
    }

    /// The deviation of the velocity on arrival, about zero, in each axis; without it nothing is known of that velocity.
    #[must_use]
    pub fn end_velocity(self, deviation: f64) -> Self {
        Self { end_velocity: Some(deviation), ..self }
    }

    /// The weight before any observation, 1 if not given; only ratios matter.
    #[must_use]
    pub fn prior(self, prior: f64) -> Self {
        Self { prior, ..self }
    }

    /// An arrival prior of its own in place of the scenario's.
    #[must_use]
    pub fn arrival(self, arrival: Arrival) -> Self {
        Self { arrival: Some(Box::new(arrival)), ..self }
    }

    /// Its id.
    pub(crate) fn id(&self) -> &str {
        &self.id
    }

    /// Reads a list of destinations.
    ///
    /// # Errors
    /// As [`Destination::read`].
    pub(crate) fn read_all(node: &Node<'_>, dimensions: usize) -> Result<Vec<Self>> {
        let items = node.items()?;
        let mut all = Vec::with_capacity(items.len());
        for item in items {
            all.push(Self::read(&item, dimensions)?);
        }
        Ok(all)
    }

    /// Reads `{ id, mean, covariance }` or `{ id, center, size, endVelocity? }`, each with `prior?` (1) and `arrival?`.
    ///
    /// # Errors
    /// `unknown-key`, `missing-key`, `wrong-type`, and those of an arrival prior.
    pub(crate) fn read(node: &Node<'_>, dimensions: usize) -> Result<Self> {
        let keys = ["id", "mean", "covariance", "center", "size", "endVelocity", "prior", "arrival"];
        let fields = node.fields(&keys)?;
        let number = |key| fields.optional(key).map(|field| field.float()).transpose();
        let numbers = |key| fields.optional(key).map(|field| field.floats()).transpose();
        Ok(Self {
            id: fields.required("id")?.text()?.to_owned(),
            center: numbers("center")?,
            size: fields.optional("size").map(|size| PerAxis::read(&size, dimensions)).transpose()?,
            end_velocity: number("endVelocity")?,
            mean: numbers("mean")?,
            covariance: fields.optional("covariance").map(|covariance| Matrix::read(&covariance)).transpose()?,
            prior: number("prior")?.unwrap_or(1.0),
            arrival: fields.optional("arrival").map(|arrival| Arrival::read(&arrival).map(Box::new)).transpose()?,
        })
    }

    /// The endpoint and its class, for a motion model of `states` components in `dimensions` axes.
    ///
    /// # Errors
    /// `unknown-key`, `missing-key`, `wrong-length`, `not-finite`, `out-of-range`, `not-positive-definite`.
    fn check(&self, path: &Path<'_>, dimensions: usize, states: usize) -> Result<(Endpoint, EndpointClass)> {
        let missing =
            |key: &str| Error::new(Code::MissingKey, path.key(key).to_string(), format!("missing key {}", quote(key)));
        let prior = path.key("prior").not_negative(self.prior)?;
        if let Some(arrival) = &self.arrival {
            arrival.check(&path.key("arrival"))?;
        }
        let mut center = [0.0; AXES];
        let (rest, class) = if let Some(given) = &self.center {
            let refused = "cannot be combined with center and size";
            if let Some(mean) = &self.mean {
                return Err(path.key("mean").error(Code::UnknownKey, refused, mean.as_slice()));
            }
            if let Some(covariance) = &self.covariance {
                return Err(path.key("covariance").error(Code::UnknownKey, refused, covariance));
            }
            let given = path.key("center").vector(given, dimensions, |at, x| at.number(x))?;
            center[..dimensions].copy_from_slice(given);
            let mut sides = [0.0; AXES];
            let size = self.size.as_ref().ok_or_else(|| missing("size"))?;
            size.write(&path.key("size"), |at, x| at.positive(x), &mut sides[..dimensions])?;
            if let Some(deviation) = self.end_velocity {
                let path = path.key("endVelocity");
                if states < 2 * dimensions {
                    return Err(path.error(Code::OutOfRange, "the motion model has no velocity", deviation));
                }
                path.positive(deviation)?;
            }
            (Box::default(), EndpointClass::of_box(sides, dimensions, self.end_velocity, self.arrival.clone()))
        } else {
            let refused = "cannot be combined with mean and covariance";
            if let Some(size) = &self.size {
                return Err(path.key("size").error(Code::UnknownKey, refused, size.to_value()));
            }
            if let Some(deviation) = self.end_velocity {
                return Err(path.key("endVelocity").error(Code::UnknownKey, refused, deviation));
            }
            let mean = self.mean.as_ref().ok_or_else(|| missing("mean"))?;
            let at = path.key("mean");
            if mean.len() < dimensions || mean.len() > states {
                let must = format!("must have {dimensions} to {states} numbers, has {}", mean.len());
                return Err(at.error(Code::WrongLength, &must, mean.as_slice()));
            }
            let mean = at.each(mean, |at, x| at.number(x))?;
            let covariance = self.covariance.as_ref().ok_or_else(|| missing("covariance"))?;
            let covariance = covariance.covariance(&path.key("covariance"), mean.len())?;
            let (first, rest) = mean.split_at(dimensions);
            center[..dimensions].copy_from_slice(first);
            (rest.into(), EndpointClass::of_covariance(covariance, self.arrival.clone()))
        };
        Ok((Endpoint { id_end: 0, center, rest, prior, class: 0 }, class))
    }

    /// The scenario's own form.
    #[must_use]
    pub(crate) fn to_value(&self) -> Value {
        let fields = [
            ("id", Some(Value::text(&self.id))),
            ("center", self.center.as_ref().map(Value::numbers)),
            ("size", self.size.as_ref().map(PerAxis::to_value)),
            ("endVelocity", self.end_velocity.map(Value::Number)),
            ("mean", self.mean.as_ref().map(Value::numbers)),
            ("covariance", self.covariance.as_ref().map(Value::from)),
            ("prior", Some(Value::Number(self.prior))),
            ("arrival", self.arrival.as_ref().map(|arrival| arrival.to_value())),
        ];
        Value::some(fields.into())
    }
}

impl Serialize for Destination {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        self.to_value().serialize(serializer)
    }
}

#[cfg(test)]
mod tests;
