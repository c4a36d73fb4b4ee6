//! Bindings behind `js/core/sequence.ts`.

use super::{Result, flat};
use crate::conditionally_markov::{ConditionallyMarkovSequence, DEFAULT_TOLERANCE};
use crate::error::Code;
use crate::internals;
use crate::value::{Node, Value};
use nalgebra::DMatrix;
use wasm_bindgen::prelude::wasm_bindgen;

/// What a JavaScript `ConditionallyMarkovSequence` holds.
#[wasm_bindgen]
#[derive(Debug)]
pub struct SequenceEngine {
    sequence: ConditionallyMarkovSequence,
}

#[wasm_bindgen]
impl SequenceEngine {
    /// A sequence induced by a Markov model.
    #[wasm_bindgen(constructor)]
    pub fn new(value: &[u8]) -> Result<SequenceEngine> {
        Ok(Self { sequence: internals::sequence(&Value::from_bytes(value)?)? })
    }

    /// A sequence given matrix by matrix.
    pub fn from_parameters(value: &[u8]) -> Result<SequenceEngine> {
        Ok(Self { sequence: internals::given_sequence(&Value::from_bytes(value)?)? })
    }

    /// The number of components of one state.
    pub fn states(&self) -> usize {
        self.sequence.states()
    }

    /// The number of steps.
    pub fn steps(&self) -> usize {
        self.sequence.steps()
    }

    /// How many numbers the joint density of the pinned states and two more has.
    pub fn size(&self) -> f64 {
        (((self.sequence.pins().len() + 2) * self.states()) as f64).powi(2)
    }

    /// The model of `{ step }`: previous, destination and covariance row by row, and behind them the offset.
    pub fn model(&self, value: &[u8]) -> Result<Vec<f64>> {
        let model = self.sequence.model(self.step(value)?)?;
        let mut flat = Vec::new();
        for matrix in [&model.previous, &model.destination, &model.covariance] {
            flat.extend(DMatrix::transpose(matrix).iter());
        }
        flat.extend(model.offset.iter());
        Ok(flat)
    }

    /// Takes in `{ step, position }`.
    pub fn measure(&mut self, value: &[u8]) -> Result<()> {
        let value = Value::from_bytes(value)?;
        let node = Node::root(&value, "");
        let fields = node.fields(&["step", "position"])?;
        let step = self.integer_step(&fields.required("step")?)?;
        Ok(self.sequence.measure(step, &fields.required("position")?.vector(None)?)?)
    }

    /// The state at `{ step }`.
    pub fn state(&self, value: &[u8]) -> Result<Vec<f64>> {
        Ok(flat(self.sequence.state(self.step(value)?)?))
    }

    /// The state at the end.
    pub fn destination(&self) -> Vec<f64> {
        flat(self.sequence.destination())
    }

    /// Forgets all measurements.
    pub fn reset(&mut self) {
        self.sequence.reset();
    }

    /// `{ seed, count }` sequences, one behind the other.
    pub fn sample(&self, value: &[u8]) -> Result<Vec<f64>> {
        let value = Value::from_bytes(value)?;
        let node = Node::root(&value, "");
        let fields = node.fields(&["seed", "count"])?;
        let seed = fields.required("seed")?.integer(0, u32::MAX as usize)?;
        let count = fields.required("count")?.integer(0, u32::MAX as usize)?;
        Ok(self.sequence.sample(seed as u64, count)?.concat())
    }

    /// Whether it is reciprocal to `{ tolerance? }`.
    pub fn is_reciprocal(&self, value: &[u8]) -> Result<bool> {
        Ok(self.sequence.is_reciprocal(tolerance(value)?)?)
    }

    /// Whether it is Markov to `{ tolerance? }`.
    pub fn is_markov(&self, value: &[u8]) -> Result<bool> {
        Ok(self.sequence.is_markov(tolerance(value)?)?)
    }
}

impl SequenceEngine {
    /// `{ step }`.
    fn step(&self, value: &[u8]) -> crate::Result<usize> {
        let value = Value::from_bytes(value)?;
        let node = Node::root(&value, "");
        self.integer_step(&node.fields(&["step"])?.required("step")?)
    }

    fn integer_step(&self, node: &Node<'_>) -> crate::Result<usize> {
        let (x, last) = (node.number()?, self.sequence.steps());
        if x.fract() == 0.0 && (0.0..=last as f64).contains(&x) {
            return Ok(x as usize);
        }
        Err(node.error(Code::OutOfRange, &format!("must be an integer from 0 to {last}")))
    }
}

fn tolerance(value: &[u8]) -> crate::Result<f64> {
    let value = Value::from_bytes(value)?;
    let node = Node::root(&value, "");
    node.fields(&["tolerance"])?.optional("tolerance").map_or(Ok(DEFAULT_TOLERANCE), |tolerance| tolerance.number())
}
