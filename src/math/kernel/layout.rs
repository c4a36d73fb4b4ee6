//! Destinations as flat arrays of blocks, those of one class together: what the hot loops run over.
//!
//! Where those of one class follow one another anyway, they stand in their own order, and nothing is kept twice: what is said
//! of them is read from the destinations, and what is found is written where it is wanted.

use super::mixture::{AXES, Places};
use super::vectors::{Block, WIDTH};
use std::ops::Range;

/// Fewer destinations of one class than this are sooner evaluated among others, each with its own variances.
pub const FEW: usize = 8;

/// In [`Layout::order`], a place that only fills a block up.
const NOBODY: u32 = u32::MAX;

/// Some blocks of each axis; those of an axis that there is not are empty.
fn part<'a>([x, y, z]: [&'a [Block]; AXES], blocks: &Range<usize>) -> [&'a [Block]; AXES] {
    let of = |list: &'a [Block]| list.get(blocks.clone()).unwrap_or_default();
    [of(x), of(y), of(z)]
}

fn lists([x, y, z]: &[Vec<Block>; AXES]) -> [&[Block]; AXES] {
    [x, y, z]
}

/// Where the destinations stand.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// The destinations' coordinates in another order than their own.
    coordinates: [Vec<Block>; AXES],
    variances: [Vec<Block>; AXES],
    /// Which destination stands where; empty where they stand in their own order.
    order: Vec<u32>,
    blocks: usize,
    count: usize,
    own_variances: bool,
}

impl Layout {
    /// Puts destinations after those that are there and tells where they stand; `own` is whether each has its own variances.
    pub fn place(&mut self, members: &[u32], own: bool) -> Range<usize> {
        let start = self.blocks;
        self.blocks += members.len().div_ceil(WIDTH);
        self.own_variances |= own && !members.is_empty();
        for chunk in members.chunks(WIDTH) {
            self.order.extend((0..WIDTH).map(|lane| chunk.get(lane).copied().unwrap_or(NOBODY)));
        }
        start..self.blocks
    }

    /// Once all of them are there: `count`, with `coordinates` in blocks in their own order, and `variance(i, axis)` of those that
    /// have their own.
    pub fn finish(&mut self, count: usize, coordinates: [&[Block]; AXES], variance: &dyn Fn(usize, usize) -> f64) {
        self.count = count;
        if self.order.iter().take(self.count).zip(0..).all(|(&i, place)| i == place) {
            self.order.clear();
        }
        self.order.shrink_to_fit();
        for (axis, own) in coordinates.iter().enumerate().filter(|(_, own)| !own.is_empty()) {
            if !self.is_own() {
                let own = own.as_flattened();
                self.coordinates[axis] = self.gather(&|i, _| own.get(i).copied().unwrap_or_default());
            }
            if self.own_variances {
                self.variances[axis] = self.gather(&|i, _| variance(i, axis));
            }
        }
    }

    /// Whether destinations stand as they follow one another, in the blocks that they have themselves.
    #[must_use]
    pub fn is_own(&self) -> bool {
        self.order.is_empty()
    }

    /// How many blocks there are.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.blocks
    }

    /// The destinations of each block and whether they stand there themselves or only fill it up, which the block's first one
    /// does, at no weight.
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

    /// A number of each destination and of those that only fill a block up, in the order of the arrays.
    #[must_use]
    pub fn gather(&self, number: &dyn Fn(usize, bool) -> f64) -> Vec<Block> {
        self.members().map(|block| block.map(|(i, stands)| number(i, stands))).collect()
    }

    /// The coordinates of all, a list for each axis; `own` are those in the destinations' own order.
    #[must_use]
    pub fn coordinates<'a>(&'a self, own: [&'a [Block]; AXES]) -> [&'a [Block]; AXES] {
        if self.is_own() { own } else { lists(&self.coordinates) }
    }

    /// The places of some blocks; `own` as for [`Layout::coordinates`].
    #[must_use]
    pub fn places<'a>(&'a self, own: [&'a [Block]; AXES], blocks: &Range<usize>, origin: [f64; AXES]) -> Places<'a> {
        let variances = part(lists(&self.variances), blocks);
        Places { coordinates: part(self.coordinates(own), blocks), variances, origin }
    }

    /// Room for a number of each destination: in `into` itself where they stand in their own order, else in `aside`. Every
    /// block is to be written, and then [`Layout::settle`] called.
    pub fn room<'a>(&self, aside: &'a mut Vec<Block>, into: &'a mut Vec<f64>) -> &'a mut [Block] {
        if self.is_own() {
            *aside = Vec::new();
            let length = self.blocks * WIDTH;
            if into.capacity() < length {
                into.reserve_exact(length.saturating_sub(into.len()));
            }
            into.resize(length, 0.0);
            return into.as_chunks_mut().0;
        }
        aside.resize(self.blocks, [0.0; WIDTH]);
        aside
    }

    /// Brings what was written into the room to the order of the destinations.
    pub fn settle(&self, aside: &[Block], into: &mut Vec<f64>) {
        into.resize(self.count, 0.0);
        for (x, &i) in aside.as_flattened().iter().zip(&self.order) {
            if let Some(place) = into.get_mut(i as usize) {
                *place = *x;
            }
        }
    }
}
