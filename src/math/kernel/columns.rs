//! One number of each of many things, in whole blocks: what the hot loops read as it stands.

use crate::math::kernel::vectors::{Block, WIDTH};

/// What the last block is filled up with.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Filler {
    /// Nothing: of weights.
    Zero,
    /// The block's first number: of positions, so that nothing is said of any place but those that there are.
    First,
}

/// Numbers in order.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    /// Whole blocks, the last one filled up.
    numbers: Vec<f64>,
    length: usize,
    filler: Filler,
}

impl Column {
    pub fn with_capacity(count: usize, filler: Filler) -> Self {
        Self { numbers: Vec::with_capacity(count.next_multiple_of(WIDTH)), length: 0, filler }
    }

    /// As many zeros, with as much room.
    pub fn zeros(&self) -> Self {
        let mut numbers = Vec::with_capacity(self.numbers.capacity());
        numbers.resize(self.numbers.len(), 0.0);
        Self { numbers, ..*self }
    }

    /// All of them, the last block filled up.
    pub fn blocks(&self) -> &[Block] {
        self.numbers.as_chunks().0
    }

    pub fn numbers(&self) -> &[f64] {
        self.numbers.get(..self.length).unwrap_or_default()
    }

    /// One of them.
    pub fn get(&self, i: usize) -> f64 {
        self.numbers.get(i).copied().unwrap_or_default()
    }

    /// Puts one behind the others.
    pub fn push(&mut self, x: f64) {
        self.numbers.truncate(self.length);
        self.numbers.push(x);
        self.length += 1;
        self.fill_up();
    }

    /// Puts another in the place of one, and returns that.
    pub fn replace(&mut self, i: usize, x: f64) -> f64 {
        let before = self.numbers.get_mut(i).map_or(x, |number| std::mem::replace(number, x));
        self.fill_up();
        before
    }

    /// Takes one out; those after it move up.
    pub fn remove(&mut self, i: usize) {
        self.numbers.remove(i);
        self.length -= 1;
        self.fill_up();
    }

    fn fill_up(&mut self) {
        let start = self.length / WIDTH * WIDTH;
        let filler = match self.filler {
            Filler::Zero => 0.0,
            Filler::First => self.numbers.get(start).copied().unwrap_or_default(),
        };
        self.numbers.truncate(self.length);
        self.numbers.resize(self.length.next_multiple_of(WIDTH), filler);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers, and what a column that never held any others has in its blocks.
    fn expect(column: &Column, numbers: &[f64]) {
        assert_eq!(column.numbers(), numbers);
        let mut anew = Column::with_capacity(numbers.len(), column.filler);
        numbers.iter().for_each(|x| anew.push(*x));
        assert_eq!(column.blocks(), anew.blocks());
        let standing = column.blocks().as_flattened();
        let last = numbers.len().div_ceil(WIDTH).saturating_sub(1) * WIDTH;
        for x in &standing[numbers.len()..] {
            let filler = if matches!(column.filler, Filler::Zero) { 0.0 } else { standing[last] };
            assert_eq!(*x, filler);
        }
    }

    #[test]
    fn numbers_come_change_and_go_and_blocks_stay_filled_up() {
        for filler in [Filler::Zero, Filler::First] {
            let mut column = Column::with_capacity(3, filler);
            let mut numbers = Vec::new();
            expect(&column, &numbers);
            for k in 0..19 {
                column.push(f64::from(k) + 0.5);
                numbers.push(f64::from(k) + 0.5);
                expect(&column, &numbers);
            }
            for i in [16, 0, 18, 8] {
                let before = column.replace(i, -1.0 - i as f64);
                assert_eq!(before, std::mem::replace(&mut numbers[i], -1.0 - i as f64));
                expect(&column, &numbers);
            }
            while !numbers.is_empty() {
                let i = 16.min(numbers.len() / 2);
                column.remove(i);
                numbers.remove(i);
                expect(&column, &numbers);
            }
        }
    }
}
