//! The engine without FMI: a scene in, tables and a page to look at out.
//!
//! ```text
//! cargo run --release --example simulate -- examples/scenes/feup.toml --csv motion.csv --impacts impacts.csv --html run.html
//! ```

use clap::Parser;
use std::io::Write;
use std::process::ExitCode;

/// Solves a scene with the engine alone.
#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    simulate: pounding_simulate::Arguments,
}

fn main() -> ExitCode {
    let done = pounding_simulate::run(&Arguments::parse().simulate);
    match done.and_then(|text| Ok(std::io::stdout().write_all(text.as_bytes())?)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
