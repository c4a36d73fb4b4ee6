//! Errors: Rust makes the very `WhitherError` that JavaScript gets, so nothing is translated on the way.

use crate::error::Error;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// The class of that name where the generated code lies: `scripts/build-wasm.mjs` imports `#error` there, which is
    /// `js/core/error.ts`; tests put a class of their own among the globals.
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
