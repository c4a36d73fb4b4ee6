//! Track files, one JSON object a line, read in batches so that a file of any length takes the same memory.

use crate::recorded::Recorded;
use presentation::progress;
use rayon::prelude::*;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::ops::ControlFlow;
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
    /// What was recorded, with `margin` added to the size of every box, or what is wrong with the line.
    pub fn recorded(&self, margin: f64) -> Result<Recorded, String> {
        let value = serde_json::from_slice(&self.text).map_err(|error| error.to_string())?;
        Recorded::read(&value, margin)
    }

    /// The same for what knows boxes alone.
    pub fn track(&self, margin: f64) -> Result<Track, String> {
        self.recorded(margin)?.boxes().cloned()
    }

    /// What is wrong with it, and where.
    fn broken(&self, path: &Path, message: &str) -> String {
        format!("{}:{}: {message}", path.display(), self.number)
    }
}

/// Broken lines: one of each kind, and how many there are of it.
#[derive(Default)]
struct Faults {
    kinds: Vec<Fault>,
    lines: usize,
}

struct Fault {
    kind: String,
    first: String,
    lines: usize,
}

impl Faults {
    /// How many kinds are reported; a file that is not one of tracks has as many as lines.
    const REPORTED: usize = 20;

    /// Counts a line, which is reported as `first` where its `message` is the first of its kind: numbers and what is in quotation marks
    /// or brackets differ within a kind.
    fn add(&mut self, message: &str, first: impl FnOnce() -> String) {
        self.lines += 1;
        let kind = kind(message);
        if let Some(fault) = self.kinds.iter_mut().find(|fault| fault.kind == kind) {
            fault.lines += 1;
        } else if self.kinds.len() < Self::REPORTED {
            self.kinds.push(Fault { kind, first: first(), lines: 1 });
        }
    }

    /// The reported lines, in the order of the file.
    fn report(&self) -> Vec<String> {
        let more = |lines: usize, what: &str| match lines {
            0 => String::new(),
            1 => format!("; 1 more line {what}"),
            n => format!("; {n} more lines {what}"),
        };
        let mut report: Vec<_> =
            self.kinds.iter().map(|f| format!("{}; skipped{}", f.first, more(f.lines - 1, "like it"))).collect();
        let others = self.lines - self.kinds.iter().map(|fault| fault.lines).sum::<usize>();
        if let Some(last) = report.last_mut() {
            last.push_str(&more(others, "of other kinds"));
        }
        report
    }
}

/// A message without its numbers and values.
fn kind(message: &str) -> String {
    let mut kind = String::new();
    let mut quoted = false;
    for character in message.split(", got ").next().unwrap_or_default().chars() {
        quoted ^= character == '"';
        let digit = character.is_ascii_digit();
        if !(quoted && character != '"' || digit && kind.ends_with('0')) {
            kind.push(if digit { '0' } else { character });
        }
    }
    kind
}

/// Does `work` for every line in parallel, with a progress bar, and passes the result to `take`, in the order of the file.
/// A line for which `work` fails is skipped, and reported once for all of its kind; returns how many there were.
pub fn each<T: Send>(
    path: &Path,
    work: impl Fn(&Line) -> Result<Option<T>, String> + Sync,
    mut take: impl FnMut(T),
) -> Result<usize, String> {
    let size = std::fs::metadata(path).map_err(|error| format!("{}: {error}", path.display()))?.len();
    let bar = progress(size, name(path));
    let mut faults = Faults::default();
    in_batches(path, |lines, bytes| {
        let done: Vec<_> = lines
            .par_iter()
            .map(|line| {
                let done = work(line);
                bar.inc(line.text.len() as u64);
                done
            })
            .collect();
        for (line, done) in lines.iter().zip(done) {
            match done {
                Ok(Some(done)) => take(done),
                Ok(None) => {}
                Err(message) => faults.add(&message, || line.broken(path, &message)),
            }
        }
        bar.set_position(bytes);
        Ok(ControlFlow::Continue(()))
    })?;
    bar.finish_and_clear();
    faults.report().iter().for_each(|line| eprintln!("{line}"));
    Ok(faults.lines)
}

/// What the tables call a file.
pub fn name(path: &Path) -> String {
    path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}

/// The dimensions of the first track of a file; broken lines are left for later.
pub fn dimensions(path: &Path) -> Result<Option<usize>, String> {
    let mut found = None;
    in_batches(path, |lines, _| {
        let track = lines.iter().find_map(|line| line.recorded(0.0).ok());
        found = track.map(|track| track.dimensions());
        Ok(if found.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    })?;
    Ok(found)
}

/// The most targets that any track of a file has.
pub fn most_targets(path: &Path) -> Result<usize, String> {
    let mut most = 0;
    in_batches(path, |lines, _| {
        let targets = |line: &Line| line.recorded(0.0).map_or(0, |track| track.targets.len());
        most = most.max(lines.par_iter().map(targets).max().unwrap_or(0));
        Ok(ControlFlow::Continue(()))
    })?;
    Ok(most)
}

/// Reads a file batch by batch until `take` breaks, which gets the lines and the bytes read so far.
fn in_batches(
    path: &Path,
    mut take: impl FnMut(&[Line], u64) -> Result<ControlFlow<()>, String>,
) -> Result<(), String> {
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
            if take(&batch, bytes)?.is_break() {
                return Ok(());
            }
            batch.clear();
        }
        if read == 0 {
            return Ok(());
        }
    }
}

