//! A number for all axes, or one for each.

use crate::error::{Code, Result};
use crate::value::{Check, Node, Path, Value};

/// One number for all axes, or one for each of them: a deviation, a size, a noise.
///
/// Whatever takes one takes a number or a list of numbers too.
///
/// ```
/// use whither::PerAxis;
/// assert_eq!(PerAxis::from(1.5), PerAxis::All(1.5));
/// assert_eq!(PerAxis::from([1.5, 2.0]), PerAxis::Each(vec![1.5, 2.0]));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum PerAxis {
    /// The same for all axes.
    All(f64),
    /// As many as there are axes.
    Each(Vec<f64>),
}

impl From<f64> for PerAxis {
    fn from(x: f64) -> Self {
        Self::All(x)
    }
}

impl<const N: usize> From<[f64; N]> for PerAxis {
    fn from(each: [f64; N]) -> Self {
        Self::Each(each.to_vec())
    }
}

impl From<Vec<f64>> for PerAxis {
    fn from(each: Vec<f64>) -> Self {
        Self::Each(each)
    }
}

impl PerAxis {
    pub(crate) fn read(node: &Node<'_>, axes: usize) -> Result<Self> {
        match node.value() {
            Value::Number(x) => Ok(Self::All(*x)),
            Value::List(_) => Ok(Self::Each(node.floats()?)),
            _ => {
                let must = format!("must be a number or a list of {axes} numbers, one for each axis");
                Err(node.error(Code::WrongType, &must))
            }
        }
    }

    /// A number for each of the axes, each of which passes `check`.
    pub(crate) fn check(&self, at: &Path<'_>, axes: usize, check: Check) -> Result<Vec<f64>> {
        let mut each = vec![0.0; axes];
        self.write(at, check, &mut each)?;
        Ok(each)
    }

    /// The same, written into a list of as many.
    pub(crate) fn write(&self, at: &Path<'_>, check: Check, into: &mut [f64]) -> Result<()> {
        match self {
            Self::All(x) => into.fill(check(at, *x)?),
            Self::Each(each) => into.copy_from_slice(at.vector(each, into.len(), check)?),
        }
        Ok(())
    }

    /// One number where all axes have the same, a list where they differ.
    pub(crate) fn to_value(&self) -> Value {
        match self {
            Self::All(x) => Value::Number(*x),
            Self::Each(each) => match each.as_slice() {
                [first, others @ ..] if others.iter().all(|x| x == first) => Value::Number(*first),
                _ => Value::numbers(each),
            },
        }
    }
}
