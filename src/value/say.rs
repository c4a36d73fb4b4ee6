//! Texts put together from parts. `format!` brings along all that can be asked of a number or a text (width, sign, padding),
//! 2 kB of the WebAssembly under gzip.

use super::number;

/// What can be a part of a text.
pub trait Part {
    /// Appends it.
    fn say(&self, text: &mut String);
}

impl Part for str {
    fn say(&self, text: &mut String) {
        text.push_str(self);
    }
}

impl Part for String {
    fn say(&self, text: &mut String) {
        text.push_str(self);
    }
}

impl Part for usize {
    fn say(&self, text: &mut String) {
        text.push_str(&number(*self as f64));
    }
}

impl Part for u64 {
    fn say(&self, text: &mut String) {
        text.push_str(&number(*self as f64));
    }
}

impl<P: Part + ?Sized> Part for &P {
    fn say(&self, text: &mut String) {
        (**self).say(text);
    }
}

/// The parts one after the other, as a `String`.
macro_rules! say {
    ($($part:expr),+ $(,)?) => {{
        let mut text = String::new();
        $($crate::value::Part::say(&$part, &mut text);)+
        text
    }};
}
pub(crate) use say;
