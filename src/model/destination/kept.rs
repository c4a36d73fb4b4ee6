//! What an engine computes from destinations alone, kept with them.

use std::any::Any;
use std::fmt;
use std::sync::{Arc, OnceLock};

/// Room for one value, of a type that only the engine knows, which is computed where it is first asked for. Destinations do not
/// change, so that it holds as long as they exist; a copy of them, which is made to become others, begins without one.
#[derive(Default)]
pub struct Kept(OnceLock<Arc<dyn Any + Send + Sync>>);

impl Kept {
    /// The value, made by `make` where there is none yet; another one each time where one of another type is kept.
    pub fn get<T: Any + Send + Sync>(&self, make: impl Fn() -> T) -> Arc<T> {
        let kept = self.0.get_or_init(|| Arc::new(make()));
        Arc::clone(kept).downcast().unwrap_or_else(|_| Arc::new(make()))
    }
}

impl Clone for Kept {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl fmt::Debug for Kept {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Kept")
    }
}
