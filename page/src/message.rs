//! Questions, answers and refusals as bytes.
//!
//! A question is a number of parts: how many, how long each is (32-bit numbers, lowest byte first), then their bytes. The
//! first part is JSON (`desk.rs`), the others are what it speaks of: the scene, records, libraries.

use pounding::record::RecordError;
use pounding::scene::SceneError;
use serde::Serialize;

/// What comes back: bytes (JSON, or a file), and numbers.
#[derive(Debug, Default)]
pub struct Answer {
    /// JSON or a file.
    pub bytes: Vec<u8>,
    /// As the question has it.
    pub numbers: Vec<f64>,
}

impl Answer {
    /// Of something that JSON can say, and numbers beside it.
    ///
    /// # Errors
    /// What JSON cannot say.
    pub fn json(value: &impl Serialize, numbers: Vec<f64>) -> Result<Answer, Refusal> {
        let bytes = serde_json::to_vec(value).map_err(|error| Refusal::value(error.to_string()))?;
        Ok(Answer { bytes, numbers })
    }

    /// A file.
    pub fn file(bytes: Vec<u8>) -> Answer {
        Answer { bytes, numbers: Vec::new() }
    }
}

/// Why there is no answer.
#[derive(Debug, Serialize)]
pub struct Refusal {
    /// The exception that the Python module raises for the same.
    pub kind: &'static str,
    /// Each a line for a person.
    pub problems: Vec<String>,
}

impl Refusal {
    /// A value that is not fit.
    pub fn value(problem: impl Into<String>) -> Refusal {
        Refusal { kind: "ValueError", problems: vec![problem.into()] }
    }

    /// A name that there is not.
    pub fn key(problem: impl Into<String>) -> Refusal {
        Refusal { kind: "KeyError", problems: vec![problem.into()] }
    }

    /// A run that cannot go on.
    pub fn run(problem: impl ToString) -> Refusal {
        Refusal { kind: "RuntimeError", problems: vec![problem.to_string()] }
    }

    /// More than there is memory for.
    pub fn memory(problem: impl Into<String>) -> Refusal {
        Refusal { kind: "MemoryError", problems: vec![problem.into()] }
    }
}

impl From<SceneError> for Refusal {
    fn from(error: SceneError) -> Refusal {
        Refusal { kind: "ValueError", problems: error.problems.iter().map(ToString::to_string).collect() }
    }
}

/// Everything that is wrong with a record, each as `line` says it.
pub fn of_record(error: &RecordError, line: impl Fn(&str) -> String) -> Refusal {
    Refusal { kind: "ValueError", problems: error.problems.iter().map(|problem| line(problem)).collect() }
}

/// The parts of a question; none where the bytes are no question.
pub fn parts(question: &[u8]) -> Option<Vec<&[u8]>> {
    let (count, mut lengths) = number(question)?;
    let mut rest = lengths.get(count.checked_mul(4)?..)?;
    let mut parts = Vec::new();
    for _ in 0..count {
        let length;
        (length, lengths) = number(lengths)?;
        let part;
        (part, rest) = rest.split_at_checked(length)?;
        parts.push(part);
    }
    Some(parts)
}

fn number(bytes: &[u8]) -> Option<(usize, &[u8])> {
    let (first, rest) = bytes.split_first_chunk::<4>()?;
    Some((u32::from_le_bytes(*first) as usize, rest))
}
