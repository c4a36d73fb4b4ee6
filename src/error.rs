//! The one error type: what is wrong, where, and what would be legal.

use std::fmt;

/// What kind of thing is wrong. The strings of [`Code::as_str`] are part of the interface.
///
/// ```
/// use whither::{Code, Motion, Observation, Scenario};
/// let error = Scenario::builder(Motion::brownian(7, 1.0), Observation::deviation(1.0)).build().unwrap_err();
/// assert_eq!((error.code(), error.path()), (Code::OutOfRange, "motion.dimensions"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Code {
    /// An object has a key that nothing reads.
    UnknownKey,
    /// A key that has no default is absent.
    MissingKey,
    /// A value is not of the type that is read there.
    WrongType,
    /// A list or matrix has not the length that is read there.
    WrongLength,
    /// A number is NaN or infinite.
    NotFinite,
    /// A number or word is outside what is legal.
    OutOfRange,
    /// A covariance is not symmetric positive definite.
    NotPositiveDefinite,
    /// Two destinations have the same id.
    DuplicateId,
    /// No destination has this id.
    UnknownId,
    /// A scenario needs at least one destination.
    NoDestinations,
    /// A time lies before the last observation's.
    TimeNotIncreasing,
    /// The method accumulates evidence for each destination, so it cannot do this in mid-movement.
    MethodAccumulates,
    /// More than the stated limit.
    TooLarge,
    /// A snapshot is damaged or from another version.
    BadSnapshot,
    /// The object was freed.
    Freed,
    /// `init` has not run.
    NotInitialised,
    /// WebAssembly cannot be loaded here.
    WasmUnavailable,
}

impl Code {
    /// The code as it is spelt in JavaScript and in messages.
    ///
    /// ```
    /// assert_eq!(whither::Code::UnknownKey.as_str(), "unknown-key");
    /// ```
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::UnknownKey => "unknown-key",
            Self::MissingKey => "missing-key",
            Self::WrongType => "wrong-type",
            Self::WrongLength => "wrong-length",
            Self::NotFinite => "not-finite",
            Self::OutOfRange => "out-of-range",
            Self::NotPositiveDefinite => "not-positive-definite",
            Self::DuplicateId => "duplicate-id",
            Self::UnknownId => "unknown-id",
            Self::NoDestinations => "no-destinations",
            Self::TimeNotIncreasing => "time-not-increasing",
            Self::MethodAccumulates => "method-accumulates",
            Self::TooLarge => "too-large",
            Self::BadSnapshot => "bad-snapshot",
            Self::Freed => "freed",
            Self::NotInitialised => "not-initialised",
            Self::WasmUnavailable => "wasm-unavailable",
        }
    }
}

/// An error: a [`Code`], the path of the field (`destinations[3].covariance`), and a message that quotes the
/// value and names what is legal.
///
/// ```
/// use whither::{Arrival, Code, Destination, Error, Motion, Observation, Scenario};
/// let scenario = Scenario::builder(Motion::brownian(1, 1.0), Observation::deviation(1.0))
///     .arrival(Arrival::uniform(1.0, 5.0))
///     .none(2.0)
///     .destination(Destination::new("there", [9.0]).size(1.0));
/// let error: Error = scenario.build().unwrap_err();
/// assert_eq!((error.code(), error.path()), (Code::OutOfRange, "none"));
/// assert_eq!(error.to_string(), "none: must be at least 0 and less than 1, got 2");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    // one pointer, so that every result that may be an error is small, and so is the code that hands it on
    what: Box<What>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct What {
    code: Code,
    path: String,
    message: String,
}

/// What everything here that can fail returns.
///
/// ```
/// use whither::{Motion, Observation, Result, Scenario};
/// fn built() -> Result<Scenario> {
///     Scenario::builder(Motion::brownian(1, 1.0), Observation::deviation(-1.0)).build()
/// }
/// assert_eq!(built().unwrap_err().path(), "observation.noise");
/// ```
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// An error about the field at `path`.
    #[must_use]
    pub(crate) fn new(code: Code, path: impl Into<String>, message: impl Into<String>) -> Self {
        Self { what: Box::new(What { code, path: path.into(), message: message.into() }) }
    }

    /// What kind of thing is wrong.
    #[must_use]
    pub fn code(&self) -> Code {
        self.what.code
    }

    /// The field, such as `destinations[3].covariance`; empty where the error is about no field.
    #[must_use]
    pub fn path(&self) -> &str {
        &self.what.path
    }

    /// The value and what is legal, without the path.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.what.message
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let What { path, message, .. } = self.what.as_ref();
        if path.is_empty() { f.write_str(message) } else { write!(f, "{path}: {message}") }
    }
}

impl std::error::Error for Error {}
