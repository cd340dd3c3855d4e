//! FMUs tried in a process of their own: an archive, a description or a library that crashes it or never comes back is
//! a finding, not the end of this program.
//!
//! This program starts itself for that. The child writes what it finds line by line, so that nothing is lost with it.

use crate::check;
use crate::experiment::Outcome;
use crate::recipe;
use crate::report::Report;
use anyhow::{Context, Result};
use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// What is done with an FMU.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Trial {
    /// `cargo fmu check`.
    Check,
    /// The run after building.
    Run,
}

/// One line from the child.
#[derive(Serialize, Deserialize)]
enum News {
    /// A check begins.
    Begins(String),
    /// It has ended.
    Found(String, Vec<String>),
    /// The run has ended.
    Ran(Box<Outcome>),
    /// That was all; a library may end the process before that without a sign.
    Over,
}

impl Trial {
    /// What a child finds that is stopped when the time is up.
    pub fn report(self, fmu: &Path, limit: Duration) -> Report {
        let mut report = Report::new(fmu);
        let mut check = "archive".to_owned();
        if let Err(error) = self.follow(fmu, limit, &mut report, &mut check) {
            report.add(&check, vec![format!("{error:#}")]);
        }
        report
    }

    /// Takes over what the child finds; `check` is what it is at.
    fn follow(self, fmu: &Path, limit: Duration, report: &mut Report, check: &mut String) -> Result<()> {
        let deadline = Instant::now() + limit;
        // Here and not in the child, which may not live to clear it away.
        let directory = TempDir::with_prefix("fmu-").context("cannot make a temporary directory")?;
        let mut child = self.start(fmu, directory.path()).context("cannot start a process for the FMU")?;
        let news = listen(&mut child);
        let mut is_over = false;
        loop {
            match news.recv_timeout(deadline.saturating_duration_since(Instant::now())) {
                Ok(News::Begins(name)) => *check = name,
                Ok(News::Found(name, findings)) => report.add(&name, findings),
                Ok(News::Ran(outcome)) => report.ran(*outcome),
                Ok(News::Over) => is_over = true,
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => break,
            }
        }
        match end(&mut child, deadline)? {
            None => anyhow::bail!("not over after {} s, so it was stopped (--time-limit)", limit.as_secs_f64()),
            Some(status) if status.success() && is_over => Ok(()),
            Some(status) => anyhow::bail!("the process that tried the FMU came to a bad end: {status}"),
        }
    }

    fn start(self, fmu: &Path, directory: &Path) -> Result<Child> {
        let mut command = Command::new(std::env::current_exe()?);
        let name = self.to_possible_value().context("a trial without a name")?;
        command.arg("trial").arg(name.get_name()).arg(fmu).arg(directory);
        Ok(command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn()?)
    }

    /// The child: tries an FMU, which it unpacks in an empty directory.
    pub fn make(self, fmu: &Path, directory: &Path) -> Result<()> {
        std::thread::spawn(end_with_parent);
        match self {
            Trial::Check => check::inspect(fmu, directory)?,
            Trial::Run => recipe::try_out(fmu, directory)?,
        }
        tell(&News::Over)
    }
}

/// In the child: the parent holds the other end of its input, and who is killed lets go of it. There is nobody to stop
/// this process then.
fn end_with_parent() {
    let _ = std::io::copy(&mut std::io::stdin(), &mut std::io::sink());
    std::process::exit(1);
}

/// What the child writes, without whatever else comes from its library.
fn listen(child: &mut Child) -> mpsc::Receiver<News> {
    let (sender, news) = mpsc::channel();
    if let Some(output) = child.stdout.take() {
        std::thread::spawn(move || {
            let lines = BufReader::new(output).lines().map_while(Result::ok);
            for item in lines.filter_map(|line| serde_json::from_str(&line).ok()) {
                if sender.send(item).is_err() {
                    break;
                }
            }
        });
    }
    news
}

/// How the child has ended; `None` where it had to be stopped.
fn end(child: &mut Child, deadline: Instant) -> Result<Option<ExitStatus>> {
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if Instant::now() >= deadline {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// In the child: a step that the next ones need. Its error is a finding, its value what they go on with.
pub fn need<T>(name: &str, check: impl FnOnce() -> Result<T>) -> Result<Option<T>> {
    tell(&News::Begins(name.into()))?;
    let (value, findings) = match check() {
        Ok(value) => (Some(value), Vec::new()),
        Err(error) => (None, vec![format!("{error:#}")]),
    };
    tell(&News::Found(name.into(), findings))?;
    Ok(value)
}

/// In the child: a check that the next ones do not need, and whether all is well.
pub fn look(name: &str, check: impl FnOnce() -> Vec<String>) -> Result<bool> {
    tell(&News::Begins(name.into()))?;
    let findings = check();
    let well = findings.is_empty();
    tell(&News::Found(name.into(), findings))?;
    Ok(well)
}

/// In the child: what a run has shown.
pub fn ran(outcome: Outcome) -> Result<()> {
    tell(&News::Ran(Box::new(outcome)))
}

fn tell(news: &News) -> Result<()> {
    let mut output = std::io::stdout().lock();
    // On a line of its own, whatever the library has written.
    writeln!(output, "\n{}", serde_json::to_string(news)?)?;
    Ok(output.flush()?)
}
