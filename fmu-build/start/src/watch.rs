//! Cargo at work, with what it says along the way as text: for a line on a terminal that says how far it is.

use std::io::{self, BufReader, Read};
use std::process::{Command, ExitStatus, Stdio};
use std::thread;

/// What cargo has left behind.
pub struct Done {
    /// How it ended.
    pub status: ExitStatus,
    /// What it wrote to standard output.
    pub output: String,
    /// Errors and warnings, as it writes them for people.
    pub complaints: String,
}

/// Runs a command of cargo's that builds something; `show` gets what it is at, one line each: what it waits for, what
/// it downloads, a bar with the crates that are being compiled.
pub fn watch(mut cargo: Command, mut show: impl FnMut(&str)) -> io::Result<Done> {
    // Cargo draws no bar in a pipe, and is told here to.
    cargo.env("CARGO_TERM_QUIET", "false").env("CARGO_TERM_VERBOSE", "false").env("CARGO_TERM_COLOR", "never");
    cargo.env("CARGO_TERM_PROGRESS_WHEN", "always").env("CARGO_TERM_PROGRESS_WIDTH", "50");
    let mut child = cargo.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()?;
    let output = child.stdout.take().map(|output| thread::spawn(move || text(output)));
    let (mut complaints, mut line) = (String::new(), Vec::new());
    for byte in child.stderr.take().into_iter().flat_map(|said| BufReader::new(said).bytes()) {
        match byte? {
            // A bar ends with a return and no new line.
            b'\n' | b'\r' => {
                let text = String::from_utf8_lossy(&line);
                match kind(&text) {
                    Kind::State => show(text.trim()),
                    Kind::Step => {}
                    Kind::Complaint => complaints = complaints + &text + "\n",
                }
                line.clear();
            }
            byte => line.push(byte),
        }
    }
    let status = child.wait()?;
    let output = output.and_then(|output| output.join().ok()).unwrap_or_default();
    Ok(Done { status, output, complaints })
}

fn text(mut from: impl Read) -> String {
    let mut bytes = Vec::new();
    // What came before an error is all there is.
    let _ = from.read_to_end(&mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}

/// What a line of cargo's is.
enum Kind {
    /// What it is at.
    State,
    /// What it has begun or ended, of which there are many.
    Step,
    /// Anything else.
    Complaint,
}

fn kind(line: &str) -> Kind {
    // Cargo writes its own words flush right in twelve columns; `error` and `warning` begin a line.
    let indented = line.starts_with(' ');
    match line.split_whitespace().next() {
        Some("Blocking" | "Building" | "Downloading" | "Updating") if indented => Kind::State,
        Some("Compiling" | "Fresh" | "Finished" | "Downloaded" | "Locking" | "Adding") if indented => Kind::Step,
        None if line.is_empty() => Kind::Step,
        _ => Kind::Complaint,
    }
}
