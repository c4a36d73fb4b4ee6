//! Destinations in blocks, those of one class together: the flat arrays that the hot loops run over.
//!
//! Where the destinations of each class follow one another already, the arrays keep their order, and results are written where
//! they are wanted; elsewhere they are written aside and scattered to that order.

use super::mixture::{AXES, Places};
use super::vectors::{Block, WIDTH};
use std::ops::Range;

/// Fewer destinations of one class than this are sooner evaluated among others, each with its own variances.
pub const FEW: usize = 8;

/// In [`Layout::order`], a lane that only pads its block.
const PADDING: u32 = u32::MAX;

/// Some blocks of each axis; those of an axis beyond the dimensions are empty.
fn part<'a>([x, y, z]: &'a [Vec<Block>; AXES], blocks: &Range<usize>) -> [&'a [Block]; AXES] {
    let of = |list: &'a [Block]| list.get(blocks.clone()).unwrap_or_default();
    [of(x), of(y), of(z)]
}

/// The order of the destinations in the arrays, with their coordinates and variances.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    coordinates: [Vec<Block>; AXES],
    variances: [Vec<Block>; AXES],
    /// The destination in each lane; empty where the arrays keep the order of the destinations.
    order: Vec<u32>,
    blocks: usize,
    count: usize,
    own_variances: bool,
}

impl Layout {
    /// Appends destinations and returns their blocks; `own` is whether each has its own variances.
    pub fn place(&mut self, members: &[u32], own: bool) -> Range<usize> {
        let start = self.blocks;
        self.blocks += members.len().div_ceil(WIDTH);
        self.own_variances |= own && !members.is_empty();
        self.order.extend_from_slice(members);
        self.order.resize(self.blocks * WIDTH, PADDING);
        start..self.blocks
    }

    /// Once all `count` destinations are placed: their coordinates, `coordinate(i, axis)`, and the variances of those that have
    /// their own.
    pub fn finish(
        &mut self,
        (count, dimensions): (usize, usize),
        coordinate: &dyn Fn(usize, usize) -> f64,
        variance: &dyn Fn(usize, usize) -> f64,
    ) {
        self.count = count;
        if self.order.iter().take(self.count).zip(0..).all(|(&i, place)| i == place) {
            self.order.clear();
        }
        self.order.shrink_to_fit();
        for axis in 0..dimensions.min(AXES) {
            self.coordinates[axis] = self.gather(&|i, _| coordinate(i, axis));
            if self.own_variances {
                self.variances[axis] = self.gather(&|i, _| variance(i, axis));
            }
        }
    }

    /// Whether the arrays keep the order of the destinations.
    #[must_use]
    pub fn keeps_order(&self) -> bool {
        self.order.is_empty()
    }

    /// How many blocks there are.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.blocks
    }

    /// The destination in each lane of each block, and whether the lane is its own; padding repeats the block's first one, which
    /// adds no new place, to be given no weight.
    pub fn members(&self) -> impl ExactSizeIterator<Item = [(usize, bool); WIDTH]> {
        let member = |place: usize| match self.order.get(place) {
            Some(&i) => (i != PADDING).then_some(i as usize),
            None => (place < self.count).then_some(place),
        };
        (0..self.blocks).map(move |block| {
            let first = member(block * WIDTH).unwrap_or(0);
            std::array::from_fn(|lane| member(block * WIDTH + lane).map_or((first, false), |i| (i, true)))
        })
    }

    /// A number of each lane, from its destination and whether the lane is its own as in [`Layout::members`].
    #[must_use]
    pub fn gather(&self, number: &dyn Fn(usize, bool) -> f64) -> Vec<Block> {
        self.members().map(|block| block.map(|(i, is_member)| number(i, is_member))).collect()
    }

    /// The places of some blocks.
    #[must_use]
    pub fn places(&self, blocks: &Range<usize>, origin: [f64; AXES]) -> Places<'_> {
        Places { coordinates: part(&self.coordinates, blocks), variances: part(&self.variances, blocks), origin }
    }

    /// A buffer for a number of each lane: `into` itself where the arrays keep the order of the destinations, else `aside`. Every
    /// block is to be written, and then [`Layout::scatter`] called.
    pub fn buffer<'a>(&self, aside: &'a mut Vec<Block>, into: &'a mut Vec<f64>) -> &'a mut [Block] {
        if self.keeps_order() {
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

    /// Brings the numbers in the buffer to the order of the destinations.
    pub fn scatter(&self, aside: &[Block], into: &mut Vec<f64>) {
        into.resize(self.count, 0.0);
        for (x, &i) in aside.as_flattened().iter().zip(&self.order) {
            if let Some(place) = into.get_mut(i as usize) {
                *place = *x;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout(classes: &[&[u32]], count: usize) -> Layout {
        let mut layout = Layout::default();
        for members in classes {
            layout.place(members, true);
        }
        layout.finish((count, 1), &|i, _| i as f64, &|i, _| 100.0 + i as f64);
        layout
    }

    fn scattered(layout: &Layout) -> Vec<f64> {
        let (mut aside, mut into) = (Vec::new(), Vec::new());
        let numbers = layout.gather(&|i, is_member| if is_member { i as f64 } else { -1.0 });
        layout.buffer(&mut aside, &mut into).copy_from_slice(&numbers);
        layout.scatter(&aside, &mut into);
        into
    }

    #[test]
    fn results_come_back_in_the_order_of_the_destinations() {
        let five: Vec<f64> = (0..5).map(f64::from).collect();
        for classes in [&[&[0, 1, 2, 3, 4][..]][..], &[&[0, 2, 4], &[1, 3]], &[&[4, 3, 2, 1, 0]]] {
            assert_eq!(scattered(&layout(classes, 5)), five);
        }
        assert!(layout(&[&[0, 1, 2, 3], &[4]], 5).keeps_order());
        assert!(!layout(&[&[0, 2, 4], &[1, 3]], 5).keeps_order());
    }

    #[test]
    fn padding_repeats_the_first_place_of_its_block() {
        for (classes, count) in [(&[&[0, 1, 2, 3, 4][..]][..], 5), (&[&[0, 2, 4], &[1, 3]], 5)] {
            let layout = layout(classes, count);
            for (block, members) in layout.members().enumerate() {
                let places = layout.places(&(block..block + 1), [0.0; AXES]);
                for (lane, (i, is_member)) in members.into_iter().enumerate() {
                    assert!(is_member || i == members[0].0);
                    let place = (places.coordinates[0][0][lane], places.variances[0][0][lane]);
                    assert_eq!(place, (i as f64, 100.0 + i as f64));
                }
            }
        }
    }
}
