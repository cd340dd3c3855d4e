//! What a call comes back with.

use crate::engine::EngineError;
use crate::scene::SceneError;

/// The status of a call or a message, in the numbers of the standard. Pending calls do not occur here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Done.
    Ok = 0,
    /// Of messages only: what they are about has been done.
    Warning = 1,
    /// Status information or a derivative that there is not, or a step at which a collapse has ended the run.
    Discard = 2,
    /// Refused, or failed; the instance can be reset.
    Error = 3,
    /// The instance cannot be used any more.
    Fatal = 4,
}

impl From<()> for Status {
    fn from((): ()) -> Status {
        Status::Ok
    }
}

/// Which status information a master asks for, in the words of the standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names of the standard")]
pub enum StatusKind {
    DoStepStatus,
    PendingStatus,
    LastSuccessfulTime,
    Terminated,
}

/// Why a call is refused: everything at once, one line each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// For a person: what was found and what was expected.
    pub problems: Vec<String>,
}

impl Refusal {
    /// No refusal if there is no problem.
    ///
    /// # Errors
    /// The problems, if there are any.
    pub fn unless_empty(problems: Vec<String>) -> Result<(), Refusal> {
        if problems.is_empty() { Ok(()) } else { Err(Refusal { problems }) }
    }
}

impl From<String> for Refusal {
    fn from(problem: String) -> Refusal {
        Refusal { problems: vec![problem] }
    }
}

impl From<SceneError> for Refusal {
    fn from(error: SceneError) -> Refusal {
        Refusal { problems: error.problems.iter().map(ToString::to_string).collect() }
    }
}

impl From<EngineError> for Refusal {
    fn from(error: EngineError) -> Refusal {
        Refusal::from(error.to_string())
    }
}
