//! Numbers in groups, without a list for each group.

use std::ops::Range;

/// The numbers from zero on, those of each group together and in their order.
#[derive(Clone, Debug, Default)]
pub struct Grouped {
    members: Vec<u32>,
    /// Where each group starts, and at last how many there are.
    starts: Vec<u32>,
}

impl Grouped {
    /// From the group of each number, one of so many.
    #[must_use]
    pub fn new(group_of: &[u32], groups: usize) -> Self {
        // no indices: in WebAssembly each, with what it reports where it is wrong, is larger than this
        let mut starts = vec![0u32; groups + 1];
        for &group in group_of {
            if let Some(start) = starts.get_mut(group as usize) {
                *start += 1;
            }
        }
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        let mut members = vec![0; group_of.len()];
        // from the last one on, each in front of those of its group that are there
        for (i, &group) in group_of.iter().enumerate().rev() {
            if let Some(start) = starts.get_mut(group as usize) {
                *start -= 1;
                if let Some(member) = members.get_mut(*start as usize) {
                    *member = i as u32;
                }
            }
        }
        Self { members, starts }
    }

    /// All numbers, one group after the other.
    #[must_use]
    pub fn members(&self) -> &[u32] {
        &self.members
    }

    /// Where the numbers of a group are among all.
    #[must_use]
    pub fn range(&self, group: usize) -> Range<usize> {
        let start = |group: usize| self.starts.get(group).map_or(0, |start| *start as usize);
        start(group)..start(group + 1)
    }

    /// The numbers of a group.
    #[must_use]
    pub fn of(&self, group: usize) -> &[u32] {
        self.members.get(self.range(group)).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_have_their_numbers_in_order_and_may_be_empty() {
        let grouped = Grouped::new(&[3, 0, 3, 2, 0, 3], 5);
        let all: Vec<&[u32]> = (0..5).map(|group| grouped.of(group)).collect();
        assert_eq!(all, [&[1, 4][..], &[], &[3], &[0, 2, 5], &[]]);
        assert_eq!(grouped.members(), [1, 4, 3, 0, 2, 5]);
        assert_eq!(grouped.range(3), 3..6);
    }
}
