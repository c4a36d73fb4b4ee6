//! The different sizes among many targets.

/// The fractional part of the golden ratio: a product with it has in its upper bits all that numbers differ in.
const MIX: u64 = 0x9e37_79b9_7f4a_7c15;

/// Different sizes, numbered in the order in which they come.
#[derive(Clone, Debug)]
pub struct Sizes {
    list: Vec<[f64; 2]>,
    /// A hash table: of each size one more than its number, where its hash points or in the next free slot after that.
    slots: Vec<u32>,
    /// How many bits of a hash are not for the slot.
    shift: u32,
}

impl Sizes {
    /// None yet, with room for so many.
    #[must_use]
    pub fn among(count: usize) -> Self {
        // at least half of it stays free
        let slots = (2 * count).max(2).next_power_of_two();
        Self { list: Vec::new(), slots: vec![0; slots], shift: u64::BITS - slots.trailing_zeros() }
    }

    /// The number of a size, which is given one where it is new.
    pub fn number(&mut self, size: [f64; 2]) -> usize {
        let last = self.slots.len() - 1;
        let mut slot = (hash(size) >> self.shift) as usize;
        loop {
            let number = self.slots[slot] as usize;
            if number == 0 {
                self.list.push(size);
                self.slots[slot] = self.list.len() as u32;
                return self.list.len() - 1;
            }
            if self.list[number - 1] == size {
                return number - 1;
            }
            slot = (slot + 1) & last;
        }
    }

    /// The sizes, by their numbers.
    #[must_use]
    pub fn list(&self) -> &[[f64; 2]] {
        &self.list
    }
}

/// A hash, the best of it in its upper bits.
fn hash([width, height]: [f64; 2]) -> u64 {
    (width.to_bits().wrapping_mul(MIX) ^ height.to_bits()).wrapping_mul(MIX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_sizes_have_one_number_and_others_the_next() {
        let mut sizes = Sizes::among(5);
        let found = [[3.0, 4.0], [4.0, 3.0], [3.0, 4.0], [3.0, 4.5], [4.0, 3.0]].map(|size| sizes.number(size));
        assert_eq!(found, [0, 1, 0, 2, 1]);
        assert_eq!(sizes.list(), [[3.0, 4.0], [4.0, 3.0], [3.0, 4.5]]);
    }

    #[test]
    fn sizes_of_few_digits_are_spread_over_the_table() {
        let wide = (1..=100).flat_map(|width| (1..=100).map(move |height| [f64::from(width), f64::from(height)]));
        let high = (1..=10_000).map(|height| [20.0, f64::from(height)]);
        for sizes in [wide.collect::<Vec<_>>(), high.collect()] {
            let mut found = [0; 1 << 15];
            for size in sizes {
                found[(hash(size) >> 49) as usize] += 1;
            }
            let most = found.into_iter().max();
            assert!(most < Some(8), "{most:?} of 10 000 sizes in one of 32 768 slots");
        }
    }
}
