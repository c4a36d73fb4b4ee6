//! Whither ("to which place") predicts where a moving thing is heading while it is still on its way.
#![forbid(unsafe_code)]

pub mod error;
pub mod likelihood;
pub mod math;
pub mod model;
pub mod pointer;
pub mod posterior;
pub mod predictor;
pub mod scenario;
pub mod snapshot;
pub mod value;

pub use error::{Code, Error, Result};
pub use math::gaussian::Gaussian;
pub use model::destination::Destination;
pub use posterior::arrival_time::Arrival;
pub use predictor::{Best, Predictor, Remaining};
pub use scenario::Scenario;
pub use value::Value;
