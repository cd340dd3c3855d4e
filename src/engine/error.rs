//! What the engine cannot go on from.

/// What the engine cannot go on from; carries the numbers and the remedy.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct EngineError {
    /// For a person.
    pub message: String,
}
