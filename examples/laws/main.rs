//! Free impacts under every law: the tables of docs/laws.md, and the numbers of its picture.
//!
//! ```text
//! cargo run --release --example laws                        # writes the tables into docs/laws.md
//! cargo run --release --example laws -- --csv target/laws   # writes curves.csv and outcomes.csv there instead
//! ```

mod curves;
mod impact;
mod tables;

use clap::Parser;
use impact::Failure;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Runs a free impact under every law.
#[derive(Parser)]
struct Arguments {
    /// Write the numbers of the picture here instead of the tables into docs/laws.md.
    #[arg(long, value_name = "FOLDER")]
    csv: Option<PathBuf>,
}

fn main() -> ExitCode {
    let result = match &Arguments::parse().csv {
        Some(folder) => curves::write(folder),
        None => renew(&Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/laws.md")),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn renew(file: &Path) -> Result<(), Failure> {
    let document = std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
    std::fs::write(file, tables::renewed(&document)?)?;
    println!("wrote {}", file.display());
    Ok(())
}
