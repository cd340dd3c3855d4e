//! Cases in processes of their own: the only way to survive a crash or a hang, and to see all of them.

use std::env;
use std::io::Read;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// Longer than any case should take on a busy machine, by far.
const TIME_LIMIT: Duration = Duration::from_secs(20);

/// Runs one test of this executable again for each case, with the case's place in a variable of the environment; what
/// went wrong, in the order of the cases.
pub fn run_each(names: &[&str], variable: &str, test: &str) -> Vec<String> {
    let (next, failures) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let workers = thread::available_parallelism().map_or(2, |n| n.get().min(8));
    let work = || {
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(name) = names.get(place) else { return };
            let child = Command::new(env::current_exe().unwrap())
                .args(["--exact", test, "--nocapture", "--test-threads=1"])
                .env(variable, place.to_string())
                .stdin(Stdio::null())
                .stdout(Stdio::null())
                .stderr(Stdio::piped())
                .spawn();
            if let Err(problem) = outcome(child.unwrap()) {
                failures.lock().unwrap().push((place, format!("{name}: {problem}")));
            }
        }
    };
    thread::scope(|scope| (0..workers).for_each(|_| drop(scope.spawn(work))));
    let mut failures = failures.into_inner().unwrap();
    failures.sort();
    failures.into_iter().map(|(_, failure)| failure).collect()
}

/// Waits for the end of a process, or ends it.
fn outcome(mut child: Child) -> Result<(), String> {
    let mut stderr = child.stderr.take().unwrap();
    let reader = thread::spawn(move || {
        let mut said = String::new();
        let _ = stderr.read_to_string(&mut said);
        said
    });
    let status = wait(&mut child);
    let said = reader.join().unwrap();
    match status {
        Some(status) if status.success() => Ok(()),
        Some(status) => Err(format!("{status}\n{}", indented(&said))),
        None => Err(format!("not done after {} s\n{}", TIME_LIMIT.as_secs(), indented(&said))),
    }
}

fn wait(child: &mut Child) -> Option<ExitStatus> {
    let started = Instant::now();
    let mut pause = Duration::from_micros(500);
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return Some(status);
        }
        if started.elapsed() > TIME_LIMIT {
            child.kill().unwrap();
            child.wait().unwrap();
            return None;
        }
        thread::sleep(pause);
        pause = (2 * pause).min(Duration::from_millis(20));
    }
}

/// Without the frames of the call, of which there are many.
fn indented(said: &str) -> String {
    let lines = said.lines().take_while(|line| !line.starts_with("stack backtrace"));
    lines.filter(|line| !line.is_empty()).map(|line| format!("    {line}\n")).collect()
}
