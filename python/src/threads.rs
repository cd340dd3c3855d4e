//! Work beside Python: other Python threads go on meanwhile, and Ctrl-C ends the work.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::any::Any;
use std::convert::Infallible;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread::{self, Builder};
use std::time::Duration;

/// How long Ctrl-C may wait to be seen.
const TICK: Duration = Duration::from_millis(100);

/// Does `work` on so many threads, each of which ends soon after it has been told to stop. Meanwhile the calling thread
/// looks for Ctrl-C, and calls `tick`, ten times a second; an exception of either stops the work.
///
/// # Errors
/// That exception, or that no thread can be started.
pub fn work_on(
    py: Python<'_>,
    threads: usize,
    work: impl Fn(&AtomicBool) + Send + Sync,
    mut tick: impl FnMut(Python<'_>) -> PyResult<()> + Send,
) -> PyResult<()> {
    let (stop, bug) = (AtomicBool::new(false), OnceLock::new());
    py.detach(|| {
        thread::scope(|scope| {
            let (running, ended) = mpsc::channel::<Infallible>();
            for started in 0..threads {
                let running = running.clone();
                let (work, stop, bug) = (&work, &stop, &bug);
                let body = move || {
                    if let Err(message) = caught(|| work(stop)) {
                        stop.store(true, Ordering::Relaxed);
                        let _ = bug.set(message); // one is enough
                    }
                    drop(running);
                };
                match Builder::new().spawn_scoped(scope, body) {
                    Ok(_) => {}
                    Err(error) if started == 0 => {
                        return Err(PyRuntimeError::new_err(format!("no thread can be started: {error}")));
                    }
                    Err(_) => break, // those that run share the work
                }
            }
            drop(running);
            let mut result = Ok(());
            while ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                if result.is_ok() {
                    result = Python::attach(|py| py.check_signals().and_then(|()| tick(py)));
                    stop.fetch_or(result.is_err(), Ordering::Relaxed);
                }
            }
            result
        })
    })?;
    bug.into_inner().map_or(Ok(()), |message| Err(PyRuntimeError::new_err(message)))
}

/// What work returns, or its panic in one line: a bug of ours, not the user's.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| bug(panic.as_ref()))
}

fn bug(panic: &(dyn Any + Send)) -> String {
    let what = (panic.downcast_ref::<&str>().copied())
        .or_else(|| panic.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("of unknown kind");
    format!("pounding_fmu has met a bug of its own ({what}); please report it together with the scene")
}
