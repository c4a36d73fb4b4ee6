//! Reserves memory before a call. Running out of memory in the middle of a call ends in a trap, after which the object that was
//! used stays locked and what was allocated stays allocated; so `js/core/memory.ts` calls this first.

use std::hint::black_box;
use wasm_bindgen::prelude::wasm_bindgen;

/// Whether so many bytes can be allocated: what is allocated and freed here stays with the allocator.
#[wasm_bindgen]
pub fn reserve_memory(bytes: f64) -> bool {
    let mut reserved: Vec<u8> = Vec::new();
    let possible = bytes < f64::from(i32::MAX) && reserved.try_reserve_exact(bytes as usize).is_ok();
    black_box(&reserved);
    possible
}
