//! Where a value is in a description, and the checks of numbers that name the place and quote the value.

use super::{LARGEST, Value};
use crate::error::{Code, Error, Result};
use std::fmt;

#[derive(Clone, Copy, Debug)]
enum Step<'a> {
    Root(&'a str),
    Key(&'a str),
    Index(usize),
}

/// The place of a value, such as `destinations[3].covariance`: made of references, so that it costs nothing until it is printed.
#[derive(Clone, Copy, Debug)]
pub struct Path<'a> {
    parent: Option<&'a Path<'a>>,
    step: Step<'a>,
}

/// A check of one number.
pub type Check = fn(&Path<'_>, f64) -> Result<f64>;

impl<'a> Path<'a> {
    /// The root: `name` begins every path (empty for a scenario, `destination` for one destination).
    pub const fn root(name: &'a str) -> Self {
        Self { parent: None, step: Step::Root(name) }
    }

    /// A field of the object here.
    pub const fn key(&'a self, key: &'a str) -> Self {
        Self { parent: Some(self), step: Step::Key(key) }
    }

    /// An item of the list here.
    pub const fn index(&'a self, index: usize) -> Self {
        Self { parent: Some(self), step: Step::Index(index) }
    }

    /// An error about the value here: `"must be positive"` becomes `"must be positive, got -3"`.
    pub fn error(&self, code: Code, must: &str, got: impl Into<Value>) -> Error {
        Error::new(code, self.to_string(), format!("{must}, got {}", got.into().quoted()))
    }

    /// A finite number, at most [`LARGEST`] in absolute value.
    pub fn number(&self, x: f64) -> Result<f64> {
        if x.abs() <= LARGEST {
            Ok(x)
        } else if x.is_finite() {
            Err(self.error(Code::OutOfRange, "must be from -1e50 to 1e50", x))
        } else {
            Err(self.error(Code::NotFinite, "must be a finite number", x))
        }
    }

    /// A number above zero whose square and whose inverse are within reach: from 1e-50 to 1e50.
    pub fn positive(&self, x: f64) -> Result<f64> {
        match self.number(x)? {
            x if x <= 0.0 => Err(self.error(Code::OutOfRange, "must be greater than 0", x)),
            x if x < 1.0 / LARGEST => Err(self.error(Code::OutOfRange, "must be at least 1e-50", x)),
            x => Ok(x),
        }
    }

    /// A number that is zero or above.
    pub fn not_negative(&self, x: f64) -> Result<f64> {
        let x = self.number(x)?;
        if x >= 0.0 { Ok(x) } else { Err(self.error(Code::OutOfRange, "must be at least 0", x)) }
    }

    /// An integer from `low` to `high`; above `high` the code is `too-large`.
    pub fn integer(&self, x: f64, low: usize, high: usize) -> Result<usize> {
        let x = self.number(x)?;
        let must = || format!("must be an integer from {low} to {high}");
        if x.fract() != 0.0 || x < low as f64 {
            return Err(self.error(Code::OutOfRange, &must(), x));
        }
        if x > high as f64 {
            return Err(self.error(Code::TooLarge, &must(), x));
        }
        Ok(x as usize)
    }

    /// The numbers, if each passes `check`.
    pub fn each<'n>(&self, numbers: &'n [f64], check: Check) -> Result<&'n [f64]> {
        for (i, x) in numbers.iter().enumerate() {
            check(&self.index(i), *x)?;
        }
        Ok(numbers)
    }

    /// The numbers, if there are so many and each passes `check`.
    pub fn vector<'n>(&self, numbers: &'n [f64], length: usize, check: Check) -> Result<&'n [f64]> {
        if numbers.len() != length {
            let must = format!("must have {length} numbers, has {}", numbers.len());
            return Err(self.error(Code::WrongLength, &must, numbers));
        }
        self.each(numbers, check)
    }
}

impl fmt::Display for Path<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let before = self.parent.map(Path::to_string).unwrap_or_default();
        match self.step {
            Step::Root(name) => f.write_str(name),
            Step::Key(key) if before.is_empty() => f.write_str(key),
            Step::Key(key) => write!(f, "{before}.{key}"),
            Step::Index(i) => write!(f, "{before}[{i}]"),
        }
    }
}
