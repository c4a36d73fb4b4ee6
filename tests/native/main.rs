//! Tests of the library through its public interface, natively: golden cases, identities, errors, the life of a predictor.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::type_complexity)]

mod batch;
mod blocks;
mod calibration;
mod devices;
mod documentation;
mod errata;
mod errors;
mod first_observation;
mod fuzz;
mod golden;
mod habits;
mod identities;
mod imports;
mod life;
mod movements;
mod numerics;
mod outcomes;
mod pointing;
mod pointing_times;
mod problem;
mod sequences;
mod shake;
mod states;
mod support;
mod typed;
