//! What `evaluate` and `reproduce` print and draw with: Markdown tables, line charts as SVG, progress bars, files.
#![forbid(unsafe_code)]

mod chart;

pub use chart::{COLOURS, Corner, Panel, Series, Stroke, chart};
pub use comfy_table::Table;
pub use indicatif::ProgressBar;
pub use plotters::style::RGBColor;

use comfy_table::{CellAlignment, Row, presets};
use indicatif::ProgressStyle;
use std::path::Path;

/// A table in Markdown, its first `texts` columns aligned left and the others right.
pub fn table(header: impl Into<Row>, texts: usize) -> Table {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header(header);
    for column in table.column_iter_mut().skip(texts) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// A progress bar of this length.
pub fn progress(length: u64, message: String) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg} {wide_bar} {percent}% {eta}");
    ProgressBar::new(length).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())).with_message(message)
}

/// Writes a file, and the folders that it lies in; an error names the path.
pub fn write(path: &Path, text: &str) -> Result<(), String> {
    let folder = path.parent().unwrap_or(Path::new(""));
    std::fs::create_dir_all(folder)
        .and_then(|()| std::fs::write(path, text))
        .map_err(|error| format!("{}: {error}", path.display()))
}