/// The set that a track belongs to within its file: ids that end in `-in` or `-out` are kept apart.
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

    /// What is reported for one line among good ones; the lines before and after it are read.
    fn fault(what: &str, line: &str) -> String {
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
            Ok(ControlFlow::Continue(()))
        })
        .unwrap();
        assert_eq!(each(&path, |line| line.track(0.0).map(Some), |_| ()), Ok(1), "one is skipped");
        std::fs::remove_file(path).unwrap();
        assert_eq!((good, found.len()), (2, 1), "{found:?}");
        found.remove(0)
    }

    #[test]
    fn a_wrong_field_is_reported_with_its_file_and_line() {
        let line = r#"{"targets": [[0, 0, 2, 2]], "target": 0, "sample": [[0, 9, 9]]}"#;
        let expected = "tracks.jsonl:3: sample: unknown key \"sample\", expected one of \"id\", \"user\", \"targets\", \"target\", \"samples\"";
        assert_eq!(fault("field", line), expected);
        let line = r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, 9, "9"]]}"#;
        assert_eq!(fault("type", line), "tracks.jsonl:3: samples[0][2]: must be a number, got \"9\"");
    }

    #[test]
    fn a_missing_target_is_reported_with_its_file_and_line() {
        let line = r#"{"targets": [[0, 0, 2, 2]], "target": 1, "samples": [[0, 9, 9]]}"#;
        let expected = "tracks.jsonl:3: target: must be the place of one of the 1 targets, counted from 0, got 1";
        assert_eq!(fault("index", line), expected);
        assert_eq!(fault("negative", &line.replace("1,", "-1,")), expected.replace("got 1", "got -1"));
    }

    #[test]
    fn time_that_runs_back_is_reported_with_its_file_and_line() {
        let line = r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": [[0, 9, 9], [2, 8, 8], [1, 0, 0]]}"#;
        assert_eq!(
            fault("time", line),
            "tracks.jsonl:3: samples[2]: must not be before the sample at 2, got [1, 0, 0]"
        );
    }

    #[test]
    fn an_empty_list_is_reported_with_its_file_and_line() {
        let line = r#"{"targets": [], "target": 0, "samples": [[0, 9, 9]]}"#;
        assert_eq!(fault("targets", line), "tracks.jsonl:3: targets: must have at least one target, got []");
        let line = r#"{"targets": [[0, 0, 2, 2]], "target": 0, "samples": []}"#;
        assert_eq!(fault("samples", line), "tracks.jsonl:3: samples: must have at least one sample, got []");
    }

    /// What is reported for messages, one a line.
    fn all_reported(messages: &[&str]) -> Vec<String> {
        let mut faults = Faults::default();
        for (i, message) in messages.iter().enumerate() {
            faults.add(message, || format!("{}: {message}", i + 1));
        }
        assert_eq!(faults.lines, messages.len());
        faults.report()
    }

    #[test]
    fn one_fault_in_every_line_is_reported_once_with_its_count() {
        let many: Vec<String> = (0..240)
            .map(|k| format!("samples[{k}][{}]: must be a number, got \"{}\"", k % 3, "x".repeat(k % 7)))
            .collect();
        let reported = all_reported(&many.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(reported, ["1: samples[0][0]: must be a number, got \"\"; skipped; 239 more lines like it"]);
    }

    #[test]
    fn faults_of_different_kinds_are_reported_each() {
        let [one, two, three] =
            ["user: must be a string, got true", "target: must be a number, got [0, 1]", "EOF at line 1 column 40"];
        let reported = all_reported(&[one, two, one, three, "EOF at line 1 column 7", one]);
        let expected = [
            format!("1: {one}; skipped; 2 more lines like it"),
            format!("2: {two}; skipped"),
            format!("4: {three}; skipped; 1 more line like it"),
        ];
        assert_eq!(reported, expected);
        // a file of anything
        let any: Vec<String> = (0..100).map(|k| format!("key{}: unknown", "a".repeat(k))).collect();
        let reported = all_reported(&any.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(reported.len(), Faults::REPORTED);
        assert!(reported[Faults::REPORTED - 1].ends_with("; skipped; 80 more lines of other kinds"), "{reported:?}");
    }

    #[test]
    fn names_may_be_numbers_and_coordinates_missing() {
        let path = file(
            "missing",
            &[&GOOD.replace("[0, 9, 9]", "[0, 9, null], [0.5, null, 7]").replace("{", "{\"id\": 3, \"user\": 14, ")],
        );
        let mut tracks = Vec::new();
        assert_eq!(each(&path, |line| line.track(0.0).map(Some), |track| tracks.push(track)), Ok(0));
        std::fs::remove_file(path).unwrap();
        assert_eq!((tracks[0].id.as_str(), tracks[0].user.as_str(), tracks[0].approach()), ("3", "14", Some(3)));
    }

    #[test]
    fn a_line_that_is_no_json_is_reported_with_its_file_and_line() {
        assert!(fault("cut", &GOOD[..40]).starts_with("tracks.jsonl:3: EOF while parsing"));
    }

    #[test]
    fn the_results_keep_the_order_of_the_lines_over_batches() {
        let path = file("order", &vec![GOOD; 3 * BATCH + 7]);
        let mut numbers = Vec::new();
        assert_eq!(each(&path, |line| Ok(Some(line.number)), |number| numbers.push(number)), Ok(0));
        std::fs::remove_file(path).unwrap();
        assert_eq!(numbers, (1..=3 * BATCH + 7).collect::<Vec<_>>());
        let missing = each(Path::new("no/such/file"), |line| Ok(Some(line.number)), |_| ()).unwrap_err();
        assert!(missing.starts_with("no/such/file: "), "{missing}");
    }
}
