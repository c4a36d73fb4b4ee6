//! Remakes the experiments of the three papers: prints their tables and writes `target/reproduce/index.html`, with each figure
//! next to what the paper states. `npm run reproduce`, or `npm run reproduce -- --quick`.
#![forbid(unsafe_code)]

mod ardeshiri;
mod data;
mod gestures;
#[cfg(test)]
mod headlines;
mod liang;
mod movement;
mod random;
mod report;
mod rezaie_li;

use clap::Parser;
use presentation::{ProgressBar, progress, write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// How many tracks and runs.
#[derive(Clone, Copy, Debug)]
pub enum Effort {
    /// As many as in the papers.
    Full,
    /// Enough to check that everything works.
    Quick,
}

/// Remakes the experiments of the three papers and writes target/reproduce/index.html.
#[derive(Parser)]
#[command(name = "npm run reproduce --")]
struct Arguments {
    /// Fewer tracks and runs: under a minute.
    #[arg(long)]
    quick: bool,
    /// Where to write every number behind the page as JSON, too: comparisons, tables, and the points of every line.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// A folder for the same as CSV, a file for each figure and table.
    #[arg(long, value_name = "FOLDER")]
    csv: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), String> {
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    let start = Instant::now();
    let work = rezaie_li::work(effort) + liang::work(effort) + ardeshiri::work(effort);
    let progress = progress(work, String::new());
    let papers: [fn(Effort, &ProgressBar) -> report::Chapter; 3] =
        [liang::chapter, ardeshiri::chapter, rezaie_li::chapter];
    let chapters = papers.map(|chapter| {
        let chapter = chapter(effort, &progress);
        progress.suspend(|| {
            println!("\n{}\n", chapter.citation);
            chapter.exhibits.iter().for_each(report::Exhibit::print);
        });
        chapter
    });
    progress.finish_and_clear();
    let introduction = format!(
        "Each figure and table of the three papers that can be remade without their private recordings, next to what the paper states. \
         Seeded: every run has the same numbers, but for the run times.{}",
        if matches!(effort, Effort::Quick) { " This is a quick run with fewer tracks." } else { "" }
    );
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/reproduce/index.html");
    write(&file, &report::page(&chapters, &introduction))?;
    println!("target/reproduce/index.html ({:.0} s)", start.elapsed().as_secs_f64());
    if let Some(file) = &arguments.json {
        write(file, &format!("{:#}\n", data::json(&chapters)))?;
        println!("{}", file.display());
    }
    if let Some(folder) = &arguments.csv {
        let names = data::csv(&chapters, folder)?;
        println!("{}: {}", folder.display(), names.join(", "));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_help_is_what_scripts_print_without_compiling() {
        let help = Arguments::command().term_width(100).render_long_help().to_string();
        assert_eq!(include_str!("../help.txt"), help, "tools/reproduce/help.txt has to be:\n{help}");
    }
}
