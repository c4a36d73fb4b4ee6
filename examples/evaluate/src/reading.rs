//! Track files, one JSON object a line, read in batches so that a file of any length takes the same memory.

use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
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
    /// The track with `margin` added to the size of every target, or what is wrong with the line.
    pub fn track(&self, margin: f64) -> Result<Track, String> {
        let mut track: Track = serde_json::from_slice(&self.text).map_err(|error| error.to_string())?;
        track.targets.iter_mut().flat_map(|target| &mut target.size).for_each(|side| *side += margin);
        Ok(track)
    }

    /// What is wrong with it, and where.
    fn broken(&self, path: &Path, message: &str) -> String {
        format!("{}:{}: {message}", path.display(), self.number)
    }
}

/// Does `work` for every line in parallel, with a progress bar, and gives what comes of it to `take`, in the order of the file.
/// A line for which `work` fails is told and skipped; gives how many there were.
pub fn each<T: Send>(
    path: &Path,
    work: impl Fn(&Line) -> Result<Option<T>, String> + Sync,
    mut take: impl FnMut(T),
) -> Result<usize, String> {
    let size = std::fs::metadata(path).map_err(|error| format!("{}: {error}", path.display()))?.len();
    let style = ProgressStyle::with_template("{msg} {wide_bar} {percent}% {eta}").map_err(|error| error.to_string())?;
    let bar = ProgressBar::new(size).with_style(style).with_message(name(path));
    let mut skipped = 0;
    in_batches(path, |lines, bytes| {
        let done: Vec<_> = lines.par_iter().map(&work).collect();
        for (line, done) in lines.iter().zip(done) {
            match done {
                Ok(Some(done)) => take(done),
                Ok(None) => {}
                Err(message) => {
                    skipped += 1;
                    bar.suspend(|| eprintln!("{}; skipped", line.broken(path, &message)));
                }
            }
        }
        bar.set_position(bytes);
        Ok(())
    })?;
    bar.finish_and_clear();
    Ok(skipped)
}

/// What the tables call a file.
pub fn name(path: &Path) -> String {
    path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}

/// Reads a file batch by batch; `take` gets the lines and the bytes read so far.
fn in_batches(path: &Path, mut take: impl FnMut(&[Line], u64) -> Result<(), String>) -> Result<(), String> {
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    fn file(name: &str, lines: &[&str]) -> PathBuf {
        let path = std::env::temp_dir().join(format!("whither-{}-{name}.jsonl", std::process::id()));
        std::fs::write(&path, lines.join("\n")).unwrap();
        path
    }

    const GOOD: &str = r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, 9, 9], [1, 0, 0]]}"#;

    /// What is told of one line among good ones; the lines before and after it are read.
    fn told(what: &str, line: &str) -> String {
        let path = file(what, &[GOOD, "", line, GOOD]);
        let mut found = Vec::new();
        let mut good = 0;
        in_batches(&path, |lines, _| {
            for line in lines {
                match line.track(0.0) {
                    Ok(_) => good += 1,
                    Err(message) => found.push(line.broken(Path::new("tracks.jsonl"), &message)),
                }
            }
            Ok(())
        })
        .unwrap();
        assert_eq!(each(&path, |line| line.track(0.0).map(Some), |_| ()), Ok(1), "one is skipped");
        std::fs::remove_file(path).unwrap();
        assert_eq!((good, found.len()), (2, 1), "{found:?}");
        found.remove(0)
    }

    #[test]
    fn a_wrong_field_is_told_with_its_file_and_line() {
        let line = r#"{"targets": [[0, 0, 2, 2]], "target": 0, "sample": [[0, 9, 9]]}"#;
        let expected = "tracks.jsonl:3: sample: unknown key \"sample\", expected one of \"id\", \"user\", \"targets\", \"target\", \"samples\"";
        assert_eq!(told("field", line), expected);
        let line = r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, 9, "9"]]}"#;
        assert_eq!(told("type", line), "tracks.jsonl:3: samples[0][2]: must be a number, got \"9\"");
    }

    #[test]
    fn a_target_that_is_not_there_is_told_with_its_file_and_line() {
        let line = r#"{"targets": [[0, 0, 2, 2]], "target": 1, "samples": [[0, 9, 9]]}"#;
        let expected = "tracks.jsonl:3: target: must be the place of one of the 1 targets, counted from 0, got 1";
        assert_eq!(told("index", line), expected);
        assert_eq!(told("negative", &line.replace("1,", "-1,")), expected.replace("got 1", "got -1"));
    }

    #[test]
    fn time_that_runs_back_is_told_with_its_file_and_line() {
        let line = r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, 9, 9], [2, 8, 8], [1, 0, 0]]}"#;
        assert_eq!(told("time", line), "tracks.jsonl:3: samples[2]: must not be before the sample at 2, got [1, 0, 0]");
    }

    #[test]
    fn an_empty_list_is_told_with_its_file_and_line() {
        let line = r#"{"targets": [], "target": 0, "samples": [[0, 9, 9]]}"#;
        assert_eq!(told("targets", line), "tracks.jsonl:3: targets: must have at least one target, got []");
        let line = r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": []}"#;
        assert_eq!(told("samples", line), "tracks.jsonl:3: samples: must have at least one sample, got []");
    }

    #[test]
    fn a_line_that_is_no_json_is_told_with_its_file_and_line() {
        assert!(told("cut", &GOOD[..40]).starts_with("tracks.jsonl:3: EOF while parsing"));
    }

    #[test]
    fn what_comes_of_the_lines_keeps_their_order_over_batches() {
        let path = file("order", &vec![GOOD; 3 * BATCH + 7]);
        let mut numbers = Vec::new();
        assert_eq!(each(&path, |line| Ok(Some(line.number)), |number| numbers.push(number)), Ok(0));
        std::fs::remove_file(path).unwrap();
        assert_eq!(numbers, (1..=3 * BATCH + 7).collect::<Vec<_>>());
        let missing = each(Path::new("no/such/file"), |line| Ok(Some(line.number)), |_| ()).unwrap_err();
        assert!(missing.starts_with("no/such/file: "), "{missing}");
    }
}
