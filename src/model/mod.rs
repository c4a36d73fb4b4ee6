//! What moves, what is observed, where it may go and when: the parts of the state-space model.

pub mod arrival;
pub mod bridge;
pub mod destination;
pub mod endpoint;
pub mod habits;
pub mod initial;
pub(crate) mod learnt;
pub mod matrix;
pub mod motion;
pub mod observation;
pub mod per_axis;
