//! Whither ("to which place") predicts where a moving thing is heading while it is still on its way.
#![forbid(unsafe_code)]

pub mod error;
pub mod math;
pub mod model;
pub mod value;

pub use error::{Code, Error, Result};
