//! The command `pounding-fmu`: as `cargo fmu`, with the libraries of the wheel, and the runs of `simulate`.

use anyhow::anyhow;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use fmu_build::arguments::{self, BuildArguments};
use fmu_build::command::{self, Verdict};
use fmu_build::face::{Face, Home};
use fmu_build::libraries::Shipped;
use pyo3::prelude::*;
use std::error::Error;
use std::ffi::OsString;
use std::io;
use std::path::PathBuf;
use std::process::Command;

/// Makes an FMU of a scene (FMI 2.0 or 3.0, co-simulation), runs it once and says what happened.
#[derive(Parser)]
#[command(name = "pounding-fmu", bin_name = "pounding-fmu", version, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Commands>,
    #[command(flatten)]
    build: BuildArguments,
}

#[derive(Subcommand)]
enum Commands {
    #[command(flatten)]
    OfFmus(arguments::Command),
    /// Solves a scene without making an FMU of it: tables, and a page to look at.
    Simulate(pounding_simulate::Arguments),
    /// Solves a scene and makes a page of the run: one file that any browser shows, without a network.
    Report(pounding_simulate::ReportArguments),
}

/// The command of the wheel.
struct PoundingFmu {
    /// What starts it again.
    again: Vec<OsString>,
    /// The files that came with it.
    data: PathBuf,
}

impl Face for PoundingFmu {
    fn name(&self) -> &'static str {
        "pounding-fmu"
    }

    fn again(&self) -> io::Result<Command> {
        let (program, arguments) = self.again.split_first().ok_or(io::ErrorKind::NotFound)?;
        let mut command = Command::new(program);
        command.args(arguments);
        Ok(command)
    }

    fn home(&self) -> anyhow::Result<Home> {
        Ok(Home {
            default_scene: self.data.join("scenes").join("feup.toml"),
            fmus: PathBuf::new(),
            has_notes: false,
            libraries: Box::new(Shipped(self.data.join("libraries"))),
        })
    }
}

/// Does what the arguments say, the first of which is the program, and returns the exit code. The help of the whole
/// command begins with `overview`, which knows the commands in Python, too.
#[pyfunction]
pub fn run_command(
    py: Python<'_>,
    arguments: Vec<OsString>,
    again: Vec<OsString>,
    data: PathBuf,
    overview: String,
) -> u8 {
    py.detach(|| {
        let command = Arguments::command().before_help(overview).help_template("{before-help}{options}\n");
        let parsed = command.try_get_matches_from(arguments).and_then(|found| Arguments::from_arg_matches(&found));
        let arguments = match parsed {
            Ok(arguments) => arguments,
            Err(usage) => return command::say(&usage),
        };
        let face = PoundingFmu { again, data };
        command::carry_out(face.name(), || run(&face, arguments))
    })
}

fn run(face: &PoundingFmu, Arguments { command, build }: Arguments) -> anyhow::Result<Verdict> {
    match command {
        None => command::run(face, None, &build),
        Some(Commands::OfFmus(command)) => command::run(face, Some(command), &build),
        Some(Commands::Simulate(arguments)) => done(pounding_simulate::run(&arguments)),
        Some(Commands::Report(arguments)) => done(pounding_simulate::report(&arguments)),
    }
}

fn done(text: Result<String, Box<dyn Error>>) -> anyhow::Result<Verdict> {
    text.map(Verdict::done).map_err(|error| anyhow!("{error}"))
}
