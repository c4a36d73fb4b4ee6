//! A [`Value`] as two flat things, numbers and a text. `js/value.ts` is the other half and tells the form.

use crate::error::{Code, Error, Result};
use crate::value::Value;
use wasm_bindgen::prelude::wasm_bindgen;

const NOTHING: f64 = 0.0;
const FALSE: f64 = 1.0;
const TRUE: f64 = 2.0;
const NUMBER: f64 = 3.0;
const TEXT: f64 = 4.0;
const LIST: f64 = 5.0;
const MAP: f64 = 6.0;

/// The value that `js/value.ts` wrote.
///
/// # Errors
/// `wrong-type` where it wrote something else.
pub fn read(numbers: &[f64], text: &str) -> Result<Value> {
    let mut reader = Reader { numbers, text };
    reader.value().ok_or_else(|| Error::new(Code::WrongType, "", "must be what js/value.ts writes"))
}

struct Reader<'a> {
    numbers: &'a [f64],
    text: &'a str,
}

impl Reader<'_> {
    fn number(&mut self) -> Option<f64> {
        let (first, rest) = self.numbers.split_first()?;
        self.numbers = rest;
        Some(*first)
    }

    fn text(&mut self) -> Option<String> {
        // JavaScript counts UTF-16 units. A lone surrogate arrives as U+FFFD, which is one unit too.
        let mut units = self.number()?;
        let mut bytes = 0;
        for character in self.text.chars() {
            if units <= 0.0 {
                break;
            }
            units -= character.len_utf16() as f64;
            bytes += character.len_utf8();
        }
        let (text, rest) = self.text.split_at_checked(bytes)?;
        self.text = rest;
        Some(text.to_owned())
    }

    fn value(&mut self) -> Option<Value> {
        let kind = self.number()?;
        Some(if kind == NUMBER {
            Value::Number(self.number()?)
        } else if kind == TEXT {
            Value::Text(self.text()?)
        } else if kind == LIST {
            let length = self.length()?;
            let mut items = Vec::with_capacity(length);
            for _ in 0..length {
                items.push(self.value()?);
            }
            Value::List(items)
        } else if kind == MAP {
            let length = self.length()?;
            let mut entries = Vec::with_capacity(length);
            for _ in 0..length {
                entries.push((self.text()?, self.value()?));
            }
            Value::Map(entries)
        } else if kind == NOTHING {
            Value::Null
        } else {
            Value::Bool(kind == TRUE)
        })
    }

    /// A count of things each of which takes at least one number.
    fn length(&mut self) -> Option<usize> {
        Some((self.number()? as usize).min(self.numbers.len()))
    }
}

/// A value on its way to JavaScript.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct Tree {
    numbers: Vec<f64>,
    text: String,
}

#[wasm_bindgen]
impl Tree {
    /// Hands the numbers over.
    pub fn numbers(&mut self) -> Vec<f64> {
        std::mem::take(&mut self.numbers)
    }

    /// Hands the text over.
    pub fn text(&mut self) -> String {
        std::mem::take(&mut self.text)
    }
}

impl Tree {
    /// Writes `value`.
    pub(super) fn new(value: &Value) -> Self {
        let mut tree = Self::default();
        tree.write(value);
        tree
    }

    fn write(&mut self, value: &Value) {
        match value {
            Value::Null => self.numbers.push(NOTHING),
            Value::Bool(b) => self.numbers.push(if *b { TRUE } else { FALSE }),
            Value::Number(x) => self.numbers.extend([NUMBER, *x]),
            Value::Text(text) => {
                self.numbers.push(TEXT);
                self.write_text(text);
            }
            Value::List(items) => {
                self.numbers.extend([LIST, items.len() as f64]);
                items.iter().for_each(|item| self.write(item));
            }
            Value::Map(entries) => {
                self.numbers.extend([MAP, entries.len() as f64]);
                for (key, item) in entries {
                    self.write_text(key);
                    self.write(item);
                }
            }
        }
    }

    fn write_text(&mut self, text: &str) {
        self.numbers.push(text.encode_utf16().count() as f64);
        self.text.push_str(text);
    }
}
