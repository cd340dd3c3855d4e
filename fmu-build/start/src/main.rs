//! `cargo fmu` begins here: compiles the program that does the work, which takes minutes the first time and nothing
//! later, and starts it. On a terminal a line says how far that is; it vanishes.

use std::ffi::OsString;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

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
    let (sender, states) = mpsc::channel();
    let line = thread::spawn(move || draw(&states));
    let done = fmu_start::watch(cargo(), |state| drop(sender.send(state.to_owned())));
    drop(sender);
    let _ = line.join();
    let done = done.map_err(|error| io::Error::other(format!("cannot start cargo: {error}")))?;
    if !done.status.success() {
        let said = done.complaints.trim_end();
        return Err(io::Error::other(format!("cargo fmu itself does not compile:\n{said}")));
    }
    let program = done.output.lines().find_map(executable);
    program.ok_or_else(|| io::Error::other("cargo did not say where it put cargo fmu itself"))
}

fn cargo() -> Command {
    // Cargo tells a program that it runs; who starts it by hand gets the checkout that it was compiled in.
    let package = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo")));
    cargo.args(["build", "--release", "--bin", "cargo-fmu", "--message-format=json-render-diagnostics"]);
    cargo.arg("--manifest-path").arg(Path::new(&package).join("../Cargo.toml"));
    cargo
}

/// The program that one of cargo's messages names.
fn executable(message: &str) -> Option<PathBuf> {
    let (path, _) = message.split_once("\"executable\":\"")?.1.split_once('"')?;
    Some(path.replace("\\\\", "\\").into())
}

/// Writes the latest state and since when it has been so to a terminal, each second; nothing elsewhere.
fn draw(states: &mpsc::Receiver<String>) {
    let mut terminal = io::stderr();
    let is_terminal = terminal.is_terminal() && std::env::var_os("TERM").is_none_or(|kind| kind != "dumb");
    let (begun, mut state) = (Instant::now(), String::new());
    loop {
        match states.recv_timeout(Duration::from_secs(1)) {
            Ok(next) => state = next,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => break,
        }
        if is_terminal && !state.is_empty() {
            let line = format!("\r\x1b[2Kcargo fmu itself: {state} ({} s)", begun.elapsed().as_secs());
            let _ = terminal.write_all(line.as_bytes());
        }
    }
    if is_terminal && !state.is_empty() {
        let _ = write!(terminal, "\r\x1b[2K");
    }
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
