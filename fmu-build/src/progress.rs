//! Progress on a terminal, silence in a pipe.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::Write;
use std::time::Duration;

/// A line on the terminal's standard error that says what is going on; it vanishes when dropped.
pub struct Progress(ProgressBar);

impl Progress {
    /// Nothing is drawn where standard error is not a terminal.
    pub fn start() -> Progress {
        let bar = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {wide_msg}") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(100));
        Progress(bar)
    }

    /// Lines on standard error that stay.
    pub fn say(&self, lines: &[String]) {
        self.0.suspend(|| {
            for line in lines {
                // Nobody may be there to read it.
                let _ = writeln!(std::io::stderr(), "{line}");
            }
        });
    }

    /// What is being done from now on.
    pub fn step(&self, what: &'static str) {
        self.0.reset_elapsed();
        self.0.set_message(what);
    }

    /// How far that is.
    pub fn state(&self, what: &'static str, state: &str) {
        self.0.set_message(format!("{what}: {state}"));
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
