//! The intents of `whither/dom`, which runs in Node: `intents/intents.mjs` replays the tracks and prints.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Replays the tracks of `files`; with `users` also prints a table by user, with `grid` also reports every combination of the options.
pub fn run(files: &[PathBuf], json: &Path, users: bool, grid: bool) -> Result<(), String> {
    let flags = [("--users", users), ("--grid", grid)];
    let status = Command::new("node")
        .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/intents/intents.mjs"))
        .args(flags.iter().filter(|(_, given)| *given).map(|(flag, _)| flag))
        .arg("--json")
        .arg(json)
        .arg("--")
        .args(files)
        .status()
        .map_err(|error| format!("node does not start: {error}"))?;
    if status.success() { Ok(()) } else { Err("the intents were not measured, see above".to_owned()) }
}
