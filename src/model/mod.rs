//! What moves, what is seen, where it may end: the parts of the state-space model.

pub mod bridge;
