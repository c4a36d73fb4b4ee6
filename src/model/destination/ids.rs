//! The names of many things, one after the other in one text: a few bytes each, where a text of its own takes two dozen.

use std::ops::Range;

/// Names in order.
#[derive(Clone, Debug, Default)]
pub(super) struct Ids {
    text: String,
    /// Where each one ends.
    ends: Vec<usize>,
}

impl Ids {
    pub fn with_capacity(count: usize) -> Self {
        Self { text: String::new(), ends: Vec::with_capacity(count) }
    }

    pub fn len(&self) -> usize {
        self.ends.len()
    }

    fn range(&self, i: usize) -> Range<usize> {
        let start = if i == 0 { 0 } else { self.ends[i - 1] };
        start..self.ends[i]
    }

    pub fn get(&self, i: usize) -> &str {
        // not by index: what prints a text that is cut inside a character weighs 3 kB
        self.text.get(self.range(i)).unwrap_or_default()
    }

    pub fn iter(&self) -> impl ExactSizeIterator<Item = &str> {
        (0..self.len()).map(|i| self.get(i))
    }

    /// Puts one behind the others.
    pub fn push(&mut self, id: &str) {
        self.text.push_str(id);
        self.ends.push(self.text.len());
    }

    /// Gives back what was only room to grow.
    pub fn trim(&mut self) {
        self.text.shrink_to_fit();
    }

    /// Takes one out; those after it move up.
    pub fn remove(&mut self, i: usize) {
        let range = self.range(i);
        let length = range.len();
        self.text.drain(range);
        self.ends.remove(i);
        for end in &mut self.ends[i..] {
            *end -= length;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_their_order_when_one_goes() {
        let mut ids = Ids::default();
        for id in ["a", "", "größer", "d"] {
            ids.push(id);
        }
        assert_eq!(ids.iter().collect::<Vec<_>>(), ["a", "", "größer", "d"]);
        ids.remove(2);
        ids.remove(0);
        ids.push("e");
        assert_eq!(ids.iter().collect::<Vec<_>>(), ["", "d", "e"]);
    }
}
