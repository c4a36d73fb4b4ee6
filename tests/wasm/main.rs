//! The library as WebAssembly, in Node: the golden cases from SIMD code, and the boundary to JavaScript that the feature `wasm`
//! adds, from the side of Rust. `tests/js` has the classes of `js/` around it.
#![cfg(target_arch = "wasm32")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod boundary;
mod errors;
#[path = "../native/golden.rs"]
mod golden;
mod node;
#[path = "../native/support.rs"]
mod support;

use wasm_bindgen_test::wasm_bindgen_test;

#[wasm_bindgen_test]
fn is_built_for_simd() {
    const { assert!(cfg!(target_feature = "simd128"), "RUSTFLAGS replaced the target's own flags") };
}
