//! The intents of `whither/dom`, which runs in Node: `intents/intents.mjs` replays the tracks and prints.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Replays the tracks of `files`, with those of the program's flags that are given.
pub fn run(files: &[PathBuf], json: &Path, flags: &[(&str, bool)]) -> Result<(), String> {
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
