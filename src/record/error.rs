//! What is wrong with a record file.

/// A record file that cannot be read: everything that is wrong with it; displayed with one problem a line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", problems.join("\n"))]
#[non_exhaustive]
pub struct RecordError {
    /// What is wrong, with line and value, in the order of the file: the first [`super::MOST_PROBLEMS`], then how many more
    /// there are.
    pub problems: Vec<String>,
}

impl RecordError {
    pub(super) fn new(problem: impl Into<String>) -> RecordError {
        RecordError { problems: vec![problem.into()] }
    }
}
