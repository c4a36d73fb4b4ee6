//! The boundary to JavaScript, and the only folder that names wasm-bindgen. The files here and those in `js/` mirror one another.
//!
//! Flat things cross: numbers, slices of numbers, strings, and whole objects as plain [`data`]. JavaScript has read all of a
//! user's object before it enters here, so that no getter and no proxy runs while a method borrows its engine.

mod data;
mod error;
#[cfg(feature = "wasm-fit")]
mod fit;
#[cfg(feature = "wasm")]
mod pointer;
#[cfg(feature = "wasm")]
mod predictor;
#[cfg(feature = "wasm")]
mod sequence;

use error::WhitherError;

type Result<T> = std::result::Result<T, WhitherError>;

/// The mean and behind it the covariance.
#[cfg(feature = "wasm")]
fn flat(gaussian: crate::math::gaussian::Gaussian) -> Vec<f64> {
    let mut flat = gaussian.mean.as_slice().to_vec();
    flat.extend(gaussian.covariance.iter());
    flat
}
