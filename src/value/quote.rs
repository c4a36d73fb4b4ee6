//! How error messages quote texts and numbers.

/// A text in quotation marks, cut where it is long.
#[must_use]
pub fn quote(text: &str) -> String {
    let cut: String = text.chars().take(40).collect();
    let more = if cut.len() < text.len() { "..." } else { "" };
    format!("\"{cut}{more}\"")
}

/// A number as JavaScript prints it.
#[cfg(all(any(feature = "wasm", feature = "wasm-fit"), target_arch = "wasm32"))]
#[must_use]
pub fn number(x: f64) -> String {
    // JavaScript has this already; in Rust the printing of floating-point numbers is 8 kB under gzip
    crate::wasm::number(x)
}

/// A number as JavaScript would print it, nearly.
#[cfg(not(all(any(feature = "wasm", feature = "wasm-fit"), target_arch = "wasm32")))]
#[must_use]
pub fn number(x: f64) -> String {
    if x.is_nan() {
        "NaN".to_owned()
    } else if x.is_infinite() {
        (if x > 0.0 { "Infinity" } else { "-Infinity" }).to_owned()
    } else if x != 0.0 && (x.abs() < 1e-6 || x.abs() >= 1e21) {
        format!("{x:e}")
    } else {
        format!("{x}")
    }
}
