//! The commands of docs/comparing.md, run as they are there, print what is printed there.
#![allow(clippy::unwrap_used)]

use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;

/// How far numbers may differ, as a share of them or absolutely: platforms differ in the last digits of logarithms.
const ROUNDING: f64 = 1e-9;

/// A folder with an `npm` whose `run evaluate --` is the program that was built for this test.
fn folder() -> PathBuf {
    let folder = std::env::temp_dir().join(format!("whither-comparing-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("target")).unwrap();
    std::fs::create_dir_all(folder.join("bin")).unwrap();
    let program = env!("CARGO_BIN_EXE_evaluate");
    let npm = folder.join("bin/npm");
    std::fs::write(
        &npm,
        format!("#!/bin/sh\ntest \"$1 $2 $3\" = \"run evaluate --\" && shift 3 && exec '{program}' \"$@\"\n"),
    )
    .unwrap();
    std::fs::set_permissions(&npm, std::fs::Permissions::from_mode(0o755)).unwrap();
    folder
}

/// Each block of commands and the block of output after it.
fn commands(document: &str) -> Vec<(&str, &str)> {
    let blocks: Vec<(&str, &str)> =
        document.split("\n```").skip(1).step_by(2).map(|block| block.split_once('\n').unwrap_or((block, ""))).collect();
    blocks.windows(2).filter(|pair| pair[0].0 == "bash").map(|pair| (pair[0].1, pair[1].1)).collect()
}

fn run(folder: &Path, commands: &str) -> String {
    let path = format!("{}:{}", folder.join("bin").display(), std::env::var("PATH").unwrap());
    let output =
        Command::new("bash").args(["-e", "-c", commands]).current_dir(folder).env("PATH", path).output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && errors.is_empty(), "{commands}\n{errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Whether two words are the same, or numbers that are nearly.
fn same(found: &str, expected: &str) -> bool {
    let numbers = found.parse::<f64>().ok().zip(expected.parse::<f64>().ok());
    found == expected || numbers.is_some_and(|(a, b)| (a - b).abs() <= ROUNDING * b.abs().max(1.0))
}

#[test]
fn the_commands_of_the_document_print_what_is_printed_there() {
    let document = include_str!("../../../docs/comparing.md");
    let folder = folder();
    let commands = commands(document);
    assert!(commands.len() >= 7, "{} blocks of commands", commands.len());
    for (command, expected) in commands {
        let found = run(&folder, command);
        let words = |text: &str| -> Vec<String> {
            text.trim()
                .lines()
                .flat_map(|line| [line, "\n"])
                .flat_map(|line| line.split([' ', ',']))
                .map(str::to_owned)
                .collect()
        };
        let (found_words, expected_words) = (words(&found), words(expected));
        let equal = found_words.len() == expected_words.len()
            && found_words.iter().zip(&expected_words).all(|(a, b)| same(a, b));
        assert!(equal, "docs/comparing.md: after\n{command}\nhas to be\n{found}");
    }
    std::fs::remove_dir_all(folder).unwrap();
}
