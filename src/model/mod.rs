//! What moves, what is seen, where it may end and when: the parts of the state-space model.

pub mod arrival;
pub mod bridge;
pub mod destination;
pub mod endpoint;
pub mod habits;
pub mod initial;
pub mod motion;
pub mod observation;
