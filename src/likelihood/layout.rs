//! Destinations as flat arrays of blocks, those of one class together: what the hot loops run over.

use crate::math::lanes::{Block, WIDTH};
use crate::math::mixture::{AXES, Places};
use crate::model::destination::Destinations;
use std::ops::Range;

/// In [`Layout::order`], a place that only fills a block up.
const NOBODY: u32 = u32::MAX;

/// Some blocks of each axis; those of an axis that there is not are empty.
fn part<'a>([x, y, z]: &'a [Vec<Block>; AXES], blocks: &Range<usize>) -> [&'a [Block]; AXES] {
    let of = |list: &'a [Block]| list.get(blocks.clone()).unwrap_or_default();
    [of(x), of(y), of(z)]
}

/// Where the destinations stand.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    coordinates: [Vec<Block>; AXES],
    variances: [Vec<Block>; AXES],
    /// Which destination stands where; empty where they stand in their own order.
    order: Vec<u32>,
    blocks: usize,
    count: usize,
    own_variances: bool,
}

impl Layout {
    /// Forgets all destinations and keeps the room.
    pub fn clear(&mut self) {
        self.order.clear();
        self.blocks = 0;
        self.coordinates.iter_mut().chain(&mut self.variances).for_each(Vec::clear);
        self.own_variances = false;
    }

    /// Puts destinations after those that are there and tells where they stand; `own` is whether each has its own variances.
    pub fn place(&mut self, destinations: &Destinations, members: &[u32], own: bool) -> Range<usize> {
        let start = self.blocks;
        self.blocks += members.len().div_ceil(WIDTH);
        self.own_variances |= own && !members.is_empty();
        for chunk in members.chunks(WIDTH) {
            // a block is filled up with its first destination, at no weight
            let member = |lane: usize| *chunk.get(lane).unwrap_or(&chunk[0]) as usize;
            for axis in 0..destinations.dimensions() {
                self.coordinates[axis].push(std::array::from_fn(|lane| destinations.center(member(lane))[axis]));
            }
            self.order.extend((0..WIDTH).map(|lane| chunk.get(lane).copied().unwrap_or(NOBODY)));
        }
        start..self.blocks
    }

    /// Once all of them are there.
    pub fn finish(&mut self, destinations: &Destinations) {
        self.count = destinations.len();
        if self.order.iter().take(self.count).zip(0..).all(|(&i, place)| i == place) {
            self.order.clear();
        }
        self.order.shrink_to_fit();
        for axis in 0..destinations.dimensions() {
            self.coordinates[axis].shrink_to_fit();
            if self.own_variances {
                let variance = |i: usize| destinations.kind(i).covariance[(axis, axis)];
                self.variances[axis] = self.members().map(|block| block.map(|(i, _)| variance(i))).collect();
            }
        }
    }

    /// How many blocks there are.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.blocks
    }

    /// The destinations of each block and whether they stand there themselves or only fill it up.
    pub fn members(&self) -> impl ExactSizeIterator<Item = [(usize, bool); WIDTH]> {
        let member = |place: usize| match self.order.get(place) {
            Some(&i) => (i != NOBODY).then_some(i as usize),
            None => (place < self.count).then_some(place),
        };
        (0..self.blocks).map(move |block| {
            let first = member(block * WIDTH).unwrap_or(0);
            std::array::from_fn(|lane| member(block * WIDTH + lane).map_or((first, false), |i| (i, true)))
        })
    }

    /// The coordinates of all, a list for each axis.
    #[must_use]
    pub fn coordinates(&self) -> [&[Block]; AXES] {
        self.coordinates.each_ref().map(Vec::as_slice)
    }

    /// The places of some blocks.
    #[must_use]
    pub fn places(&self, blocks: &Range<usize>, origin: [f64; AXES]) -> Places<'_> {
        Places { coordinates: part(&self.coordinates, blocks), variances: part(&self.variances, blocks), origin }
    }

    /// Takes what stands in the order of the arrays to the order of the destinations.
    pub fn scatter(&self, from: &[Block], into: &mut Vec<f64>) {
        into.clear();
        if self.order.is_empty() {
            return into.extend(&from.as_flattened()[..self.count]);
        }
        into.resize(self.count, 0.0);
        for (x, &i) in from.as_flattened().iter().zip(&self.order) {
            if let Some(place) = into.get_mut(i as usize) {
                *place = *x;
            }
        }
    }
}
