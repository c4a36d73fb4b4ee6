//! The project's own copy of the wasm-bindgen tools, so that Rust and Node are all that a machine needs:
//! `xtask bindgen ARGS` is `wasm-bindgen`, `xtask test-runner ARGS` is `wasm-bindgen-test-runner`, `xtask snip IN OUT`
//! makes a file smaller before the former, `xtask number IN OUT` gives its imports short names, `xtask arrange IN OUT` brings its
//! functions into an order that compresses well, `xtask gzip IN OUT` packs it for good.

mod arrange;
mod imports;
mod snip;
mod unused;

use std::env::args_os;
use std::process::ExitCode;

use wasm_bindgen_cli::{wasm_bindgen, wasm_bindgen_test_runner};

fn main() -> ExitCode {
    let mut arguments = args_os().skip(1).peekable();
    let tool = arguments.peek().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let outcome = match tool.as_str() {
        "bindgen" => wasm_bindgen::run_cli_with_args(arguments),
        "snip" | "number" | "arrange" | "gzip" => {
            match &arguments.map(|path| path.to_string_lossy().into_owned()).collect::<Vec<_>>()[..] {
                [_, from, to] if tool == "snip" => snip::snip(from, to),
                [_, from, to] if tool == "number" => imports::number(from, to),
                [_, from, to] if tool == "arrange" => arrange::arrange(from, to),
                [_, from, to] => gzip(from, to),
                _ => Err(anyhow::anyhow!("{tool} takes two paths: IN and OUT")),
            }
        }
        "test-runner" => wasm_bindgen_test_runner::run_cli_with_args(arguments),
        _ => {
            eprintln!("unknown tool {tool:?}: it is `bindgen`, `snip`, `number`, `arrange`, `gzip` or `test-runner`");
            return ExitCode::FAILURE;
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{tool}: {error:?}");
            ExitCode::FAILURE
        }
    }
}

/// Writes to `to` what `from` is under gzip, packed by Zopfli: 4% smaller than by zlib.
fn gzip(from: &str, to: &str) -> anyhow::Result<()> {
    let mut packed = Vec::new();
    zopfli::compress(zopfli::Options::default(), zopfli::Format::Gzip, std::fs::read(from)?.as_slice(), &mut packed)?;
    Ok(std::fs::write(to, packed)?)
}
