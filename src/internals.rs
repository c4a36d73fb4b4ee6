//! What the tools and tests of this repository use of the inside. It is no part of the interface and changes with any release.

use crate::conditionally_markov::{ConditionallyMarkovSequence, GivenSequence, SequenceParameters};
use crate::error::Result;
use crate::value::{Node, Value};

/// A sequence from the data that JavaScript's constructor takes.
///
/// # Errors
/// Those of reading and of [`ConditionallyMarkovSequence::new`].
pub fn sequence(value: &Value) -> Result<ConditionallyMarkovSequence> {
    ConditionallyMarkovSequence::new(&SequenceParameters::read(&Node::root(value, ""))?)
}

/// A sequence from the data that JavaScript's `fromParameters` takes.
///
/// # Errors
/// Those of reading and of [`ConditionallyMarkovSequence::from_parameters`].
pub fn given_sequence(value: &Value) -> Result<ConditionallyMarkovSequence> {
    ConditionallyMarkovSequence::from_parameters(&GivenSequence::read(&Node::root(value, ""))?)
}
