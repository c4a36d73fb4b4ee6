//! Whether there is memory for what is asked. Running out of memory in the middle of a call ends in a trap, after which the object
//! that was used stays locked and what was taken stays taken; so `js/room.ts` asks before a call.

use std::hint::black_box;
use wasm_bindgen::prelude::wasm_bindgen;

/// Whether there are so many bytes: what is taken and given back here stays with the allocator.
#[wasm_bindgen]
pub fn make_room(bytes: f64) -> bool {
    let mut room: Vec<u8> = Vec::new();
    let found = bytes < f64::from(i32::MAX) && room.try_reserve_exact(bytes as usize).is_ok();
    black_box(&room);
    found
}
