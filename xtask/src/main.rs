//! The project's own copy of the wasm-bindgen tools, so that Rust and Node are all that a machine needs:
//! `xtask bindgen ARGS` is `wasm-bindgen`, `xtask test-runner ARGS` is `wasm-bindgen-test-runner`, `xtask snip IN OUT`
//! makes a file smaller before the former.

mod snip;

use std::env::args_os;
use std::process::ExitCode;

use wasm_bindgen_cli::{wasm_bindgen, wasm_bindgen_test_runner};

fn main() -> ExitCode {
    let mut arguments = args_os().skip(1).peekable();
    let tool = arguments.peek().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let outcome = match tool.as_str() {
        "bindgen" => wasm_bindgen::run_cli_with_args(arguments),
        "snip" => match &arguments.map(|path| path.to_string_lossy().into_owned()).collect::<Vec<_>>()[..] {
            [_, from, to] => snip::snip(from, to),
            _ => Err(anyhow::anyhow!("snip takes two paths: IN and OUT")),
        },
        "test-runner" => wasm_bindgen_test_runner::run_cli_with_args(arguments),
        _ => {
            eprintln!("unknown tool {tool:?}: it is `bindgen`, `snip` or `test-runner`");
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
