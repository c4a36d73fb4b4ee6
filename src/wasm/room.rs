//! Whether there is memory for what is asked, and how many numbers that is. Running out of memory in the middle of a call ends in a
//! trap, after which the object that was used stays locked and what was taken stays taken; so `js/room.ts` asks before a call.

#[cfg(all(feature = "wasm", feature = "papers"))]
use crate::likelihood::Method;
#[cfg(feature = "wasm")]
use crate::predictor::Predictor;
#[cfg(all(feature = "wasm", feature = "papers"))]
use crate::scenario::Engine;
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

/// What a predictor has many of: destinations, bytes of their ids; and of the papers' methods numbers for each destination and
/// arrival time, numbers for each arrival time of a kind of destinations, those that a movement keeps, those that a snapshot has.
#[cfg(feature = "wasm")]
pub fn sizes(predictor: &Predictor) -> [f64; 6] {
    let [pairs, nodes, kept, saved] = numbers(predictor);
    let ids: usize = predictor.ids().map(str::len).sum();
    [predictor.len() as f64, ids as f64, pairs, nodes, kept, saved]
}

#[cfg(all(feature = "wasm", not(feature = "papers")))]
fn numbers(_: &Predictor) -> [f64; 4] {
    [0.0; 4]
}

#[cfg(all(feature = "wasm", feature = "papers"))]
fn numbers(predictor: &Predictor) -> [f64; 4] {
    let (scenario, destinations) = (&predictor.scenario, &predictor.destinations);
    let Engine::Papers { method, arrival, quadrature, .. } = &scenario.engine else { return [0.0; 4] };
    let prior = |kind: usize| destinations.kinds()[kind].arrival().unwrap_or(arrival);
    let points = |kind: usize| prior(kind).points(quadrature) as f64;
    let mut pairs = 0.0;
    let mut nodes: f64 = (0..destinations.kinds().len()).map(points).sum();
    for kind in (0..destinations.len()).map(|i| destinations.kind_number(i)) {
        pairs += points(kind);
        nodes += if prior(kind).needs_distance() { points(kind) } else { 0.0 };
    }
    let candidates = scenario.motion.candidates.len() as f64;
    let states = scenario.motion.states() as f64;
    let (pairs, nodes) = (pairs * candidates, nodes * candidates);
    let apart = scenario.motion.depends_on_destination();
    let columns = if apart { 2.0 * states * destinations.len() as f64 * candidates } else { 0.0 };
    let table = match method {
        // of a filter of the state and the endpoint
        Method::Bridging => (2.0 * states + 1.0) * pairs + 4.0 * states * states * nodes,
        Method::PseudoObservation if !apart => 0.0,
        _ => pairs,
    };
    let saved = columns + if method.accumulates() { table } else { 0.0 };
    [pairs, nodes, table + columns, saved]
}
