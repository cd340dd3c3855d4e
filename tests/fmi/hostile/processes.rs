//! Cases in processes that may crash or hang: the only way to survive that, and to see all of them.
//!
//! A process takes a stretch of the cases, for most of its time would go into its start. It says which case it begins; where
//! it ends before its stretch does, that case has failed, and another process goes on behind it.

use std::env;
use std::io::{BufRead, BufReader};
use std::ops::Range;
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

/// Longer than any case should take on a busy machine, by far.
const TIME_LIMIT: Duration = Duration::from_secs(20);

/// Cases of a process. What a case maps stays mapped until the process ends, and there is a limit to that.
const STRETCH: usize = 50;

/// Tells a process which cases it is for: from the first of two numbers to before the second.
const CASES: &str = "HOSTILE_CASES";

/// Begins a line that says which case begins.
const BEGINS: &str = "case ";

/// The cases of this process, if it is one that has been started for some.
pub fn assigned() -> Option<Range<usize>> {
    let cases = env::var(CASES).ok()?;
    let (start, end) = cases.split_once(' ').unwrap();
    Some(start.parse().unwrap()..end.parse().unwrap())
}

/// Says which case begins.
pub fn begin(place: usize) {
    eprintln!("{BEGINS}{place}");
}

/// Runs one test of this executable again for each stretch of the cases; what went wrong, in the order of the cases.
pub fn run_each(names: &[&str], test: &str) -> Vec<String> {
    let (next, failures) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let workers = thread::available_parallelism().map_or(2, |n| n.get().min(8));
    let work = || {
        loop {
            let start = STRETCH * next.fetch_add(1, Ordering::Relaxed);
            let mut cases = start..names.len().min(start + STRETCH);
            if cases.is_empty() {
                return;
            }
            while let Some((place, problem)) = first_failure(&cases, test) {
                failures.lock().unwrap().push((place, format!("{}: {problem}", names[place])));
                cases.start = place + 1;
            }
        }
    };
    thread::scope(|scope| (0..workers).for_each(|_| drop(scope.spawn(work))));
    let mut failures = failures.into_inner().unwrap();
    failures.sort();
    failures.into_iter().map(|(_, failure)| failure).collect()
}

/// The first of these cases that fails in a process for them, and how.
fn first_failure(cases: &Range<usize>, test: &str) -> Option<(usize, String)> {
    if cases.is_empty() {
        return None;
    }
    let child = Command::new(env::current_exe().unwrap())
        .args(["--exact", test, "--nocapture", "--test-threads=1"])
        .env(CASES, format!("{} {}", cases.start, cases.end))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn();
    let Outcome { begun, said, end } = outcome(child.unwrap());
    let problem = end.err().or((begun != cases.len()).then(|| "ended too early".to_owned()))?;
    Some((cases.start + begun.saturating_sub(1), format!("{problem}\n{}", indented(&said))))
}

struct Outcome {
    /// How many cases have begun.
    begun: usize,
    /// Since the last of them.
    said: String,
    end: Result<(), String>,
}

/// Waits for the end of a process, or ends it.
fn outcome(mut child: Child) -> Outcome {
    let stderr = BufReader::new(child.stderr.take().unwrap());
    let (sender, lines) = channel();
    let reader = thread::spawn(move || {
        stderr.split(b'\n').map_while(Result::ok).for_each(|line| drop(sender.send(line)));
    });
    let (mut begun, mut said, mut limit) = (0, String::new(), Instant::now() + TIME_LIMIT);
    let is_stuck = loop {
        match lines.recv_timeout(limit.saturating_duration_since(Instant::now())) {
            Ok(line) if line.starts_with(BEGINS.as_bytes()) => {
                (begun, limit) = (begun + 1, Instant::now() + TIME_LIMIT);
                said.clear();
            }
            Ok(line) => said += &format!("{}\n", String::from_utf8_lossy(&line)),
            Err(RecvTimeoutError::Disconnected) => break false,
            Err(RecvTimeoutError::Timeout) => break true,
        }
    };
    if is_stuck {
        child.kill().unwrap();
    }
    let status = child.wait().unwrap();
    reader.join().unwrap();
    let end = match status.success() {
        _ if is_stuck => Err(format!("not done after {} s", TIME_LIMIT.as_secs())),
        true => Ok(()),
        false => Err(status.to_string()),
    };
    Outcome { begun, said, end }
}

/// Without the frames of the call, of which there are many.
fn indented(said: &str) -> String {
    let lines = said.lines().take_while(|line| !line.starts_with("stack backtrace"));
    lines.filter(|line| !line.is_empty()).map(|line| format!("    {line}\n")).collect()
}
