//! `cargo fmu`: in a checkout, compiles the library and makes FMUs with it; checks FMUs, and merges them.

mod workspace;

use clap::Parser;
use fmu_build::arguments::{BuildArguments, Command};
use fmu_build::command;
use fmu_build::face::{Face, Home};
use std::process::ExitCode;
use workspace::Workspace;

/// Compiles a scene into an FMU (FMI 2.0 or 3.0, co-simulation), runs it once and says what happened.
#[derive(Parser)]
#[command(name = "cargo fmu", bin_name = "cargo fmu", version, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    build: BuildArguments,
}

struct CargoFmu;

impl Face for CargoFmu {
    fn name(&self) -> &'static str {
        "cargo fmu"
    }

    fn again(&self) -> std::io::Result<std::process::Command> {
        // Where Linux says what runs, that is still there when another `cargo fmu` has compiled a new program in its place.
        let running = std::path::Path::new("/proc/self/exe");
        let program = if running.exists() { running.to_path_buf() } else { std::env::current_exe()? };
        Ok(std::process::Command::new(program))
    }

    fn home(&self) -> anyhow::Result<Home> {
        let workspace = Workspace::find()?;
        Ok(Home {
            default_scene: workspace.default_scene(),
            fmus: workspace.fmus(),
            has_notes: true,
            libraries: Box::new(workspace),
        })
    }
}

pub(crate) fn main() -> ExitCode {
    ExitCode::from(match Arguments::try_parse() {
        Ok(Arguments { command, build }) => {
            command::carry_out(CargoFmu.name(), || command::run(&CargoFmu, command, &build))
        }
        Err(usage) => command::say(&usage),
    })
}
