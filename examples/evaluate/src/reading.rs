//! Track files, one JSON object a line, read in batches so that a file of any length takes the same memory.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;
use whither::study::track::Track;

/// Lines that are scored at once.
const BATCH: usize = 256;

/// Lines longer than this are broken: no track has so many samples.
const LONGEST_LINE: u64 = 1 << 28;

/// One line: its number, counted from 1, and its text.
pub struct Line {
    pub number: usize,
    text: Vec<u8>,
}

impl Line {
    /// The track, or what is wrong with the line.
    pub fn track(&self) -> Result<Track, String> {
        serde_json::from_slice(&self.text).map_err(|error| error.to_string())
    }
}

/// Reads a file batch by batch; `take` gets the lines and the bytes read so far.
pub fn in_batches(path: &Path, mut take: impl FnMut(&[Line], u64) -> Result<(), String>) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("{}: {error}", path.display());
    let mut reader = BufReader::new(File::open(path).map_err(failed)?);
    let (mut batch, mut number, mut bytes) = (Vec::with_capacity(BATCH), 0, 0);
    loop {
        let mut text = Vec::new();
        let read = std::io::Read::take(&mut reader, LONGEST_LINE).read_until(b'\n', &mut text).map_err(failed)?;
        number += 1;
        bytes += read as u64;
        if text.iter().any(|byte| !byte.is_ascii_whitespace()) {
            batch.push(Line { number, text });
        }
        if batch.len() == BATCH || read == 0 {
            take(&batch, bytes)?;
            batch.clear();
        }
        if read == 0 {
            return Ok(());
        }
    }
}

/// The set that a track belongs to within its file: ids that end in `-in` or `-out` are told apart.
pub fn part(track: &Track) -> &'static str {
    match track.id.rsplit('-').next() {
        Some("in") => " in",
        Some("out") => " out",
        _ => "",
    }
}
