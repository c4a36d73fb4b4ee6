//! Programs of this folder that run in Node: a line of JSON in, a line of JSON out.

use serde_json::Value as Json;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::Mutex;

/// Processes of one program, as many as are asked at a time.
#[derive(Debug)]
pub struct Node {
    program: &'static str,
    idle: Mutex<Vec<Process>>,
}

#[derive(Debug)]
struct Process {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl Node {
    /// Of a program of this folder.
    pub fn new(program: &'static str) -> Self {
        Self { program, idle: Mutex::default() }
    }

    /// What the program answers; an error where its process has ended.
    pub fn ask(&self, question: &Json) -> Result<Json, String> {
        let idle = self.idle.lock().map_err(|error| error.to_string())?.pop();
        let mut process = idle.map_or_else(|| Process::spawn(self.program), Ok)?;
        let answer = process.ask(question)?;
        self.idle.lock().map_err(|error| error.to_string())?.push(process);
        Ok(answer)
    }
}

impl Process {
    fn spawn(program: &str) -> Result<Self, String> {
        let mut child = Command::new("node")
            .arg(format!("{}/{program}", env!("CARGO_MANIFEST_DIR")))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| format!("node does not start: {error}"))?;
        let input = child.stdin.take().ok_or("no standard input")?;
        let output = BufReader::new(child.stdout.take().ok_or("no standard output")?);
        Ok(Self { child, input, output })
    }

    fn ask(&mut self, question: &Json) -> Result<Json, String> {
        let ended = |error: std::io::Error| format!("its process ended ({error})");
        writeln!(self.input, "{question}").map_err(ended)?;
        let mut answer = String::new();
        self.output.read_line(&mut answer).map_err(ended)?;
        serde_json::from_str(&answer).map_err(|_| "its process gave no answer".to_owned())
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // Its standard input closes with this; what is left is to collect it.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
