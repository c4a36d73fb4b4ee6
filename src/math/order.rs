//! Sorting and numbering, each in one form that is not generic: what the standard library makes anew for every type of item
//! weighs several kilobytes each time.

use std::cmp::Ordering;
use std::ops::Range;

/// The indices below `count` in the order that `compare` gives; what is equal keeps its order.
///
/// ```
/// let numbers = [3.0f64, 1.0, 2.0];
/// assert_eq!(whither::math::order::order(3, &|i, j| numbers[i].total_cmp(&numbers[j])), [1, 2, 0]);
/// ```
#[must_use]
pub fn order(count: usize, compare: &dyn Fn(usize, usize) -> Ordering) -> Vec<u32> {
    let mut indices: Vec<u32> = (0..count as u32).collect();
    indices.sort_unstable_by(|&i, &j| compare(i as usize, j as usize).then(i.cmp(&j)));
    indices
}

/// The numbers from the least to the largest.
///
/// ```
/// assert_eq!(whither::math::order::sorted(&[3.0, 1.0, 2.0]), [1.0, 2.0, 3.0]);
/// ```
#[must_use]
pub fn sorted(numbers: &[f64]) -> Vec<f64> {
    order(numbers.len(), &|i, j| numbers[i].total_cmp(&numbers[j])).into_iter().map(|i| numbers[i as usize]).collect()
}

/// Numbers things in the order in which they first appear. Keys are words that tell a thing from every other one.
///
/// ```
/// let mut numbering = whither::math::order::Numbering::default();
/// assert_eq!(numbering.of(&[7, 7]), (0, true));
/// assert_eq!(numbering.of(&[8]), (1, true));
/// assert_eq!(numbering.of(&[7, 7]), (0, false));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Numbering {
    /// The keys one after the other, and where each is.
    words: Vec<u64>,
    known: Vec<Range<usize>>,
    /// The numbers, each where the checksum of its key leads or in the next free place after it; twice as many places as keys
    /// or more, a power of two.
    places: Vec<u32>,
}

/// A place where there is no number.
const FREE: u32 = u32::MAX;

impl Numbering {
    /// The number of `key`, and whether it is new.
    pub fn of(&mut self, key: &[u64]) -> (usize, bool) {
        let next = self.known.len();
        if 2 * next >= self.places.len() {
            self.places = vec![FREE; (4 * next).max(16)];
            for number in 0..next {
                let place = self.place(&self.words[self.known[number].clone()]);
                self.places[place] = number as u32;
            }
        }
        let place = self.place(key);
        if self.places[place] != FREE {
            return (self.places[place] as usize, false);
        }
        self.places[place] = next as u32;
        self.known.push(self.words.len()..self.words.len() + key.len());
        self.words.extend_from_slice(key);
        (next, true)
    }

    /// Where the number of `key` is, or where it would be.
    fn place(&self, key: &[u64]) -> usize {
        let last = self.places.len() - 1;
        let mut place = checksum(key) as usize & last;
        while self.places[place] != FREE && self.words[self.known[self.places[place] as usize].clone()] != *key {
            place = (place + 1) & last;
        }
        place
    }
}

/// FNV-1a over words, rotated so that every bit reaches every other (a product alone would let two flipped signs cancel).
///
/// ```
/// use whither::math::order::checksum;
/// assert_ne!(checksum(&[1, 2]), checksum(&[2, 1]));
/// ```
#[must_use]
pub fn checksum(words: &[u64]) -> u64 {
    let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
    for word in words {
        hash = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(29);
    }
    hash
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_keys_keep_their_numbers() {
        let mut numbering = Numbering::default();
        let keys: Vec<Vec<u64>> =
            (0..5000u64).map(|k| vec![(k as f64 * 12.0).to_bits(); (k % 4) as usize + 1]).collect();
        for round in 0..2 {
            for (number, key) in keys.iter().enumerate() {
                assert_eq!(numbering.of(key), (number, round == 0));
            }
        }
        // no longer than it takes to tell them apart
        assert_eq!(numbering.of(&[]), (5000, true));
        assert_eq!(numbering.of(&[]), (5000, false));
    }
}
