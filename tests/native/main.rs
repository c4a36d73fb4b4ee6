//! Tests of the whole library, natively: golden cases, identities, errors, the life of a predictor.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod documentation;
mod errors;
mod golden;
mod habits;
mod identities;
mod life;
mod numerics;
mod pointing;
mod sequences;
mod support;
mod telescoped;
