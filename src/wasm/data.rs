//! A [`Value`] as JavaScript's plain data. `js/core/plain.ts` has copied all of a user's object before it comes here.

use crate::error::{Code, Error, Result};
use crate::value::Value;
use js_sys::{Array, Object};
use serde::Serialize;
use wasm_bindgen::{JsCast, JsValue};

/// The value that `js/core/plain.ts` copied. Read by hand: deserialising brings in its own messages, and with them all that prints
/// numbers, 14 kB under gzip.
///
/// # Errors
/// `wrong-type` for what is no plain data.
pub fn read(value: &JsValue) -> Result<Value> {
    if let Some(number) = value.as_f64() {
        Ok(Value::Number(number))
    } else if let Some(text) = value.as_string() {
        Ok(Value::Text(text))
    } else if let Some(truth) = value.as_bool() {
        Ok(Value::Bool(truth))
    } else if value.is_null() || value.is_undefined() {
        Ok(Value::Null)
    } else if let Some(list) = value.dyn_ref::<Array>() {
        let mut items = Vec::with_capacity(list.length() as usize);
        for i in 0..list.length() {
            items.push(read(&list.get(i))?);
        }
        Ok(Value::List(items))
    } else if value.is_object() {
        let list = Object::entries(value.unchecked_ref());
        let mut entries = Vec::with_capacity(list.length() as usize);
        for i in 0..list.length() {
            let entry: Array = list.get(i).unchecked_into();
            entries.push((entry.get(0).as_string().unwrap_or_default(), read(&entry.get(1))?));
        }
        Ok(Value::Map(entries))
    } else {
        Err(Error::new(Code::WrongType, "", "must be plain data"))
    }
}

/// A value as objects, arrays, strings and numbers; JSON can carry it.
///
/// # Errors
/// `wrong-type` where JavaScript refuses it.
pub fn write(value: &Value) -> Result<JsValue> {
    let plain = value.serialize(&serde_wasm_bindgen::Serializer::json_compatible());
    plain.map_err(|_| Error::new(Code::WrongType, "", "must be plain data"))
}
