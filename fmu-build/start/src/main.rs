//! `cargo fmu` begins here: compiles the program that does the work, with the library that it packs, and starts it. That
//! takes a minute the first time and nothing later. On a terminal a line says how far that is; it vanishes.

use fmu_start::{Line, compile};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

fn main() -> ExitCode {
    match compiled().and_then(|program| go_on(Command::new(program).args(std::env::args_os().skip(1)))) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Where `cargo fmu` itself is, compiled.
fn compiled() -> io::Result<PathBuf> {
    let line = Line::start();
    line.work("cargo fmu itself");
    // Cargo tells a program that it runs; who starts it by hand gets the checkout that it was compiled in.
    let package = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
    let checkout = Path::new(&package).ancestors().nth(2).ok_or_else(|| io::Error::other("no checkout is above it"))?;
    let with_check = std::env::args_os().nth(1).is_some_and(|argument| argument == "check");
    let compiled = compile(checkout, with_check, |state| line.state(state));
    let compiled = compiled.map_err(|error| io::Error::other(format!("cargo fmu itself: {error}")))?;
    let program = compiled.command().map(Path::to_path_buf);
    program.ok_or_else(|| io::Error::other("cargo did not say where it put cargo fmu itself"))
}

/// Becomes the program.
#[cfg(unix)]
fn go_on(program: &mut Command) -> io::Result<ExitCode> {
    Err(std::os::unix::process::CommandExt::exec(program))
}

/// Runs the program and ends as it does.
#[cfg(not(unix))]
fn go_on(program: &mut Command) -> io::Result<ExitCode> {
    let code = program.status()?.code().and_then(|code| u8::try_from(code).ok());
    Ok(code.map_or(ExitCode::FAILURE, ExitCode::from))
}
