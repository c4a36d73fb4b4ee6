//! The kinds of many destinations, each once, and which destination is of which.

use super::Kind;

/// Kinds in the order of the destinations.
#[derive(Clone, Debug, Default)]
pub(super) struct Kinds {
    /// Some may have no destination left.
    list: Vec<Kind>,
    /// The number of each destination's kind; empty where all are of the first.
    of: Vec<u32>,
    count: usize,
}

impl Kinds {
    pub fn list(&self) -> &[Kind] {
        &self.list
    }

    /// The number of a destination's kind.
    pub fn of(&self, i: usize) -> usize {
        self.of.get(i).map_or(0, |&number| number as usize)
    }

    /// Puts one that is not there yet behind the others.
    pub fn add(&mut self, kind: &Kind) {
        self.list.push(kind.clone());
    }

    /// One more destination, of a kind that is there.
    pub fn push(&mut self, number: usize) {
        self.spell_out(number);
        if !self.of.is_empty() || number > 0 {
            self.of.push(number as u32);
        }
        self.count += 1;
    }

    /// The kind of a destination becomes another.
    pub fn replace(&mut self, i: usize, kind: &Kind) {
        let number = self.place(kind, Some(i));
        self.spell_out(number);
        if let Some(of) = self.of.get_mut(i) {
            *of = number as u32;
        }
    }

    /// Takes a destination out; those after it move up.
    pub fn remove(&mut self, i: usize) {
        if i < self.of.len() {
            self.of.remove(i);
        }
        self.count -= 1;
    }

    /// Writes down the number of each where they are not all of the first kind any more.
    fn spell_out(&mut self, number: usize) {
        if number > 0 && self.of.is_empty() {
            self.of = vec![0; self.count];
        }
    }

    /// The number of an equal kind, or of a place for a new one that no destination but `except` needs.
    pub fn place(&mut self, kind: &Kind, except: Option<usize>) -> usize {
        if let Some(found) = self.list.iter().position(|known| known == kind) {
            return found;
        }
        let mut used = vec![false; self.list.len()];
        for i in (0..self.count).filter(|i| Some(*i) != except) {
            used[self.of(i)] = true;
        }
        if let Some(free) = used.iter().position(|used| !used) {
            self.list[free] = kind.clone();
            return free;
        }
        self.add(kind);
        self.list.len() - 1
    }

    /// Numbers the kinds in the order of their first destinations, as reading a list does, and forgets the others: what is
    /// computed from a list must not depend on how it came about.
    pub fn renumber(&mut self) {
        let mut numbers = vec![None; self.list.len()];
        let mut renumbered = Self::default();
        for i in 0..self.count {
            let before = self.of(i);
            let number = *numbers[before].get_or_insert_with(|| {
                renumbered.add(&self.list[before]);
                renumbered.list.len() - 1
            });
            renumbered.push(number);
        }
        renumbered.trim();
        *self = renumbered;
    }

    /// Gives back what was only room to grow.
    pub fn trim(&mut self) {
        self.list.shrink_to_fit();
        self.of.shrink_to_fit();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_keeps_its_kind_when_others_come_change_and_go() {
        let kind = |side: usize| Kind::of_box(&[side as f64], None, None);
        let mut kinds = Kinds::default();
        let mut sides = Vec::new();
        let expect = |kinds: &mut Kinds, sides: &[usize]| {
            let found = |kinds: &Kinds| (0..sides.len()).map(|i| kinds.list()[kinds.of(i)].clone()).collect::<Vec<_>>();
            let expected: Vec<Kind> = sides.iter().map(|side| kind(*side)).collect();
            assert_eq!(found(kinds), expected);
            let mut renumbered = kinds.clone();
            renumbered.renumber();
            assert_eq!(found(&renumbered), expected);
            let mut distinct = Vec::new();
            sides.iter().for_each(|side| {
                if !distinct.contains(side) {
                    distinct.push(*side)
                }
            });
            assert_eq!(renumbered.list(), distinct.into_iter().map(kind).collect::<Vec<_>>());
            assert_eq!(renumbered.of.is_empty(), renumbered.list.len() < 2, "numbers only where they differ");
        };
        for side in [5, 5, 5, 7, 5, 7, 9] {
            let number = kinds.place(&kind(side), None);
            kinds.push(number);
            sides.push(side);
            expect(&mut kinds, &sides);
        }
        for (i, side) in [(6, 7), (0, 11), (3, 11), (5, 3), (6, 3), (1, 3)] {
            kinds.replace(i, &kind(side));
            sides[i] = side;
            expect(&mut kinds, &sides);
        }
        while sides.len() > 1 {
            let i = sides.len() / 2;
            kinds.remove(i);
            sides.remove(i);
            expect(&mut kinds, &sides);
        }
        assert!(kinds.list().len() <= 5, "free places are taken again");
        // one that has the first kind to itself gives it up without a second
        let mut alone = Kinds::default();
        alone.add(&kind(1));
        alone.push(0);
        alone.replace(0, &kind(2));
        assert_eq!((alone.list(), alone.of(0)), (&[kind(2)][..], 0));
    }
}
