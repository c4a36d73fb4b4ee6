//! The boundary to JavaScript, and the only folder that names wasm-bindgen. The files here and those in `js/` mirror one another.
//!
//! Flat things cross: numbers, slices of numbers, strings, and objects as bytes ([`crate::value`]). JavaScript has read all of a
//! user's object before it enters here, so that no getter and no proxy runs while a method borrows its engine.

#[cfg(any(feature = "wasm", feature = "wasm-fit"))]
mod error;
#[cfg(feature = "wasm-fit")]
mod fit;
mod memory;
#[cfg(feature = "wasm")]
mod pointer;
#[cfg(feature = "wasm-pointing")]
mod pointing;
#[cfg(feature = "wasm")]
mod predictor;
#[cfg(feature = "wasm")]
mod sequence;

#[cfg(any(feature = "wasm", feature = "wasm-fit"))]
pub use error::WhitherError;
#[cfg(feature = "wasm")]
pub use pointer::device_scenario;
#[cfg(feature = "wasm-pointing")]
pub use pointing::{PointerEngine, constants};
#[cfg(feature = "wasm")]
pub use predictor::Engine;
#[cfg(feature = "wasm")]
pub use sequence::SequenceEngine;
#[cfg(any(feature = "wasm", feature = "wasm-fit"))]
use wasm_bindgen::prelude::wasm_bindgen;

/// Small, and as sparing with memory as the default one.
#[cfg(all(any(feature = "wasm", feature = "wasm-fit"), not(feature = "wasm-pointing"), target_family = "wasm"))]
#[global_allocator]
static ALLOCATOR: talc::wasm::WasmDynamicTalc = talc::wasm::new_wasm_dynamic_allocator();

#[cfg(any(feature = "wasm", feature = "wasm-fit"))]
type Result<T> = std::result::Result<T, WhitherError>;

#[cfg(any(feature = "wasm", feature = "wasm-fit"))]
#[wasm_bindgen]
extern "C" {
    /// A number as JavaScript prints it.
    #[wasm_bindgen(js_name = String)]
    pub(crate) fn number(x: f64) -> String;
}

/// The mean and behind it the covariance.
#[cfg(feature = "wasm")]
fn flat(gaussian: crate::math::gaussian::Gaussian) -> Vec<f64> {
    let mut flat = gaussian.mean.as_slice().to_vec();
    flat.extend(gaussian.covariance.iter());
    flat
}
