//! The keys of an object.

use super::{Key, Node, Value, quote, same};
use crate::error::{Code, Error, Result};

/// An object whose keys have been checked.
#[derive(Clone, Copy, Debug)]
pub struct Fields<'a> {
    pub(super) entries: &'a [(Key, Value)],
    pub(super) node: &'a Node<'a>,
}

impl<'a> Fields<'a> {
    /// The value at `key`, or none where it is absent or null.
    #[must_use]
    pub fn optional(&self, key: &'a str) -> Option<Node<'a>> {
        let (_, value) = self.entries.iter().find(|(k, v)| same(k, key) && !matches!(v, Value::Null))?;
        Some(Node { value, path: self.node.place().key(key) })
    }

    /// The value at `key`.
    ///
    /// # Errors
    /// `missing-key`.
    pub fn required(&self, key: &'a str) -> Result<Node<'a>> {
        self.optional(key).ok_or_else(|| {
            Error::new(Code::MissingKey, self.node.place().key(key).to_string(), format!("missing key {}", quote(key)))
        })
    }

    /// [`Node::float`] at `key`.
    ///
    /// # Errors
    /// `missing-key`, `wrong-type`.
    pub fn float(&self, key: &'a str) -> Result<f64> {
        self.required(key)?.float()
    }

    /// [`Node::number`] at `key`.
    ///
    /// # Errors
    /// `missing-key`, and those of [`Node::number`].
    pub fn number(&self, key: &'a str) -> Result<f64> {
        self.required(key)?.number()
    }

    /// [`Node::positive`] at `key`.
    ///
    /// # Errors
    /// `missing-key`, and those of [`Node::positive`].
    pub fn positive(&self, key: &'a str) -> Result<f64> {
        self.required(key)?.positive()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn null_counts_as_absent_but_its_key_must_be_known() {
        let value: Value = serde_json::from_str(r#"{ "noise": 3, "matrix": null }"#).unwrap();
        let root = Node::root(&value, "observation");
        let fields = root.fields(&["noise", "matrix"]).unwrap();
        assert_eq!(fields.required("noise").unwrap().number(), Ok(3.0));
        assert!(fields.optional("matrix").is_none());
        assert_eq!(root.fields(&["noise"]).unwrap_err().path(), "observation.matrix");
    }
}
