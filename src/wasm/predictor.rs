//! Bindings behind `js/core/predictor.ts`.

use super::error::WhitherError;
use super::{Result, flat};
use crate::Learnt;
use crate::predictor::Predictor;
use crate::scenario::Scenario;
use crate::snapshot::Snapshot;
use crate::value::{Node, Value};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// The interface of `js/core/best.ts`.
    #[derive(Debug)]
    pub type Best;

    /// Makes one by a single call out of WebAssembly; imported as `WhitherError` is.
    fn best(id: &str, index: usize, probability: f64) -> Best;
}

/// What a JavaScript `Predictor` holds.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Engine {
    predictor: Predictor,
    /// What was learnt, for JavaScript.
    learnt_numbers: [f64; 7],
}

impl Engine {
    fn of(predictor: Predictor) -> Self {
        Self { predictor, learnt_numbers: [0.0; 7] }
    }
}

#[wasm_bindgen]
impl Engine {
    /// From a scenario.
    #[wasm_bindgen(constructor)]
    pub fn new(value: &[u8]) -> Result<Engine> {
        let scenario = Scenario::from_value(&Value::from_bytes(value)?)?;
        Ok(Self::of(Predictor::new(&scenario)))
    }

    /// From a snapshot.
    pub fn restore(value: &[u8]) -> Result<Engine> {
        Ok(Self::of(Predictor::restore(&Snapshot(Value::from_bytes(value)?))?))
    }

    /// A second engine in the same state.
    pub fn duplicate(&self) -> Engine {
        Self::of(self.predictor.clone())
    }

    /// A snapshot.
    pub fn snapshot(&self) -> Vec<u8> {
        self.predictor.snapshot().0.to_bytes()
    }

    /// An observation of the first `count` of three numbers.
    ///
    /// Returns its error: thrown errors come back as a pair, for which JavaScript makes an array at every call.
    pub fn observe(&mut self, time: f64, count: usize, x: f64, y: f64, z: f64) -> Option<WhitherError> {
        let position = [x, y, z];
        let count = count.min(position.len());
        self.predictor.observe(time, &position[..count]).err().map(WhitherError::from)
    }

    /// An observation `{ time, position, noise? }` with all that may be missing or wrong.
    pub fn observe_in_full(&mut self, value: &[u8]) -> Result<()> {
        let value = Value::from_bytes(value)?;
        Ok(self.predictor.observe_value(&Node::root(&value, ""))?)
    }

    /// The sizes by which `js/core/memory.ts` bounds what is allocated.
    pub fn sizes(&self) -> Vec<f64> {
        self.predictor.sizes().to_vec()
    }

    /// The number of destinations; never 0.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.predictor.len()
    }

    /// The ids of the destinations.
    pub fn ids(&self) -> Vec<String> {
        self.predictor.ids().map(ToOwned::to_owned).collect()
    }

    /// Where the probabilities of the destinations are.
    pub fn probabilities(&mut self) -> *const f64 {
        self.predictor.probabilities().as_ptr()
    }

    /// Where the log likelihoods of the destinations are.
    pub fn log_likelihoods(&mut self) -> *const f64 {
        self.predictor.log_likelihoods().as_ptr()
    }

    /// The probability of none of them.
    pub fn none(&mut self) -> f64 {
        self.predictor.none()
    }

    /// The most probable destination; none before the first observation.
    pub fn best(&mut self) -> Option<Best> {
        self.predictor.best().map(|found| best(&found.id, found.index, found.probability))
    }

    /// Whether every arrival node has passed.
    pub fn expired(&self) -> bool {
        self.predictor.expired()
    }

    /// The arrival time for `{ id? }`: mean, deviation, the times, their probabilities.
    pub fn arrival(&mut self, value: &[u8]) -> Result<Option<Vec<f64>>> {
        let value = Value::from_bytes(value)?;
        let node = Node::root(&value, "");
        let id = node.get("id");
        let id = id.as_ref().map(Node::text).transpose()?;
        let arrival = self.predictor.arrival(id)?;
        Ok(arrival.map(|arrival| {
            let mut flat = vec![arrival.mean, arrival.deviation];
            flat.extend(arrival.times);
            flat.extend(arrival.probabilities);
            flat
        }))
    }

    /// The time that is left: mean, low, high.
    pub fn remaining(&mut self) -> Option<Vec<f64>> {
        self.predictor.remaining().map(|remaining| vec![remaining.mean, remaining.low, remaining.high])
    }

    /// The state now.
    pub fn state(&mut self) -> Option<Vec<f64>> {
        self.predictor.state().map(flat)
    }

    /// The state at the first observation.
    pub fn initial_state(&mut self) -> Option<Vec<f64>> {
        self.predictor.initial_state().map(flat)
    }

    /// The state at `{ time }`.
    pub fn forecast(&mut self, value: &[u8]) -> Result<Option<Vec<f64>>> {
        let value = Value::from_bytes(value)?;
        let node = Node::root(&value, "");
        let time = node.fields(&["time"])?.number("time")?;
        Ok(self.predictor.forecast(time)?.map(flat))
    }

    /// The expected positions for `{ id, times }`.
    pub fn path(&mut self, value: &[u8]) -> Result<Vec<f64>> {
        let value = Value::from_bytes(value)?;
        let node = Node::root(&value, "");
        let fields = node.fields(&["id", "times"])?;
        let id = fields.required("id")?.text()?;
        let times = fields.required("times")?.vector(None)?;
        Ok(self.predictor.path(id, &times)?)
    }

    /// Adds `{ destination }`.
    pub fn add_destination(&mut self, value: &[u8]) -> Result<()> {
        let value = Value::from_bytes(value)?;
        Ok(self.predictor.add_value(&Node::root(&value, ""))?)
    }

    /// Replaces `{ id, destination }`.
    pub fn update_destination(&mut self, value: &[u8]) -> Result<()> {
        let value = Value::from_bytes(value)?;
        Ok(self.predictor.update_value(&Node::root(&value, ""))?)
    }

    /// Removes `{ id }`.
    pub fn remove_destination(&mut self, value: &[u8]) -> Result<()> {
        let value = Value::from_bytes(value)?;
        let node = Node::root(&value, "");
        Ok(self.predictor.remove_destination(node.fields(&["id"])?.required("id")?.text()?)?)
    }

    /// Sets all `{ destinations }`.
    pub fn set_destinations(&mut self, value: &[u8]) -> Result<()> {
        let value = Value::from_bytes(value)?;
        Ok(self.predictor.set_value(&Node::root(&value, ""))?)
    }

    /// Begins a new movement.
    pub fn reset(&mut self) {
        self.predictor.reset();
    }

    /// The address of what was learnt of the user, seven numbers.
    pub fn learnt(&mut self) -> *const f64 {
        self.learnt_numbers = self.predictor.learnt().numbers();
        self.learnt_numbers.as_ptr()
    }

    /// Goes on with what JavaScript has checked and wrote where [`Engine::learnt`] points to.
    pub fn apply_learnt(&mut self) {
        self.predictor.apply_learnt(Learnt::of(self.learnt_numbers));
    }

    /// Counts `{ id }` as chosen.
    pub fn chosen(&mut self, value: &[u8]) -> Result<()> {
        let value = Value::from_bytes(value)?;
        let node = Node::root(&value, "");
        Ok(self.predictor.chosen(node.fields(&["id"])?.required("id")?.text()?)?)
    }
}
