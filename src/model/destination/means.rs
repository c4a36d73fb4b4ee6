//! The means of the endpoints, a list for each component, as the hot loops read those of the position.

use crate::math::kernel::columns::{Column, Filler};
use crate::math::kernel::mixture::AXES;
use crate::math::kernel::vectors::Block;
use std::ops::Deref;

/// The centre of a destination, the first `d` components of its endpoint's mean.
///
/// ```
/// use whither::{Value, model::destination::Destinations, value::Node};
/// let value: Value = serde_json::from_str(r#"[{ "id": "map", "center": [500, 300], "size": 60 }]"#).unwrap();
/// let destinations = Destinations::read(&Node::root(&value, "destinations"), 2, 2).unwrap();
/// let center = destinations.center(0);
/// assert_eq!((center.len(), center[1]), (2, 300.0));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Center {
    numbers: [f64; AXES],
    dimensions: usize,
}

impl Deref for Center {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        self.numbers.get(..self.dimensions).unwrap_or_default()
    }
}

/// Means in order.
#[derive(Clone, Debug)]
pub(super) struct Means {
    pub dimensions: usize,
    /// As many as the longest one has components; what others do not have is zero.
    components: Vec<Column>,
}

impl Means {
    pub fn with_capacity(count: usize, dimensions: usize) -> Self {
        let mut components = Vec::new();
        for _ in 0..dimensions {
            components.push(Column::with_capacity(count, Filler::First));
        }
        Self { dimensions, components }
    }

    /// So many components of one of them, but not the first ones.
    pub fn components(&self, i: usize, first: usize, length: usize) -> Vec<f64> {
        let mut components = Vec::with_capacity(length.saturating_sub(first));
        for column in self.components.iter().take(length).skip(first) {
            components.push(column.get(i));
        }
        components
    }

    pub fn center(&self, i: usize) -> Center {
        let component = |k: usize| self.components.get(k).map_or(0.0, |column| column.get(i));
        Center { numbers: [component(0), component(1), component(2)], dimensions: self.dimensions }
    }

    /// The centres in whole blocks, a list for each axis, empty for those that there are not. The last block is filled up with
    /// its first place.
    pub fn coordinates(&self) -> [&[Block]; AXES] {
        let axis = |k: usize| match self.components.get(k) {
            Some(column) if k < self.dimensions => column.blocks(),
            _ => &[],
        };
        [axis(0), axis(1), axis(2)]
    }

    /// Puts one behind the others.
    pub fn push(&mut self, mean: &[f64]) {
        self.widen(mean.len());
        for (k, column) in self.components.iter_mut().enumerate() {
            column.push(mean.get(k).copied().unwrap_or_default());
        }
    }

    /// Puts another in the place of one.
    pub fn replace(&mut self, i: usize, mean: &[f64]) {
        self.widen(mean.len());
        for (k, column) in self.components.iter_mut().enumerate() {
            column.replace(i, mean.get(k).copied().unwrap_or_default());
        }
    }

    /// Makes room for so many components.
    fn widen(&mut self, length: usize) {
        while self.components.len() < length {
            let Some(first) = self.components.first() else { return };
            self.components.push(first.zeros());
        }
    }

    /// Takes one out; those after it move up.
    pub fn remove(&mut self, i: usize) {
        self.components.iter_mut().for_each(|column| column.remove(i));
    }
}
