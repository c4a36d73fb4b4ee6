//! Recorded movements, and how well a predictor does on them.
//!
//! ```
//! use whither::study::{metrics::Score, track::Track};
//! use whither::{PointerOptions, PointerTarget, pointer_scenario};
//! let track: Track = serde_json::from_str(r#"{
//!     "id": "example", "user": "ann", "target": 1,
//!     "targets": [[100, 100, 40, 40], [500, 100, 40, 40]],
//!     "samples": [[0, 300, 100], [0.1, 320, 100], [0.2, 380, 100], [0.3, 450, 100], [0.4, 490, 100]]
//! }"#).unwrap();
//! let approach = track.approach().unwrap(); // up to the entry into the target
//! let any = PointerTarget { id: "any".to_owned(), x: 0.0, y: 0.0, width: 1.0, height: 1.0 };
//! let scenario = track.scenario(&pointer_scenario(&[any], PointerOptions::default()).unwrap()).unwrap();
//! let score = Score::of_scenario(&track, approach, &scenario).unwrap();
//! assert!(score.time > 0.5);
//! ```

#[cfg(feature = "fit")]
pub mod fit;
pub mod metrics;
pub mod simulate;
pub mod track;
