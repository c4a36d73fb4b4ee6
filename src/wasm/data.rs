//! A [`Value`] as JavaScript's plain data, by serde. `js/value.ts` has copied all of a user's object before it comes here.

use crate::error::{Code, Error, Result};
use crate::value::Value;
use serde::Serialize;
use wasm_bindgen::JsValue;

/// The value that `js/value.ts` copied.
///
/// # Errors
/// `wrong-type` for what is no plain data.
pub fn read(value: JsValue) -> Result<Value> {
    serde_wasm_bindgen::from_value(value).map_err(|_| Error::new(Code::WrongType, "", "must be plain data"))
}

/// A value as objects, arrays, strings and numbers; JSON can carry it.
///
/// # Errors
/// `wrong-type` where JavaScript refuses it.
pub fn write(value: &Value) -> Result<JsValue> {
    let plain = value.serialize(&serde_wasm_bindgen::Serializer::json_compatible());
    plain.map_err(|_| Error::new(Code::WrongType, "", "must be plain data"))
}
