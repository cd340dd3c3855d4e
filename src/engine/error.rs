//! The error of a run that the engine cannot continue.

/// A run that cannot be continued, or a state that cannot be restored: the message has the numbers and the remedy.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct EngineError {
    /// The message to the user.
    pub message: String,
}
