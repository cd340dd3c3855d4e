//! A line on a terminal that says what is going on, and since when; it vanishes. Nothing is drawn elsewhere.

use std::io::{self, IsTerminal, Write};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// The line; gone when dropped.
pub struct Line {
    messages: Option<Sender<Message>>,
    drawn: Option<JoinHandle<()>>,
}

enum Message {
    /// What is done from now on, and since now.
    Work(String),
    /// How far that is.
    State(String),
    /// Text above the line, which stays.
    Said(String),
}

impl Line {
    /// Nothing is on it yet.
    pub fn start() -> Line {
        let (messages, received) = mpsc::channel();
        Line { messages: Some(messages), drawn: Some(thread::spawn(move || draw(&received))) }
    }

    /// What is done from now on.
    pub fn work(&self, what: &str) {
        self.send(Message::Work(what.to_owned()));
    }

    /// How far that is.
    pub fn state(&self, state: &str) {
        self.send(Message::State(state.to_owned()));
    }

    /// Writes to standard error, terminal or not.
    pub fn say(&self, text: &str) {
        self.send(Message::Said(text.to_owned()));
    }

    fn send(&self, message: Message) {
        // Who draws lives as long as the line.
        let _ = self.messages.as_ref().map(|messages| messages.send(message));
    }
}

impl Drop for Line {
    fn drop(&mut self) {
        self.messages = None;
        let _ = self.drawn.take().map(JoinHandle::join);
    }
}

/// Draws the line each second, and when something changes, until nobody is there to change it.
fn draw(messages: &mpsc::Receiver<Message>) {
    let mut terminal = io::stderr();
    let is_terminal = terminal.is_terminal() && std::env::var_os("TERM").is_none_or(|kind| kind != "dumb");
    let (mut work, mut state, mut begun) = (String::new(), String::new(), Instant::now());
    // Nobody may be there to read it.
    let mut write = |text: String| drop(terminal.write_all(text.as_bytes()));
    loop {
        match messages.recv_timeout(Duration::from_secs(1)) {
            Ok(Message::Work(what)) => (work, state, begun) = (what, String::new(), Instant::now()),
            Ok(Message::State(next)) => state = next,
            Ok(Message::Said(text)) => write(format!("{}{text}\n", if is_terminal { CLEARED } else { "" })),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => break,
        }
        if is_terminal && !work.is_empty() {
            let colon = if state.is_empty() { "" } else { ": " };
            write(format!("{CLEARED}{work}{colon}{state} ({} s)", begun.elapsed().as_secs()));
        }
    }
    if is_terminal && !work.is_empty() {
        write(CLEARED.to_owned());
    }
}

/// The beginning of an empty line.
const CLEARED: &str = "\r\x1b[2K";
