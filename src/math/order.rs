//! Sorting and numbering, each in one form that is not generic: what the standard library makes anew for every type of item
//! weighs several kilobytes each time.

use std::cmp::Ordering;
use std::collections::HashMap;

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
    known: HashMap<Box<[u64]>, usize>,
}

impl Numbering {
    /// The number of `key`, and whether it is new.
    pub fn of(&mut self, key: &[u64]) -> (usize, bool) {
        if let Some(&number) = self.known.get(key) {
            return (number, false);
        }
        let number = self.known.len();
        self.known.insert(key.into(), number);
        (number, true)
    }
}
