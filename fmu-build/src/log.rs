//! What an FMU says through its logger.

use crate::bounded::Bounded;
use std::sync::Mutex;

/// Messages with a status other than OK, one `category: text` each, until somebody takes them: the first of them,
/// and how many more there were.
#[derive(Default)]
pub struct Log(Mutex<Bounded>);

impl Log {
    /// Notes a message.
    pub fn note(&self, category: &str, text: &str) {
        self.messages().push(&format!("{category}: {text}"));
    }

    /// Empties the log.
    pub fn take(&self) -> Vec<String> {
        std::mem::take(&mut *self.messages()).listed()
    }

    /// Empties the log into what it adds to an error message.
    pub fn explanation(&self) -> String {
        let messages = self.take();
        if messages.is_empty() { String::new() } else { format!(": {}", messages.join("; ")) }
    }

    fn messages(&self) -> std::sync::MutexGuard<'_, Bounded> {
        self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }
}
