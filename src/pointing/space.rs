//! How many axes there are.

use std::fmt::Debug;

/// The number of axes, 1 to 3. Where it is a constant, nothing of the others is compiled.
pub(crate) trait Space: Copy + Debug {
    /// The number.
    fn dimensions(self) -> usize;
}

/// A line, a plane or space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AnySpace(pub usize);

/// Two axes: a screen.
#[cfg(feature = "wasm-pointing")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane;

impl Space for AnySpace {
    fn dimensions(self) -> usize {
        self.0
    }
}

#[cfg(feature = "wasm-pointing")]
impl Space for Plane {
    fn dimensions(self) -> usize {
        2
    }
}
