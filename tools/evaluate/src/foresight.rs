//! ForesightJS, run through its own package in Node on the same samples.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::Mutex;
use whither::study::track::{Track, distance};

use crate::peers::least;

/// Node processes that are waiting for a track.
#[derive(Debug, Default)]
pub struct Foresight {
    idle: Mutex<Vec<Process>>,
}

#[derive(Debug)]
struct Process {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl Foresight {
    /// Tries it on one track of its own; the reason where it cannot run.
    pub fn start() -> Result<Self, String> {
        let foresight = Self::default();
        let track: Track = serde_json::from_str(r#"{"targets": [[0, 0, 1, 1]], "target": 0, "samples": [[0, 0, 0]]}"#)
            .map_err(|error| error.to_string())?;
        foresight.tops(&track, 1)?;
        Ok(foresight)
    }

    /// The target nearest to the point that the package predicts, after each of the first `length` samples.
    pub fn tops(&self, track: &Track, length: usize) -> Result<Vec<Option<usize>>, String> {
        let idle = self.idle.lock().map_err(|error| error.to_string())?.pop();
        let mut process = idle.map_or_else(Process::spawn, Ok)?;
        let points = process.predict(track, length)?;
        self.idle.lock().map_err(|error| error.to_string())?.push(process);
        Ok(points.iter().map(|point| least(track, |target| distance(&target.center, point))).collect())
    }
}

impl Process {
    fn spawn() -> Result<Self, String> {
        let mut child = Command::new("node")
            .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/foresight.mjs"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| format!("node does not start: {error}"))?;
        let input = child.stdin.take().ok_or("no standard input")?;
        let output = BufReader::new(child.stdout.take().ok_or("no standard output")?);
        Ok(Self { child, input, output })
    }

    fn predict(&mut self, track: &Track, length: usize) -> Result<Vec<[f64; 2]>, String> {
        let samples: Vec<[f64; 3]> =
            track.samples[..length].iter().map(|s| [s.time, s.position[0], s.position[1]]).collect();
        let failed =
            |error: std::io::Error| format!("its process ended ({error}); is js.foresight installed (npm ci)?");
        let line = serde_json::to_string(&samples).map_err(|error| error.to_string())?;
        writeln!(self.input, "{line}").map_err(failed)?;
        let mut answer = String::new();
        self.output.read_line(&mut answer).map_err(failed)?;
        let points: Vec<[f64; 2]> = serde_json::from_str(&answer)
            .map_err(|_| "its process gave no answer; is js.foresight installed (npm ci)?".to_owned())?;
        if points.len() == length { Ok(points) } else { Err("its process gave too few points".to_owned()) }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // Its standard input closes with this; what is left is to collect it.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
