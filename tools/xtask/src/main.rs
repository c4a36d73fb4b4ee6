//! The project's own copy of the WebAssembly tools, so that Rust and Node are all that a machine needs:
//! `xtask bindgen ARGS` is `wasm-bindgen`, `xtask test-runner ARGS` is `wasm-bindgen-test-runner`, `xtask gzip IN OUT` packs a file.

use std::env::args_os;
use std::path::Path;
use std::process::ExitCode;

use wasm_bindgen_cli::{wasm_bindgen, wasm_bindgen_test_runner};

fn main() -> ExitCode {
    let arguments: Vec<_> = args_os().skip(1).collect();
    let tool = arguments.first().map(|name| name.to_string_lossy()).unwrap_or_default();
    let outcome = match (tool.as_ref(), &arguments[..]) {
        ("bindgen", _) => wasm_bindgen::run_cli_with_args(&arguments),
        ("test-runner", _) => wasm_bindgen_test_runner::run_cli_with_args(&arguments),
        ("gzip", [_, from, to]) => gzip(from.as_ref(), to.as_ref()),
        _ => Err(anyhow::anyhow!("xtask bindgen ARGS, xtask test-runner ARGS or xtask gzip IN OUT")),
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
fn gzip(from: &Path, to: &Path) -> anyhow::Result<()> {
    let mut packed = Vec::new();
    zopfli::compress(zopfli::Options::default(), zopfli::Format::Gzip, std::fs::read(from)?.as_slice(), &mut packed)?;
    Ok(std::fs::write(to, packed)?)
}
