//! What takes long, in slices.

use crate::message::{Answer, Refusal};

/// Work under way.
pub trait Job: Send {
    /// Does so many of its pieces and answers with what they have brought. JSON with `done`, which is true after the last one.
    ///
    /// # Errors
    /// What keeps it from going on.
    fn go_on(&mut self, pieces: usize) -> Result<Answer, Refusal>;
}
