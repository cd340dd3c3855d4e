//! From the process that tries an FMU to the one that has started it.
//!
//! The library of the FMU is in the same process and may write wherever it likes, end it or close what is open. So the
//! channel is not its standard output, each line of it begins with a word that the library is not told, and a report
//! counts only when it is complete. This is no wall: code that searches the memory of its process finds the word.

use crate::bounded::Bounded;
use anyhow::{Context, Result};
use pounding_simulate::outcome::Outcome;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::hash::{BuildHasher, RandomState};
use std::io::{self, BufRead, BufReader, Read, Stdin, Write};
use std::sync::mpsc::{self, Receiver};
use std::thread;

/// Bytes of a line: the values of the largest building that can be solved are a tenth of it.
const LONGEST_LINE: u64 = 1 << 26;

/// One line.
#[derive(Serialize, Deserialize)]
pub enum News {
    /// A check begins.
    Begins(String),
    /// It has ended.
    Found(String, Bounded),
    /// The run has ended.
    Ran(Box<Outcome>),
    /// That was all, from the process of that number: a library may have made two of it, and ended the first.
    Over(u32),
}

/// A word that nobody guesses.
pub fn secret() -> String {
    // The keys of each state are random numbers from the operating system.
    let number = || RandomState::new().hash_one(0_u8);
    format!("{:016x}{:016x}", number(), number())
}

/// What comes through the channel in lines that begin with the secret.
pub fn listen(from: impl Read + Send + 'static, secret: String) -> Receiver<News> {
    let (sender, news) = mpsc::channel();
    thread::spawn(move || {
        let mut from = BufReader::new(from);
        let mut line = Vec::new();
        while matches!((&mut from).take(LONGEST_LINE).read_until(b'\n', &mut line), Ok(1..)) {
            let item = line.strip_prefix(secret.as_bytes()).and_then(|item| serde_json::from_slice(item).ok());
            if item.is_some_and(|item| sender.send(item).is_err()) {
                break;
            }
            line.clear();
        }
    });
    news
}

/// The end at which news go in.
pub struct Channel {
    file: File,
    secret: String,
}

impl Channel {
    /// Takes the standard output of this process for itself and reads the secret from its input. What a library writes to
    /// its output goes with its errors from now on.
    pub fn open(input: &mut BufReader<Stdin>) -> Result<Channel> {
        let mut secret = String::new();
        input.read_line(&mut secret).context("nobody has started this trial")?;
        Ok(Channel { file: own_output()?, secret: secret.trim_end().to_owned() })
    }

    /// A step that the next ones need. Its error is a finding, its value what they go on with.
    pub fn need<T>(&self, name: &str, check: impl FnOnce() -> Result<T>) -> Result<Option<T>> {
        self.tell(&News::Begins(name.into()))?;
        let (value, findings) = match check() {
            Ok(value) => (Some(value), Vec::new()),
            Err(error) => (None, vec![format!("{error:#}")]),
        };
        self.tell(&News::Found(name.into(), findings.into()))?;
        Ok(value)
    }

    /// A check that the next ones do not need, and whether all is well.
    pub fn look(&self, name: &str, check: impl FnOnce() -> Vec<String>) -> Result<bool> {
        self.tell(&News::Begins(name.into()))?;
        let findings = check();
        let well = findings.is_empty();
        self.tell(&News::Found(name.into(), findings.into()))?;
        Ok(well)
    }

    /// What a run has shown.
    pub fn ran(&self, outcome: Outcome) -> Result<()> {
        self.tell(&News::Ran(Box::new(outcome)))
    }

    /// Says something.
    pub fn tell(&self, news: &News) -> Result<()> {
        // On a line of its own, whatever the library has written there.
        let line = format!("\n{}{}\n", self.secret, serde_json::to_string(news)?);
        Ok((&self.file).write_all(line.as_bytes())?)
    }
}

#[cfg(unix)]
fn own_output() -> io::Result<File> {
    use std::os::fd::AsFd;
    let output = io::stdout().as_fd().try_clone_to_owned()?;
    rustix::stdio::dup2_stdout(io::stderr())?;
    Ok(output.into())
}

#[cfg(windows)]
fn own_output() -> io::Result<File> {
    use std::os::windows::io::AsHandle;
    Ok(io::stdout().as_handle().try_clone_to_owned()?.into())
}
