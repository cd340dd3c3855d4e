//! FMUs tried in a process of their own: an archive, a description or a library that crashes it or never comes back is
//! a finding, not the end of this program.
//!
//! The command starts itself for that. The child reports what it finds line by line, so that nothing is lost with it.

pub mod channel;
mod report;
mod run;

use crate::bounded::Bounded;
#[cfg(feature = "check")]
use crate::check;
use crate::face::Face;
use anyhow::{Context, Result, bail};
use channel::{Channel, News};
use clap::ValueEnum;
use report::Report;
use std::io::{self, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ExitStatus, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// How often a child is looked after that says nothing.
const PAUSE: Duration = Duration::from_millis(20);
/// For what a child has said before it ended.
const LAST_WORDS: Duration = Duration::from_millis(500);
/// Bytes of a library's own output that are shown.
const SHOWN: u64 = 500;

/// What is done with an FMU.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Trial {
    /// `cargo fmu check`.
    #[cfg(feature = "check")]
    Check,
    /// The run after building.
    Run,
}

impl Trial {
    /// What a child finds that is stopped when the time is up.
    pub fn report(self, face: &dyn Face, fmu: &Path, limit: Duration) -> Report {
        let mut report = Report::new(fmu);
        let mut check = "archive".to_owned();
        if let Err(error) = self.follow(face, fmu, limit, &mut report, &mut check) {
            report.add(&check, Bounded::from(vec![format!("{error:#}")]));
        }
        report
    }

    /// Takes over what the child finds; `check` is what it is at.
    fn follow(
        self,
        face: &dyn Face,
        fmu: &Path,
        limit: Duration,
        report: &mut Report,
        check: &mut String,
    ) -> Result<()> {
        let deadline = Instant::now() + limit;
        // Here and not in the child, which may not live to clear it away.
        let directory = TempDir::with_prefix("fmu-").context("cannot make a temporary directory")?;
        let mut trial = self.start(face, fmu, directory.path()).context("cannot start a process for the FMU")?;
        let mut is_over = false;
        while let Some(news) = trial.next(deadline)? {
            match news {
                News::Begins(name) => *check = name,
                News::Found(name, findings) => report.add(&name, findings),
                News::Ran(outcome) => report.ran(*outcome),
                News::Over(process) => is_over = process == trial.child.id(),
            }
        }
        match trial.end(deadline)? {
            None => bail!("not over after {} s, so it was stopped (--time-limit)", limit.as_secs_f64()),
            Some(status) if status.success() && is_over && report.is_complete(self.checks()) => Ok(()),
            Some(status) => {
                let said = trial.output();
                bail!("the process that tried the FMU came to a bad end before all was tried: {status}{said}")
            }
        }
    }

    fn start(self, face: &dyn Face, fmu: &Path, directory: &Path) -> Result<Running> {
        let mut command = face.again()?;
        let name = self.to_possible_value().context("a trial without a name")?;
        // A library may go elsewhere.
        command.arg("trial").arg(name.get_name()).arg(fmu).arg(std::path::absolute(directory)?);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        // What a library starts goes with it.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command.spawn()?;
        let secret = channel::secret();
        // The child ends when this pipe is closed: it stays open as long as the child is wanted.
        child.stdin.as_mut().context("no input")?.write_all(format!("{secret}\n").as_bytes())?;
        let news = channel::listen(child.stdout.take().context("no output")?, secret);
        let output = collect(child.stderr.take().context("no errors")?);
        Ok(Running { child, news, output })
    }

    /// What is tried where nothing is found.
    fn checks(self) -> &'static [&'static str] {
        match self {
            #[cfg(feature = "check")]
            Trial::Check => &check::CHECKS,
            Trial::Run => &["run"],
        }
    }

    /// The child: tries an FMU, which it unpacks in an empty directory.
    pub fn make(self, fmu: &Path, directory: &Path) -> Result<()> {
        let mut input = BufReader::new(io::stdin());
        let channel = Channel::open(&mut input)?;
        std::thread::spawn(move || end_with_parent(input));
        match self {
            #[cfg(feature = "check")]
            Trial::Check => check::inspect(fmu, directory, &channel)?,
            Trial::Run => run::try_out(fmu, directory, &channel)?,
        }
        channel.tell(&News::Over(std::process::id()))
    }
}

/// In the child: the parent holds the other end of its input, and who is killed lets go of it. There is nobody to stop
/// this process then.
fn end_with_parent(mut input: impl Read) {
    let _ = io::copy(&mut input, &mut io::sink());
    std::process::exit(1);
}

/// The child, as the parent has it.
struct Running {
    child: Child,
    news: Receiver<News>,
    output: Receiver<String>,
}

impl Running {
    /// The next that it reports; `None` where there is no more or the time is up.
    fn next(&mut self, deadline: Instant) -> Result<Option<News>> {
        loop {
            match self.news.recv_timeout(PAUSE) {
                Ok(news) => return Ok(Some(news)),
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
                Err(RecvTimeoutError::Timeout) if Instant::now() >= deadline => return Ok(None),
                // Its channel may outlive it in what the library has started.
                Err(RecvTimeoutError::Timeout) if self.child.try_wait()?.is_some() => {
                    return Ok(self.news.recv_timeout(LAST_WORDS).ok());
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }

    /// How it has ended; `None` where it had to be stopped.
    fn end(&mut self, deadline: Instant) -> Result<Option<ExitStatus>> {
        let status = loop {
            match self.child.try_wait()? {
                None if Instant::now() < deadline => std::thread::sleep(PAUSE),
                status => break status,
            }
        };
        self.stop()?;
        Ok(status)
    }

    /// Ends it and what the library has started.
    fn stop(&mut self) -> io::Result<()> {
        #[cfg(unix)]
        // None left is as good.
        let _ = rustix::process::kill_process_group(
            rustix::process::Pid::from_child(&self.child),
            rustix::process::Signal::KILL,
        );
        self.child.kill()?;
        self.child.wait().map(drop)
    }

    /// What the library has written.
    fn output(&self) -> String {
        let said = self.output.recv_timeout(LAST_WORDS).unwrap_or_default();
        if said.is_empty() { String::new() } else { format!("; its output begins {said:?}") }
    }
}

/// The beginning of what comes from there. All of it is read: who writes shall not wait.
fn collect(mut from: impl Read + Send + 'static) -> Receiver<String> {
    let (sender, output) = mpsc::channel();
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        let _ = (&mut from).take(SHOWN).read_to_end(&mut bytes);
        let _ = sender.send(String::from_utf8_lossy(&bytes).trim().to_owned());
        let _ = io::copy(&mut from, &mut io::sink());
    });
    output
}
