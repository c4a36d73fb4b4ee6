//! Errors: Rust makes the very `WhitherError` that JavaScript sees, so nothing is translated on the way.

use crate::error::Error;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(raw_module = "#error")]
extern "C" {
    /// The class of `js/core/error.ts`, under the name that tsconfig.json gives it.
    #[derive(Debug)]
    pub type WhitherError;

    #[wasm_bindgen(constructor)]
    fn new(code: &str, path: &str, message: &str) -> WhitherError;
}

impl From<Error> for WhitherError {
    fn from(error: Error) -> Self {
        Self::new(error.code().as_str(), error.path(), error.message())
    }
}
