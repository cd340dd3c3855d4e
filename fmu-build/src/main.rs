//! `cargo fmu`: compiles a scene of two pounding buildings into an FMU, checks FMUs, and merges them.
//!
//! | file | holds |
//! |---|---|
//! | `main.rs` | arguments, exit codes |
//! | `recipe.rs` | from a scene file to an FMU that has been seen to run, step by step |
//! | `merge.rs` | one FMU with the libraries of two |
//! | `workspace.rs` | where the checkout is; compiling the library with cargo |
//! | `documentation.rs` | the page about the model and the icon |
//! | `licenses.rs` | the licence texts that travel inside the FMU |
//! | `archive.rs` | the zip: writing it reproducibly, unpacking it safely |
//! | `destination.rs` | where an FMU goes: at once and whole, or not at all |
//! | `provenance.rs` | which scene the FMU at the default place is of |
//! | `platform.rs` | where FMI 2.0 wants the library of each platform, and what it is |
//! | `library.rs` | whether a library is what its folder and name say, without running it |
//! | `functions.rs` | the names of the library's C functions |
//! | `c_interface.rs` | the library's C functions, called by hand (the only unsafe code here) |
//! | `importer.rs` | the same through an importer that is not ours |
//! | `log.rs` | what an FMU says through its logger |
//! | `experiment.rs` | one run of an FMU over its default experiment, through either |
//! | `summary.rs` | what happened in that run, for a person |
//! | `went_in.rs` | what went into it |
//! | `trial.rs` | an FMU tried in a process of its own, for as long as it may take |
//! | `channel.rs` | what that process reports, which the FMU's library cannot |
//! | `bounded.rs` | as many texts of an FMU as a person reads |
//! | `report.rs` | what a trial has found, for a person and for a program |
//! | `check/` | `cargo fmu check`: what is wrong with an FMU |
#![deny(unsafe_code)]

mod archive;
mod bounded;
#[allow(unsafe_code)]
mod c_interface;
mod channel;
mod check;
mod destination;
mod documentation;
mod experiment;
mod functions;
mod importer;
mod library;
mod licenses;
mod log;
mod merge;
mod platform;
mod progress;
mod provenance;
mod recipe;
mod report;
mod summary;
mod trial;
mod went_in;
mod workspace;

use clap::{Args, Parser, Subcommand};
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;
use trial::Trial;

/// Compiles a scene into an FMU (FMI 2.0, co-simulation), runs it once and says what happened.
#[derive(Parser)]
#[command(name = "cargo fmu", bin_name = "cargo fmu", version, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    build: BuildArguments,
}

#[derive(Subcommand)]
enum Command {
    /// Opens an FMU with an independent importer, validates it and runs it; exit code 1 where anything is wrong.
    Check(CheckArguments),
    /// Makes one FMU of two that hold the same but for their libraries, which are for different platforms.
    Merge(MergeArguments),
    /// For this program itself, in a process of its own: tries an FMU.
    #[command(hide = true)]
    Trial { trial: Trial, fmu: PathBuf, directory: PathBuf },
}

#[derive(Args)]
struct BuildArguments {
    /// The scene; without it, examples/scenes/feup.toml.
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// Where the FMU goes, in a directory that is made if need be; without it, target/fmu/NAME.fmu (NAME: the scene's).
    #[arg(short, long, value_name = "FILE.fmu")]
    output: Option<PathBuf>,
    #[command(flatten)]
    limit: Limit,
}

#[derive(Args)]
struct CheckArguments {
    /// The FMU.
    #[arg(value_name = "FILE.fmu")]
    fmu: PathBuf,
    /// Findings for a program to read, as docs/check.schema.json describes them.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    limit: Limit,
}

#[derive(Args)]
struct MergeArguments {
    /// One FMU.
    #[arg(value_name = "A.fmu")]
    one: PathBuf,
    /// The other: the same scene, built with the same version for another platform.
    #[arg(value_name = "B.fmu")]
    other: PathBuf,
    /// Where the merged FMU goes, in a directory that is made if need be.
    #[arg(short, long, value_name = "C.fmu")]
    output: PathBuf,
}

#[derive(Args)]
struct Limit {
    /// How long the FMU may take to be tried, its run included; then it is stopped, and that is a failure.
    #[arg(long, value_name = "SECONDS", default_value = "300", value_parser = seconds)]
    time_limit: Duration,
}

/// What a command has to say on standard output, and whether all is well.
struct Verdict {
    text: String,
    well: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    std::panic::set_hook(Box::new(|_| {}));
    let verdict = std::panic::catch_unwind(|| run(arguments)).unwrap_or_else(|panic| Err(bug(panic.as_ref())));
    match verdict {
        Ok(verdict) => {
            // A reader that has seen enough (`| head`) closes the pipe: no error of ours.
            let _ = std::io::stdout().write_all(verdict.text.as_bytes());
            if verdict.well { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(Arguments { command, build }: Arguments) -> anyhow::Result<Verdict> {
    let done = |text| Ok(Verdict { text, well: true });
    match command {
        None => done(recipe::build(build.scene.as_deref(), build.output.as_deref(), build.limit.time_limit)?),
        Some(Command::Merge(merge)) => done(merge::merge([&merge.one, &merge.other], &merge.output)?),
        Some(Command::Trial { trial, fmu, directory }) => {
            trial.make(&fmu, &directory)?;
            done(String::new())
        }
        Some(Command::Check(check)) => {
            let report = Trial::Check.report(&check.fmu, check.limit.time_limit);
            let text = if check.json { report.json()? } else { report.text() };
            Ok(Verdict { text, well: report.is_valid() })
        }
    }
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    // Far below where the clock ends.
    let seconds = seconds.filter(|seconds| !seconds.is_zero() && seconds.as_secs() < 1 << 40);
    seconds.ok_or_else(|| "expected a number of seconds > 0".to_owned())
}

/// A panic is a bug of this program and not the user's: said in one line, without the panic's own output.
fn bug(panic: &(dyn std::any::Any + Send)) -> anyhow::Error {
    let what = (panic.downcast_ref::<&str>().copied())
        .or_else(|| panic.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("of unknown kind");
    anyhow::anyhow!("cargo fmu has met a bug of its own ({what}); please report it together with the scene")
}
