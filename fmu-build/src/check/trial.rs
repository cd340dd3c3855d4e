//! The library of an FMU, tried in a process of its own: one that crashes or never comes back is a finding, not the end
//! of the check.
//!
//! This program starts itself for that. The child writes what it finds line by line, so that nothing is lost with it.

use super::report::{Report, Run};
use super::{behaviour, parse};
use crate::experiment;
use crate::importer::Imported;
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

/// One line from the child.
#[derive(Serialize, Deserialize)]
enum News {
    /// A check begins.
    Begins(String),
    /// It has ended.
    Found(String, Vec<String>),
    /// The run has ended.
    Ran(Box<Run>),
    /// That was all; a library may end the process before that without a sign.
    Over,
}

/// Tries the library of the FMU that is unpacked in `root`.
pub fn run(root: &Path, limit: Duration, report: &mut Report) {
    let mut check = "library".to_owned();
    if let Err(error) = follow(root, limit, report, &mut check) {
        report.add(&check, vec![format!("{error:#}")]);
    }
}

/// Takes over what the child finds; `check` is what it is at.
fn follow(root: &Path, limit: Duration, report: &mut Report, check: &mut String) -> Result<()> {
    let deadline = Instant::now() + limit;
    let mut child = start(root).context("cannot start a process for the library")?;
    let news = listen(&mut child);
    let mut is_over = false;
    loop {
        match news.recv_timeout(deadline.saturating_duration_since(Instant::now())) {
            Ok(News::Begins(name)) => *check = name,
            Ok(News::Found(name, findings)) => report.add(&name, findings),
            Ok(News::Ran(run)) => report.ran(*run),
            Ok(News::Over) => is_over = true,
            Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => break,
        }
    }
    match end(&mut child, deadline)? {
        None => anyhow::bail!("not over after {} s, so it was stopped (--time-limit)", limit.as_secs_f64()),
        Some(status) if status.success() && is_over => Ok(()),
        Some(status) => anyhow::bail!("the process that tried the library came to a bad end: {status}"),
    }
}

fn start(root: &Path) -> Result<Child> {
    let mut command = Command::new(std::env::current_exe()?);
    command.arg("check").arg("--trial").arg(root);
    Ok(command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn()?)
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

/// The child.
pub fn try_library(root: &Path) -> Result<()> {
    inspect(root)?;
    tell(&News::Over)
}

/// Goes through what the library does as long as what has been found lets it.
fn inspect(root: &Path) -> Result<()> {
    let description = parse(&std::fs::read_to_string(root.join("modelDescription.xml"))?)?;

    let Some(binary) = need("library", || behaviour::library(root, &description))? else { return Ok(()) };
    if !all_well("exported functions", || behaviour::missing_functions(&binary))? {
        return Ok(());
    }
    all_well("guid", || behaviour::wrong_guid_accepted(root, &description, &binary))?;
    let start_values = || {
        let instance = Imported::new(root, &description)?;
        behaviour::start_values(&description, &instance)
    };
    let Some(differences) = need("start values", start_values)? else { return Ok(()) };
    tell(&News::Found("start values".into(), differences))?;
    let run = || experiment::run(&description, &Imported::new(root, &description)?);
    let Some(outcome) = need("run", run)? else { return Ok(()) };
    tell(&News::Ran(Box::new(Run::new(&description, outcome))))
}

fn need<T>(name: &str, check: impl FnOnce() -> Result<T>) -> Result<Option<T>> {
    tell(&News::Begins(name.into()))?;
    let (value, findings) = match check() {
        Ok(value) => (Some(value), Vec::new()),
        Err(error) => (None, vec![format!("{error:#}")]),
    };
    tell(&News::Found(name.into(), findings))?;
    Ok(value)
}

fn all_well(name: &str, check: impl FnOnce() -> Vec<String>) -> Result<bool> {
    tell(&News::Begins(name.into()))?;
    let findings = check();
    let well = findings.is_empty();
    tell(&News::Found(name.into(), findings))?;
    Ok(well)
}

fn tell(news: &News) -> Result<()> {
    let mut output = std::io::stdout().lock();
    // On a line of its own, whatever the library has written.
    writeln!(output, "\n{}", serde_json::to_string(news)?)?;
    Ok(output.flush()?)
}
