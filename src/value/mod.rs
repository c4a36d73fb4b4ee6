//! The dynamic tree that scenarios and snapshots travel as, and the reader that turns it into typed parts.
//!
//! Every part reads its own object key by key: [`Node::fields`] names the legal keys (any other one is an error that
//! names it), and each read reports the full path and quotes what it found. Derived deserialisation would make the
//! WebAssembly several times as large and its errors poorer.

use crate::error::{Code, Error, Result};
use std::sync::Arc;

#[cfg(any(test, feature = "wasm", feature = "wasm-fit"))]
mod bytes;
mod fields;
mod path;
mod quote;
mod serial;

pub use fields::Fields;
pub use path::{Check, Path};
pub use quote::{number, quote};

/// The largest number, in absolute value, that a scenario can have, as a length, a time or a variance, and the inverse of
/// the smallest deviation: what is computed from such numbers stays finite.
pub const LARGEST: f64 = 1e50;

/// The key of an object; where many objects are alike, they share it.
pub type Key = Arc<str>;

/// What JSON can hold, with NaN and infinities left in, so that they can be refused by name.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `null` or `undefined`.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// Any number.
    Number(f64),
    /// A string.
    Text(String),
    /// An array.
    List(Vec<Value>),
    /// An object, in the order of its keys.
    Map(Vec<(Key, Value)>),
}

impl Value {
    /// An object from its entries.
    #[must_use]
    pub fn map<const N: usize>(entries: [(&str, Self); N]) -> Self {
        Self::Map(entries.into_iter().map(|(key, value)| (key.into(), value)).collect())
    }

    /// An object of those entries that there are.
    #[must_use]
    pub fn some(entries: Vec<(&str, Option<Self>)>) -> Self {
        Self::Map(entries.into_iter().filter_map(|(key, value)| Some((key.into(), value?))).collect())
    }

    /// A list of numbers.
    pub fn numbers<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> Self {
        Self::List(numbers.into_iter().map(|&x| Self::Number(x)).collect())
    }

    /// A number that any format must give back to the bit: what JSON cannot hold (NaN, infinities, minus zero) becomes text.
    #[must_use]
    pub fn exact(x: f64) -> Self {
        if x.is_finite() && x.to_bits() != (-0.0f64).to_bits() {
            Self::Number(x)
        } else {
            Self::Text(if x == 0.0 { "-0".to_owned() } else { number(x) })
        }
    }

    /// A list of numbers as [`Value::exact`].
    pub fn exact_numbers<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> Self {
        Self::List(numbers.into_iter().map(|&x| Self::exact(x)).collect())
    }

    /// A piece of text.
    #[must_use]
    pub fn text(text: &str) -> Self {
        Self::Text(text.to_owned())
    }

    /// Appends words that no other value has: its kind, its length, its contents.
    pub fn bits(&self, words: &mut Vec<u64>) {
        let text = |s: &str, words: &mut Vec<u64>| {
            words.push(s.len() as u64);
            words.extend(s.bytes().map(u64::from));
        };
        match self {
            Self::Null => words.push(0),
            Self::Bool(b) => words.extend([1, u64::from(*b)]),
            // minus zero is zero here: JSON in JavaScript does not distinguish them
            Self::Number(x) => words.extend([2, (x + 0.0).to_bits()]),
            Self::Text(s) => {
                words.push(3);
                text(s, words);
            }
            Self::List(items) => {
                words.extend([4, items.len() as u64]);
                items.iter().for_each(|item| item.bits(words));
            }
            Self::Map(entries) => {
                words.extend([5, entries.len() as u64]);
                for (key, value) in entries {
                    text(key, words);
                    value.bits(words);
                }
            }
        }
    }

    /// How an error message quotes this value: short, and one line.
    #[must_use]
    pub fn quoted(&self) -> String {
        match self {
            Self::Null => "nothing".to_owned(),
            Self::Bool(b) => (if *b { "true" } else { "false" }).to_owned(),
            Self::Number(x) => number(*x),
            Self::Text(s) => quote(s),
            Self::List(v) => {
                let mut text = String::from("[");
                for (i, item) in v.iter().take(4).enumerate() {
                    text += if i == 0 { "" } else { ", " };
                    text += &item.quoted();
                }
                text.push_str(if v.len() > 4 { ", ...]" } else { "]" });
                text
            }
            Self::Map(_) => "an object".to_owned(),
        }
    }
}

