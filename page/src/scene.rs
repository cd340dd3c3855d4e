//! The scene of a question; what is wrong and odd in it, with lines.

use crate::message::Refusal;
use pounding::description::Package;
use pounding::record::RecordFile;
use pounding::scene::{Problem, SceneError, lines};
use pounding_simulate::scenario::Scenario;
use serde::Serialize;

/// A scene and the records that lie beside it.
pub struct Given<'q> {
    scene: &'q [u8],
    /// By the name that scenes have for them.
    records: Vec<(&'q str, &'q [u8])>,
}

/// Something that an editor shows beside a line.
#[derive(Serialize)]
pub struct Finding {
    /// `problem` or `warning`.
    kind: &'static str,
    text: String,
    path: String,
    /// Counted from 1; none where it is about no line.
    line: Option<usize>,
}

impl<'q> Given<'q> {
    /// Of the parts of a question behind the first.
    pub fn of(parts: &[&'q [u8]], names: &'q [String]) -> Given<'q> {
        let scene = parts.first().copied().unwrap_or_default();
        let records = names.iter().map(String::as_str).zip(parts.iter().skip(1).copied()).collect();
        Given { scene, records }
    }

    /// The bytes of a record.
    fn record(&self, name: &str) -> Option<Vec<u8>> {
        self.records.iter().find(|(known, _)| *known == name).map(|(_, bytes)| bytes.to_vec())
    }

    /// A record file, whose name may ask for a channel.
    pub fn record_file(&self, name: &str) -> Option<RecordFile> {
        RecordFile::find(name, |name| self.record(name))
    }

    /// The scene as it goes into an FMU.
    pub fn package(&self) -> Result<Package, SceneError> {
        let text = String::from_utf8(self.scene.to_vec()).map_err(|error| {
            let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
            Problem::new("scene", "", format!("UTF-8 text, which line {line} is not"))
        })?;
        Package::from_memory(text, |name| self.record(name))
    }

    /// The scene, ready to be run.
    pub fn scenario(&self) -> Result<Scenario, Refusal> {
        Ok(Scenario::new(self.package()?))
    }
}

/// Everything that is wrong with a scene, a line each.
pub fn problems(given: &Given<'_>) -> Vec<String> {
    given.package().err().map_or_else(Vec::new, |error| error.problems.iter().map(ToString::to_string).collect())
}

/// What looks like a slip in a scene that can be run, a line each.
pub fn warnings(given: &Given<'_>) -> Vec<String> {
    given.package().map_or_else(
        |_| Vec::new(),
        |package| Scenario::new(package).warnings().iter().map(ToString::to_string).collect(),
    )
}

/// Both, with the lines of the scene that they are about.
pub fn findings(given: &Given<'_>) -> Vec<Finding> {
    let (kind, found): (_, Vec<(String, String)>) = match given.package() {
        Ok(package) => {
            let warnings = Scenario::new(package).warnings();
            ("warning", warnings.into_iter().map(|warning| (warning.to_string(), warning.path)).collect())
        }
        Err(error) => {
            ("problem", error.problems.into_iter().map(|problem| (problem.to_string(), problem.path)).collect())
        }
    };
    let text = std::str::from_utf8(given.scene).unwrap_or_default();
    let lines = lines(text, found.iter().map(|(_, path)| path.as_str()));
    found.into_iter().zip(lines).map(|((text, path), line)| Finding { kind, text, path, line }).collect()
}
