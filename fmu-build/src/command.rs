//! The command line: what is done, exit codes, what is said where.

use crate::arguments::{BuildArguments, Command, TrialArguments};
use crate::face::Face;
use crate::{merge, recipe};
use std::io::{self, ErrorKind, Write};

/// What a command has to say on standard output, and whether all is well.
pub struct Verdict {
    /// With its last line break.
    pub text: String,
    /// The exit code is 0 then, else 1.
    pub well: bool,
}

impl Verdict {
    /// Of a command that has done what it should.
    pub fn done(text: String) -> Verdict {
        Verdict { text, well: true }
    }
}

/// Builds, where there is no other command.
///
/// # Errors
/// What keeps the command from being done.
pub fn run(face: &dyn Face, command: Option<Command>, build: &BuildArguments) -> anyhow::Result<Verdict> {
    match command {
        None => Ok(Verdict::done(recipe::build(face, build)?)),
        Some(Command::Merge(merge)) => Ok(Verdict::done(merge::merge([&merge.one, &merge.other], &merge.output)?)),
        Some(Command::Trial(TrialArguments { trial, fmu, directory })) => {
            trial.make(&fmu, &directory)?;
            Ok(Verdict::done(String::new()))
        }
        #[cfg(feature = "check")]
        Some(Command::Check(check)) => {
            let report = crate::trial::Trial::Check.report(face, &check.fmu, check.limit.time_limit);
            let text = if check.json { report.json()? } else { report.text() };
            Ok(Verdict { text, well: report.is_valid() })
        }
        // The alias never comes here with it.
        #[cfg(not(feature = "check"))]
        Some(Command::Check(_)) => anyhow::bail!("{} was compiled without check: expected its feature", face.name()),
    }
}

/// Does a command's work, says what came of it and returns the exit code. A panic is a bug of this program and not the
/// user's: said in one line, without the panic's own output.
pub fn carry_out(name: &str, work: impl FnOnce() -> anyhow::Result<Verdict> + std::panic::UnwindSafe) -> u8 {
    std::panic::set_hook(Box::new(|_| {}));
    let verdict = std::panic::catch_unwind(work).unwrap_or_else(|panic| Err(bug(name, panic.as_ref())));
    match verdict {
        Ok(verdict) => {
            let mut output = std::io::stdout();
            let written = output.write_all(verdict.text.as_bytes()).and_then(|()| output.flush());
            code_of(written, u8::from(!verdict.well))
        }
        Err(error) => refuse(&error),
    }
}

/// Says what a command line asks for or what is wrong with it, and returns the exit code.
pub fn say(usage: &clap::Error) -> u8 {
    let (written, code) = (usage.print(), u8::try_from(usage.exit_code()).unwrap_or(2));
    // Nobody may be there to read what is wrong with the usage.
    if usage.use_stderr() { code } else { code_of(written.and_then(|()| io::stdout().flush()), code) }
}

/// The exit code of a command that has written to standard output: 1 where what it has said is lost.
fn code_of(written: io::Result<()>, code: u8) -> u8 {
    match written {
        // A reader that has seen enough (`| head`) closes the pipe: no error of ours.
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            refuse(&anyhow::Error::new(error).context("cannot write to standard output"))
        }
        _ => code,
    }
}

fn refuse(error: &anyhow::Error) -> u8 {
    let _ = writeln!(std::io::stderr(), "error: {error:#}"); // nobody may be there to read it
    1
}

fn bug(name: &str, panic: &(dyn std::any::Any + Send)) -> anyhow::Error {
    let what = (panic.downcast_ref::<&str>().copied())
        .or_else(|| panic.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("of unknown kind");
    anyhow::anyhow!("{name} has met a bug of its own ({what}); please report it together with the scene")
}