impl From<f64> for Value {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}

impl From<&[f64]> for Value {
    fn from(numbers: &[f64]) -> Self {
        Self::numbers(numbers)
    }
}

impl From<&Vec<f64>> for Value {
    fn from(numbers: &Vec<f64>) -> Self {
        Self::numbers(numbers)
    }
}

/// Whether two keys are the same. Most differ in their lengths, which are compared without a call.
#[inline(always)]
fn same(a: &str, b: &str) -> bool {
    a.len() == b.len() && a == b
}

/// A value and its place.
#[derive(Clone, Copy, Debug)]
pub struct Node<'a> {
    value: &'a Value,
    path: Path<'a>,
}

impl<'a> Node<'a> {
    /// The root of a tree. `name` begins every path (empty for a scenario, `destination` for one destination).
    #[must_use]
    pub const fn root(value: &'a Value, name: &'a str) -> Self {
        Self { value, path: Path::root(name) }
    }

    /// The value itself.
    #[must_use]
    pub const fn value(&self) -> &'a Value {
        self.value
    }

    /// Where it is, such as `destinations[3].covariance`.
    #[must_use]
    pub const fn place(&self) -> &Path<'a> {
        &self.path
    }

    /// The same in words.
    #[must_use]
    pub fn path(&self) -> String {
        self.path.to_string()
    }

    /// An error about this value: `"must be positive"` becomes `"must be positive, got -3"`.
    #[must_use]
    pub fn error(&self, code: Code, must: &str) -> Error {
        Error::new(code, self.path(), format!("{must}, got {}", self.value.quoted()))
    }

    /// This value as an object that may have the `legal` keys only.
    ///
    /// # Errors
    /// `wrong-type` if it is none, `unknown-key` for any other key and for a duplicate one.
    pub fn fields(&self, legal: &[&str]) -> Result<Fields<'_>> {
        let Value::Map(entries) = self.value else {
            return Err(self.error(Code::WrongType, "must be an object"));
        };
        for (i, (key, _)) in entries.iter().enumerate() {
            let path = || self.path.key(key).to_string();
            if !legal.iter().any(|legal| same(key, legal)) {
                let legal: Vec<String> = legal.iter().map(|k| quote(k)).collect();
                let message = format!("unknown key {}, expected one of {}", quote(key), legal.join(", "));
                return Err(Error::new(Code::UnknownKey, path(), message));
            }
            if entries[..i].iter().any(|(before, _)| same(before, key)) {
                return Err(Error::new(Code::UnknownKey, path(), format!("duplicate key {}", quote(key))));
            }
        }
        Ok(Fields { entries, node: self })
    }

    /// The key `key` of this value, if it is an object that has it and it is not null.
    #[must_use]
    pub fn get<'b>(&'b self, key: &'b str) -> Option<Node<'b>> {
        let Value::Map(entries) = self.value else { return None };
        let (_, value) = entries.iter().find(|(k, v)| same(k, key) && !matches!(v, Value::Null))?;
        Some(Node { value, path: self.path.key(key) })
    }

    /// One of the given words at `key` of an object whose other legal keys depend on that word.
    ///
    /// # Errors
    /// `wrong-type`, `missing-key`, `out-of-range`.
    pub fn tag<T: Copy>(&self, key: &str, words: &[(&str, T)]) -> Result<T> {
        let Value::Map(entries) = self.value else {
            return Err(self.error(Code::WrongType, "must be an object"));
        };
        Fields { entries, node: self }.required(key)?.word(words)
    }

    /// Any number.
    ///
    /// # Errors
    /// `wrong-type`.
    pub fn float(&self) -> Result<f64> {
        match self.value {
            Value::Number(x) => Ok(*x),
            _ => Err(self.error(Code::WrongType, "must be a number")),
        }
    }

    /// A list of numbers.
    ///
    /// # Errors
    /// `wrong-type`.
    pub fn floats(&self) -> Result<Vec<f64>> {
        let Value::List(items) = self.value else { return Err(self.error(Code::WrongType, "must be a list")) };
        if let Some(i) = items.iter().position(|item| !matches!(item, Value::Number(_))) {
            return Err(Node { value: &items[i], path: self.path.index(i) }.error(Code::WrongType, "must be a number"));
        }
        // in two passes, of which none calls a function for each
        Ok(items.iter().map(|item| if let Value::Number(x) = item { *x } else { 0.0 }).collect())
    }

    /// A number that passes [`Path::number`].
    ///
    /// # Errors
    /// `wrong-type`, and those of [`Path::number`].
    pub fn number(&self) -> Result<f64> {
        self.path.number(self.float()?)
    }

    /// True or false.
    ///
    /// # Errors
    /// `wrong-type`.
    pub fn boolean(&self) -> Result<bool> {
        match self.value {
            Value::Bool(value) => Ok(*value),
            _ => Err(self.error(Code::WrongType, "must be true or false")),
        }
    }

    /// A number that passes [`Path::positive`].
    ///
    /// # Errors
    /// `wrong-type`, and those of [`Path::positive`].
    pub fn positive(&self) -> Result<f64> {
        self.path.positive(self.float()?)
    }

    /// An integer that passes [`Path::integer`].
    ///
    /// # Errors
    /// `wrong-type`, and those of [`Path::integer`].
    pub fn integer(&self, low: usize, high: usize) -> Result<usize> {
        self.path.integer(self.float()?, low, high)
    }

    /// A number that [`Value::exact`] wrote.
    ///
    /// # Errors
    /// `wrong-type`.
    pub fn exact(&self) -> Result<f64> {
        match self.value {
            Value::Text(s) => match s.as_str() {
                "-0" => Ok(-0.0),
                "NaN" => Ok(f64::NAN),
                "Infinity" => Ok(f64::INFINITY),
                "-Infinity" => Ok(f64::NEG_INFINITY),
                _ => self.float(),
            },
            _ => self.float(),
        }
    }

    /// A list of `length` numbers that [`Value::exact_numbers`] wrote.
    ///
    /// # Errors
    /// `wrong-type`, `wrong-length`.
    pub fn exact_numbers(&self, length: usize) -> Result<Vec<f64>> {
        let items = self.items()?;
        if items.len() != length {
            let must = format!("must have {length} numbers, has {}", items.len());
            return Err(self.error(Code::WrongLength, &must));
        }
        self.numbers(|item| item.exact())
    }

    /// A string.
    ///
    /// # Errors
    /// `wrong-type`.
    pub fn text(&self) -> Result<&'a str> {
        match self.value {
            Value::Text(s) => Ok(s),
            _ => Err(self.error(Code::WrongType, "must be a string")),
        }
    }

    /// One of the given words.
    ///
    /// # Errors
    /// `wrong-type`, `out-of-range`.
    pub fn word<T: Copy>(&self, words: &[(&str, T)]) -> Result<T> {
        let text = self.text()?;
        words.iter().find(|(word, _)| *word == text).map(|(_, item)| *item).ok_or_else(|| {
            let legal: Vec<String> = words.iter().map(|(word, _)| quote(word)).collect();
            self.error(Code::OutOfRange, &format!("must be one of {}", legal.join(", ")))
        })
    }

    /// The items of a list.
    ///
    /// # Errors
    /// `wrong-type`.
    pub fn items(&self) -> Result<impl ExactSizeIterator<Item = Node<'_>>> {
        match self.value {
            Value::List(items) => {
                Ok(items.iter().enumerate().map(move |(i, value)| Node { value, path: self.path.index(i) }))
            }
            _ => Err(self.error(Code::WrongType, "must be a list")),
        }
    }

    /// A list of finite numbers, of the given length where one is given.
    ///
    /// # Errors
    /// `wrong-type`, `wrong-length`, `not-finite`.
    pub fn vector(&self, length: Option<usize>) -> Result<Vec<f64>> {
        let items = self.items()?;
        match length {
            Some(n) if items.len() != n => {
                let found = items.len();
                Err(self.error(Code::WrongLength, &format!("must have {n} numbers, has {found}")))
            }
            _ => self.numbers(|item| item.number()),
        }
    }

    /// A list of numbers, each passed through `check`.
    ///
    /// # Errors
    /// `wrong-type`, and those of `check`.
    pub fn numbers(&self, check: fn(&Node<'_>) -> Result<f64>) -> Result<Vec<f64>> {
        let items = self.items()?;
        let mut numbers = Vec::with_capacity(items.len());
        for item in items {
            numbers.push(check(&item)?);
        }
        Ok(numbers)
    }
}
