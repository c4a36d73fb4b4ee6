//! What the tests take from Node, and what they give to JavaScript and get back.

use js_sys::{Array, Float64Array, Function, JSON, Reflect, WebAssembly};
use serde_json::Value as Json;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsCast, JsValue};
use whither::internals::Value;
use whither::wasm::WhitherError;

/// What everything at the boundary that can fail returns.
pub type Result<T> = std::result::Result<T, WhitherError>;

#[wasm_bindgen(module = "node:fs")]
extern "C" {
    #[wasm_bindgen(js_name = readFileSync)]
    pub fn read_file(path: &str, encoding: &str) -> String;
}

/// Puts among the globals what the package imports: the class of `js/core/error.ts` and the function of `js/core/best.ts`.
pub fn globals() {
    let class = "globalThis.WhitherError = class { constructor(...parts) { this.parts = parts; } };";
    let best = "globalThis.best = (id, index, probability) => ({ id, index, probability });";
    Function::new_no_args(&format!("{class} {best}")).call0(&JsValue::NULL).unwrap();
}

/// What an error was made from, code, path and message, with numbers as Rust prints them: 1e51 where JavaScript has 1e+51.
pub fn parts(error: impl Into<JsValue>) -> String {
    let parts: Array = Reflect::get(&error.into(), &"parts".into()).unwrap().unchecked_into();
    String::from(parts.join(" | ")).replace("e+", "e")
}

/// A value as it crosses the boundary.
pub fn plain(json: &Json) -> Vec<u8> {
    crate::support::value(json).to_bytes()
}

/// An object of JavaScript as JSON.
pub fn object(value: &JsValue) -> Json {
    serde_json::from_str(&String::from(JSON::stringify(value).unwrap())).unwrap()
}

/// What crossed the boundary as JSON.
pub fn json(bytes: &[u8]) -> Json {
    serde_json::to_value(Value::from_bytes(bytes).unwrap()).unwrap()
}

/// The numbers at a place in memory, as `js/core/predictor.ts` reads them.
pub fn at(place: *const f64, count: usize) -> Vec<f64> {
    let memory: WebAssembly::Memory = wasm_bindgen::memory().unchecked_into();
    Float64Array::new_with_byte_offset_and_length(&memory.buffer(), place as u32, count as u32).to_vec()
}
