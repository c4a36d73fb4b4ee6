//! A [`Value`] as bytes: how data crosses the boundary to JavaScript, at once and both ways. `js/core/bytes.ts` is the other side.
//!
//! A value is a tag and what follows it; numbers are little-endian, lengths and counts 32 bits long.
//!
//! | tag | value | what follows |
//! |---:|---|---|
//! | 0 | null | |
//! | 1, 2 | false, true | |
//! | 3 | a number | 64 bits |
//! | 4 | a text | its length, as many bytes of UTF-8 |
//! | 5 | a list | its length, its items |
//! | 6 | an object | its length; of each entry the number of its key and the value |
//!
//! Keys are numbered as they come: a number that is new has the key as a text behind it.

use super::{Key, Value};
use crate::error::{Code, Error, Result};

impl Value {
    /// The value that was written.
    ///
    /// # Errors
    /// `wrong-type` for anything else.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self> {
        let value = Reader { rest: bytes, keys: Vec::new() }.value();
        value.ok_or_else(|| Error::new(Code::WrongType, "", "must be plain data"))
    }

    /// The value in bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut writer = Writer::default();
        writer.value(self);
        writer.bytes
    }
}

struct Reader<'a> {
    rest: &'a [u8],
    keys: Vec<Key>,
}

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (taken, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        Some(*taken)
    }

    fn count(&mut self) -> Option<usize> {
        self.take().map(|bytes| u32::from_le_bytes(bytes) as usize)
    }

    fn text(&mut self) -> Option<&str> {
        let length = self.count()?;
        let (text, rest) = self.rest.split_at_checked(length)?;
        self.rest = rest;
        std::str::from_utf8(text).ok()
    }

    fn key(&mut self) -> Option<Key> {
        let number = self.count()?;
        if number == self.keys.len() {
            let key = self.text()?.into();
            self.keys.push(key);
        }
        self.keys.get(number).cloned()
    }

    /// The next values, if all are numbers, as in most lists: without a call for each.
    fn numbers(&mut self, count: usize) -> Option<Vec<Value>> {
        let (all, rest) = self.rest.split_at_checked(count.checked_mul(9)?)?;
        let all = all.as_chunks::<9>().0;
        if all.iter().any(|[tag, ..]| *tag != 3) {
            return None;
        }
        self.rest = rest;
        let number = |[_, bytes @ ..]: &[u8; 9]| Value::Number(f64::from_le_bytes(*bytes));
        Some(all.iter().map(number).collect())
    }

    fn value(&mut self) -> Option<Value> {
        let [tag] = self.take()?;
        Some(match tag {
            0 => Value::Null,
            1 => Value::Bool(false),
            2 => Value::Bool(true),
            3 => Value::Number(f64::from_le_bytes(self.take()?)),
            4 => Value::text(self.text()?),
            5 => {
                let count = self.count()?;
                if let Some(numbers) = self.numbers(count) {
                    return Some(Value::List(numbers));
                }
                // no item is shorter than a byte
                let mut items = Vec::with_capacity(count.min(self.rest.len()));
                for _ in 0..count {
                    items.push(self.value()?);
                }
                Value::List(items)
            }
            6 => {
                let count = self.count()?;
                let mut entries = Vec::with_capacity(count.min(self.rest.len()));
                for _ in 0..count {
                    entries.push((self.key()?, self.value()?));
                }
                Value::Map(entries)
            }
            _ => return None,
        })
    }
}

#[derive(Default)]
struct Writer<'a> {
    bytes: Vec<u8>,
    keys: Vec<&'a str>,
}

impl<'a> Writer<'a> {
    fn count(&mut self, count: usize) {
        self.bytes.extend((count as u32).to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.count(text.len());
        self.bytes.extend(text.as_bytes());
    }

    fn value(&mut self, value: &'a Value) {
        match value {
            Value::Null => self.bytes.push(0),
            Value::Bool(truth) => self.bytes.push(1 + u8::from(*truth)),
            Value::Number(x) => {
                self.bytes.push(3);
                self.bytes.extend(x.to_le_bytes());
            }
            Value::Text(text) => {
                self.bytes.push(4);
                self.text(text);
            }
            Value::List(items) => {
                self.bytes.push(5);
                self.count(items.len());
                items.iter().for_each(|item| self.value(item));
            }
            Value::Map(entries) => {
                self.bytes.push(6);
                self.count(entries.len());
                for (key, value) in entries {
                    // what is written has a few dozen keys
                    let known = self.keys.iter().position(|known| **known == **key);
                    self.count(known.unwrap_or(self.keys.len()));
                    if known.is_none() {
                        self.keys.push(key);
                        self.text(key);
                    }
                    self.value(value);
                }
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_again() {
        let one = |id: &str| {
            let numbers = Value::numbers(&[1.5, -0.0, f64::INFINITY]);
            Value::map([
                ("id", Value::text(id)),
                ("center", numbers),
                ("prior", Value::Null),
                ("😀", Value::Bool(true)),
            ])
        };
        let value =
            Value::List(vec![one("a"), one("ß😀"), Value::Bool(false), Value::Map(Vec::new()), Value::text("")]);
        let bytes = value.to_bytes();
        assert_eq!(Value::from_bytes(&bytes).unwrap(), value);
        for length in 0..bytes.len() {
            assert_eq!(Value::from_bytes(&bytes[..length]).unwrap_err().code(), Code::WrongType);
        }
    }

    #[test]
    fn what_was_not_written_is_no_data() {
        let (no_tag, no_key, no_text) = (vec![7], vec![6, 1, 0, 0, 0, 1, 0, 0, 0, 0], vec![4, 1, 0, 0, 0, 0xff]);
        for bytes in [no_tag, no_key, no_text] {
            assert_eq!(Value::from_bytes(&bytes).unwrap_err().message(), "must be plain data");
        }
    }
}
