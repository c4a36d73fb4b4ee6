//! What stands on `whither/dom`, which runs in Node: `intents/intents.mjs` and `menus/menus.mjs` replay the tracks and print.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Replays the tracks of `files` by a program of this folder, with those of its flags that are given.
pub fn run(program: &str, files: &[PathBuf], json: &Path, flags: &[(&str, bool)]) -> Result<(), String> {
    let status = Command::new("node")
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join(program))
        .args(flags.iter().filter(|(_, given)| *given).map(|(flag, _)| flag))
        .arg("--json")
        .arg(json)
        .arg("--")
        .args(files)
        .status()
        .map_err(|error| format!("node does not start: {error}"))?;
    if status.success() { Ok(()) } else { Err("nothing was measured, see above".to_owned()) }
}
